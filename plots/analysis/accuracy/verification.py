"""Energies and stress intensities extrapolated to h = 0, rates of convergence, and whether they are as expected."""

import numpy as np
import pandas as pd
from scipy import stats

from analysis import load, naming
from analysis.accuracy.records import REFERENCE
from analysis.load import of

STEM = "verification"
RATES = {"released_energy": (1, 0.15), "strain_energy": (1, 0.15), "energy_norm": (0.5, 0.1),
         "displacement_l2": (1, 0.15)}  # at the tip of a cut
EXTRAPOLATED = ("released_energy", "strain_energy", "k1", "k2")
WITHIN, WITHIN_FIT = 0.5, 1.0  # percent of the exact value, of a handbook's fit
FITS = "edge_crack"
ROUNDING = 1e-9  # an error below it is exact but for rounding, and has no rate


def line(table, x, y, scatter):
    """Per sheet the straight line through the means of y over the members, by least squares; their members scatter like
    `scatter`, a function of x, as much as the residuals of all sizes together say. Mean over the sheets of (intercept,
    slope), and the half-widths of their 95 % intervals; NaN where there are too few."""
    nothing = np.full(2, np.nan), np.full(2, np.nan)
    found, variances, freedoms = [], [], []
    for _, sheet in table.groupby("sheet"):
        groups = sheet.groupby(x)[y].agg(["mean", "size", "var"]).dropna(subset=["mean"])
        at = groups.index.to_numpy(float)
        sizes = groups["size"].to_numpy(float)
        freedom = (sizes - 1).sum()
        if len(at) < 2 or freedom < 1:
            return nothing
        share = scatter(at)
        variance = np.nansum(groups["var"] * (sizes - 1) / share**2) / freedom
        weight = np.sqrt(sizes) / share
        solve = np.linalg.pinv(np.column_stack([np.ones_like(at), at]) * weight[:, None]) * weight
        found.append(solve @ groups["mean"].to_numpy())
        variances.append((solve**2) @ (share**2 / sizes) * variance)
        freedoms.append(freedom)
    if not found:
        return nothing
    width = stats.t.ppf(0.975, sum(freedoms)) * np.sqrt(np.sum(variances, axis=0)) / len(found)
    return np.mean(found, axis=0), width


def rate(table, measure):
    """The rate of convergence of the error over n, and the half-width of its interval. The logarithms are taken to have the
    same variance at all sizes."""
    table = table[table[f"error_{measure}"] > ROUNDING]
    table = table.assign(x=0.5 * np.log(table["resolution"] / 2), y=np.log(table[f"error_{measure}"]))
    (_, slope), (_, width) = line(table, "x", "y", np.ones_like)
    return -slope, width


def extrapolated(table, measure, order):
    """100 log(value / exact) extrapolated to h = 0, in percent, and the half-width of its interval. The logarithm is used
    because a mesh shortens a cut by a length proportional to h, which multiplies the value; the scatter due to the position
    of the tip in its triangle is proportional to h, too. Deviations of K1 and K2 are relative to the intensity of both
    together. Without a tip (`order` 2) the square of h takes the place of h."""
    exact = table[f"exact_{measure}"]
    if measure in ("k1", "k2"):
        scale = np.hypot(table["exact_k1"], table["exact_k2"].fillna(0))
    else:
        scale = exact
    table = table.assign(h=np.sqrt(2 / table["resolution"]) ** order,
                         y=100 * np.log1p((table[f"value_{measure}"] - exact) / scale))
    (value, _), (width, _) = line(table, "h", "y", lambda h: h)
    return value, width


def verdict(deviation, width, tolerance):
    """Whether the interval, or only its middle, is within the tolerance."""
    if abs(deviation) + width <= tolerance:
        return "within"
    if abs(deviation) <= tolerance:
        return f"within; the interval reaches {abs(deviation) + width:.2f} %"
    return "outside; not its interval" if abs(deviation) - width <= tolerance else "OUTSIDE"


def findings(records):
    """A row per problem, measure and method."""
    direct = records.rows(direct=True, failed=False)
    direct = direct[(direct["exact_incision"] == 1) & (direct["method"] != REFERENCE[0])]
    rows = []
    for problem in records.problems:
        here = direct[direct["problem"] == problem]
        measures = [c[len("error_"):] for c in here.columns if c.startswith("error_") and here[c].notna().any()]
        at_tips = "opening" in measures or "k1" in measures
        for measure in measures:
            for variant in records.methods:
                table = of(here, variant).dropna(subset=[f"error_{measure}"])
                if table["resolution"].nunique() < 2:
                    continue
                expected = RATES.get(measure) if at_tips else None
                slope, slope_width = rate(table, measure)
                value = width = np.nan
                if measure in EXTRAPOLATED and (table[f"exact_{measure}"].abs() > 0).all():
                    value, width = extrapolated(table, measure, 1 if at_tips else 2)
                rows.append([problem, measure, variant, slope, slope_width, expected, value, width])
    return pd.DataFrame(rows, columns=["problem", "measure", "variant", "rate", "rate_width", "expected", "deviation",
                                       "width"])


def tolerance(problem):
    return WITHIN_FIT if problem.startswith(FITS) else WITHIN


def print_findings(table):
    rows, judged, rates = [], [], []
    for _, r in table.iterrows():
        of_rate = of_value = "-"
        if r["expected"] and np.isfinite(r["rate"]):
            of_rate = "as expected" if abs(r["rate"] - r["expected"][0]) <= r["expected"][1] else "NOT as expected"
            rates.append(of_rate == "as expected")
        if np.isfinite(r["deviation"]):
            of_value = verdict(r["deviation"], r["width"], tolerance(r["problem"]))
            judged.append(of_value)
        rows.append([r["problem"], r["measure"], naming.looks([r["variant"]])[r["variant"]].label, r["rate"],
                     r["rate_width"], f"{r['expected'][0]:g} ± {r['expected'][1]:g}" if r["expected"] else "-", of_rate,
                     r["deviation"], r["width"], of_value])
    load.print_table("Verification (not a ranking): rate of convergence over n, and the deviation from the exact value "
                     "extrapolated to h = 0, percent; ±: 95 %",
                     ["problem", "measure", "method", "rate", "±", "expected", "judged", "extrapolated, %", "±",
                      "judged"], rows)
    near = sum(v.startswith("within") for v in judged)
    print(f"Energies and K extrapolated within {WITHIN:g} % of exact ({WITHIN_FIT:g} % of a handbook's fit): {near} of "
          f"{len(judged)}; with all of their 95 % interval: {judged.count('within')}; outside with all of it: "
          f"{judged.count('OUTSIDE')}; without 0 in it, so that what is left is no chance: "
          f"{(table['deviation'].abs() > table['width']).sum()}. Rates at the tips of cuts as expected: {sum(rates)} of {len(rates)}.")
