#!/usr/bin/env python3
"""Makes the report page of a folder that holds one simulated scene, and reads it: one file that needs nothing else, every
section, the scene's verdict, what was not run said. Also: how lips are compared, on lips whose difference is known. Prints
every disagreement; exit code 1 if there is any.
usage: check_report.py RESULTS with RESULTS/picked_cut/picked_cut/METHOD of `cutbench simulate --frames`"""

import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

import numpy as np

PLOTS = Path(__file__).resolve().parent.parent / "plots"
sys.path.insert(0, str(PLOTS))
HEADINGS = {"h2", "h3"}
VOID = {"meta", "link", "img", "br"}
problems = []


def expect(what, condition):
    if not condition:
        problems.append(what)


class Page(HTMLParser):
    def __init__(self):
        super().__init__()
        self.open, self.sources, self.headings, self.text = [], [], [], {}
        self.names = set()

    def handle_starttag(self, tag, attributes):
        if tag not in VOID:
            self.open.append(tag)
        for name, value in attributes:
            if name == "id":
                expect(f"two parts are called {value}", value not in self.names)
                self.names.add(value)
            if name in ("src", "href"):
                self.sources.append(value)
        if tag in HEADINGS:
            self.headings.append("")
        if tag == "img":
            expect("a picture has neither a size nor a name", {"width", "height", "alt"} <= {n for n, _ in attributes})

    def handle_endtag(self, tag):
        expect(f"</{tag}> closes <{self.open[-1:]}>", self.open and self.open.pop() == tag)

    def handle_data(self, data):
        if self.open and self.open[-1] in HEADINGS:
            self.headings[-1] += data
        elif self.headings:
            self.text[self.headings[-1]] = self.text.get(self.headings[-1], "") + data


def check_page(results):
    done = subprocess.run([sys.executable, PLOTS / "report.py", "--results", results], capture_output=True, text=True)
    expect(f"report.py: {done.returncode} {done.stderr}", done.returncode == 0 and not done.stderr)
    page = Page()
    page.feed((results / "report.html").read_text(encoding="utf-8"))
    expect(f"left open: {page.open}", not page.open)
    for source in page.sources:
        expect(f"needs {source[:60]}", source.startswith("data:") or (source[0] == "#" and source[1:] in page.names))
    from report_parts.sections import SECTIONS
    for section in SECTIONS:
        expect(f"no section {section.title}", section.title in page.headings)
    scene = page.text["Cut picked on the deformed sheet"]
    expect(f"the scene's verdict: {scene}", "1 of 1 simulations" in scene and "conventional_split" in scene)
    expect("the comparison that was not run is not said to be", "not run" in page.text["All methods "])
    expect("a figure that was not run is not said to be", "not run" in page.text["Figure 5: single cuts"])
    expect("one that was run is said not to be", "not run" not in scene)


def check_lips():
    from common import lips
    along = np.linspace(0, 2, 60)
    truth = np.stack([along, 0.1 * np.sin(3 * along), 0 * along], axis=1)
    length = along[-1]

    def difference(moved):
        return lips.difference({1: (along, moved), -1: (along, truth)}, {1: (along, truth), -1: (along, truth)}, length)

    turn = np.radians(8)
    turned = truth @ np.array([[np.cos(turn), np.sin(turn), 0], [-np.sin(turn), np.cos(turn), 0], [0, 0, 1]])
    for name, moved, offset, degrees in (("the same", truth, 0, 0), ("displaced", truth + [0, 0, 0.3], 0.3, 0),
                                         ("turned", turned, None, 8)):
        found = difference(moved)  # over both lips, one of which is right: root mean squares over sqrt 2
        if offset is not None:
            expect(f"{name}: off by {found[0]}", abs(found[0] - offset / np.sqrt(2)) < 1e-9)
        expect(f"{name}: turned by {found[1]}", abs(found[1] - degrees / np.sqrt(2)) < 1e-4)


check_lips()
check_page(Path(sys.argv[1]))
print("\n".join(problems))
sys.exit(1 if problems else 0)
