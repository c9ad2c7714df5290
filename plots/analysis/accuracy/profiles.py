"""How soon each case is solved to a tolerance."""

import numpy as np

TOLERANCES = (0.2, 0.1, 0.05, 0.02)


def solved_times(records, variant, tolerance):
    """For each case of the ensemble, the least time over all resolutions, solvers and budgets to an error within the
    tolerance; infinity where no solve reaches it. A case: problem, sheet, member. Index: the problem."""
    table = members_throughout(records).rows(variant)
    good = table["ms"].where((table["error"] <= tolerance) & ~table["failed"], np.inf)
    return good.groupby([table[c] for c in ("problem", "sheet", "case")]).min().droplevel(["sheet", "case"])


def members_throughout(records):
    """The members that ran on all resolutions of their problem, or on all but one; without the problems that even the
    body-fitted mesh solves exactly."""
    table = records.ranked().table
    sizes = table.groupby(["problem", "case"])["resolution"].nunique().rename("sizes").reset_index()
    sizes["most"] = sizes.groupby("problem")["sizes"].transform("max")
    kept = sizes[sizes["sizes"] >= np.maximum(sizes["most"] - 1, 1)].set_index(["problem", "case"]).index
    return records.with_rows(table[table.set_index(["problem", "case"]).index.isin(kept)])
