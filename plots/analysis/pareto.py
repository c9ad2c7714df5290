"""Points of two measures, each the median of an ensemble, and the Pareto front: the points that no other beats in both."""

from dataclasses import dataclass

import numpy as np
import pandas as pd

from analysis import load

SOLVE = ["solver", "budget"]  # columns of records whose cuts were solved


@dataclass(frozen=True)
class Axis:
    """A column, and whether less of it is better."""
    column: str
    less_is_better: bool = True

    def cost(self, values):
        return values if self.less_is_better else -values


def failed_rows(table):
    return (table["verdict"] != "ok") | table["status"].isin(["failed", "refused"])


def cells(table, x, y, by, panel=()):
    """A row per group of `by` columns: median and quartiles of x and y over the rows that have them, their number, how
    many failed, and the layer of the front it is on among those of equal `panel` columns. A failed case counts as
    infinitely bad, so where half of them fail the group has no finite median and is on no front."""
    failed = failed_rows(table)
    table = table.assign(failed=failed)[failed | table[[x.column, y.column]].notna().all(axis=1)]
    found = []
    for key, group in table.groupby(by, sort=False):
        row = dict(zip(by, key)) | {"n": len(group), "failed": int(group["failed"].sum())}
        for name, axis in (("x", x), ("y", y)):
            costs = axis.cost(group[axis.column]).where(~group["failed"], np.inf)
            quartiles = [axis.cost(q) for q in load.quantiles(costs, [0.25, 0.5, 0.75])]
            row |= dict(zip((f"{name}_q1", name, f"{name}_q3"), quartiles))
            row[f"{name}_made"] = group.loc[~group["failed"], axis.column].median()
        found.append(row)
    result = pd.DataFrame(found)
    if result.empty:
        return result
    result["layer"] = 0
    for index in result.groupby([result[c] for c in panel] or np.zeros(len(result))).groups.values():
        here = result.loc[index]
        result.loc[index, "layer"] = load.front_layers(x.cost(here["x"]), y.cost(here["y"]))
    return result
