"""The error itself, over time or unknowns: every method against the same truth, whatever the size of its sheet."""

import numpy as np
import pandas as pd

from analysis import load
from analysis.accuracy.profiles import members_throughout
from analysis.accuracy.ranking import made_by_all
from analysis.accuracy.records import REFERENCE
from analysis.load import of


def throughout(records):
    """The direct solves of the problems, and of their members, that are on all sizes, so that sizes can be compared."""
    records = members_throughout(records)
    table = records.rows(direct=True)
    sizes = table.groupby("problem")["resolution"].nunique()
    return records.with_rows(table[table["problem"].isin(sizes[sizes == sizes.max()].index)])


def by_problem(table):
    """Geometric mean of the error, of each problem."""
    made = table[(table["error"] > 0) & ~table["failed"]]
    return np.exp(np.log(made["error"]).groupby(made["problem"]).mean())


def interval(mine, reference):
    """95 %, by drawing the problems anew, of the mean of `mine` over that of `reference`, times the latter: the problems'
    own levels cancel. Both are of by_problem()."""
    logs = np.log(mine / reference).dropna().to_numpy()
    if not len(logs):
        return np.nan, np.nan
    return np.exp(np.log(reference).mean() + np.quantile(load.drawn_means(logs), [0.025, 0.975]))


def points(records, x):
    """A row per sheet, resolution and variant, as front.draw() takes it: median of column `x`; the geometric mean over
    problems of the error in percent, of the cases that no method failed, and its interval."""
    rows = []
    for (sheet, resolution), here in records.table.groupby(["sheet", "resolution"], sort=False):
        common = made_by_all(here)
        reference = by_problem(of(common, REFERENCE))
        for variant in records.looks:
            tried, made = of(here, variant), of(common, variant)
            errors = by_problem(made)
            y = 100 * np.exp(np.log(errors).mean())
            low, high = (y, y) if variant == REFERENCE else (100 * end for end in interval(errors, reference))
            q1, middle, q3 = load.quantiles(made[x], [0.25, 0.5, 0.75])
            rows.append({"sheet": sheet, "resolution": resolution, "method": variant[0], "parameter": variant[1], "x": middle,
                         "x_q1": q1, "x_q3": q3, "x_made": tried.loc[~tried["failed"], x].median(), "y": y, "y_q1": low,
                         "y_q3": high, "n": len(tried), "failed": int(tried["failed"].sum())})
    found = pd.DataFrame(rows)
    return found.assign(layer=np.isfinite(found[["x", "y"]]).all(axis=1).astype(int))  # none is pale
