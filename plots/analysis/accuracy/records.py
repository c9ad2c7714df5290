"""Records of an accuracy run (harness/study/accuracy.h)."""

import copy

import numpy as np

from analysis import load, naming, pareto, shares
from analysis.load import of

REFERENCE = ("body_fitted (reference)", "")
NEEDED = ["budget", "exact_incision", "cut_us", "total_us", "unknowns", "iterations", "ar_max_cut", "error",
          "excess_error"]
CASE = ["problem", "sheet", "resolution", "case"]
CONVERGED = 1.05  # of the direct solve's error: the iterations no longer matter
EXACT = 1e-5  # a fitted mesh that errs less is exact but for rounding: there is nothing to compare with, or to rank


class Records:
    """The rows with: failed, ratio (error over the reference's), ms, variant columns, direct (solved to the end). Those
    solved with tip functions are left out."""

    def __init__(self, folder, records="records.csv", context="context.json"):
        table = load.read_records(folder / records, load.TEXT + ["problem", "solver", "primary"] + load.COUNTS + NEEDED,
                                  all_columns=True)
        if "tip_functions" in table:
            table = table[table["tip_functions"] != 1]
        failed = pareto.failed_rows(table)
        fitted = table[(table["method"] == REFERENCE[0]) & ~failed].groupby("problem")["error"].median()
        self.exact = set(fitted[fitted < EXACT].index)
        table.loc[table["problem"].isin(self.exact), "excess_error"] = np.nan
        self.table = table.assign(failed=failed, ratio=1 + table["excess_error"], ms=table["total_us"] / 1000,
                                  excess_percent=100 * table["excess_error"], direct=table["budget"] == 0)
        self.run = load.Run(table[~failed], table[failed], load.read_context(folder / context))
        self.programs = load.programs(table, self.run.context)
        counts = shares.shares(self.table, self.table["failed"], self.programs)
        self.looks = naming.looks(set(zip(table["method"], table["parameter"])), self.programs, counts)
        self.methods = {v: look for v, look in self.looks.items() if v != REFERENCE}
        self.sheets = naming.sheet_order(table["sheet"])
        self.problems = list(dict.fromkeys(table["problem"]))
        self.resolutions = sorted(set(table["resolution"]))
        self.solvers = list(dict.fromkeys(table.loc[~self.table["direct"], "solver"]))
        self.budgets = sorted(set(table.loc[~self.table["direct"], "budget"].astype(int)))

    def rows(self, variant=None, **values):
        table = self.table if variant is None else of(self.table, variant)
        for column, value in values.items():
            table = table[table[column] == value]
        return table

    def with_rows(self, table):
        """The same with other rows."""
        other = copy.copy(self)
        other.table = table
        other.problems = [p for p in self.problems if p in set(table["problem"])]
        return other

    def in_plane(self):
        """Without the problems that take no budgets: those, out of plane, are on few sizes. The direct solve and all
        budgets are then of the same cases. All, where there are no budgets."""
        budgeted = set(self.table.loc[~self.table["direct"], "problem"])
        return self.with_rows(self.table[self.table["problem"].isin(budgeted)]) if budgeted else self

    def out_of_plane(self):
        return self.with_rows(self.table[~self.table["problem"].isin(set(self.in_plane().problems))])

    def ranked(self):
        """Without the problems that even the fitted mesh solves exactly."""
        return self.with_rows(self.table[~self.table["problem"].isin(self.exact)])

    def enough(self):
        """The fewest iterations of the first solver after which the reference mesh has converged on the largest sheet, in
        each problem's median; the most there are if it never does, None without any."""
        for budget in self.budgets:
            here = self.ranked().rows(REFERENCE, solver=self.solvers[0], budget=budget, resolution=self.resolutions[-1])
            if len(here) and (here.groupby("problem")["ratio"].median() <= CONVERGED).all():
                return budget
        return self.budgets[-1] if self.budgets else None

    def caption(self, *sentences):
        """The sentences, and where the rows, those of this, are from."""
        failed = self.table["failed"]
        drawn = load.Run(self.table[~failed], self.table[failed], self.run.context)
        return " ".join([*sentences, naming.provenance(drawn, drawn.rows, with_machine=True, with_crosses=False)])


def cells_of(table, x, y, by, panel=()):
    return pareto.cells(table, pareto.Axis(x), pareto.Axis(y), by, panel)
