"""Table 1 of the paper: times of cuts, which statements of the paper they agree with, and tables."""

import numpy as np
import pandas as pd

from analysis import load, naming

STEM = "table1_timing"
PHASES = {"locate_us": "#bdbdbd", "trace_us": "#737373", "embed_us": "#0072b2", "improve_us": "#e69f00",
          "open_us": "#009e73"}
MEASURES = ["crossed_triangles", "geometry_us"]  # of what is published; a run of one's own has PHASES, too
STEP = ["rotate_us", "assemble_us", "setup_us", "solve_us"]
IN_MOTION = ["transfer_us", "pattern_us", "bending_us", "rebuild_us", "bending_rebuild_us", "triplets_us",
             "solver_iterations", *STEP]
BASELINE = ("every_edge", "")
REAL_TIME_US = 6000  # "less than six milliseconds", section 5.3


class Timings:
    """The cuts of one sheet family, one row each: medians of the repetitions in microseconds, ns_per_crossed."""

    def __init__(self, run, sheet):
        self.run, self.sheet = run.select(sheet=sheet), sheet
        caches = set(self.run.rows["cache"]) - {"simulation"}
        self.cache = "warm" if "warm" in caches or not caches else sorted(caches)[0]
        self.cuts = self.medians(self.cache)
        self.variants = self.run.variants("geometry_us")
        self.resolutions = sorted(set(self.run.everything()["resolution"]))

    def medians(self, cache):
        rows = self.run.select(cache=cache).rows
        cuts = load.median_repetition(rows, MEASURES + [phase for phase in PHASES if phase in rows])
        crossed = cuts["crossed_triangles"].where(cuts["crossed_triangles"] > 0)
        return cuts.assign(ns_per_crossed=1000 * cuts["geometry_us"] / crossed)

    def of(self, variant, resolution=None, cuts=None):
        cuts = self.cuts if cuts is None else cuts
        chosen = (cuts["method"] == variant[0]) & (cuts["parameter"] == variant[1])
        return cuts[chosen if resolution is None else chosen & (cuts["resolution"] == resolution)]

    def ratio(self, upper, lower, resolution):
        """load.ratio of the times of two variants, cut by cut."""
        pairs = self.of(upper, resolution).merge(self.of(lower, resolution), on=load.CUT)
        return load.ratio(pairs["geometry_us_x"], pairs["geometry_us_y"])

    def growth(self, variant):
        """Median time at the highest resolution over that at the lowest; None unless there are two."""
        medians = load.quartiles(self.of(variant), "resolution", "geometry_us")["median"]
        return (medians.index[0], medians.index[-1], medians.iloc[-1] / medians.iloc[0]) if len(medians) > 1 else None

    def papers_method(self):
        """The paper's method with its local split: one round, else whatever was run."""
        parameters = sorted((k for m, k in self.variants if m == "bowyer_watson"), key=lambda k: (k != "rounds=1", k))
        return ("bowyer_watson", parameters[0]) if parameters else None


def published(column="geometry_ms"):
    path = load.REPOSITORY / "results" / "published" / "table1.csv"
    try:
        return pd.read_csv(path).set_index("triangles")[column] * 1000
    except (OSError, ValueError, KeyError) as error:
        load.stop(f"{path}, the paper's own numbers, can't be read: {error}")


def statements(timings, paper):
    """Which statements of the paper held, one sentence each."""
    method = timings.papers_method()
    if method is None or timings.of(method).empty:
        return ["The paper's statements were not tested: no successful cut by bowyer_watson."]
    return [s for s in (growth_statement(timings, paper, method), real_time_statement(timings, method),
                        baseline_statement(timings, method), overhead_statement(timings)) if s]


def interval(ratio):
    """load.ratio() as text."""
    mean, low, high, n = ratio
    return f"{load.number(mean)} [{load.number(low)}, {load.number(high)}]" if n else "-"


def label(variant):
    return naming.looks([variant])[variant].label


def growth_statement(timings, paper, method):
    """Held where the exponent is below 0.75: nearer to that of a cut's length, 0.5, than to the sheet's, 1."""
    growth = timings.growth(method)
    if growth is None:
        return None
    low, high, factor = growth
    held = factor < (high / low) ** 0.75
    beside = [f"root: {np.sqrt(high / low):.1f}"]
    if low in paper.index and high in paper.index:
        beside.append(f"the paper: {paper[high] / paper[low]:.1f}")
    edges = timings.growth(BASELINE)
    if edges and edges[:2] == (low, high):
        beside.append(f"testing every edge: {edges[2]:.1f}")
    return (f"{'Held' if held else 'Not held'} (exponent below 0.75): the cost grows like the cut, not like the sheet: "
            f"{high / low:.3g} times the triangles take {factor:.1f} times as long by {label(method)} "
            f"({'; '.join(beside)}).")


def real_time_statement(timings, method):
    slowest = load.quartiles(timings.of(method), "resolution", "geometry_us")["median"]
    return (f"{'Held' if slowest.max() < REAL_TIME_US else 'Not held'}: below 6 ms (here the geometry alone, and not "
            f"on the paper's CPU): {load.number(slowest.max() / 1000, 2)} ms at {slowest.idxmax()} triangles.")


def baseline_statement(timings, method):
    resolution = timings.of(method)["resolution"].max()
    ratio = timings.ratio(BASELINE, method, resolution)
    return ratio[3] and (f"At {resolution} triangles testing every edge takes {interval(ratio)} times as long as the "
                         "whole cut (geometric mean of the pairs, 95 % interval).")


def overhead_statement(timings):
    """The first contribution: Bowyer-Watson generation costs less than existing algorithms."""
    generation, resolution = ("bowyer_watson", "rounds=0"), max(timings.resolutions)
    parts = []
    for other in [v for v in naming.looks(timings.variants) if v[0] in ("conventional_split", "cgal_cdt")]:
        ratio = timings.ratio(other, generation, resolution)
        if ratio[3]:
            verdict = "held" if ratio[1] > 1 else "not held" if ratio[2] < 1 else "undecided"
            parts.append(f"{verdict} against {label(other)} (which takes {interval(ratio)} times as long)")
    return f"'Lower overhead than existing algorithms', {label(generation)}: {', '.join(parts)}." if parts else None


def in_motion(run, sheet):
    """The cuts of one sheet made inside the running simulation, one row each, with sums."""
    cuts = run.select(sheet=sheet, cache="simulation").rows
    return cuts.assign(update_us=cuts["transfer_us"] + cuts["pattern_us"], step_us=cuts[STEP].sum(axis=1, skipna=False),
                       total_us=cuts["geometry_us"] + cuts[["transfer_us", "pattern_us", "bending_us"]].sum(axis=1)
                       + cuts[STEP].sum(axis=1, skipna=False))


def motion_statements(cuts):
    """The ratios that justify an incremental update, at the highest resolution."""
    top = cuts[cuts["resolution"] == cuts["resolution"].max()]
    def ratio(upper, lower):
        return interval(load.ratio(top[upper], top[lower]))
    return [f"At {top['resolution'].max()} triangles the incremental update of the pattern is "
            f"{ratio('rebuild_us', 'pattern_us')} times faster than a new one and "
            f"{ratio('triplets_us', 'pattern_us')} times faster than Eigen's setFromTriplets; the bending update {ratio('bending_rebuild_us', 'bending_us')} times faster than a new one; "
            f"assembly {ratio('triplets_us', 'assemble_us')} times faster than setFromTriplets (geometric means, 95 % "
            "intervals)."]


def print_motion(run, sheet):
    cuts = in_motion(run, sheet)
    rows = []
    for resolution in sorted(set(cuts["resolution"])):
        for variant, look in naming.looks(set(zip(cuts["method"], cuts["parameter"]))).items():
            here = cuts[(cuts["resolution"] == resolution) & (cuts["method"] == variant[0]) &
                        (cuts["parameter"] == variant[1])]
            medians = here[["geometry_us", "update_us", "bending_us", *STEP, "solver_iterations"]].median()
            rows.append([str(resolution), look.label, str(load.count(here)), *medians,
                         load.ratio(here["rebuild_us"], here["pattern_us"])[0],
                         load.ratio(here["triplets_us"], here["pattern_us"])[0],
                         load.ratio(here["triplets_us"], here["assemble_us"])[0],
                         load.ratio(here["bending_rebuild_us"], here["bending_us"])[0]])
    if rows:
        load.print_table(f"A cut inside the running simulation, {sheet}, medians over the cuts, us; ratios: geometric means",
                         ["triangles", "method", "cuts", "geometry", "update", "bending", "rotate", "assemble", "setup",
                          "solve", "iterations", "anew/pattern", "triplets/pattern", "triplets/assemble",
                          "bending anew/update"], rows)
        for statement in motion_statements(cuts):
            print(statement)


def print_numbers(timings, paper):
    cold = timings.medians("cold")
    rows = []
    for resolution in timings.resolutions:
        for variant, look in naming.looks(timings.variants).items():
            here = timings.of(variant, resolution)
            q1, median, q3 = here["geometry_us"].quantile([0.25, 0.5, 0.75])
            cold_median = timings.of(variant, resolution, cold)["geometry_us"].median()
            slower = cold_median / median if timings.cache == "warm" else np.nan
            against = "-" if variant == BASELINE else interval(timings.ratio(BASELINE, variant, resolution))
            failed = timings.run.select(resolution=resolution, method=variant[0], parameter=variant[1]).failed
            rows.append([str(resolution), look.label, str(load.count(here)), str(load.count(failed)),
                         here["crossed_triangles"].median(), q1, median, q3, cold_median, slower,
                         here["ns_per_crossed"].median(), against, paper.get(resolution, np.nan)])
    load.print_table(
        f"Geometry of a cut, {timings.sheet}, medians over the cuts; every edge / method: geometric mean over the pairs "
        "and bootstrap 95 % interval",
        ["triangles", "method", "cuts", "failed", "crossed", f"{timings.cache} us q1", "median", "q3", "cold us",
         "cold/warm", "ns/crossed", "every edge / method", "paper us"], rows)
    for statement in statements(timings, paper):
        print(statement)


def other_sheets(timings):
    """The growth on the sheets the figure does not show."""
    grown = [(t.sheet, t.growth(t.papers_method())) for t in timings if t.papers_method()]
    grown = [f"{naming.sheet_title(sheet)} {growth[2]:.1f}" for sheet, growth in grown if growth]
    return [f"Growth of the paper's method on other sheets: {', '.join(grown)} times."] if grown else []
