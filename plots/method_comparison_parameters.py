#!/usr/bin/env python3
"""The methods at other settings, on other cuts than method_comparison: every parameter at five settings
(results/method_comparison_parameters) and, where they exist beside it, the parts of warp_and_refine (method_comparison_ablation) and
all methods by a smaller chord tolerance (method_comparison_fine)."""

from functools import partial

import method_comparison
import method_gallery
from common import load, style
from method_comparison import AGAINST, OURS, ranking, read_cuts, summary
from method_parts import details, sweeps

STEM = "method_comparison_parameters"
PARAMETERS = ("What each method's parameter changes, medians: lower is better. The aspect ratio is that of the triangles outside forced wedges. "
         "A marker without a line: bound 0, which sets no bound, or a variant without a parameter.")
ABLATION = ("The parts of warp_and_refine: the steps before the split (rows) and after it (columns). Medians. AR: of the triangles "
            "outside forced wedges.")


def main():
    folder = load.results_folder(STEM, __doc__)
    defaults = {(m["name"], f"{m['parameter']['name']}={m['parameter']['default']:g}") for m in method_gallery.all_methods() if m["parameter"]}
    tables = {}
    for stem, draw, what in ((STEM, partial(sweeps.draw_parameters, defaults=defaults), PARAMETERS),
                             ("method_comparison_ablation", sweeps.draw_ablation, ABLATION),
                             ("method_comparison_fine", None, "")):
        if stem != STEM and not (folder.with_name(stem) / "records.csv").is_file():
            continue
        run, table = read_cuts(folder.with_name(stem))
        ranks = ranking(table, style.sheet_order(table["sheet"]))
        order = list(ranks.index)
        if draw:
            draw(folder, table, f"{what} {style.provenance(run, run.rows, with_crosses=False, per=[])}")
        else:
            tables[f"{AGAINST}_fine"] = details.against(table, next(v for v in order if v[0] == OURS), order)
        tables[stem] = summary(table, None, order, ranks)
    method_comparison.write_tables(folder, STEM, tables)


if __name__ == "__main__":
    main()
