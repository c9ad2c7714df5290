"""The page: its parts one below the other, with the style sheet and the scripts beside this file inside."""

import html
import json
from pathlib import Path

from analysis import load, naming
from pages.report import chart, claim_lines, comparison
from pages.report.markup import badge, escape, figure_of, picture_of, table_of
from pages.report.sections import SECTIONS

HERE = Path(__file__).parent
SCRIPTS = ["state.js", "table.js", "chart.js", "main.js"]
ELSEWHERE = ("whole_step", "readme_")  # beginnings of the names of figures that the chart and README.md show
ALONE = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'"  # the page asks no network


def section_of(results, section):
    """A figure of the paper: its title and verdict, the rest folded. Also the pictures it shows."""
    command = f"experiments/reproduce {section.stem}".strip()
    found = section.find(results) if section.find else None
    pictures = [p for p in (picture_of(results, section.stem, name) for name in section.figures) if p]
    animations = sorted((results / section.stem).glob("*.webp")) if section.stem else []
    verdict = found[0] if found else "" if pictures else "not run"
    parts = [f'<details id="paper-{section.stem or "scenes"}"><summary><h3>{escape(section.title)}</h3> '
             f"{badge(verdict) if verdict else ''}</summary>", f'<p class="paper">The paper: {escape(section.paper)}</p>']
    if found and found[1]:
        parts.append(f"<p>{escape(found[1])}</p>")
    if not (found or pictures):
        parts.append("<p>There are no results.</p>")
    shown = [figure_of(file, " (the project's own run)" if reference else "") for file, reference in pictures]
    parts.append(f'<div class="figures">{"".join(shown + [figure_of(a, ", animated") for a in animations])}</div>')
    if found and found[2]:
        parts.append(found[2])
    return "\n".join([*parts, f"<p>Command: <code>{escape(command)}</code></p></details>"]), [p for p, _ in pictures]


def other_figures(results, used):
    """All other figures in the results but those that the page draws itself, so that it shows everything that was run."""
    files = [f for folder in sorted(results.glob("*/")) for f in sorted(folder.glob("*.png"))]
    names = {f.name for f in used}
    more = [f for f in files if f not in used and f.name not in names and not f.name.startswith(ELSEWHERE)]
    if not more:
        return ""
    shown = "".join(figure_of(f, f" ({f.parent.name})") for f in more)
    return f'<details id="more"><summary><h3>More figures</h3></summary><div class="figures">{shown}</div></details>'


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


def data(name, value):
    """JSON for a script; `<` is escaped, so that no text ends the element."""
    text = json.dumps(value, separators=(",", ":")).replace("<", "\\u003c")
    return f'<script type="application/json" id="{name}">{text}</script>'


def heading(name, title):
    return f'<h2 id="{name}">{escape(title)} <a class="here" href="#{name}" aria-label="link to: {escape(title)}">#</a></h2>'


def comparison_part(results):
    """The table and the chart; the scripts fill them."""
    table, points = comparison.Comparison(results).as_json(), chart.as_json(results)
    if not table["methods"]:
        return (heading("table", "All methods") + f"<p>{badge('not run')} <code>experiments/reproduce method_comparison</code> "
                "makes the records.</p>", "")
    parts = [heading("table", "All methods"), (HERE / "table.html").read_text(encoding="utf-8"), data("comparison", table)]
    if points:
        parts += [heading("chart", "Time against error"), (HERE / "chart.html").read_text(encoding="utf-8"), data("points", points)]
    scripts = "".join(f"<script>{(HERE / name).read_text(encoding='utf-8')}</script>" for name in SCRIPTS)
    return "\n".join(parts), scripts


def page(results):
    sections, used = [], []
    for section in SECTIONS:
        text, pictures = section_of(results, section)
        sections.append(text)
        used += pictures
    methods, scripts = comparison_part(results)
    there = [("table", "All methods"), ("chart", "Time against error"), ("claims", "The paper's claims"), ("figures", "Figures"),
             ("runs", "Runs")]
    links = "".join(f'<a href="#{name}">{escape(title)}</a>' for name, title in there if name != "chart" or 'id="chart"' in methods)
    return "\n".join([
        '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f'<meta http-equiv="Content-Security-Policy" content="{html.escape(ALONE)}">'
        '<link rel="icon" href="data:,">'
        f"<title>cutbench: methods that cut a deformable sheet</title><style>{(HERE / 'page.css').read_text(encoding='utf-8')}"
        "</style></head><body>",
        "<h1>cutbench: methods that cut a deformable sheet</h1>",
        f"<nav>{links}</nav>",
        methods,
        heading("claims", "The paper's claims"),
        "<p>Xin, Marris, Mihut, Ushaw, Morgan: <i>Accurate Real-time Complex Cutting in Finite Element Modeling</i>, 2018. "
        "All verdicts are computed from records; only the descriptions of the paper are written by hand. A line unfolds.</p>",
        claim_lines.lines(results),
        heading("figures", "The paper's figures, and experiments beside them"),
        f"<p>{escape(naming.AR_DEFINITION)} Other terms: <code>docs/explanation/measuring.md</code>.</p>",
        *sections, other_figures(results, used),
        heading("runs", "Runs"), f"<details id=\"all-runs\"><summary>Commands, seeds and commits of all records</summary>"
        f"{provenance(results)}</details>", scripts, "</body></html>", ""])
