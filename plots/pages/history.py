#!/usr/bin/env python3
"""Draws the counts of commits, which experiments/history keeps, as one HTML page without links to other files.

usage: plots/pages/history.py [--file results/history.jsonl] [--out results/history.html] [--url https://example.org/you/cutbench]

The commits that changed most come first, then each series with its change points, the largest first: a step of more than
0.5 % in instructions, 5 % in misses, any in a counter; for times, what the test of E-divisive finds."""

import argparse
import html
import json
import math
from collections import defaultdict
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

RESULTS = Path(__file__).resolve().parents[2] / "results"
LEAST = {"instructions": 0.005, "misses": 0.05}  # as in experiments/track.toml; counters: any change
TIME = "time_us"
STYLE = """
body{font:16px/1.5 system-ui,sans-serif;margin:0 auto;padding:1rem;max-width:72rem;color:#1c1c1c;background:#fff}
h1{font-size:1.6rem;line-height:1.2}h2{font-size:1.25rem;margin:2.5rem 0 .5rem;border-top:2px solid #1c1c1c;padding-top:.6rem}
.wide{overflow-x:auto}table{border-collapse:collapse;font-size:.85rem}
td,th{padding:.3rem .8rem .3rem 0;text-align:left;vertical-align:top;border-bottom:1px solid #ddd}
td.n,th.n{text-align:right;white-space:nowrap}.slower,.faster,td:nth-child(2){white-space:nowrap}code{font-size:.95em}
.slower{color:#a63c00}.faster{color:#005a94}svg{display:block}details{margin-top:1rem}
"""


@dataclass
class Change:
    at: int  # the place in the series where the new level begins
    ratio: float  # new level over old


@dataclass
class Series:
    row: str
    metric: str
    commits: list = field(default_factory=list)  # places in the list of commits
    values: list = field(default_factory=list)
    changes: list = field(default_factory=list)

    def largest(self):
        return max((abs(math.log(c.ratio)) for c in self.changes), default=0)


def read_lines(file):
    lines = [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()]
    return sorted(lines, key=lambda line: line["date"])


def ratio(new, old):
    """Plus one on both sides, so that counters may be zero."""
    return (new + 1) / (old + 1)


def steps(metric, values):
    """Of exact counts: wherever two that follow each other differ by more than is noise."""
    least = math.log1p(LEAST.get(metric, 0))
    return [Change(i, ratio(values[i], values[i - 1])) for i in range(1, len(values))
            if abs(math.log(ratio(values[i], values[i - 1]))) > least]


def divergence(x, m):
    """E-divisive's statistic of the samples before and from m on (Matteson and James, A nonparametric approach for
    multiple change point analysis, JASA 2014, eq. 5 and 6), exponent 1."""
    a, b = x[:m], x[m:]
    between = np.abs(a[:, None] - b[None, :]).mean()
    within = [np.abs(s[:, None] - s[None, :]).sum() / (len(s) * (len(s) - 1)) for s in (a, b)]
    return len(a) * len(b) / (len(a) + len(b)) * (2 * between - sum(within))


def split(x, least):
    """The best place to split, and its statistic."""
    places = range(least, len(x) - least + 1)
    found = [divergence(x, m) for m in places]
    return (places[int(np.argmax(found))], max(found)) if found else (None, 0)


def e_divisive(values, least=3, level=0.05, permutations=499):
    """Places where the distribution of the values changes: the best split of each part, as long as random orders of the
    part seldom have as good a one. The permutations are the same each time."""
    draw, x = np.random.default_rng(1), np.log(np.asarray(values, float))

    def parts(begin, end):
        m, best = split(x[begin:end], least)
        if m is None:
            return []
        as_good = sum(split(draw.permutation(x[begin:end]), least)[1] >= best for _ in range(permutations))
        if (as_good + 1) / (permutations + 1) > level:
            return []
        return parts(begin, begin + m) + [begin + m] + parts(begin + m, end)
    return parts(0, len(x))


def changes_of_times(values):
    places = e_divisive(values)
    levels = [np.median(values[a:b]) for a, b in zip([0, *places], [*places, len(values)])]
    return [Change(place, new / old) for place, old, new in zip(places, levels, levels[1:])]


def all_series(lines):
    found = {}
    for place, line in enumerate(lines):
        for row in line["rows"]:
            counted = {name: row[name] for name in (*LEAST, TIME) if name in row} | row["counters"]
            for metric, value in counted.items():
                series = found.setdefault((row["id"], metric), Series(row["id"], metric))
                series.commits.append(place)
                series.values.append(value)
    for series in found.values():
        series.changes = changes_of_times(series.values) if series.metric == TIME else steps(series.metric, series.values)
    return sorted(found.values(), key=Series.largest, reverse=True)


def percent(r):
    return f"{100 * (r - 1):+.1f} %" if 0.5 < r < 2 else f"x {r:.3g}" if r > 1 else f"/ {1 / r:,.3g}"


def coloured(r):
    return f'<span class="{"slower" if r > 1 else "faster"}">{"▲" if r > 1 else "▼"} {percent(r)}</span>'


def number(value):
    return f"{value:,.0f}"


def sparkline(series, commits, width=260, height=44):
    """On a logarithmic scale; a triangle where a change begins, up for slower."""
    logs = [math.log(v + 1) for v in series.values]
    low, high = min(logs), max(logs)
    span = max(high - low, 0.01)

    def place(i):
        x = 6 + (width - 12) * series.commits[i] / max(1, len(commits) - 1)
        return x, height - 8 - (height - 16) * (logs[i] - low) / span
    points = [place(i) for i in range(len(logs))]
    parts = [f'<svg width="{width}" height="{height}" role="img" aria-label="{html.escape(series.row)} {series.metric}">'
             f'<polyline fill="none" stroke="#777" stroke-width="1.5" points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in points)}"/>']
    for change in series.changes:
        (x, y), up = points[change.at], change.ratio > 1
        d = -5 if up else 5
        parts.append(f'<path fill="{"#d55e00" if up else "#0072b2"}" d="M{x - 4:.1f},{y - d:.1f}h8l-4,{2 * d}z"><title>'
                     f'{commits[series.commits[change.at]]["commit"][:7]} {percent(change.ratio)}</title></path>')
    return "".join(parts) + "</svg>"


def link(commit, url):
    short = commit["commit"][:7]
    target = f"{url}/commit/{commit['commit']}" if url else f"#{short}"
    return f'<a href="{html.escape(target)}"><code>{short}</code></a>'


def table(head, rows):
    cell = lambda tag, text: f'<{tag}{" class=n" if text[:1] == ">" else ""}>{text.lstrip(">")}</{tag}>'  # noqa: E731
    lines = ["".join(cell("th", text) for text in head)] + ["".join(cell("td", text) for text in row) for row in rows]
    return '<div class="wide"><table>' + "".join(f"<tr>{line}</tr>\n" for line in lines) + "</table></div>"


def commits_that_changed(series, commits, url):
    """By their largest change; times are named where nothing was counted."""
    by_commit = defaultdict(list)
    for one in series:
        for change in one.changes:
            by_commit[one.commits[change.at]].append((abs(math.log(change.ratio)), one, change))
    rows = []
    for place, changed in sorted(by_commit.items(), key=lambda item: -max(c[0] for c in item[1])):
        commit, shown = commits[place], sorted(changed, key=lambda c: -c[0])
        named = [f"<code>{html.escape(one.row)}</code> {one.metric} {coloured(change.ratio)}" for _, one, change in shown[:4]]
        more = f"<br>and {len(shown) - 4} more" if len(shown) > 4 else ""
        rows.append([f'<span id="{commit["commit"][:7]}">{link(commit, url)}</span>', commit["date"][:10],
                     html.escape(commit["subject"]), "<br>".join(named) + more])
    return table(["commit", "date", "what it says", "largest changes"], rows)


def series_table(series, commits, url):
    rows = []
    for one in series:
        told = [f"{link(commits[one.commits[c.at]], url)} {coloured(c.ratio)}" for c in one.changes]
        rows.append([f"<code>{html.escape(one.row)}</code><br>{one.metric}", sparkline(one, commits), ">" + number(one.values[0]),
                     ">" + number(one.values[-1]), ">" + percent(ratio(one.values[-1], one.values[0])), "<br>".join(told)])
    return table(["row", "first to last commit", ">first", ">last", ">in all", "changes"], rows)


def page(lines, url):
    series = all_series(lines)
    moved = [one for one in series if one.changes]
    tools = ", ".join(f"{name} {version}" for name, version in lines[-1]["tools"].items())
    others = [line for line in lines if line["tools"] != lines[-1]["tools"] and set(lines[-1]["tools"]) == set(line["tools"])]
    return f"""<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>cutbench: what commits changed</title><style>{STYLE}</style>
<h1>cutbench: which commit made it slower, or faster?</h1>
<p>{len(lines)} commits from {lines[0]["date"][:10]} to {lines[-1]["date"][:10]}; {len(series)} series, {len(moved)} of which
changed. Instructions, misses and calls of exact arithmetic are counted and repeat; times are from one machine. A change is
marked where instructions differ by more than 0.5 %, misses by 5 %, a counter at all; for times, where E-divisive finds one.
It began somewhere after the commit before it on this page: those between were not counted.
{f"{len(others)} commits were counted with other tools." if others else ""}</p>
<h2>Commits by their largest change</h2>{commits_that_changed(series, lines, url)}
<h2>Series by their largest change</h2>{series_table(moved, lines, url)}
<details><summary>{len(series) - len(moved)} series did not change</summary><p>
{", ".join(f"<code>{html.escape(one.row)}</code> {one.metric}" for one in series if not one.changes)}</p></details>
<details><summary>Tools</summary><p>{html.escape(tools)}</p></details></html>
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--file", type=Path, default=RESULTS / "history.jsonl")
    parser.add_argument("--out", type=Path, default=RESULTS / "history.html")
    parser.add_argument("--url", default="", help="of the project: commits are linked to URL/commit/SHA")
    arguments = parser.parse_args()
    if not arguments.file.is_file():
        parser.error(f"there is no {arguments.file}; experiments/history makes it")
    part = arguments.out.with_suffix(".part")
    part.write_text(page(read_lines(arguments.file), arguments.url.rstrip("/")), encoding="utf-8")
    part.replace(arguments.out)
    print(arguments.out)


if __name__ == "__main__":
    main()
