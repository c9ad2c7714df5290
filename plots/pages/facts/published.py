"""The published records, each read when it is first asked for."""

from functools import cached_property

from analysis import load, pareto
from analysis.accuracy import tip_functions
from analysis.accuracy.ranking import at_equal_unknowns
from analysis.accuracy.records import Records
from analysis.methods import comparison, kinds, remedies
from analysis.paper import fig9_aspect_ratio
from analysis.stability import points as stability_points
from analysis.whole_step import points, runs

REMEDIES = ["eigenvalue_ratio", "bending_eigenvalue_ratio", "stabilised_eigenvalue_ratio", "stabilised_bending_eigenvalue_ratio",
            "geometry_us", "crossed_triangles"]


class Published:
    def __init__(self, folder):
        self.folder = folder

    def run(self, stem, measures):
        return load.run_of(self.folder / f"{stem}.records.csv.xz", self.folder / f"{stem}.context.json", measures)

    def text(self, name):
        try:
            return (self.folder / name).read_text(encoding="utf-8")
        except OSError as error:
            load.stop(f"{self.folder / name} can't be read: {error.strerror}")

    @cached_property
    def cuts(self):
        """The comparison: each cut of each method once, but for the sheets that a method refuses altogether."""
        return comparison.cuts_of(self.run(comparison.STEM, comparison.MEASURES))[1]

    @cached_property
    def error_kinds(self):
        """The excess errors at rest, solved directly, by method: over kinds of problems, and by kind."""
        records = Records(self.folder, "method_comparison_accuracy.direct.records.csv.xz", "method_comparison_accuracy.context.json")
        return kinds.table_of(at_equal_unknowns(records).ranked()).set_index("method")

    @cached_property
    def stability(self):
        return stability_points.read(self.folder)

    @cached_property
    def remedies(self):
        """Of each remedy a row as analysis.methods.remedies.rows_of()."""
        records = Records(self.folder, "remedies_accuracy.direct.records.csv.xz", "remedies_accuracy.context.json")
        excess, *_ = remedies.errors(at_equal_unknowns(records).ranked())
        return remedies.rows_of(self.run("remedies", REMEDIES).first_repetition(), excess)

    @cached_property
    def remedy_cuts(self):
        """The number of cuts by each remedy."""
        rows = self.run("remedies", REMEDIES).first_repetition().rows
        return len(rows[rows["method"] == "conventional_split"])

    @cached_property
    def motions(self):
        return points.motions(runs.read(self.folder)[0])

    @cached_property
    def fronts(self):
        """Time against the energy norm in twelve settings, each method by its fastest solver."""
        costs = points.costs(runs.read(self.folder)[0])
        return points.joined(points.best_of(costs), self.energy_errors)

    @cached_property
    def energy_errors(self):
        return points.errors(points.LEADS, self.folder)

    @cached_property
    def flap(self):
        """The rows of motion.toml that were made."""
        rows = load.read_records(self.folder / "motion.records.csv.xz", [*load.TEXT, "problem", *load.COUNTS, "unknowns", "error"],
                                 all_columns=True)
        return rows[~pareto.failed_rows(rows)]

    @cached_property
    def tips(self):
        columns = [*load.TEXT, "problem", *load.COUNTS, "tip_functions", tip_functions.MEASURE]
        rows = load.read_records(self.folder / "tip_functions.records.csv.xz", columns, all_columns=True)
        return rows.assign(error=rows[tip_functions.MEASURE].abs())

    @cached_property
    def robustness(self):
        return load.read_counts(self.folder / "robustness.records.csv.xz")

    @cached_property
    def figure_9(self):
        return self.run(fig9_aspect_ratio.STEM, fig9_aspect_ratio.MEASURES).first_repetition()

    @cached_property
    def solvers(self):
        import pandas as pd
        return pd.read_csv(self.folder / "solver_table.csv.xz", dtype={"cuts": str}).replace({"solver": load.OLD_SOLVERS})
