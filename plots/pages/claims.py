#!/usr/bin/env python3
"""results/claims.md: what the paper claims, and whether it held in the records of fig9_aspect_ratio, table1_timing and
accuracy. Every verdict and number is computed from these records; a claim whose records are missing is said to be
untested, with the command that makes them."""

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from analysis import load, naming
from analysis.accuracy import profiles, shape
from analysis.accuracy.records import CASE, REFERENCE, Records
from analysis.load import of
from analysis.methods.kinds import kind_of
from analysis.paper import fig9_aspect_ratio, table1_timing

HELD, NOT_HELD, UNDECIDED, CONDITION = "held", "not held", "undecided", "held in part"
PAPERS = ("bowyer_watson", "rounds=1")  # with one round of the local split
GENERATION = ("bowyer_watson", "rounds=0")  # Bowyer-Watson alone
CONVENTIONAL = ("conventional_split", "")
ROUNDS = {"rounds=0": "without local split", "rounds=1": "with one round", "rounds=3": "with three rounds"}
FEW = 0.1  # of the sheet's vertices: "a small number of additional DOFs"


@dataclass
class Finding:
    verdict: str
    evidence: str
    figure: str


@dataclass
class Claim:
    words: str  # the paper's, with the place
    stem: str
    find: object  # a function of the experiment's records, to a Finding, or None where they don't tell


def name(variant):
    return naming.looks([variant])[variant].label


def interval(ratio):
    mean, low, high, n = ratio
    return f"{load.number(mean)} [{load.number(low)}, {load.number(high)}] (n = {n})"


def by_interval(ratio):
    """Held where all of the interval is above 1, not held where all is below."""
    return HELD if ratio[1] > 1 else NOT_HELD if ratio[2] < 1 else UNDECIDED


def summed_up(verdicts):
    """Of {condition: verdict} of the same claim: the one they share, else on which conditions it held."""
    if len(set(verdicts.values())) == 1:
        return next(iter(verdicts.values()))
    where = {v: "; ".join(c for c, verdict in verdicts.items() if verdict == v) for v in (HELD, UNDECIDED, NOT_HELD)}
    if where[HELD]:
        return f"{CONDITION}: {where[HELD]}"
    return f"{NOT_HELD}: {where[NOT_HELD]}; {UNDECIDED}: {where[UNDECIDED]}"


# --- shapes --------------------------------------------------------------------------------------------------------


def below_limit(column, what, figure, share):
    """Held where so large a share of the cuts of each sheet is below the limit."""
    def find(run):
        parts, verdicts = [], {}
        for parameter, cuts in fig9_aspect_ratio.paper_method(run).items():
            label = ROUNDS.get(parameter, parameter or "default")
            good, n = fig9_aspect_ratio.held(cuts, column)
            parts.append(f"{label}: {good} of {n} cuts")
            counts = {naming.sheet_title(sheet): fig9_aspect_ratio.held(cuts.select(sheet=sheet), column)
                      for sheet in naming.sheet_order(cuts.everything()["sheet"])}
            held = [sheet for sheet, (here, tried) in counts.items() if here >= share * tried]
            where = f" on {', '.join(held)}" if held and len(held) < len(counts) else ""
            verdicts[f"{label}{where}"] = HELD if held else NOT_HELD
            if where:
                verdicts[f"{label} elsewhere"] = NOT_HELD
        if not parts:
            return None
        return Finding(summed_up(verdicts), f"{what} below {fig9_aspect_ratio.LIMIT} (held: in {100 * share:g} % of the cuts on a "
                       f"sheet): {'; '.join(parts)}.", figure)
    return find


def local_split_lowers(run):
    pairs = of(run.rows, CONVENTIONAL).merge(of(run.rows, PAPERS), on=load.CUT)
    ratio = load.ratio(pairs["ar_max_cut_x"], pairs["ar_max_cut_y"])
    if not ratio[3]:
        return None
    return Finding(by_interval(ratio), f"Largest AR of the conventional split over that of {name(PAPERS)}, same "
                   f"cuts: {interval(ratio)} (above 1: the paper's method is better).", "fig9_aspect_ratio")


def few_vertices(run):
    pairs = of(run.rows, CONVENTIONAL).merge(of(run.rows, PAPERS), on=load.CUT)
    if pairs.empty:
        return None
    share = (pairs["vertices_added_y"] - pairs["vertices_added_x"]) / (pairs["resolution"] / 2)
    by_size = share.groupby(pairs["resolution"]).median()
    verdicts = {f"{r} triangles": HELD if s <= FEW else NOT_HELD for r, s in by_size.items()}
    return Finding(summed_up(verdicts), f"Vertices that {name(PAPERS)} adds in excess of the conventional split, in percent of "
                   f"the vertices of the uncut sheet (medians; held: at most {100 * FEW:g} %): " +
                   ", ".join(f"{100 * s:.1f} % at {r}" for r, s in by_size.items()) + ".", "fig9_aspect_ratio")


# --- times ---------------------------------------------------------------------------------------------------------


def papers_grid(run):
    return table1_timing.Timings(run, naming.sheet_order(run.everything()["sheet"])[0])


def real_time(run):
    cuts = of(table1_timing.in_motion(run, papers_grid(run).sheet), PAPERS)
    if cuts.empty:
        return None
    cuts = cuts[cuts["resolution"] == cuts["resolution"].max()]
    limit = table1_timing.REAL_TIME_US
    sums = {"geometry": cuts["geometry_us"], "geometry and update without bending": cuts["geometry_us"] + cuts["update_us"],
            "geometry and update": cuts["geometry_us"] + cuts["update_us"] + cuts["bending_us"],
            "geometry, update and first step": cuts["total_us"]}
    medians = {what: values.median() for what, values in sums.items()}
    verdicts = {what: HELD if value < limit else NOT_HELD for what, value in medians.items()}
    return Finding(summed_up(verdicts), f"{name(PAPERS)} in the running simulation at {cuts['resolution'].max()} triangles (not the "
                   "paper's CPU), medians: " + "; ".join(f"{what} {value / 1000:.2f} ms"
                                                         for what, value in medians.items()) + ".",
                   "table1_timing_in_motion")


def growth(run):
    parts, verdicts = [], {}
    for sheet in naming.sheet_order(run.everything()["sheet"]):
        grown = table1_timing.Timings(run, sheet).growth(PAPERS)
        if grown:
            low, high, factor = grown
            verdicts[naming.sheet_title(sheet)] = HELD if factor < (high / low) ** 0.75 else NOT_HELD
            parts.append(f"{naming.sheet_title(sheet)} {factor:.1f}")
    if not parts:
        return None
    paper = table1_timing.published()
    return Finding(summed_up(verdicts), f"Time of the geometry at {high} triangles over that at {low} ({high / low:.3g} times "
                   f"as many; held: the ratio is below their ratio to the power 0.75, {(high / low) ** 0.75:.1f}): "
                   f"{', '.join(parts)}; in the paper "
                   f"{paper.get(high, np.nan) / paper.get(low, np.nan):.1f}.", "table1_timing")


def overhead(run):
    timings = papers_grid(run)
    resolution = max(timings.resolutions)
    parts, verdicts = [], {}
    for other in (CONVENTIONAL, ("cgal_cdt", "")):
        ratio = timings.ratio(other, GENERATION, resolution)
        if ratio[3]:
            verdicts[f"against {name(other)}"] = by_interval(ratio)
            parts.append(f"{name(other)} takes {interval(ratio)} times as long")
    if not parts:
        return None
    return Finding(summed_up(verdicts), f"Against {name(GENERATION)} at {resolution} triangles: {'; '.join(parts)}.",
                   "table1_timing")


def incremental(run):
    cuts = table1_timing.in_motion(run, papers_grid(run).sheet)
    parts, verdicts = [], {}
    for resolution in sorted(set(cuts["resolution"])):
        here = cuts[cuts["resolution"] == resolution]
        ratio = load.ratio(here["rebuild_us"], here["pattern_us"])
        if ratio[3]:
            verdicts[f"{resolution} triangles"] = by_interval(ratio)
            parts.append(f"{load.number(ratio[0])} at {resolution}")
    if not parts:
        return None
    return Finding(summed_up(verdicts), "Time of a complete rebuild over that of an update of the rows that the cut changed: "
                   f"{', '.join(parts)} (geometric means; the verdict takes the interval of each).", "table1_timing_in_motion")


# --- accuracy ------------------------------------------------------------------------------------------------------


def over_kinds(problems, ratios):
    """Geometric mean over kinds of problems in plane, its bootstrap 95 % interval over these, and their number: cases of one
    kind say nothing of another. Other problems do not count."""
    logs = np.log(ratios).groupby(problems.map(kind_of)).mean()
    return load.ratio(np.exp(logs), 1)


def paired_errors(records, other, condition):
    """Error of `other` over that of the paper's method, of the same cases."""
    keys = [*CASE, "solver", "budget"]
    good = records.rows(failed=False, **condition)
    pairs = of(good, other).merge(of(good, PAPERS), on=keys)
    pairs = pairs[pairs["ratio_x"].notna() & pairs["ratio_y"].notna()]
    return over_kinds(pairs["problem"], pairs["error_x"] / pairs["error_y"])


def failures(records):
    """How many cases of the paper's method failed, in words."""
    cases = of(records.table, PAPERS).groupby(CASE)["failed"].any()
    return f"{cases.sum()} of its {len(cases)} cases failed" + (" and are left out" if cases.any() else "")


def physically_accurate(records):
    parts, verdicts = [], {}
    for title, condition in shape.shape_columns(records):
        title = title.replace("\n", " ")
        ratio = paired_errors(records, CONVENTIONAL, condition)
        if ratio[3]:
            verdicts[title] = by_interval(ratio)
            parts.append(f"{title}: {interval(ratio)}")
    if not parts:
        return None
    direct = of(records.rows(direct=True, failed=False), PAPERS)
    direct = direct[direct["ratio"].notna()]
    fitted = over_kinds(direct["problem"], direct["ratio"])
    return Finding(summed_up(verdicts), "Error of the conventional split over that of "
                   f"{name(PAPERS)}, same cases (above 1: the paper's method is better; n kinds of problems in plane): {'; '.join(parts)}. Error of the "
                   f"paper's method over that of a body-fitted mesh, direct solver: {interval(fitted)}. {failures(records)}.", "accuracy")


def shapes_cost_accuracy(records):
    records = records.in_plane()
    parts, verdicts = [], {}
    for title, condition in shape.shape_columns(records):
        title = title.replace("\n", " ")
        table = records.rows(failed=False, **condition)
        factor, low, high, n = shape.factor_per_decade(table[table["method"] != REFERENCE[0]])
        if n and not np.isnan(factor):
            verdicts[title] = HELD if low > 1.02 else NOT_HELD
            parts.append(f"{title}: {factor:.3f} [{low:.3f}, {high:.3f}] (n = {n})")
    if not parts:
        return None
    return Finding(summed_up(verdicts), "Factor of the error when the largest aspect ratio grows tenfold, within one problem, "
                   f"sheet and resolution: {'; '.join(parts)} (held: the whole interval is above 1.02).", "accuracy_shape")


def share_of_draws(slower, faster, draws=1000):
    """The share of the bootstrap draws of problems in which the median of `faster` is below that of `slower`; ties count half."""
    problems = sorted(set(slower.index))
    of_problem = [(slower[p].to_numpy(), faster[p].to_numpy()) for p in problems]
    picks = np.random.default_rng(1).integers(0, len(problems), (draws, len(problems)))
    score = 0.0
    for pick in picks:
        a, b = (load.median(np.concatenate([of_problem[p][k] for p in pick])) for k in (0, 1))
        score += 0.5 * (b < a) + 0.5 * (b <= a)
    return score / draws


def refined_is_slower(records):
    """Whether the optimised sheet reaches the conventional split's accuracy in less time."""
    parts, verdicts = [], {}
    for tolerance in profiles.TOLERANCES:
        times = {v: profiles.solved_times(records, v, tolerance) for v in (CONVENTIONAL, PAPERS)}
        solved = {v: np.isfinite(t) for v, t in times.items()}
        medians = {v: load.median(t) for v, t in times.items()}
        if not np.isfinite(list(medians.values())).any():
            continue  # neither solves half of the cases
        faster = share_of_draws(*times.values())
        verdicts[f"error {100 * tolerance:g} %"] = HELD if faster > 0.975 else NOT_HELD if faster < 0.025 else UNDECIDED
        parts.append(f"error {100 * tolerance:g} %: " + ", ".join(
            f"{name(v)} {100 * solved[v].mean():.0f} % of the cases, half of all " +
            (f"within {medians[v]:.3g} ms" if np.isfinite(medians[v]) else "never") for v in times) +
            f"; faster in {100 * faster:.0f} % of the draws")
    if not parts:
        return None
    return Finding(summed_up(verdicts), "Time to reach an error, by the best resolution, solver and number of iterations "
                   "(held: the paper's method is faster in 97.5 % of the draws of a bootstrap over problems): " + "; ".join(parts) + ".",
                   "accuracy_profile")


CLAIMS = [
    Claim("'maximum aspect ratio in the triangulation of less than 3' (conclusion, figure 9)", "fig9_aspect_ratio",
          below_limit("ar_max_cut_strict", "Maximum AR of the triangles the cut made or changed, forced corners left out,",
                      "fig9_aspect_ratio", 1)),
    Claim("the same, where forced wedges are left out, too", "fig9_aspect_ratio",
          below_limit("ar_max_cut_outside_wedges", "The same outside forced wedges", "fig9_aspect_ratio", 1)),
    Claim("'low average aspect ratio (less than 3)' (5.2)", "fig9_aspect_ratio",
          below_limit("ar_mean_all", "Mean AR of the sheet", "fig9_aspect_ratio_mean", 0.5)),
    Claim("the conventional subdivision's 'high aspect ratio', against the 'optimized' one (5.2)", "fig9_aspect_ratio",
          local_split_lowers),
    Claim("'a small number of additional DOFs' (5.4)", "fig9_aspect_ratio", few_vertices),
    Claim("'the total computation time in each call is less than six milliseconds' (5.3)", "table1_timing", real_time),
    Claim("cost that grows 4.8 times from 800 to 12800 triangles: 'integrated into a high-quality model' (5.3)",
          "table1_timing", growth),
    Claim("Bowyer-Watson has 'lower computational overhead than existing algorithms' (conclusion)", "table1_timing",
          overhead),
    Claim("updating the matrix is 'more computationally efficient than recalculating the global matrix' (4.2)",
          "table1_timing", incremental),
    Claim("'a stable and physically accurate incision' by optimised triangles (5.2)", "accuracy", physically_accurate),
    Claim("'ill-shaped objects can inject significant errors' (1)", "accuracy", shapes_cost_accuracy),
    Claim("'computational speed can be reduced by inefficient elements' (4.1.3), so that optimising them pays",
          "accuracy", refined_is_slower),
]


def records_of(results):
    """{stem: its records, or None where there are none}."""
    readers = {"fig9_aspect_ratio": lambda folder: load.read(folder, fig9_aspect_ratio.MEASURES).first_repetition(),
               "table1_timing": lambda folder: load.read(folder, table1_timing.MEASURES + table1_timing.IN_MOTION),
               "accuracy": Records}
    return {stem: read(results / stem) if (results / stem / "records.csv").is_file() else None
            for stem, read in readers.items()}


def context_of(records):
    return records.run.context if isinstance(records, Records) else records.context


def text_of(results):
    records = records_of(results)
    lines = ["# The paper's claims", "",
             "Claims of Xin et al. 2018 and what the records say about them. `plots/pages/claims.py` computes all verdicts and "
             "numbers from the records named below. A claim without records is not judged.", "",
             "| claim | verdict | what was found | figure |", "|---|---|---|---|"]
    for claim in CLAIMS:
        found = claim.find(records[claim.stem]) if records[claim.stem] is not None else None
        if found is None:
            why = f"`experiments/reproduce {claim.stem}` makes the records" if records[claim.stem] is None else \
                f"the records of {claim.stem} lack the rows for it"
            lines.append(f"| {claim.words} | untested | {why} | |")
            continue
        figure = f"{claim.stem}/{found.figure}.png"
        link = f"[{found.figure}]({figure})" if (results / figure).is_file() else f"`{load.script_of(claim.stem)}` draws it"
        lines.append(f"| {claim.words} | **{found.verdict}** | {found.evidence.replace('|', '/')} | {link} |")
    lines += ["", "| records | command | seed | commit | machine |", "|---|---|---|---|---|"]
    for stem, of_stem in records.items():
        if of_stem is not None:
            context = context_of(of_stem)
            dirty = " with uncommitted changes" if context.get("dirty") else ""
            lines.append(f"| {stem} | `{context.get('command', 'unknown')}` | {context.get('seed', 'unknown')} | "
                         f"{str(context.get('commit') or 'unknown')[:10]}{dirty} | {context.get('cpu', 'unknown')} |")
    return "\n".join(lines + ["", naming.AR_DEFINITION + " Intervals: bootstrap, 95 %.", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, metavar="DIR", default=load.REPOSITORY / "results",
                        help="holds the folders of the runs, receives claims.md (default: results)")
    path = parser.parse_args().results / "claims.md"
    text = text_of(path.parent)
    load.write_page(path, text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
