#!/usr/bin/env python3
"""Makes the report page of a folder that holds one simulated scene, and reads it: one file that needs nothing else, every
section, the scene's verdict, what was not run said. Also: how lips are compared, on lips whose difference is known, where
close-ups look, and what of a caption is drawn. Prints every disagreement; exit code 1 if there is any.
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
    done = subprocess.run([sys.executable, PLOTS / "pages/report/report.py", "--results", results],
                          capture_output=True, text=True)
    expect(f"report.py: {done.returncode} {done.stderr}", done.returncode == 0 and not done.stderr)
    page = Page()
    page.feed((results / "report.html").read_text(encoding="utf-8"))
    expect(f"left open: {page.open}", not page.open)
    for source in page.sources:
        expect(f"needs {source[:60]}", source.startswith("data:") or (source[0] == "#" and source[1:] in page.names))
    from pages.report.sections import SECTIONS
    for section in SECTIONS:
        expect(f"no section {section.title}", section.title in page.headings)
    scene = page.text["Cut picked on the deformed sheet"]
    expect(f"the scene's verdict: {scene}", "1 of 1 simulations" in scene and "conventional_split" in scene)
    expect("the comparison that was not run is not said to be", "not run" in page.text["All methods "])
    expect("a figure that was not run is not said to be", "not run" in page.text["Figure 5: single cuts"])
    expect("one that was run is said not to be", "not run" not in scene)


def check_lips():
    from analysis import lips
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


def check_close_ups():
    """Two flat pieces of a sheet beside an incision, each turned its own way: the camera of a place looks at the piece that was
    asked for, along its normal, its rest x to the right."""
    from analysis.frame_files import Frame
    from figures.common import close_ups
    n = 20
    x, y = np.meshgrid(np.linspace(0, 0.5, n + 1), np.linspace(0, 1, 2 * n + 1))
    half = np.stack([x.ravel(), y.ravel()], axis=1)
    corner = np.arange(2 * n)[:, None] * (n + 1) + np.arange(n)
    one = np.stack([corner, corner + 1, corner + n + 2], axis=-1).reshape(-1, 3)
    other = np.stack([corner, corner + n + 2, corner + n + 1], axis=-1).reshape(-1, 3)
    triangles = np.concatenate([one, other])
    rng = np.random.default_rng(3)
    turns = [np.linalg.qr(rng.normal(size=(3, 3)))[0] for _ in range(2)]
    turns = [q * np.sign(np.linalg.det(q)) for q in turns]
    rest = np.concatenate([half, half + [0.5, 0]])
    flat = np.hstack([rest, np.zeros((len(rest), 1))])
    deformed = np.concatenate([flat[:len(half)] @ turns[0].T, flat[len(half):] @ turns[1].T + [0, 0, 3]])
    frame = Frame(0, deformed, rest, np.concatenate([triangles, triangles + len(half)]))
    place = np.array([0.5, 0.5])  # on the incision
    for turn, shift in zip(turns, (0, 3)):
        target = turn @ [*place, 0] + [0, 0, shift]
        camera = close_ups.facing(frame, place, target)
        axes = np.array([camera.right, camera.normal])
        expect(f"the camera's axes: {axes}", np.allclose(axes, [turn[:, 0], turn[:, 2]], atol=1e-9))
        expect(f"it looks at {camera.centre}", np.allclose(camera.centre, target, atol=1e-9))


def check_captions():
    """Whole sentences, as many as two lines hold; the whole caption is kept for the file beside the figure."""
    from figures.common import style
    figure = style.plt.figure(figsize=(style.WIDTH, 1))
    caption = "A short one. " + "Words that fill more than a line, and a little bit of the next one, as sentences do. " * 2
    lines = style.two_lines(figure, caption.strip(), style.WIDTH - 0.1)
    expect(f"not the sentences that fit: {lines}", len(lines) <= 2 and caption.startswith(" ".join(lines)) and lines[-1].endswith("do."))
    expect("the caption is not kept", figure.get_label() == caption.strip())
    lines = style.two_lines(figure, "one sentence " * 40, style.WIDTH - 0.1)
    expect(f"a long sentence: {lines}", len(lines) == 2 and lines[1].endswith("…"))
    style.plt.close(figure)


def check_swirl():
    """Angles twice those of the conventional split in one cut, half in another: the materials of a cut count once."""
    import pandas as pd
    from analysis.scenes import swirl
    rows = pd.DataFrame([(cut, material, method, angle * (1 if method == swirl.CONVENTIONAL else factor))
                         for cut, factor, materials in ((0, 2, "abc"), (1, 0.5, "a"))
                         for material, angle in zip(materials, (1, 3, 7)) for method in (swirl.CONVENTIONAL, "cgal_cdt")],
                        columns=["cut", "material", "method", "degrees"])
    (name, ratio, low, high, n), = swirl.ratios(rows)
    expect(f"the swirl's ratio: {name} {ratio} [{low}, {high}] {n}",
           np.allclose([ratio, low, high, n], [1, 0.5, 2, 2]) and name == "cgal cdt")


check_lips()
check_swirl()
check_close_ups()
check_captions()
check_page(Path(sys.argv[1]))
print("\n".join(problems))
sys.exit(1 if problems else 0)
