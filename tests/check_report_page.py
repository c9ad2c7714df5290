#!/usr/bin/env python3
"""Opens results/report.html, made from the records in results/reference, in headless Chromium, and reads what it shows: the
order of the rows, filters, links, the chart, and whether it fits a phone. All its numbers are computed anew here from the
records, by code that shares nothing with plots/. Prints every disagreement; exit code 1 if there is any."""

import csv
import lzma
import html
import json
import math
import re
import shutil
import subprocess
import sys
import tempfile
from collections import defaultdict
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent
REFERENCE = PROJECT / "results/reference"
KINDS = {"centre_crack": "crack", "inclined_crack": "crack", "arc_crack": "arc", "edge_crack": "edge", "kirsch_hole": "hole",
         "williams": "tip", "collinear_cracks": "row", "loaded_lips": "lips", "crossed_cracks": "crossing", "corner": "corner",
         "elliptic_hole": "ellipse", "bent_plate": "plate", "free_strip": "strip"}
SETTING = ("4", 1 / 240, "1000")
FEW = 1e-4  # relative: the page holds six digits
problems = []


def expect(what, condition):
    if not condition:
        problems.append(what)


# ---- the oracle


def rows_of(stem):
    with lzma.open(REFERENCE / f"{stem}.records.csv.xz", "rt", encoding="utf-8", newline="") as file:
        names = ["parameter" if name == "knob" else name for name in next(csv.reader([file.readline()]))]  # its older name
        return list(csv.DictReader(file, names))


def median(values):
    """The mean of the two middle values where their number is even."""
    values = sorted(values)
    return (values[(len(values) - 1) // 2] + values[len(values) // 2]) / 2 if values else None


def geometric(values):
    return math.exp(sum(map(math.log, values)) / len(values))


def grouped(rows, *names):
    groups = defaultdict(list)
    for row in rows:
        groups[tuple(row[n] for n in names)].append(row)
    return groups


def failed(row):
    return row["verdict"] != "ok" or row["status"] in ("failed", "refused")


def without_refused(rows, refused):
    """Without the sheets that a method refuses altogether."""
    return [r for group in grouped(rows, "method", "sheet").values() if not all(map(refused, group)) for r in group]


def cut_numbers(rows):
    found = {}
    for (method,), cuts in grouped(rows, "method").items():
        bad = [math.inf for c in cuts if failed(c)]
        made = [c for c in cuts if not failed(c) and c["status"] != "noop"]

        def ratio(column, made=made):
            return [float(c[column]) / float(c["crossed_triangles"]) for c in made]

        found[method] = {
            "us_per_crossed": median(ratio("geometry_us") + bad),
            "vertices_per_crossed": median(ratio("vertices_added") + bad),
            "incision_error_h": median([float(c["incision_error_h"]) for c in made
                                        if c["incision_error_h"] and abs(float(c["area_change"])) <= 1e-6] + bad),
            "eigenvalue_ratio": median([float(c["eigenvalue_ratio"]) for c in made if c["eigenvalue_ratio"]]),
            "ar_max_cut": median([float(c["ar_max_cut"]) for c in made if c["ar_max_cut"] and float(c["ar_max_cut"]) != 0]),
            "failed_percent": 100 * len(bad) / len(cuts)}
    return found


def motion_ms(rows):
    """{method: (ms, solver)} by the fastest solver of those that ran every size."""
    sizes = {r["resolution"] for r in rows}
    ran = {s: {r["resolution"] for r in here} for (s,), here in grouped(rows, "solver").items()}
    rows = [r for r in rows if ran[r["solver"]] == sizes]
    rows = without_refused(rows, lambda r: r["verdict"] == "refused")
    best = {}
    for (method, solver), motions in grouped(rows, "method", "solver").items():
        ms = []
        for m in motions:
            ended = m["verdict"] in ("ok", "energy_growth", "inverted")
            ms.append((float(m["cut_update_us"]) / float(m["place"]) + float(m["first_step_us"])
                       + (round(0.25 / float(m["step_s"])) - 1) * float(m["step_us"])) / 1000 if ended else math.inf)
        best[method] = min(best.get(method, (math.inf, "")), (median(ms), solver))
    return best


def error_rows():
    rows = rows_of("method_comparison_accuracy.direct")
    rows = [r | {"kind": next((k for name, k in KINDS.items() if r["problem"].startswith(name)), None)} for r in rows]
    rows = [r for group in grouped([r for r in rows if r["kind"] and r["problem"] != "two_cuts_one_geometry"], "method", "sheet", "kind").values()
            if sum(map(failed, group)) <= len(group) / 2 for r in group]  # a method that misses over half of a kind has no row there
    whole = grouped(rows, "problem", "sheet", "resolution", "case")
    return [r for group in whole.values() if not any(map(failed, group)) for r in group
            if r["error_energy_norm"] and float(r["error_energy_norm"]) != 0]


def errors(rows):
    case = ("problem", "sheet", "resolution", "case")
    fitted = {tuple(r[c] for c in case): r for r in rows if r["method"] == "body_fitted (reference)"}  # not the graded one
    if not fitted:
        return {}

    def size(row):
        return abs(float(row["error_energy_norm"]))

    level = geometric([geometric([size(r) for r in here]) for here in grouped(fitted.values(), "kind").values()])
    found = {}
    for (method,), here in grouped(rows, "method").items():
        pairs = [r | {"ratio": size(r) / size(fitted[tuple(r[c] for c in case)])} for r in here if tuple(r[c] for c in case) in fitted]
        found[method] = level * geometric([geometric([r["ratio"] for r in kind]) for kind in grouped(pairs, "kind").values()])
    return found


class Oracle:
    def __init__(self):
        self.cuts = without_refused(rows_of("method_comparison"), lambda r: r["status"] == "refused")
        self.all_motions = rows_of("whole_step")
        self.motions = self.at(*SETTING)
        self.errors = error_rows()
        self.robustness = rows_of("robustness")
        self.stability = [r for r in rows_of("stability") if r["sweep"] == "vertex" and r["mass"] == "lumped"]
        parameters = {r["method"]: r["parameter"] for r in self.motions + self.cuts}
        self.robustness, self.stability = ([r for r in rows if parameters.get(r["method"]) == r["parameter"]] for rows in (self.robustness, self.stability))

    def at(self, place, step, stiffness):
        return [r for r in self.all_motions if float(r["place"]) == float(place) and abs(float(r["step_s"]) - step) < 1e-9
                and float(r["stiffness_n_m"]) == float(stiffness)]

    def table(self, sheet="all", family="all", triangles="all"):
        """{method: {column: number}}"""
        def here(rows, by="sheet family triangles"):
            return [r for r in rows if (sheet in ("all", r["sheet"]) or "sheet" not in by)
                    and ("family" not in by or family in ("all", r["cut_family"]))
                    and ("triangles" not in by or triangles in ("all", r["resolution"]))]
        found = defaultdict(dict)
        for method, numbers in cut_numbers(here(self.cuts)).items():
            found[method] |= numbers
        for method, (ms, _) in motion_ms(here(self.motions, "sheet triangles")).items():
            found[method]["step_ms"] = ms
        for method, error in errors(here(self.errors, "sheet triangles")).items():
            if not method.startswith("body_fitted"):
                found[method]["error_percent"] = 100 * error
        for (method,), rows in grouped(here(self.robustness, "sheet"), "method").items():
            def total(*names, rows=rows):
                return sum(int(r[n]) for r in rows for n in names)
            found[method] |= {"faults": total("failed", "wrong", "crashed", "timed_out"),
                              "refused_percent": 100 * total("refused") / total("tried")}
        for (method,), rows in grouped(here(self.stability, "sheet"), "method").items():
            steps = [float(r["explicit_step_ratio"]) for r in rows if r["explicit_step_ratio"]]
            if steps:
                found[method]["explicit_step"] = min(steps)
        return {m: {c: x for c, x in numbers.items() if x is not None} for m, numbers in found.items()}

    def chart(self, *setting):
        """{(method, triangles): (ms, error)}"""
        found = {}
        for size in {r["resolution"] for r in self.errors}:
            error = errors([r for r in self.errors if r["resolution"] == size])
            for method, (ms, _) in motion_ms([r for r in self.at(*setting) if r["resolution"] == size]).items():
                if method in error:
                    found[method, size] = ms, error[method]
        return found


# ---- the browser

DRIVER = """<!DOCTYPE html><meta charset="utf-8"><body><pre id="found"></pre><script>
const found = { steps: {}, errors: [], widths: {} };
window.addEventListener("error", (e) => found.errors.push(e.message));
const wait = (ms = 0) => new Promise((done) => setTimeout(done, ms));
async function open(width, hash) {
  const frame = document.createElement("iframe");
  frame.style = `width:${width}px;height:900px;border:0`;
  frame.src = "report.html" + hash;
  document.body.append(frame);
  await new Promise((done) => frame.addEventListener("load", done));
  frame.contentWindow.addEventListener("error", (e) => found.errors.push(e.message));
  await wait(200);
  return frame;
}
function read(frame) {
  const page = frame.contentDocument, all = (what) => [...page.querySelectorAll(what)];
  const keys = all("#methods th[data-key]").map((h) => h.dataset.key);
  return { hash: frame.contentWindow.location.hash, keys,
    rows: all("#methods tr[id]").map((row) => [row.id.slice(4), [...row.querySelectorAll("td[data-value]")].map((d) => [d.dataset.value, d.textContent])]),
    more: all("#methods tr.more").map((row) => row.textContent),
    points: all("#plot .point").map((p) => [p.dataset.method, p.dataset.triangles, p.dataset.layer, p.getAttribute("aria-label"), p.tabIndex]),
    sorted: all("#methods th[aria-sort=ascending],#methods th[aria-sort=descending]").map((h) => h.dataset.key),
    unfolded: all("details[open]").map((d) => d.id), scroll: frame.contentWindow.scrollY,
    menus: Object.fromEntries(all("select,input").map((m) => [m.name, m.value])) };
}
async function go(frame, hash) {
  const window = frame.contentWindow;
  if (window.location.hash === hash) return;
  await new Promise((done) => { window.addEventListener("hashchange", done, { once: true }); window.location.hash = hash; });
  await wait();
}
async function drive(steps) {
  for (const hash of FRESH) { const frame = await open(1280, hash); found.steps["fresh " + hash] = read(frame); frame.remove(); }
  const frame = await open(1280, "");
  for (const hash of HASHES) { await go(frame, hash); found.steps[hash] = read(frame); }
  const act = async (name, what) => {
    await go(frame, "#find=");
    await what(frame.contentDocument, frame.contentWindow);
    await wait(50);
    found.steps[name] = read(frame);
  };
  await act("heading", (page) => page.querySelector("th[data-key=error_percent] button").click());
  await act("heading twice", (page) => { for (const i of [1, 2]) page.querySelector("th[data-key=error_percent] button").click(); });
  await act("method", (page) => page.querySelector("#row-vertex_snap button").click());
  await act("menu", (page, w) => { const m = page.querySelector("select[name=sheet]"); m.value = "grid"; m.dispatchEvent(new w.Event("change")); });
  await act("find", (page, w) => { const m = page.querySelector("input[name=find]"); m.value = "refine"; m.dispatchEvent(new w.Event("input")); });
  await act("point", (page, w) => page.querySelector(".point[data-method=adaptive_remesh]").dispatchEvent(new w.MouseEvent("click", { bubbles: true })));
  await act("enter", (page, w) => page.querySelector(".point[data-method=cisamr]").dispatchEvent(new w.KeyboardEvent("keydown", { key: "Enter", bubbles: true })));
  await act("focus", (page) => {
    const point = page.querySelector(".point[data-method=cisamr]");
    point.focus();
    found.told = [page.querySelector("#point").textContent, point.getAttribute("aria-label")];
  });
  await act("unfold", (page) => page.querySelector("#claim-2 summary").click());
  await act("link", (page) => page.querySelector("nav a[href='#claims']").click());
  found.requests = frame.contentWindow.performance.getEntriesByType("resource").map((r) => r.name);
  frame.remove();
  for (const width of [360, 1280]) {
    const frame = await open(width, "#open=warp_and_refine,cut_polygons"), root = frame.contentDocument.documentElement;
    const measured = [root.scrollWidth, root.clientWidth];
    for (const part of frame.contentDocument.querySelectorAll("details")) part.open = true;
    await wait(300);
    found.widths[width] = [...measured, root.scrollWidth, root.clientWidth];
    frame.remove();
  }
  document.querySelector("#found").textContent = JSON.stringify(found);
}
drive().catch((e) => { document.querySelector("#found").textContent = JSON.stringify({ failed: String(e.stack) }); });
</script>"""


def browse(chromium, folder, fresh, hashes):
    (folder / "driver.html").write_text(DRIVER.replace("FRESH", json.dumps(fresh)).replace("HASHES", json.dumps(hashes)), encoding="utf-8")
    done = subprocess.run([chromium, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", f"--user-data-dir={folder}/profile",
                           "--allow-file-access-from-files", "--enable-logging=stderr", "--hide-scrollbars", "--window-size=1400,1000",
                           "--virtual-time-budget=60000", "--dump-dom", f"file://{folder}/driver.html"],
                          capture_output=True, text=True, timeout=600)
    for line in done.stderr.splitlines():
        expect(f"the console: {line}", "CONSOLE" not in line)
    text = re.search(r'<pre id="found">(.*?)</pre>', done.stdout, re.S)
    if not text or not text[1]:
        sys.exit(f"check_report_page.py: Chromium did not finish: {done.stderr[-1000:]}")
    found = json.loads(html.unescape(text[1]))
    if "failed" in found:
        sys.exit(f"check_report_page.py: {found['failed']}")
    return found


# ---- the comparison of both


def numbers_of(step):
    return {name: {k: float(v) for k, (v, _) in zip(step["keys"], cells) if v != ""} for name, cells in step["rows"]}


def check_numbers(what, step, truth):
    shown = numbers_of(step)
    expect(f"{what}: rows {sorted(shown)} instead of {sorted(truth)}", set(shown) == {m for m, numbers in truth.items() if numbers})
    for method, numbers in shown.items():
        right = truth.get(method, {})
        expect(f"{what}: {method} has {sorted(numbers)} instead of {sorted(right)}", set(numbers) == set(right))
        for column, x in numbers.items():
            y = right.get(column, math.nan)
            expect(f"{what}: {method}, {column}: {x} instead of {y}", x == y or abs(x - y) <= FEW * abs(y))
    for name, cells in step["rows"]:
        for value, text in cells:  # what is read is what is held
            if value == "" or value == "Infinity":
                expect(f"{what}: {name}: {text!r} for {value!r}", text == ("–" if value == "" else "∞"))
            else:
                near = float(text.replace(",", ""))
                expect(f"{what}: {name}: {text} for {value}", abs(near - float(value)) <= 0.06 * abs(float(value))
                       and (abs(float(value)) < 1e-4 or abs(near - float(value)) <= 0.0051 * abs(float(value))))


def check_order(what, step, column, falling, truth):
    order = [name for name, _ in step["rows"]]
    values = [truth[m].get(column) for m in order]
    there = [v for v in values if v is not None]
    expect(f"{what}: rows without a number are not last", values[:len(there)] == there)
    rounded = [float(f"{v:.6g}") for v in there]
    expect(f"{what}: order {list(zip(order, rounded))}", rounded == sorted(rounded, reverse=falling))
    expect(f"{what}: marked as sorted: {step['sorted']}", step["sorted"] == [column])


def check_chart(what, step, truth):
    for method, size, layer, label, tab in step["points"]:
        ms, error = truth[method, size]
        said = re.search(r": ([\d.,]+) ms .*?, error ([\d.]+) %", label)
        expect(f"{what}: {label}", said and abs(float(said[1].replace(",", "")) - ms) <= 0.0051 * ms
               and abs(float(said[2]) - 100 * error) <= 0.51 * error)
        expect(f"{what}: {method} can't be reached by the keyboard", tab == 0)
    sound = [p for p in step["points"] if not ("gained energy" in p[3] and int(re.search(r"(\d+) % gained", p[3])[1]) > 50)]
    for point in step["points"]:
        here = truth[point[0], point[1]]
        beaten = any(all(b <= a for a, b in zip(here, truth[q[0], q[1]])) and truth[q[0], q[1]] != here for q in sound)
        expect(f"{what}: {point[0]}, {point[1]} triangles, layer {point[2]}", (point[2] == "1") == (point in sound and not beaten))
    expect(f"{what}: {len(step['points'])} points", len(step["points"]) > 20)


def main():
    chromium = shutil.which("chromium")
    if not chromium:
        sys.exit("check_report_page.py: chromium is missing; experiments/set_up browser installs it")
    oracle = Oracle()
    everything = oracle.table()
    columns = sorted({c for numbers in everything.values() for c in numbers})
    filters = [{"sheet": "grid"}, {"sheet": "graded", "family": "cut_out", "triangles": "3200"}, {"triangles": "800"},
               {"sheet": "delaunay", "family": "several", "triangles": "12800"}]
    filter_hashes = ["#" + "&".join(f"{k}={v}" for k, v in f.items()) for f in filters]
    settings = {"#cuts=20&step=0.0166667&stiffness=10000": ("20", 1 / 60, "10000"), "#cuts=1": ("1", 1 / 240, "1000")}
    sorts = {f"#sort={c}" + "&desc=1" * d: (c, bool(d)) for c in columns for d in (0, 1)}
    link = "#desc=1&sort=error_percent&sheet=grid&open=warp_and_refine&cuts=20&at=row-warp_and_refine"
    figure = "#paper-fig9_aspect_ratio"
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        (folder / "reference").symlink_to(REFERENCE)
        made = subprocess.run([sys.executable, PROJECT / "plots/pages/report/report.py", "--results", folder],
                              capture_output=True, text=True)
        expect(f"report.py: {made.returncode} {made.stderr}", made.returncode == 0 and not made.stderr)
        page = folder / "report.html"
        expect(f"{page.stat().st_size} bytes", page.stat().st_size < 6e6)
        found = browse(chromium, folder, ["", link, figure, "#sort=nonsense&sheet=nowhere&open=nobody"], [*sorts, *filter_hashes, *settings])
    steps = found["steps"]

    check_numbers("at first", steps["fresh "], everything)
    expect("columns that the oracle does not know", sorted(steps["fresh "]["keys"]) == columns)
    for step, (column, falling) in sorts.items():
        check_order(step, steps[step], column, falling, everything)
        check_numbers(step, steps[step], everything)
    for step, values in zip(filter_hashes, filters):
        check_numbers(step, steps[step], oracle.table(**values))
    check_chart("chart", steps["fresh "], oracle.chart(*SETTING))
    for step, setting in settings.items():
        check_chart(step, steps[step], oracle.chart(*setting))

    restored, on_grid = steps["fresh " + link], oracle.table(sheet="grid")
    check_numbers(link, restored, on_grid)
    check_order(link, restored, "error_percent", True, on_grid)
    check_chart(link, restored, oracle.chart("20", 1 / 240, "1000"))
    expect(f"{link}: {restored['more']}", len(restored["more"]) == 1 and "reach=0.4" in restored["more"][0]
           and "method_comparison.records.csv.xz" in restored["more"][0])
    expect(f"{link}: did not scroll, or menus {restored['menus']}", restored["scroll"] > 0 and restored["menus"]["sheet"] == "grid")
    expect(f"{figure}: unfolds {steps['fresh ' + figure]['unfolded']}", figure[1:] in steps["fresh " + figure]["unfolded"])
    check_numbers("a made-up link", steps["fresh #sort=nonsense&sheet=nowhere&open=nobody"], everything)

    check_order("heading", steps["heading"], "error_percent", False, everything)
    check_order("heading twice", steps["heading twice"], "error_percent", True, everything)
    for step, parts in {"heading": ["sort=error_percent"], "heading twice": ["sort=error_percent", "desc=1"],
                        "method": ["open=vertex_snap"], "menu": ["sheet=grid"], "find": ["find=refine"], "unfold": ["at=claim-2"],
                        "point": ["open=adaptive_remesh", "at=row-adaptive_remesh"], "enter": ["open=cisamr"], "link": ["at=claims"]}.items():
        expect(f"{step}: the hash is {steps[step]['hash']}", set(parts) <= set(steps[step]["hash"][1:].split("&")))
    expect(f"find: {[r[0] for r in steps['find']['rows']]}", {r[0] for r in steps["find"]["rows"]} == {m for m in everything if "refine" in m})
    for step in ("method", "point", "enter"):
        expect(f"{step}: no row unfolds", len(steps[step]["more"]) == 1)
    expect(f"focus tells {found['told']}", found["told"][0] == found["told"][1])
    for width, sizes in found["widths"].items():
        expect(f"{width} px: scroll and client widths {sizes}", sizes[0] <= sizes[1] == int(width) and sizes[2] <= sizes[3])
    expect(f"errors {found['errors']}", not found["errors"])
    expect(f"requests {found['requests']}", all(r.startswith("data:") for r in found["requests"]))


main()
print("\n".join(problems))
sys.exit(1 if problems else 0)
