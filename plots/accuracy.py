#!/usr/bin/env python3
"""How accurate a cut sheet is, and what that costs: the error of each problem's primary measure over that of a mesh made
anew to fit the cut, against time and unknowns, solved directly and by so many iterations of conjugate gradients; whether
it depends on the shape of the triangles; and which share of all cases is solved within a given time."""

import contextlib
import io

import numpy as np
import pandas as pd
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullFormatter, NullLocator

import front
import load
import style

STEM = "accuracy"
REFERENCE = ("body_fitted (reference)", "")
NEEDED = ["budget", "exact_incision", "cut_us", "total_us", "unknowns", "iterations", "ar_max_cut", "error",
          "excess_error"]
CASE = ["scene", "sheet", "resolution", "case"]
TOLERANCES = (0.2, 0.1, 0.05, 0.02)
CONVERGED = 1.05  # of the direct solve's error: the iterations no longer matter
EXPECTED_RATES = {"released_energy": (1, 0.15), "strain_energy": (1, 0.15), "energy_norm": (0.5, 0.1), "l2": (1, 0.15)}
AT_TIPS = ("opening", "k1")  # measures of problems whose cut ends inside the sheet, where these rates are expected
EXTRAPOLATED_WITHIN = 0.005
ROUNDING = 1e-9  # an error below it is exact but for rounding, and has no rate


class Records:
    """The rows with: failed, ratio (error over the reference's), ms, variant columns, direct (solved to the end)."""

    def __init__(self, folder):
        table = load.read_records(folder / "records.csv", load.TEXT + load.TEXT_OF_SOME + load.COUNTS + NEEDED,
                                  all_columns=True)
        failed = front.failed_rows(table)
        self.table = table.assign(failed=failed, ratio=1 + table["excess_error"], ms=table["total_us"] / 1000,
                                  excess_percent=100 * table["excess_error"], direct=table["budget"] == 0)
        self.run = load.Run(table[~failed], table[failed], load.read_context(folder / "context.json"))
        self.looks = style.looks(set(zip(table["method"], table["knob"])))
        self.methods = {v: look for v, look in self.looks.items() if v != REFERENCE}
        self.sheets = style.sheet_order(table["sheet"])
        self.problems = list(dict.fromkeys(table["scene"]))
        self.resolutions = sorted(set(table["resolution"]))
        self.solvers = list(dict.fromkeys(table.loc[~self.table["direct"], "solver"]))
        self.budgets = sorted(set(table.loc[~self.table["direct"], "budget"].astype(int)))

    def rows(self, variant=None, **values):
        table = self.table if variant is None else of(self.table, variant)
        for column, value in values.items():
            table = table[table[column] == value]
        return table

    def enough(self):
        """The fewest iterations of the first solver after which the reference mesh has converged on the largest sheet;
        the most there are if it never does, None without any."""
        for budget in self.budgets:
            here = self.rows(REFERENCE, solver=self.solvers[0], budget=budget, resolution=self.resolutions[-1])
            if len(here) and np.quantile(here["ratio"].fillna(np.inf), 0.75, method="inverted_cdf") <= CONVERGED:
                return budget
        return self.budgets[-1] if self.budgets else None

    def caption(self, *sentences):
        return " ".join([*sentences, style.provenance(self.run, self.run.rows, with_machine=True, with_crosses=False)])


def of(table, variant):
    return table[(table["method"] == variant[0]) & (table["knob"] == variant[1])]


def percent_axis(ax, values):
    """Excess errors in percent: where they are large, linear up to 10 and logarithmic beyond; plain numbers."""
    values = np.asarray(values, float)
    values = values[np.isfinite(values)]
    if len(values) and np.abs(values).max() > 100:
        ax.set_yscale("symlog", linthresh=10, linscale=0.7)
        ax.set_ylim(bottom=min(-12, 1.5 * values.min()))
        ax.yaxis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}"))
        ax.yaxis.set_minor_formatter(NullFormatter())


def ms_axis(ax):
    """Logarithmic, plain numbers. Call it when all is drawn."""
    ax.set_xscale("log")
    low, high = ax.get_xlim()
    ax.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5) if high < 40 * low else (1,), numticks=8))
    ax.xaxis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}"))
    ax.xaxis.set_minor_formatter(NullFormatter())


def cells_of(table, x, y, by, panel=()):
    return front.cells(table, front.Axis(x), front.Axis(y), by, panel)


def zero_line(ax):
    ax.axhline(0, color="#111111", linewidth=0.6, zorder=1)


def excess_figure(records, x, label, looks):
    """A panel per sheet: excess error of the direct solve over `x`, all problems, a point per resolution."""
    direct = records.rows(direct=True)
    cells = cells_of(direct[direct["method"] != REFERENCE[0]], x, "excess_percent",
                     ["sheet", "method", "knob", "resolution"], ["sheet"])
    figure, axes = style.panels(-(-len(records.sheets) // 2), min(2, len(records.sheets)), 4.4, sharex=True,
                                sharey=True)
    for i, ax in enumerate(axes.flat):
        ax.set_visible(i < len(records.sheets))
    for sheet, ax in zip(records.sheets, axes.flat):
        here = cells[cells["sheet"] == sheet]
        for variant, look in looks.items():
            front.draw(ax, of(here, variant).sort_values("resolution"), look)
        front.draw_front(ax, here)
        front.draw_failures(ax, here, looks)
        zero_line(ax)
        ms_axis(ax)
        percent_axis(ax, cells["y"])
        ax.set_title(style.sheet_title(sheet), loc="left")
    label_edges(axes, label, "excess error, %")
    style.finish(figure, looks.values(), records.caption(
        f"Excess error (of the primary measure, over that of a mesh made anew to fit the cut, minus one) against "
        f"{label}, solved directly: medians over {len(records.problems)} problems and their ensembles, a point per "
        "resolution; bars: quartiles; zero: the fitted mesh, which has as many triangles as the uncut sheet, so that methods "
        "which add many can fall below. ×: failed/tried, each counted as infinitely bad."),
        front.legend_entries())
    return figure


def label_edges(axes, x, y):
    rows, columns = axes.shape
    for r in range(rows):
        for c in range(columns):
            axes[r, c].set_ylabel("" if c else y)
            below = r + 1 < rows and axes[r + 1, c].get_visible()
            axes[r, c].set_xlabel("" if below else x)
            axes[r, c].tick_params(labelbottom=not below)


def problems_figure(records):
    """Work and precision: a panel per problem, the error itself against time, all sheets."""
    direct = records.rows(direct=True)
    cells = cells_of(direct, "ms", "error", ["scene", "method", "knob", "resolution"], ["scene"])
    rows = -(-len(records.problems) // 2)
    figure, axes = style.panels(rows, 2, 3.7, sharex=True)
    for i, ax in enumerate(axes.flat):
        ax.set_visible(i < len(records.problems))
    for problem, ax in zip(records.problems, axes.flat):
        here = cells[cells["scene"] == problem]
        for variant, look in records.looks.items():
            front.draw(ax, of(here, variant).sort_values("resolution"), look)
        front.draw_front(ax, here)
        front.draw_failures(ax, here, records.looks)
        ms_axis(ax)
        if (here["y"] > 0).any():
            ax.set_yscale("log")
            style.plain_numbers(ax)
        primary = records.rows(scene=problem)["primary"].iloc[0]
        ax.set_title(f"{problem}:\n{primary}".replace("_", " "), loc="left", fontsize=6.3)
    label_edges(axes, "total time, ms", "error")
    style.finish(figure, records.looks.values(), records.caption(
        "Error of each problem's primary measure against the total time (cut, assembly, direct solve): medians over all "
        "sheets and the ensemble, a point per resolution; bars: quartiles. The reference's cut is the meshing of the "
        "whole sheet. ×: failed/tried."), front.legend_entries())
    return figure


def budgets_figure(records):
    """A row per sheet, a column per solver: excess error over time at the highest resolution, a point per budget."""
    if not records.budgets:
        return None
    top = records.resolutions[-1]
    table = records.rows(resolution=top)
    table = table[table["scene"].isin(set(table.loc[~table["direct"], "scene"]))]
    figure, axes = style.panels(len(records.sheets), len(records.solvers), 3.7, sharex=True, sharey=True)
    everything = []
    for row, sheet in zip(axes, records.sheets):
        for ax, solver in zip(row, records.solvers):
            here = table[(table["sheet"] == sheet) & (table["direct"] | (table["solver"] == solver))]
            cells = cells_of(here, "ms", "excess_percent", ["method", "knob", "budget"])
            everything += list(cells["y"])
            for variant, look in records.looks.items():
                points = of(cells, variant).sort_values("budget")
                front.draw(ax, points[points["budget"] > 0], look)
                done = points[(points["budget"] == 0) & (points["layer"] > 0)]
                ax.plot(done["x"], done["y"], linestyle="", marker=look.marker, markersize=4.5, markeredgewidth=0.9,
                        markerfacecolor="none", markeredgecolor=look.colour, zorder=4)
            front.draw_front(ax, cells)
            front.draw_failures(ax, cells, records.looks)
            zero_line(ax)
            ms_axis(ax)
            ax.set_title(solver.replace("_", " ") if sheet == records.sheets[0] else "", loc="left")
    for ax in axes.flat:
        percent_axis(ax, everything)
    label_edges(axes, "total time, ms", "")
    for row, sheet in zip(axes, records.sheets):
        row[0].set_ylabel(f"{style.sheet_title(sheet)}\nexcess error, %")
    style.finish(figure, records.looks.values(), records.caption(
        f"Excess error against total time at {top} triangles, by {', '.join(map(str, records.budgets))} iterations of "
        "conjugate gradients from zero (filled) and by the direct solve (hollow), preconditioned by the vertices' own "
        "blocks (cg) and by joint blocks round slivers (cg sliver blocks): medians over problems and ensembles, bars: "
        "quartiles."), front.legend_entries())
    return figure


def shape_columns(records):
    """(title, condition) of the columns of the figure of shapes."""
    columns = [("direct solve", {"direct": True})]
    budget = records.enough()
    return columns + [(f"{solver.replace('_', ' ')},\n{budget} iterations", {"solver": solver, "budget": budget})
                      for solver in records.solvers]


def shape_figure(records):
    """A row per sheet: error ratio over the largest aspect ratio the cut left, every case a dot."""
    columns = shape_columns(records)
    figure, axes = style.panels(len(records.sheets), len(columns), 3.2, sharex=True, sharey=True)
    for row, sheet in zip(axes, records.sheets):
        for ax, (title, condition) in zip(row, columns):
            here = records.rows(sheet=sheet, **condition)
            for variant, look in records.methods.items():
                dots = of(here, variant).dropna(subset=["ratio", "ar_max_cut"])
                ax.plot(dots["ar_max_cut"], dots["ratio"], linestyle="", marker="o", markersize=1.3,
                        markeredgewidth=0, color=look.colour, alpha=0.45, zorder=2, rasterized=True)
            bins = decades(here[here["method"] != REFERENCE[0]])
            ax.plot(bins.index, bins["ratio"], color="#c00000", linewidth=1.1, marker="_", markersize=4, zorder=4)
            ax.axhline(1, color="#111111", linewidth=0.5, zorder=1)
            ax.set_xscale("log")
            ax.set_yscale("log")
            ax.set_title(title if sheet == records.sheets[0] else "", fontsize=6.3)
        row[0].set_ylabel(f"{style.sheet_title(sheet)}\nerror / fitted mesh's")
    for ax in axes.flat:
        ax.xaxis.set_major_locator(LogLocator(numticks=4))
        ax.xaxis.set_minor_formatter(NullFormatter())
        style.plain_numbers(ax)
    for ax in axes[-1]:
        ax.set_xlabel("max AR of the cut")
    dots = [Line2D([], [], linestyle="", marker="o", markersize=3, color=look.colour, label=look.label)
            for look in records.methods.values()]
    line = Line2D([], [], color="#c00000", linewidth=1.1, label="median per decade of AR")
    style.finish(figure, [], records.caption(
        "Does the error depend on the shape of the triangles? Error over that of the fitted mesh solved directly, against "
        "the largest aspect ratio among the triangles the cut made or changed; a dot per case. "
        f"{' '.join(shape_statements(records))} {style.AR_DEFINITION}"), [*dots, line])
    return figure


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
    logarithms within each problem, sheet, resolution and method, members along the mesh (of even number) apart from those
    at any angle; and its bootstrap 95 % interval over those groups."""
    table = table[(table["ratio"] > 0) & np.isfinite(table["ratio"]) & (table["ar_max_cut"] > 0)]
    if table.empty:
        return np.nan, np.nan, np.nan, 0
    group = table.groupby([table[c] for c in (*CASE[:3], "method", "knob")] + [table["case"] % 2]).ngroup()
    x, y = np.log10(table["ar_max_cut"]), np.log(table["ratio"])
    x, y = x - x.groupby(group).transform("mean"), y - y.groupby(group).transform("mean")
    sums = pd.DataFrame({"xy": x * y, "xx": x * x}).groupby(group).sum().to_numpy()
    sums = sums[sums[:, 1] > 0]
    if not len(sums):
        return np.nan, np.nan, np.nan, len(table)
    picks = np.random.default_rng(1).integers(0, len(sums), (draws, len(sums)))
    drawn = sums[picks].sum(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        low, high = np.exp(np.nanpercentile(drawn[:, 0] / drawn[:, 1], [2.5, 97.5]))
    return np.exp(sums[:, 0].sum() / sums[:, 1].sum()), low, high, len(table)


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
        factor, low, high, n = factor_per_decade(table[(table["method"] != REFERENCE[0]) & ~table["failed"]])
        if not n or np.isnan(factor):
            continue
        title = title.replace("\n", " ")
        found.append(f"{title}: a tenfold AR multiplies the error by {factor:.3f} [{low:.3f}, {high:.3f}]: "
                     f"{dependence(low, high)} (n = {n}).")
    return found


def solved_times(records, variant, tolerance):
    """Per case of the ensemble the least time, by whatever resolution, solver and budget, to an error within the
    tolerance; infinity where none gives it. A case: problem, sheet, member that every resolution has."""
    members = records.rows().groupby("resolution")["case"].nunique().min()
    table = records.rows(variant)
    table = table[table["case"] < members]
    good = table["ms"].where((table["error"] <= tolerance) & ~table["failed"], np.inf)
    return good.groupby([table[c] for c in ("scene", "sheet", "case")]).min().to_numpy()


def profile_figure(records):
    """Share of all cases solved to a tolerance within a time."""
    figure, axes = style.panels(2, 2, 4.0, sharex=True, sharey=True)
    for tolerance, ax in zip(TOLERANCES, axes.flat):
        for variant, look in records.looks.items():
            times = np.sort(solved_times(records, variant, tolerance))
            reached = times[np.isfinite(times)]
            if len(reached):
                share = 100 * np.arange(1, len(reached) + 1) / len(times)
                ax.step(reached, share, where="post", color=look.colour, linestyle=look.line,
                        linewidth=0.5 + 0.4 * look.width)
                ax.plot(reached[-1], share[-1], marker=look.marker, markersize=3.2, color=look.colour,
                        markeredgecolor="white", markeredgewidth=0.3)
        ax.set_title(f"error ≤ {100 * tolerance:g} %", loc="left")
        ms_axis(ax)
        ax.set_ylim(0, 102)
    label_edges(axes, "total time, ms", "cases solved, %")
    style.finish(figure, records.looks.values(), records.caption(
        f"Performance profile over all {len(records.problems)} problems and {len(records.sheets)} sheets: share of the "
        "cases (problem, sheet, member) whose primary measure is within the tolerance after so much time for cut, "
        "assembly and solve, by the best resolution, solver and number of iterations for each. Failed cases, and those "
        "that no resolution solves, are never reached."))
    return figure


def measures_of(table):
    return [c[len("error_"):] for c in table.columns if c.startswith("error_")]


def convergence(records):
    """A row per problem, measure and variant with exact incision: fitted rate of the geometric mean of the errors over
    members and sheets, and, of measures with an exact value other than 0, the relative deviation extrapolated to h = 0."""
    direct = records.rows(direct=True, failed=False)
    direct = direct[direct["exact_incision"] == 1]
    rows = []
    for problem in records.problems:
        of_problem = direct[direct["scene"] == problem]
        for measure in measures_of(direct):
            for variant in records.looks:
                table = of(of_problem, variant).dropna(subset=[f"error_{measure}"])
                if table["resolution"].nunique() > 2:
                    rows.append([problem, measure, variant, *rate(table, measure), *extrapolated(table, measure)])
    return pd.DataFrame(rows, columns=["problem", "measure", "variant", "rate", "low", "high", "deviation", "spread"])


def rate(table, measure):
    """-d log error / d log n by least squares, with the 95 % interval over bootstrap samples of (sheet, member)."""
    table = table[table[f"error_{measure}"] > ROUNDING]
    if table.empty:
        return np.nan, np.nan, np.nan
    members = table.groupby("resolution")["case"].nunique().min()
    wide = table[table["case"] < members].assign(y=lambda t: np.log(t[f"error_{measure}"])).pivot_table(
        index=["sheet", "case"], columns="resolution", values="y").dropna()
    if wide.empty or wide.shape[1] < 3:
        return np.nan, np.nan, np.nan
    x = 0.5 * np.log(wide.columns.to_numpy(float) / 2)
    x = x - x.mean()
    slopes = -(wide.to_numpy() @ x) / (x @ x)
    samples = np.random.default_rng(1).choice(slopes, (2000, len(slopes))).mean(axis=1)
    return slopes.mean(), *np.percentile(samples, [2.5, 97.5])


def extrapolated(table, measure):
    """value / exact - 1 at h = 0 by a straight line in h, or a parabola where there are enough resolutions: the mean over
    the sheets of that of their members, and its standard error."""
    if f"exact_{measure}" not in table or not (table[f"exact_{measure}"].abs() > 0).all():
        return np.nan, np.nan
    table = table.assign(h=np.sqrt(2 / table["resolution"]), d=table[f"value_{measure}"] / table[f"exact_{measure}"] - 1)
    means = table.groupby(["sheet", "h"])["d"].mean().unstack()
    ends = [np.polyfit(row.index, row, 2 if len(row) > 4 else 1)[-1]
            for row in (row.dropna() for _, row in means.iterrows()) if len(row) > 2]
    return (np.mean(ends), np.std(ends) / np.sqrt(len(ends))) if ends else (np.nan, np.nan)


def expected_rate(table, problem, measure):
    """(rate, tolerance), or None where none is expected."""
    if not set(AT_TIPS) & set(table.loc[table["problem"] == problem, "measure"]):
        return None
    return next((expected for name, expected in EXPECTED_RATES.items() if name in measure.lower()), None)


def verification_figure(records, table):
    """A panel per problem: error over resolution, solved directly, with the fitted rate."""
    problems = [p for p in records.problems if p in set(table["problem"])]
    if not problems:
        return None
    figure, axes = style.panels(-(-len(problems) // 2), 2, 3.7, sharex=True)
    for i, ax in enumerate(axes.flat):
        ax.set_visible(i < len(problems))
    direct = records.rows(direct=True, failed=False)
    for problem, ax in zip(problems, axes.flat):
        here = direct[(direct["scene"] == problem) & (direct["exact_incision"] == 1)]
        primary = here["primary"].iloc[0]
        for variant, look in records.looks.items():
            rows = of(here, variant)
            rows = rows[rows["error"] > 0]
            if rows.empty:
                continue
            means = np.exp(np.log(rows["error"]).groupby(rows["resolution"]).mean())
            ax.plot(np.sqrt(means.index / 2), means, **look.drawn())
        rates = table[(table["problem"] == problem) & (table["measure"] == primary)]["rate"].dropna()
        text = f"rate {rates.min():.2f}–{rates.max():.2f}" if len(rates) else "exact"
        ax.set_title(f"{problem}:\n{primary}, {text}".replace("_", " "), loc="left", fontsize=5.6)
        ax.set_xscale("log")
        ax.set_yscale("log")
        style.plain_numbers(ax)
        ax.xaxis.set_major_locator(FixedLocator(spaced(np.sqrt(np.array(records.resolutions) / 2))))
        ax.xaxis.set_minor_locator(NullLocator())
        ax.xaxis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}"))
        ax.xaxis.set_minor_formatter(NullFormatter())
    label_edges(axes, "n (squares per side)", "error")
    style.finish(figure, records.looks.values(), records.caption(
        "Verification, not a ranking: error of the primary measure over the resolution, solved directly (geometric mean "
        "over sheets and ensemble), for the methods that promise the exact incision. It shows that the code is right; "
        "every such method has nearly the same error."))
    return figure


def spaced(values):
    """Those of the ascending values that are a factor 1.4 apart."""
    kept = []
    for value in values:
        if not kept or value >= 1.4 * kept[-1]:
            kept.append(value)
    return kept


def print_ranking(records):
    rows = []
    for sheet in [*records.sheets, "all"]:
        chosen = records.table if sheet == "all" else records.rows(sheet=sheet)
        for variant, look in records.looks.items():
            table = of(chosen, variant)
            direct = table[table["direct"]]
            cells = [geometric_excess(direct), direct.loc[~direct["failed"], "ms"].median(),
                     direct.loc[~direct["failed"], "cut_us"].median() / 1000]
            for solver in records.solvers:
                cells.append(geometric_excess(table[(table["solver"] == solver) & (table["budget"] == records.enough())]))
            tried = table.drop_duplicates(CASE)
            bad = table[table["failed"]].drop_duplicates(CASE)
            rows.append([sheet, look.label, str(len(tried)), f"{100 * len(bad) / max(1, len(tried)):.1f}", *cells])
    rows.sort(key=lambda r: ([*records.sheets, "all"].index(r[0]), np.nan_to_num(r[4], nan=np.inf)))
    load.print_table(
        "Ranking: geometric mean of the error over the fitted mesh's, minus one, in percent; over problems, resolutions "
        f"and members. CG: after {records.enough()} iterations",
        ["sheet", "method", "cases", "failed %", "excess %, direct", "median ms", "of it cut",
         *(f"excess %, {s}" for s in records.solvers)], rows)


def geometric_excess(table):
    ratios = table.loc[~table["failed"], "ratio"]
    ratios = ratios[(ratios > 0) & np.isfinite(ratios)]
    return 100 * (np.exp(np.log(ratios).mean()) - 1) if len(ratios) else np.nan


def print_shapes(records):
    """Where shape starts to cost: the error after so many iterations over the same sheet's direct solve, by decade of
    the aspect ratio; the same sheet on both sides, so nothing but the solver's progress is in it."""
    keys = [*CASE, "method", "knob"]
    direct = records.rows(direct=True, failed=False).drop_duplicates(keys)[keys + ["error"]]
    rows, starts = [], []
    for solver in records.solvers:
        for budget in records.budgets:
            table = records.rows(solver=solver, budget=budget, failed=False).merge(direct, on=keys, suffixes=("", "_d"))
            table = table[(table["error_d"] > 1e-9) & (table["ar_max_cut"] > 0)]
            table = table.assign(lag=table["error"] / table["error_d"], decade=np.floor(np.log10(table["ar_max_cut"])))
            lags = table.groupby("decade")["lag"].agg(["median", "size"])
            lags = lags[lags["size"] >= 5]["median"]
            rows.append([solver, str(budget), *(lags.get(d, np.nan) for d in range(6))])
            slow = lags[lags > CONVERGED]
            starts.append(f"{solver}, {budget} iterations: " + (f"from AR {10 ** slow.index[0]:.0f}" if len(slow) else
                                                               "at no AR") + " on")
    if rows:
        load.print_table("Error after so many iterations over the same sheet's own, solved directly: medians by the "
                         "largest aspect ratio of the cut", ["solver", "iterations", "AR 1-10", "10-100", "100-1000",
                                                             "1e3-1e4", "1e4-1e5", "1e5-1e6"], rows)
        print(f"Shape starts to cost (median above {CONVERGED}): " + "; ".join(starts) + ".")


def print_verification(table):
    rows = []
    for _, r in table.iterrows():
        expected = expected_rate(table, r["problem"], r["measure"])
        judged = "" if expected is None or np.isnan(r["rate"]) else \
            "as expected" if abs(r["rate"] - expected[0]) <= expected[1] else "NOT as expected"
        rows.append([r["problem"], r["measure"], style.looks([r["variant"]])[r["variant"]].label, r["rate"], r["low"],
                     r["high"], f"{expected[0]:g} ± {expected[1]:g}" if expected else "-", judged or "-",
                     100 * r["deviation"], 100 * r["spread"]])
    if len(table):
        judged = table.dropna(subset=["deviation"])
        near = (judged["deviation"].abs() <= EXTRAPOLATED_WITHIN).sum()
        load.print_table("Verification (not a ranking): rate of convergence over n, and value / exact - 1 extrapolated to "
                         "h = 0, percent", ["problem", "measure", "method", "rate", "2.5 %", "97.5 %", "expected",
                                            "judged", "extrapolated %", "s.e."], rows)
        print(f"Extrapolated within {100 * EXTRAPOLATED_WITHIN:g} % of exact: {near} of {len(judged)}. Rates are expected at "
              "the tips of cuts only.")


def print_statements(records):
    print("\nDoes the error depend on the aspect ratio? All sheets:")
    for statement in shape_statements(records):
        print(f"  {statement}")
    for sheet in records.sheets:
        part = Records.__new__(Records)
        part.__dict__.update(records.__dict__, table=records.rows(sheet=sheet))
        for statement in shape_statements(part):
            print(f"  {sheet}, {statement}")


def print_all(records, table):
    print_ranking(records)
    print_shapes(records)
    print_statements(records)
    print_verification(table)


def write_text(folder, records, table):
    """Printed, and kept beside the figures."""
    text = io.StringIO()
    with contextlib.redirect_stdout(text):
        print_all(records, table)
        print(f"\n{style.provenance(records.run, records.run.rows, with_machine=True, with_crosses=False)}")
    path = folder / f"{STEM}.txt"
    try:
        path.write_text(text.getvalue().lstrip("\n"), encoding="utf-8")
    except OSError as error:
        load.stop(f"{path} can't be written: {error.strerror}")
    print(path)
    print(text.getvalue(), end="")


def main():
    folder = load.results_folder(STEM, __doc__)
    records = Records(folder)
    table = convergence(records)
    figures = {STEM: excess_figure(records, "ms", "total time, ms", records.methods),
               f"{STEM}_unknowns": excess_figure(records, "unknowns", "unknowns", records.methods),
               f"{STEM}_problems": problems_figure(records), f"{STEM}_budgets": budgets_figure(records),
               f"{STEM}_shape": shape_figure(records), f"{STEM}_profile": profile_figure(records),
               f"{STEM}_verification": verification_figure(records, table)}
    for stem, figure in figures.items():
        if figure:
            style.save(figure, folder, stem)
    write_text(folder, records, table)


if __name__ == "__main__":
    main()
