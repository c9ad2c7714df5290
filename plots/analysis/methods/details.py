"""What medians over all cuts do not show: shapes by sheet and cut family, tails of the distributions, and one method
against each other one on the same cuts."""

import numpy as np
import pandas as pd

from analysis import load
from analysis.load import of

GROUPS = {  # of the columns below, by the beginning of their names (load.group)
    "AR < 3": "forced", "eigenvalue, ": "stability", "eigenvalue x": "stability", "correlation": "stability", "us, ": "time", "failed: ": "outcome", "pairs": "pairs",
    "time over": "pairs", "error, ": "accuracy_run", "of several cuts": "pairs", "no larger eigenvalue": "pairs",
}
KEY = ["cut_family", "sheet", "resolution", "case"]


def quantile(values, share):
    """Of values that may be infinite, for what failed."""
    return float(load.quantiles(values, [share])[0])


def by_sheet_and_family(table, order, sheets):
    """A row per method: by sheet the cuts with every aspect ratio below 3 outside forced wedges, and away from them, of
    those that changed triangles; median eigenvalues by family over all sheets, on the first sheet, and there of curved
    cuts, and of those that meet nothing at less than asin(1/3); their tails, those of the even sheets, those with bending and
    those with a stabilised mass; the time at the largest resolution, and that of all cuts over all their crossed triangles; failures by verdict."""
    rows = []
    families = list(dict.fromkeys(table["cut_family"]))
    largest = table["resolution"].max()
    for variant in order:
        cuts = of(table, variant)
        row = {"method": variant[0], "parameter": variant[1]}
        for sheet in sheets:
            here = cuts[cuts["sheet"] == sheet]
            here = here[here["ar_max_cut_outside_wedges"].notna() | here["failed"]]
            for name, kind in (("outside wedges", "outside_wedges"), ("away", "away_from_wedges")):
                below = (here[f"ar_max_cut_{kind}"] < 3) & ~here["failed"]
                row[f"AR < 3 {name}, {sheet}"] = f"{int(below.sum())}/{len(here)}" if len(here) else "-"
        eigenvalue = cuts["eigenvalue_ratio"]
        for family in families:
            row[f"eigenvalue, {family}"] = load.median(eigenvalue[cuts["cut_family"] == family])
        first = cuts["sheet"] == sheets[0]
        row[f"eigenvalue, {sheets[0]}"] = load.median(eigenvalue[first])
        if "curved" in families:
            curved = first & (cuts["cut_family"] == "curved")
            row[f"eigenvalue, {sheets[0]}, curved"] = load.median(eigenvalue[curved])
            row["eigenvalue, of these nothing forced"] = load.median(eigenvalue[curved & (cuts["forced_corners"] == 0)])
        for share in (0.9, 0.95):
            row[f"eigenvalue, {100 * share:g} %"] = quantile(eigenvalue, share)
        # The graded sheet's largest eigenvalue is that of its fine corner, which most cuts don't meet.
        graded = cuts["sheet"] == "graded"
        row["eigenvalue, even sheets"] = load.median(eigenvalue[~graded])
        row["eigenvalue, even sheets, 95 %"] = quantile(eigenvalue[~graded], 0.95)
        row["eigenvalue, graded"] = load.median(eigenvalue[graded])
        for name, column in (("with bending", "bending_eigenvalue_ratio"), ("stabilised mass", "stabilised_eigenvalue_ratio")):
            for share, of_share in ((0.5, ""), (0.95, ", 95 %")):
                row[f"eigenvalue, {name}{of_share}"] = quantile(cuts[column], share)
        us = cuts.loc[cuts["resolution"] == largest, "us_per_crossed"]
        for name, share in (("q1", 0.25), ("median", 0.5), ("q3", 0.75)):
            row[f"us, {largest}, {name}"] = quantile(us, share)
        timed = cuts[cuts["geometry_us"].notna()]
        row["us, total over total"] = timed["geometry_us"].sum() / timed["crossed_triangles"].sum()
        failed = cuts[cuts["failed"]]
        for verdict, count in failed["verdict"].where(failed["status"] != "refused", "refused").value_counts().items():
            row[f"failed: {verdict}"] = float(count)
        rows.append(row)
    return pd.DataFrame(rows)


def altitude_law(table, order):
    """A row per method: how well the smallest altitude alone tells the largest eigenvalue, of cuts that leave one over 100
    times the uncut sheet's; without the graded sheet, whose h is no measure of its smallest triangles."""
    rows = []
    for variant in order:
        cuts = of(table, variant)
        cuts = cuts[(cuts["sheet"] != "graded") & (cuts["eigenvalue_ratio"] > 100) & ~cuts["failed"]]
        if len(cuts) < 10:
            continue
        product = cuts["eigenvalue_ratio"] * cuts["altitude_min_h_cut"] ** 2
        logarithms = np.log(cuts[["eigenvalue_ratio", "altitude_min_h_cut"]])
        rows.append({"method": variant[0], "parameter": variant[1], "cuts": len(cuts),
                     "correlation of logarithms": -logarithms.corr().iloc[0, 1],
                     **{f"eigenvalue x altitude2, {name}": product.quantile(share)
                        for name, share in (("5 %", 0.05), ("median", 0.5), ("95 %", 0.95))}})
    return pd.DataFrame(rows)


def jumps(table, order):
    """A row per method: the jumps at the cut relative to the value before; median, 95 % quantile and worst cut."""
    rows = []
    for variant in order:
        cuts = of(table, variant)
        row = {"method": variant[0], "parameter": variant[1], "cuts": len(cuts)}
        for column in ("membrane_jump", "bending_jump", "residual_jump"):
            for name, share in (("median", 0.5), ("95 %", 0.95), ("worst", 1)):
                row[f"{column}, {name}"] = cuts[column].quantile(share)
        rows.append(row)
    return pd.DataFrame(rows)


def against(table, one, order):
    """A row for each other method, over the cuts that neither failed: its time over that of `one`, and the share of cuts
    after which the largest eigenvalue of `one` is not the larger."""
    mine = of(table, one)
    mine = mine[~mine["failed"]]
    rows = []
    for variant in order:
        if variant == one:
            continue
        theirs = of(table, variant)
        pairs = mine.merge(theirs[~theirs["failed"]], on=KEY, suffixes=("", "_theirs"))
        ratio = pairs["geometry_us_theirs"] / pairs["geometry_us"]
        asked = pairs[pairs["eigenvalue_ratio"].notna() & pairs["eigenvalue_ratio_theirs"].notna()]
        no_larger = asked["eigenvalue_ratio"] <= asked["eigenvalue_ratio_theirs"]
        row = {"method": variant[0], "parameter": variant[1], "pairs": len(pairs)}
        for share in (0.05, 0.5, 0.95):
            row[f"time over {one[0]}'s, {100 * share:g} %"] = ratio.quantile(share)
        row[f"no larger eigenvalue by {one[0]}, %"] = 100 * no_larger.mean() if len(asked) else np.nan
        several = asked["cut_family"] == "several"
        if several.any():
            row["of several cuts, %"] = 100 * no_larger[several].mean()
        rows.append(row)
    return pd.DataFrame(rows)
