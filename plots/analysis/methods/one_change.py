"""What one kind of change does against thin triangles, alone and with others."""

from dataclasses import dataclass

import numpy as np

from analysis import load, naming, shares

STEM = "one_change"
PATH = ["cut", "case"]
CUT = ["sheet", "resolution", *PATH]
ERROR = "error_released_energy"
MADE = "made"  # shares.Share


@dataclass(frozen=True)
class Change:
    kind: str
    method: str = "conventional_split"
    mass: str = "lumped"
    solver: str = "cg"
    tips: int = 0

    def label(self):
        parts = [naming.words(self.method)] if self.kind not in ("functions", "mass", "solver") else []
        parts += ["tip functions"] * self.tips
        parts += [f"{self.mass} mass"] if self.mass != "lumped" else []
        parts += [self.solver] if self.solver != "cg" else []
        return ", ".join(parts)

    def short(self):
        """For the figure."""
        if self.kind != "together":
            return f"{self.kind}: {self.label()}"
        return f"{naming.words(self.method)}, tips, {'mass, ' if self.mass != 'lumped' else ''}multigrid"


BASE = Change("nothing")
CHANGES = [
    BASE, Change("mesh", "warp_and_refine"), Change("mesh", "adaptive_remesh"), Change("unknowns", "cut_polygons"),
    Change("unknowns", "split_and_tie"), Change("unknowns", "phantom_node"), Change("functions", tips=1),
    Change("mass", mass="stabilised"), Change("solver", solver="multigrid"),
    Change("together", "conventional_split", "stabilised", "multigrid", 1),
    Change("together", "warp_and_refine", "stabilised", "multigrid", 1),
    Change("together", "adaptive_remesh", "stabilised", "multigrid", 1),
    Change("together", "cut_polygons", "lumped", "multigrid", 1),
]


def ratio(here, base, column):
    """Median over the cuts of the time over that of the baseline on the same cut, and its 95 % interval: paths drawn anew, each with
    its cuts of all sheets and sizes, which are alike."""
    pairs = here.merge(base[CUT + [column]], on=CUT, suffixes=("", "_base"))
    if pairs.empty:
        return np.nan, np.nan, np.nan
    pairs["ratio"] = pairs[column] / pairs[f"{column}_base"]
    paths = pairs.pivot(index=PATH, columns=["sheet", "resolution"], values="ratio").to_numpy()
    picks = np.random.default_rng(1).integers(0, len(paths), (10000, len(paths)))
    return pairs["ratio"].median(), *np.quantile(np.nanmedian(paths[picks], axis=(1, 2)), [0.025, 0.975])


def error(cracks):
    """Mean of the errors in percent, and its 95 % interval: all ways to draw the problems anew, which have as many cracks each."""
    means = 100 * cracks[ERROR].abs().groupby(cracks["problem"]).mean()
    return means.mean(), *np.quantile(load.drawn_means(means), [0.025, 0.975])


def in_words(value, low, high):
    return "-" if np.isnan(value) else f"{load.number(value)} [{load.number(low, 2)}, {load.number(high, 2)}]"


def rows_of(cuts, errors):
    """Of each change the numbers of the table, by name; sizes: the numbers of triangles. Those of a kind that made few of their
    cuts come last, with eigenvalues and iterations by shares.fair_values()."""
    sizes = sorted(set(cuts["resolution"]))
    rows, base_of_mass = [], cuts[:0]
    for change in CHANGES:
        of_mass = cuts[(cuts["method"] == change.method) & (cuts["mass"] == change.mass)]
        here = of_mass[of_mass["solver"] == change.solver]
        if change.kind == "functions":  # at rest only
            here = here[:0]
        made = shares.counted(here, here["status"].isin(["failed", "refused"]))
        if change == BASE:
            base, base_of_mass = here, of_mass
        eigenvalue = shares.fair_values(of_mass, base_of_mass, "eigenvalue_ratio", [*CUT, "solver"], made.is_few)  # of one solver: it depends on none
        cracks = errors[(errors["method"] == change.method) & (errors["tip_functions"] == change.tips)]
        row = dict(zip(["eigenvalue", "95 %", "worst"], np.quantile(eigenvalue, [0.5, 0.95, 1])))
        for n in sizes:
            row[f"error %, {n}"] = error(cracks[cracks["resolution"] == n])
        for n in sizes:
            of_size = [table[table["resolution"] == n] for table in (here, base)]
            row[f"iterations, {n}"] = shares.fair_values(*of_size, "iterations", CUT, made.is_few).median()
        for n in sizes:
            row[f"a step, {n}"] = ratio(here[here["resolution"] == n], base, "step_us")
        row["first step"] = ratio(here, base, "first_step_us")
        row["cut and update"] = ratio(here, base, "cut_update_us")
        row["energy grew %"] = 100 * (here["verdict"] == "energy_growth").mean()
        row[MADE] = made
        rows.append((change, row))
    return sorted(rows, key=lambda row: (row[0].kind == "together", row[1][MADE].is_few)), sizes
