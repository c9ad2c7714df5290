"""How sure is a front? Cuts and kinds of problems are drawn anew, with replacement (bootstrap)."""

import numpy as np
import pandas as pd

from analysis import load
from analysis.whole_step import points
from analysis.whole_step.points import SETTING


def fronts(motions, measure, draws, folder):
    """Yields tables as points.joined() makes them, each method by its fastest solver. A draw takes the same cuts and the same kinds
    of problems for all methods, and the cuts for all settings. Sheets share paths, but are drawn apart: by paths with all of their
    sheets the shares of README's chart change by 4 % at most."""
    random = np.random.default_rng(1)
    motions = motions.assign(cut=motions["sheet"] + motions["case"].astype(str), grew=motions["verdict"].eq("energy_growth").astype(float))
    by_cut = {size: here.pivot(index=[*SETTING, "method", "solver"], columns="cut", values=["ms", "grew"])
              for size, here in motions.groupby("resolution")}
    levels, ratios = points.by_kind(points.with_fitted(points.published(measure, folder)))
    for _ in range(draws):
        times = pd.concat([_medians(table, random, size) for size, table in by_cut.items()], ignore_index=True)
        kinds = random.integers(0, levels.shape[1], levels.shape[1])
        ratio = ratios.iloc[:, kinds].mean(axis=1)  # of the kinds that the method has
        level = levels.iloc[:, kinds].mean(axis=1).reindex(ratio.index, level="resolution")
        error = np.exp(ratio + level).rename("error").dropna().reset_index()
        yield points.joined(points.best_of(times.dropna(subset=["ms"])), error)


def _medians(by_cut, random, size):
    cuts = random.integers(0, by_cut["ms"].shape[1], by_cut["ms"].shape[1])
    ms = [load.median(row) for row in by_cut["ms"].to_numpy()[:, cuts]]
    return pd.DataFrame({"ms": ms, "grew": by_cut["grew"].iloc[:, cuts].mean(axis=1)}).reset_index().assign(resolution=size)


def shares(motions, measure, folder, draws=1000):
    """By (method, resolution): the share of the draws in which it is on the front. \\param motions  of one setting"""
    found = pd.concat([table.assign(first=table["layer"] == 1) for table in fronts(motions, measure, draws, folder)])
    return found.groupby(["method", "resolution"])["first"].sum() / draws
