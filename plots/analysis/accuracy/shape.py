"""Whether the error depends on the shape of the triangles that a cut left, and from where on shape costs."""

import numpy as np
import pandas as pd

from analysis import load
from analysis.accuracy.records import CASE, CONVERGED, REFERENCE
from analysis.load import of


def shape_columns(records):
    """(title, condition) of the columns of the figure of shapes."""
    columns = [("direct solve", {"direct": True})]
    budget = records.enough()
    return columns + [(f"{solver.replace('_', ' ')},\n{budget} iterations", {"solver": solver, "budget": budget})
                      for solver in records.solvers]


def of_harness(records, table):
    """The rows of the methods that the claim is about: neither those of the reference nor of programs."""
    return table[~table["method"].isin({REFERENCE[0], *records.programs})]


def but_programs(records):
    """What a figure or table has to say where of_harness() leaves programs out."""
    names = ", ".join(sorted(name.replace("_", " ") for name in records.programs))
    return f"Programs ({names}) are in no fit and in no median over all methods. " if names else ""


def decades(table):
    """Median ratio by decade of the aspect ratio, where there are at least five cases; index: the decade's middle."""
    table = table.dropna(subset=["ratio", "ar_max_cut"])
    table = table[table["ar_max_cut"] > 0]
    groups = table.groupby(np.floor(np.log10(table["ar_max_cut"])))["ratio"]
    result = pd.DataFrame({"ratio": groups.median(), "n": groups.size()})
    result = result[result["n"] >= 5]
    return result.set_index(10 ** (result.index + 0.5))


def factor_per_decade(table, draws=2000):
    """By what the error is multiplied where the aspect ratio is ten times as large, all else alike: least squares of the
    logarithms, a level for each problem, sheet, resolution and method, and another for members along the mesh (of even
    number), who may err more or less than those at any angle, by problem, sheet and method; and its bootstrap 95 %
    interval over problems, each of which has the same cuts on all sheets and sizes. And the number of cases that say
    anything: those with another of their level."""
    table = table[(table["ratio"] > 0) & np.isfinite(table["ratio"]) & (table["ar_max_cut"] > 0)]
    level = [table[c] for c in (*CASE[:3], "method", "parameter")]
    table = table[table["case"].groupby(level).transform("size") > 1]
    if table.empty:
        return np.nan, np.nan, np.nan, 0
    x, y = within(np.log10(table["ar_max_cut"]), table), within(np.log(table["ratio"]), table)
    sums = pd.DataFrame({"xy": x * y, "xx": x * x}).groupby(table["problem"]).sum().to_numpy()
    sums = sums[sums[:, 1] > 1e-9]
    if not len(sums):
        return np.nan, np.nan, np.nan, len(table)
    picks = np.random.default_rng(1).integers(0, len(sums), (draws, len(sums)))
    drawn = sums[picks].sum(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        low, high = np.exp(np.nanpercentile(drawn[:, 0] / drawn[:, 1], [2.5, 97.5]))
    return np.exp(sums[:, 0].sum() / sums[:, 1].sum()), low, high, len(table)


def within(values, table):
    """The values without the two levels of factor_per_decade(), by taking the means of either out in turns."""
    levels = [table.groupby([table[c] for c in (*CASE[:3], "method", "parameter")]).ngroup(),
              table.groupby([table[c] for c in ("problem", "sheet", "method", "parameter")] + [table["case"] % 2]).ngroup()]
    for _ in range(50):
        for level in levels:
            values = values - values.groupby(level).transform("mean")
    return values


def dependence(low, high):
    """The interval of factor_per_decade() in words."""
    if 0.98 <= low and high <= 1.02:
        return "it does not depend on AR, within 2 %"
    if low <= 1 <= high:
        return "no dependence shown"
    barely = ", by less than 5 %" if 0.95 <= low and high <= 1.05 else ""
    return f"it {'grows' if low > 1 else 'falls'} with AR{barely}"


def shape_statements(records):
    found = []
    for title, condition in shape_columns(records):
        table = records.rows(**condition)
        factor, low, high, n = factor_per_decade(of_harness(records, table[~table["failed"]]))
        if not n or np.isnan(factor):
            continue
        title = title.replace("\n", " ")
        found.append(f"{title}: a tenfold AR multiplies the error by {factor:.3f} [{low:.3f}, {high:.3f}]: "
                     f"{dependence(low, high)} (n = {n}).")
    return found


def lags_of(records, solver, budget):
    """Each error after so many iterations over the same sheet's, solved directly: the same sheet on both sides, so nothing
    but the solver's progress is in it."""
    keys = [*CASE, "method", "parameter"]
    records = records.ranked()
    direct = records.rows(direct=True, failed=False).drop_duplicates(keys)[keys + ["error"]]
    table = records.rows(solver=solver, budget=budget, failed=False).merge(direct, on=keys, suffixes=("", "_d"))
    table = table[(table["method"] != REFERENCE[0]) & (table["error_d"] > 0) & (table["ar_max_cut"] > 0)]
    return table.assign(lag=table["error"] / table["error_d"], decade=np.floor(np.log10(table["ar_max_cut"])))


def by_decade(lags):
    """The median of each decade of the aspect ratio that has at least five cases."""
    found = lags.groupby("decade")["lag"].agg(["median", "size"])
    return found[found["size"] >= 5]["median"]


def starts_at(medians):
    """The lowest decade of the aspect ratio whose median is worse than that of a lower decade. Comparing decades separates
    the effect of shape from the error that the solver leaves at any shape."""
    best = np.inf
    for decade, median in medians.items():
        if median > CONVERGED * best:
            return f"AR {10 ** decade:.0f}"
        best = min(best, median)
    return "never"


def print_shapes(records):
    """Prints how much the shape of the triangles slows the solver, and from which decade on, for each method."""
    lags = {(solver, budget): lags_of(records, solver, budget) for solver in records.solvers for budget in records.budgets}
    kept = {key: of_harness(records, table) for key, table in lags.items()}
    rows = [[solver, str(budget), *(by_decade(table).get(d, np.nan) for d in range(7))]
            for (solver, budget), table in kept.items()]
    if not rows:
        return
    sizes = next(iter(kept.values())).groupby("decade").size()
    rows.append(["cases", "", *(str(sizes.get(d, 0)) for d in range(7))])
    load.print_table("Error after so many iterations over the same sheet's own, solved directly: medians over all methods "
                     f"by the largest aspect ratio of the cut. {but_programs(records)}".strip(), ["solver", "iterations", "AR 1-10", "10-100", "100-1000",
                                                                "1e3-1e4", "1e4-1e5", "1e5-1e6", "1e6-1e7"], rows)
    starts = [[look.label, solver, *(starts_at(by_decade(of(lags[solver, budget], variant))) for budget in records.budgets)]
              for variant, look in records.methods.items() if variant[0] != REFERENCE[0] for solver in records.solvers]
    load.print_table(f"From which decade of AR on shape slows the solver: the first whose median is above {CONVERGED} times that of a "
                     "lower decade, by iterations", ["method", "solver", *map(str, records.budgets)], starts)


def print_statements(records):
    records = records.in_plane()
    print("\nDoes the error depend on the aspect ratio? " + but_programs(records) + "All sheets:")
    for statement in shape_statements(records):
        print(f"  {statement}")
    for sheet in records.sheets:
        for statement in shape_statements(records.with_rows(records.rows(sheet=sheet))):
            print(f"  {sheet}, {statement}")
