#!/usr/bin/env python3
"""The methods at other settings, on other cuts than method_comparison: every parameter at five settings
(results/method_comparison_parameters) and, where they exist beside it, the parts of warp_and_refine (method_comparison_ablation) and
all methods by a smaller chord tolerance (method_comparison_fine)."""

import sys
from functools import partial
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import load, naming
from analysis.methods import comparison, details, same_cut
from analysis.methods.comparison import AGAINST, OURS, counts_of, ranking, read_cuts, summary
from figures.methods import sweeps

STEM = "method_comparison_parameters"
PARAMETERS = ("What each method's parameter changes, medians: lower is better. The aspect ratio is that of the triangles outside forced wedges. "
         "A marker without a line: bound 0, which sets no bound, or a variant without a parameter.")
ABLATION = ("The parts of warp_and_refine: the steps before the split (rows) and after it (columns). Medians. AR: of the triangles "
            "outside forced wedges.")


def main():
    folder = load.results_folder(STEM, __doc__)
    defaults = {(m["name"], f"{m['parameter']['name']}={m['parameter']['default']:g}") for m in same_cut.all_methods() if m["parameter"]}
    tables, counts = {}, {}
    for stem, draw, what in ((STEM, partial(sweeps.draw_parameters, defaults=defaults), PARAMETERS),
                             ("method_comparison_ablation", sweeps.draw_ablation, ABLATION),
                             ("method_comparison_fine", None, "")):
        if stem != STEM and not (folder.with_name(stem) / "records.csv").is_file():
            continue
        run, table = read_cuts(folder.with_name(stem))
        counts[stem] = counts[f"{AGAINST}_fine"] = counts_of(run)
        ranks = ranking(table, naming.sheet_order(table["sheet"]), counts[stem])
        order = list(ranks.index)
        if draw:
            draw(folder, table, f"{what} {naming.provenance(run, run.rows, with_crosses=False, per=[])}")
        else:
            tables[f"{AGAINST}_fine"] = details.against(table, next(v for v in order if v[0] == OURS), order)
        tables[stem] = summary(table, None, order, ranks)
    comparison.write_tables(folder, STEM, tables, counts)


if __name__ == "__main__":
    main()
