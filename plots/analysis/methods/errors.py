"""The error of every method's cut sheet, after a direct solve and after a fixed number of iterations of conjugate gradients."""

import numpy as np
import pandas as pd

from analysis import shares
from analysis.accuracy.ranking import at_equal_unknowns, fair_excess, made_by_all, ranked_by
from analysis.accuracy.records import Records
from analysis.load import VARIANT, of

STEM = "method_comparison_accuracy"
WHAT = ("error over that of a body-fitted mesh, minus one: of a mesh with as many triangles as the uncut sheet, or with as "
        "many unknowns as the cut sheet; geometric means over the cases that no method failed; the most accurate first")
BUDGET = 100  # iterations of conjugate gradients


def summary(folder):
    """The records, and a row per method, most accurate first: geometric means over problems, sheets, sizes and members,
    of the cases that no method failed; by ranked_by()."""
    records = at_equal_unknowns(Records(folder)).ranked()
    measure = ranked_by(records)
    kept = {"all": records.table} | {sheet: records.rows(sheet=sheet) for sheet in records.sheets}
    common = {sheet: made_by_all(of_methods_there(table)) for sheet, table in kept.items()}
    rows = []
    for variant in records.methods:
        row = {"method": variant[0], "parameter": variant[1]}
        for sheet, table in kept.items():
            of_direct = common[sheet][common[sheet]["direct"]]
            of_stopped = common[sheet][~common[sheet]["direct"] & (common[sheet]["budget"] == BUDGET)]
            direct = of(of_direct, variant)
            row[f"excess_percent_{sheet}"] = fair_excess(of_direct, variant, measure.column)
            row[f"us_per_crossed_{sheet}"] = (direct["cut_us"] / direct["crossed_triangles"]).median()
            if sheet == "all":
                everything = of(table, variant)
                row |= {"cuts": len(everything[everything["direct"]]),
                        "failed": int(everything.loc[everything["direct"], "failed"].sum()),
                        "excess_percent_as_many_triangles": fair_excess(of_direct, variant, "ratio"),
                        "more_unknowns_percent": 100 * (direct["more"].median() - 1),
                        f"excess_percent_cg_{BUDGET}": fair_excess(of_stopped, variant, measure.column)}
        rows.append(row)
    table = last_if_few(pd.DataFrame(rows).sort_values("excess_percent_all", kind="stable"), records)
    table.attrs["note"] = measure.note
    return records, table


def counts_of(records):
    """shares.Share by variant."""
    return shares.shares(records.table, records.table["failed"], records.programs)


def last_if_few(table, records):
    """A table with a row per method; those that made under half of their cuts come last."""
    counts = counts_of(records)
    few = [counts[variant].is_few for variant in table[VARIANT].itertuples(index=False, name=None)]
    return table.iloc[np.argsort(few, kind="stable")]


def of_methods_there(table):
    """Without the methods that refuse a kind of sheet altogether, which would leave no case that all made."""
    key = [table[c] for c in ("method", "parameter", "sheet")]
    return table[~table["failed"].groupby(key).transform("all")]
