"""Methods ranked by excess error: over the fitted mesh of as many triangles as the uncut sheet, and over one with as
many unknowns as the cut sheet, so that nobody wins by triangles alone."""

from dataclasses import dataclass

import numpy as np

from analysis import load, shares
from analysis.accuracy.records import CASE, REFERENCE
from analysis.load import of


@dataclass(frozen=True)
class Measure:
    """A ratio of errors that methods are ranked by, and the words for it."""
    column: str
    short: str
    fitted: str  # the mesh it is over
    note: str = ""


EQUAL_UNKNOWNS = Measure("ratio_equal", "at equal unknowns", "a body-fitted mesh with as many unknowns")
AS_MANY_TRIANGLES = Measure("ratio", "over a fitted mesh of as many triangles",
                            "a body-fitted mesh of as many triangles as the uncut sheet",
                            "With one resolution errors at equal unknowns are not known: how the fitted mesh's error falls "
                            "takes two.")


def ranked_by(records):
    """\\param records  at_equal_unknowns()"""
    return EQUAL_UNKNOWNS if records.table["ratio_equal"].notna().any() else AS_MANY_TRIANGLES


def per_unknown(reference):
    """p of error = constant x unknowns^-p, by least squares over the resolutions and members of one problem and sheet;
    0 where the error doesn't fall, NaN for a single resolution."""
    rows = reference[reference["error"] > 0]
    x, y = np.log(rows["unknowns"]), np.log(rows["error"])
    if rows["resolution"].nunique() < 2:
        return np.nan
    return max(0.0, -np.polyfit(x, y, 1)[0])


def at_equal_unknowns(records):
    """The records with `ratio_equal`: error over that of a fitted mesh with as many unknowns, the case's own fitted mesh
    refined as the problem's and sheet's fitted meshes converge, NaN where those have a single resolution; and `more`,
    unknowns over the fitted mesh's."""
    reference = of(records.rows(direct=True, failed=False), REFERENCE)
    powers = {key: per_unknown(rows) for key, rows in reference.groupby(["problem", "sheet"])}
    table = records.table.merge(reference[CASE + ["unknowns"]], on=CASE, how="left", suffixes=("", "_fitted"))
    power = np.array([powers.get(key, np.nan) for key in zip(table["problem"], table["sheet"])])
    more = table["unknowns"] / table["unknowns_fitted"]
    equal = (table["ratio"] * more**power).where(np.isfinite(power))  # 1**NaN is 1
    return records.with_rows(table.assign(more=more, ratio_equal=equal, excess_equal_percent=100 * (equal - 1)))


def mean_excess(table, column):
    """Of a ratio, in percent: its geometric mean minus one."""
    ratios = table.loc[~table["failed"], column]
    ratios = ratios[(ratios > 0) & np.isfinite(ratios)]
    return 100 * (np.exp(np.log(ratios).mean()) - 1) if len(ratios) else np.nan


def fair_excess(table, variant, column):
    """mean_excess() of a method. One that made fewer of the cases than shares.BASE gets that one's, times the ratio to it in the
    cases that both made: easy cases alone would flatter it. \param table  of made_by_all()"""
    made, base = of(table, variant), of(table, shares.BASE)
    if base.empty or not is_few(table, variant):
        return mean_excess(made, column)
    pairs = made.merge(base, on=[*CASE, "solver", "budget"], suffixes=("", "_base"))
    pairs = pairs.assign(over_base=pairs[column] / pairs[f"{column}_base"], failed=False)
    return 100 * ((1 + mean_excess(base, column) / 100) * (1 + mean_excess(pairs, "over_base") / 100) - 1)


def is_few(table, variant):
    """It made under half of the cases that shares.BASE made."""
    return len(of(table, variant)) < shares.LEAST * len(of(table, shares.BASE))


def made_by_all(table):
    """The rows of the cases, solvers and budgets in which nobody failed. Those who failed in over half of theirs do not decide
    which cases these are."""
    few = table["failed"].groupby([table[c] for c in load.VARIANT]).transform("mean") > 0.5
    failed = (table["failed"] & ~few).groupby([table[c] for c in (*CASE, "solver", "budget")]).transform("any")
    return table[~failed & ~table["failed"]]


def print_ranking(records, title):
    """Of records at_equal_unknowns(), without what a fitted mesh solves exactly, too."""
    records = records.ranked()
    if not records.problems:
        return
    rows, last, budgets, measure = [], {}, not records.table["direct"].all(), ranked_by(records)
    by = 4 if measure == EQUAL_UNKNOWNS else 5
    for sheet in [*records.sheets, "all"]:
        chosen = records.table if sheet == "all" else records.rows(sheet=sheet)
        common, counts = made_by_all(chosen), shares.shares(chosen, chosen["failed"], records.programs)
        for variant, look in records.looks.items():
            made = of(common, variant)
            direct = made[made["direct"]]
            table = of(chosen, variant)
            cells = [mean_excess(direct, "ratio_equal"), mean_excess(direct, "ratio"), 100 * (direct["more"].median() - 1),
                     direct["ms"].median(), direct["cut_us"].median() / 1000]
            if budgets:
                for solver in records.solvers:
                    done = made[(made["solver"] == solver) & (made["budget"] == records.enough())]
                    cells.append(mean_excess(done, "ratio"))
            tried = table.drop_duplicates(CASE)
            share = counts.get(variant, shares.Share())
            rows.append([sheet, look.label, str(len(tried)), share.text(), *cells])
            last[sheet, look.label] = share.is_few
    rows.sort(key=lambda r: ([*records.sheets, "all"].index(r[0]), last[r[0], r[1]], np.nan_to_num(r[by], nan=np.inf)))
    solvers = records.solvers if budgets else []
    load.print_table(
        f"Ranking, {title} ({', '.join(records.problems)}): geometric mean of the error over the fitted mesh's, minus one, "
        "in percent, over problems, resolutions and members, of the cases that no method failed. "
        + ("Ranked at equal unknowns: over a fitted mesh refined to as many as the cut sheet has; beside it over one of as "
           "many triangles as the uncut sheet, where triangles alone can win" if measure == EQUAL_UNKNOWNS else
           f"{measure.note} Ranked over {measure.fitted}, where triangles alone can win")
        + (f". CG: after {records.enough()} iterations" if budgets else ""),
        ["sheet", "method", "cases", "made/refused/wrong %", "excess %, equal unknowns", "as many triangles", "more unknowns, %",
         "median ms", "of it cut", *(f"as many triangles, {s}" for s in solvers)], rows)
