#!/usr/bin/env python3
"""Writes results/report.html, one file without links to others: every figure and table of the project beside the paper's
claims, with the findings, the verdicts and the commands. It uses the runs in results/, or else the project's own runs in
results/reference/, and states what has not been run."""

import argparse
import base64
import html
import io
import json
import sys
from dataclasses import dataclass
from pathlib import Path

from PIL import Image

import claims
import contact_sheet
import fig8_edge_quality as fig8
from common import fall, load, render, style

STYLE = """
body{font:16px/1.5 system-ui,sans-serif;margin:0 auto;padding:1rem;max-width:64rem;color:#1c1c1c;background:#fff}
h1{font-size:1.6rem;line-height:1.2}h2{font-size:1.25rem;margin:2.5rem 0 .5rem;border-top:2px solid #1c1c1c;padding-top:.6rem}
nav a{display:inline-block;margin:0 .8rem .3rem 0}code{font-size:.85em;background:#f2f2f2;padding:.1em .3em;overflow-wrap:anywhere}
.paper{border-left:4px solid #0072b2;padding-left:.8rem;color:#333}.wide{overflow-x:auto}
table{border-collapse:collapse;font-size:.85rem}td,th{padding:.25rem .6rem .25rem 0;text-align:left;vertical-align:top;border-bottom:1px solid #ddd}
td.n,th.n{text-align:right}.figures{display:flex;flex-wrap:wrap;gap:1rem;align-items:flex-start}
figure{margin:0;flex:1 1 20rem;max-width:30rem}figure img{width:100%;height:auto}figcaption{font-size:.8rem;color:#555}
@media(max-width:45rem){.claims tr{display:block;border-bottom:1px solid #999;padding:.4rem 0}.claims td{display:block;border:0}
.claims tr:first-child{display:none}.claims td:first-child{font-style:italic}}
.held,.not,.cond,.untested{font-weight:700;padding:.05rem .4rem;border-radius:.2rem;white-space:nowrap}
.held{background:#d6efd9}.not{background:#f8d4d0}.cond{background:#fdecc4}.untested{background:#e6e6e6}
"""


@dataclass(frozen=True)
class Section:
    title: str
    paper: str  # what it shows and claims
    stem: str
    figures: tuple  # names of PNGs, those that matter most first
    find: object = None  # a function of the results' folder, to (verdict, text, table or None), or None: not run


def escape(text):
    """Text with `commands` and **stress**, as HTML."""
    parts = html.escape(text).split("`")
    text = "".join(f"<code>{p}</code>" if i % 2 else p for i, p in enumerate(parts))
    parts = text.split("**")
    return "".join(f"<b>{p}</b>" if i % 2 else p for i, p in enumerate(parts))


def badge(verdict):
    kind = {"held": "held", "not held": "not", "failed": "not", "ran to the end": "untested", "untested": "untested", "not run": "untested"}.get(verdict, "cond")
    word, _, condition = verdict.partition(": ")
    return f'<span class="{kind}">{escape(word)}</span>{" " + escape(condition) if condition else ""}'


def table_of(columns, rows):
    def cell(tag, value):
        number = not isinstance(value, str)
        return f'<{tag}{" class=n" if number else ""}>{escape(load.number(value) if number else value)}</{tag}>'
    head = "".join(cell("th", c) for c in columns)
    body = "".join(f"<tr>{''.join(cell('td', c) for c in row)}</tr>" for row in rows)
    return f'<div class="wide"><table><tr>{head}</tr>{body}</table></div>'


# --- pictures ------------------------------------------------------------------------------------------------------


def picture_of(results, stem, name):
    """(file, whether it is one of the project's own runs), or None."""
    for file, reference in ((results / stem / f"{name}.png", False), (results / f"{name}.png", False),
                            (results / "reference" / f"{name}.png", True)):
        if file.is_file():
            return file, reference
    return None


def inlined(file):
    """A data URI: stills as WebP, a third of the PNG's size; animations as they are."""
    data = file.read_bytes()
    if file.suffix == ".png":
        buffer = io.BytesIO()
        Image.open(file).convert("RGB").save(buffer, "WEBP", quality=88, method=4)
        data = buffer.getvalue()
    return "data:image/webp;base64," + base64.b64encode(data).decode("ascii")


def figure_of(file, note):
    with Image.open(file) as image:
        width, height = image.size
    return (f'<figure><img src="{inlined(file)}" width="{width}" height="{height}" alt="{escape(file.stem)}">'
            f"<figcaption>{escape(file.stem)}{escape(note)}</figcaption></figure>")


# --- what was found ------------------------------------------------------------------------------------------------


def claim_rows(results):
    """{words of a claim: (verdict, evidence, whose run)}, of this machine's runs first."""
    rows = {}
    for folder, whose in ((results / "reference", "the project's own run"), (results, "run here")):
        try:
            text = (folder / "claims.md").read_text(encoding="utf-8")
        except OSError:
            continue
        for line in text.splitlines():
            cells = [c.strip() for c in line.strip("|").split(" | ")]
            if line.startswith("| ") and len(cells) >= 3 and cells[1].startswith("**"):
                rows[cells[0]] = cells[1].strip("*"), cells[2], whose
    return rows


def claims_table(results, stem=None):
    """HTML of all claims, or of those that a stem's records test; None where there are none."""
    known, rows = claim_rows(results), []
    for claim in claims.CLAIMS:
        if stem not in (None, claim.stem):
            continue
        verdict, evidence, whose = known.get(claim.words, ("untested", f"`experiments/reproduce {claim.stem}` makes the "
                                                           "records", "not run"))
        rows.append(f"<tr><td>{escape(claim.words)}</td><td>{badge(verdict)}</td><td>{escape(evidence)} <i>({whose})</i>"
                    "</td></tr>")
    if not rows:
        return None
    return ('<div class="wide"><table class="claims"><tr><th>the paper claims</th><th>verdict</th><th>found</th></tr>'
            + "".join(rows) + "</table></div>")


def simulations(results, stem):
    """[(folder, description)] of a stem's scenes, method by method."""
    return [(f.parent, render.read_description(f.parent)) for f in sorted((results / stem).glob(f"{stem}*/*/simulation.json"))]


def runs_of(stem, extra=lambda results: ""):
    """Whether all simulations of a stem ran to the end, and a table of them. There is no verdict on the paper's words about
    them, which name no measure."""
    def find(results):
        made = simulations(results, stem)
        if not made:
            return None
        rows = [[d["scene"].replace("_", " "), d["method"], ", ".join(c["status"] for c in d["cuts"]),
                 str(d["triangles_after"]), str(d["unknowns"]), d["verdict"]] for _, d in made]
        failed = sum(d["verdict"] != "ok" for _, d in made)
        return ("failed" if failed else "ran to the end",
                f"{len(made) - failed} of {len(made)} simulations ran to the end without a failure (solver, inverted "
                f"triangles, energy growth above 1 %). {extra(results)}".strip(),
                table_of(["scene", "method", "cuts", "triangles after", "unknowns", "verdict"], rows))
    return find


def fall_of(stem):
    def sentence(results):
        folders = [f for f, d in simulations(results, stem) if d["scene"] in ("falling_piece", "fig6_partial_and_cutout_cutout")]
        return fall.sentence(folders)
    return sentence


def swirl(results):
    if not simulations(results, fig8.STEM) or not fig8.Reference(results / fig8.STEM).is_there():
        return None
    rows, worth = fig8.measured(results / fig8.STEM)
    table = [[fig8.SCENES[scene].replace("\n", " "), f"{time:g}", " ".join(method).strip(), mm, degrees, worth[scene, time][1],
              verdict] for scene, time, method, mm, degrees, verdict in rows]
    return ("held" if fig8.swirls(rows) else "not held", fig8.answer(rows),
            table_of(["scene", "time, s", "method", "distance of the lips, mm", "angle, degrees",
                      f"sheet of {fig8.COARSER} triangles, degrees", "verdict"], table))


def level_of_detail(results):
    made = {d["method"]: d for _, d in simulations(results, "fig10_level_of_detail")}
    if not {"conventional_split", contact_sheet.METHOD} <= set(made):
        return None
    before = made["conventional_split"]["triangles_before"]
    ours, plain = made[contact_sheet.METHOD]["unknowns"], made["conventional_split"]["unknowns"]
    uncut = 3 * (round((before / 2) ** 0.5) + 1) ** 2
    share = (ours - plain) / uncut
    return ("held" if share <= claims.FEW else "not held",
            f"The paper's method with one round of local split needs {ours} unknowns, the conventional split {plain}: the difference is "
            f"{100 * share:.0f} % of the {uncut} unknowns of the uncut sheet ('small' here: at most {100 * claims.FEW:g} %). All "
            "exact methods cut through the same points, so that no incision is finer than another.",
            table_of(["method", "triangles", "unknowns"], [[m, str(d["triangles_after"]), str(d["unknowns"])]
                                                           for m, d in made.items()]))


def paper_times(_):
    paper = load.pd.read_csv(load.REPOSITORY / "results/published/table1.csv")
    return "", "The paper's numbers (i7-4790S, 3.2 GHz, one core); ours are in the figures and claims here.", table_of(
        ["triangles", "geometry, ms", "solver, ms", "total, ms"],
        [[str(int(r.triangles)), r.geometry_ms, r.solver_ms, r.total_ms] for r in paper.itertuples()])


def text_file(name):
    """A table that a program printed, as it is."""
    def find(results):
        for file in (results / name.partition(".")[0] / name, results / "reference" / name):
            if file.is_file():
                return "", "", f'<div class="wide"><pre>{html.escape(file.read_text(encoding="utf-8"))}</pre></div>'
        return None
    return find


SECTIONS = [
    Section("Figure 5: single cuts", "Shows a straight and a curved cut in a sheet of 800 triangles: 'realistic and accurate "
            "cut surfaces with arbitrary shapes even in low-resolution meshes'.", "fig5_single_cuts",
            ("fig5_single_cuts", "fig5_single_cuts_mesh"), runs_of("fig5_single_cuts")),
    Section("Figure 6: cut from a side, part cut out", "Shows a cut from a side and a part that is cut out; 'each subdivided "
            "mesh subsequently has an independent deformation basis function'.", "fig6_partial_and_cutout",
            ("fig6_partial_and_cutout", "fig6_partial_and_cutout_mesh"),
            runs_of("fig6_partial_and_cutout", fall_of("fig6_partial_and_cutout"))),
    Section("Figure 7: re-cut and several cuts", "Shows intersected cuts and several cuts in one sheet: 'robust simulation of "
            "complex cuts'.", "fig7_recut_and_multiple", ("fig7_recut_and_multiple", "fig7_recut_and_multiple_mesh"),
            runs_of("fig7_recut_and_multiple")),
    Section("Figure 8: the cut edge", "'With simply subdividing intersected elements without further optimization, it leads to "
            "a swirling cut edge. In contrast, our method provides smooth, physically accurate incisions.'", fig8.STEM,
            (f"{fig8.STEM}_lips", fig8.STEM, f"{fig8.STEM}_mesh"), swirl),
    Section("Figure 9: aspect ratio", "Compares the maximum aspect ratio after a cut with conventional subdivision's; the "
            "conclusion says a maximum, the text a 'low average aspect ratio (less than 3)'.", "fig9_aspect_ratio",
            ("fig9_aspect_ratio", "fig9_aspect_ratio_mean")),
    Section("Table 1: computation time", "Geometry 0.865 to 4.130 ms and 'solver' 0.203 to 0.853 ms a cut, from 800 to 12800 "
            "triangles.", "table1_timing", ("table1_timing", "table1_timing_in_motion", "table1_timing_phases",
                                            "table1_timing_sheets"), paper_times),
    Section("Figure 10: level of detail", "Shows finer triangles round the incision than by conventional subdivision, 'with a "
            "small number of additional DOFs'.", "fig10_level_of_detail",
            ("fig10_level_of_detail", "fig10_level_of_detail_error"), level_of_detail),
    Section("Accuracy", "'A stable and physically accurate incision'; it gives no measure. Here: problems with exact solutions.",
            "accuracy", ("accuracy", "accuracy_budgets", "accuracy_problems", "accuracy_profile", "accuracy_shape",
                         "accuracy_unknowns")),
    Section("Verification", "No comparison with exact solutions.", "verification", ("verification_extrapolated", "verification")),
    Section("Progressive cut", "4.2: the path passes through one element in step i and through the next in step i + 1.",
            "progressive_cut", ("progressive_cut", "progressive_cut_mesh"), runs_of("progressive_cut")),
    Section("Cut picked on the deformed sheet", "4.1.1: control points are picked on the surface and carried to the rest shape.",
            "picked_cut", ("picked_cut", "picked_cut_mesh"), runs_of("picked_cut")),
    Section("Falling piece", "Pieces separate and move independently.", "falling_piece", ("falling_piece", "falling_piece_mesh"),
            runs_of("falling_piece", fall_of("falling_piece"))),
    Section("All scenes and their energy budgets", "The paper shows a video and no energies.", "",
            ("contact_sheet", "energy_budget")),
    Section("Robustness", "'Robust simulation of complex cuts': no number of trials is given.", "robustness", (),
            text_file("robustness.txt")),
]


# --- the page ------------------------------------------------------------------------------------------------------


def section_of(results, number, section):
    command = f"experiments/reproduce {section.stem}".strip()
    parts = [f'<section id="s{number}"><h2>{escape(section.title)}</h2>', f'<p class="paper">The paper: {escape(section.paper)}</p>']
    found = section.find(results) if section.find else None
    table = claims_table(results, section.stem) if section.stem else None
    pictures = [p for p in (picture_of(results, section.stem, name) for name in section.figures) if p]
    animations = sorted((results / section.stem).glob("*.webp")) if section.stem else []
    if found:
        verdict, text, cells = found
        parts.append(f"<p>{badge(verdict) + ' ' if verdict else ''}{escape(text)}</p>")
    if table:
        parts.append(table)
    if not (found or pictures):
        parts.append(f"<p>{badge('not run')} There are no results.</p>")
    shown = [figure_of(file, " (the project's own run)" if reference else "") for file, reference in pictures]
    parts.append(f'<div class="figures">{"".join(shown + [figure_of(a, ", animated") for a in animations])}</div>')
    if found and cells:
        parts.append(cells)
    return "\n".join([*parts, f"<p>Command: <code>{escape(command)}</code></p></section>"]), [p for p, _ in pictures]


def other_figures(results, used):
    """All other figures in the results, so that the page shows everything that was run."""
    files = [f for folder in sorted(results.glob("*/")) for f in sorted(folder.glob("*.png"))]
    names = {f.name for f in used}
    more = [f for f in files if f not in used and f.name not in names]
    if not more:
        return ""
    shown = "".join(figure_of(f, f" ({f.parent.name})") for f in more)
    return f'<section id="more"><h2>More figures</h2><div class="figures">{shown}</div></section>'


def provenance(results):
    rows = []
    for file in sorted([*results.glob("*/context.json"), *results.glob("reference/*.context.json")]):
        try:
            context = json.loads(file.read_text(encoding="utf-8"))
        except (OSError, ValueError):
            continue
        whose = "the project's own run" if file.parent.name == "reference" else "run here"
        stem = file.name.partition(".")[0] if file.parent.name == "reference" else file.parent.name
        rows.append([stem, whose, load.pasteable(str(context.get("command"))), str(context.get("seed")), str(context.get("commit"))[:10]
                     + (" with uncommitted changes" if context.get("dirty") else ""), str(context.get("cpu"))])
    return table_of(["records", "whose", "command", "seed", "commit", "machine"], rows) if rows else ""


def page(results):
    sections, used = [], []
    for number, section in enumerate(SECTIONS):
        text, pictures = section_of(results, number, section)
        sections.append(text)
        used += pictures
    links = "".join(f'<a href="#s{i}">{escape(s.title)}</a>' for i, s in enumerate(SECTIONS))
    return "\n".join([
        '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        '<link rel="icon" href="data:,">'
        f"<title>cutbench: the paper, put to the test</title><style>{STYLE}</style></head><body>",
        "<h1>cutbench: the paper, put to the test</h1>",
        "<p>Xin, Marris, Mihut, Ushaw, Morgan: <i>Accurate Real-time Complex Cutting in Finite Element Modeling</i>, 2018. "
        "This page shows each figure and the table of the paper, and further experiments of this project, with the findings and "
        "the commands. All numbers and verdicts are computed from records; only the descriptions of the paper are written by "
        "hand.</p>",
        f"<p>{escape(style.AR_DEFINITION)} Other terms: <code>docs/measuring.md</code>.</p>",
        f"<nav>{links}</nav>",
        f"<h2>The paper's claims</h2>{claims_table(results)}",
        *sections, other_figures(results, used),
        f"<section><h2>Runs</h2>{provenance(results)}</section>", "</body></html>", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, metavar="DIR", default=load.REPOSITORY / "results",
                        help="holds the folders of the runs and reference/, receives report.html (default: results)")
    path = parser.parse_args().results / "report.html"
    text = page(path.parent)
    load.write_page(path, text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
