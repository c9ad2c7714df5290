"""The numbers of the table of all methods: for each choice of sheet, cut family and size a row per method, computed from the
records by the functions of the figures."""

import itertools
from dataclasses import dataclass

import numpy as np
import pandas as pd

from analysis import load, naming, shares
from analysis.methods import comparison, same_cut
from analysis.methods.distribution import spread
from analysis.stability import points as stability_points
from analysis.whole_step import points as whole_step_points, runs

ALL = "all"
FAULTS = ["failed", "wrong", "crashed", "timed_out"]
ROBUSTNESS = ["tried", "refused", *FAULTS]


@dataclass(frozen=True)
class Column:
    """`of`: the columns of results/columns.json that it is computed from; `by`: the filters that change it."""
    key: str
    label: str
    unit: str
    stem: str
    of: tuple
    what: str  # how it is computed of them
    by: tuple = ("sheet", "family", "triangles")
    better: str = "lower"

    def as_json(self):
        definitions = [f"{load.columns()[c]['label']}: {load.columns()[c]['definition']}" for c in self.of]
        return {"key": self.key, "label": self.label, "unit": self.unit, "better": self.better, "stem": self.stem, "by": self.by,
                "definition": " ".join([self.what, *definitions])}


HALF = "Median over the cuts, of which a failed one is infinitely bad."
COLUMNS = [
    Column("us_per_crossed", "time of a cut per crossed triangle", "µs", "method_comparison", ("geometry_us", "crossed_triangles"),
           f"{HALF} Geometry alone, caches warm."),
    Column("step_ms", "time of a cut and the motion after it", "ms", "whole_step", ("cut_update_us", "first_step_us", "step_us"),
           "Median over sheets and cuts of one cut, its update and the 0.25 s after it, by the method's fastest solver; the setting is "
           "below the table. Motions that ended early are infinitely slow.", ("sheet", "triangles")),
    Column("error_percent", "error", "%", "method_comparison_accuracy", ("error",),
           "Relative error of a direct solve in the energy norm, geometric mean over kinds of problems, of the cases that no "
           "method failed (always the project's own run).", ("sheet", "triangles")),
    Column("eigenvalue_ratio", "largest eigenvalue / uncut", "", "method_comparison", ("eigenvalue_ratio",), HALF),
    Column("ar_max_cut", "worst aspect ratio", "", "method_comparison", ("ar_max_cut",), HALF),
    Column("incision_error_h", "incision error", "h", "method_comparison", ("incision_error_h",), HALF),
    Column("vertices_per_crossed", "vertices added per crossed triangle", "", "method_comparison",
           ("vertices_added", "crossed_triangles"), HALF),
    Column("failed_percent", "cuts that failed", "%", "method_comparison", ("status", "verdict"),
           "Share of the cuts that failed, were refused or were judged wrong; a kind of sheet that a method refuses altogether is left out."),
    Column("faults", "adversarial cuts: faults", "", "robustness", tuple(FAULTS),
           "Cuts that failed, were wrong, crashed or timed out in the robustness run.", ("sheet",)),
    Column("refused_percent", "adversarial cuts: refused", "%", "robustness", ("refused", "tried"),
           "Share of the cuts of the robustness run.", ("sheet",)),
    Column("explicit_step", "worst explicit step / uncut", "", "stability", ("explicit_step_ratio",),
           "Least over the places of the stability sweeps' sweep `vertex`, paths ever closer to a vertex. A cut that was not made has none.",
           ("sheet",), "higher"),
]


def files_of(results, stem):
    """(records, context) of this machine's run, else of the project's own, or None."""
    for records, context in ((f"{stem}/records.csv", f"{stem}/context.json"),
                             (f"reference/{stem}.records.csv.xz", f"reference/{stem}.context.json"),
                             (f"reference/{stem}.direct.records.csv.xz", f"reference/{stem}.context.json")):
        if (results / records).is_file() and (results / context).is_file():
            return results / records, results / context
    return None


def origin(files):
    """Where numbers are from: the file, the command, the commit, the seed, the suite version."""
    context = load.read_context(files[1])
    version = pd.read_csv(files[0], usecols=["suite_version"], dtype=str, comment="#", nrows=1)["suite_version"].iloc[0]
    return {"version": version, "file": "/".join(files[0].parts[-2:]), "command": str(context.get("command")), "seed": str(context.get("seed")),
            "commit": str(context.get("commit"))[:10] + (" with uncommitted changes" if context.get("dirty") else "")}


def chosen(table, **values):
    for column, value in values.items():
        if value != ALL and column in table:
            table = table[table[column] == value]
    return table


def of_cuts(table):
    """{column: {(method, parameter): value}} of rows of comparison.measured()."""
    worst = {m.column: m.worst for m in comparison.SHAPES + comparison.PRICE}
    groups = dict(list(table.groupby(load.VARIANT)))
    found = {key: {v: spread(cuts[key], worst.get(key, np.inf))[0][2] for v, cuts in groups.items()}
             for key in ("us_per_crossed", "eigenvalue_ratio", "ar_max_cut", "incision_error_h", "vertices_per_crossed")}
    return found | {"failed_percent": {v: 100 * cuts["failed"].mean() for v, cuts in groups.items()}}


def of_motions(rows):
    """{method: ms} by its fastest solver of those that ran all the sizes in the rows; medians over these sizes."""
    if rows.empty:
        return {}
    sizes = rows.groupby("solver")["resolution"].nunique()
    rows = rows[rows["solver"].map(sizes) == sizes.max()]
    cost = whole_step_points.best_of(whole_step_points.costs(rows.assign(resolution=0)))
    return dict(zip(cost["method"], cost["ms"]))


def of_robustness(table):
    sums = table.groupby(load.VARIANT)[ROBUSTNESS].sum()
    return {"faults": dict(sums[FAULTS].sum(axis=1)), "refused_percent": dict(100 * sums["refused"] / sums["tried"])}


def of_stability(rows):
    return {"explicit_step": dict(rows.groupby(load.VARIANT)[stability_points.EXPLICIT].min())}


class Comparison:
    """`cells`: {column: {choice of its filters, joined by "|": {method: value}}}."""

    def __init__(self, results):
        self.results = results
        self.origins, self.variants, self.cells = {}, {}, {}
        self.sheets, self.families, self.sizes, self.setting = [], [], [], ""
        self.programs, self.counts = set(), {}
        for stem, read in (("method_comparison", self._cuts), ("whole_step", self._motions), ("robustness", self._robustness),
                           ("stability", self._stability)):
            files = files_of(results, stem)
            if files:
                self.origins[stem] = origin(files)
                read(files)

    def _put(self, choice, found):
        for column, values in found.items():
            cell = self.cells.setdefault(column, {})["|".join(map(str, choice))] = {}
            for (method, parameter), value in values.items():
                if method in self.variants and self.variants[method] == parameter and not np.isnan(value):
                    cell[method] = float(f"{value:.6g}") if np.isfinite(value) else "inf"

    def _cuts(self, files):
        run, table = comparison.cuts_of(load.run_of(*files, comparison.MEASURES))
        self.variants |= dict(sorted(zip(table["method"], table["parameter"])))
        self.programs, self.counts = load.programs(run.everything(), run.context), comparison.counts_of(run)
        self.sheets = naming.sheet_order(table["sheet"])
        self.families = list(dict.fromkeys(table["cut_family"]))
        self.sizes = sorted(set(table["resolution"]))
        for choice in itertools.product([ALL, *self.sheets], [ALL, *self.families], [ALL, *self.sizes]):
            sheet, family, size = choice
            self._put(choice, of_cuts(chosen(table, sheet=sheet, cut_family=family, resolution=size)))

    def _motions(self, files):
        rows, _ = runs.read(files[0].parent)
        setting = runs.summarised(rows)
        self.setting = runs.setting_name(setting)
        rows = runs.at(rows, setting)
        self.variants |= {m: k for m, k in zip(rows["method"], rows["parameter"]) if m not in self.variants}
        self.sheets = self.sheets or naming.sheet_order(rows["sheet"])
        self.sizes = self.sizes or sorted(set(rows["resolution"]))
        rows = rows[rows["parameter"] == rows["method"].map(self.variants)]
        published = whole_step_points.published(whole_step_points.LEADS, self.results)
        self.origins["method_comparison_accuracy"] = origin(whole_step_points.MEASURES[whole_step_points.LEADS].files(self.results))
        for sheet, size in itertools.product([ALL, *self.sheets], [ALL, *self.sizes]):
            here = whole_step_points.errors_of(chosen(published, sheet=sheet, resolution=size), pooled=True)
            error = dict(zip(here["method"], 100 * here["error"])) if len(here) else {}
            found = {"step_ms": of_motions(chosen(rows, sheet=sheet, resolution=size)), "error_percent": error}
            self._put((sheet, size), {key: {(m, self.variants.get(m)): x for m, x in values.items()}
                                      for key, values in found.items()})

    def _robustness(self, files):
        table = load.read_counts(files[0])
        for sheet in [ALL, *self.sheets]:
            self._put((sheet,), of_robustness(chosen(table, sheet=sheet)))

    def _stability(self, files):
        rows = stability_points.read(files[0].parent)
        rows = rows[(rows["sweep"] == "vertex") & (rows["mass"] == "lumped")]
        for sheet in [ALL, *self.sheets]:
            self._put((sheet,), of_stability(chosen(rows, sheet=sheet)))

    def as_json(self):
        about = {m["name"]: m for m in same_cut.all_methods()} if same_cut.PROGRAM.is_file() else {}
        methods = []
        for method, parameter in sorted(self.variants.items()):
            text = about.get(method, {})
            of_parameter = text.get("parameter") or {}
            share = self.counts.get((method, parameter), shares.Share())
            methods.append({"name": method, "parameter": parameter, "summary": text.get("summary", ""), "meaning": of_parameter.get("meaning", ""),
                            "promises": [p.replace("_", " ") for p in text.get("promises", [])],
                            "program": method in self.programs, "share": share.beside().strip(), "few": share.is_few,
                            "outside": share.outside})
        cells = {column: {choice: [values.get(m["name"]) for m in methods] for choice, values in choices.items()}
                 for column, choices in self.cells.items()}
        return {"columns": [c.as_json() for c in COLUMNS if c.key in cells], "cells": cells, "methods": methods,
                "origins": self.origins, "setting": self.setting,
                "filters": {"sheet": [ALL, *self.sheets], "family": [ALL, *self.families],
                            "triangles": [ALL, *map(str, self.sizes)]}}
