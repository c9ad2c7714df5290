"""How many of its cuts each method made, refused and got wrong; and its numbers cut by cut over those of one that makes all."""

from dataclasses import dataclass

import numpy as np
import pandas as pd

from analysis.load import VARIANT, cut_columns, of

BASE = ("conventional_split", "")  # what others are compared with, cut by cut
LEAST = 0.5  # of its cuts: a method that made fewer is drawn hollow and ranked last


@dataclass(frozen=True)
class Share:
    """Numbers of cuts. `outside`: on kinds of sheets that the method declares not to take; they are not among the others."""
    made: int = 0
    refused: int = 0
    wrong: int = 0
    outside: int = 0

    @property
    def tried(self):
        return self.made + self.refused + self.wrong

    @property
    def is_few(self):
        """Fewer than half were made."""
        return self.made < LEAST * self.tried

    def text(self):
        """Percent of the cuts tried, made / refused / failed: never 100 or 0 but for all or none."""
        if not self.tried:
            return "-"
        return "/".join(percent(n, self.tried) for n in (self.made, self.refused, self.wrong))

    def beside(self):
        """What follows the method's name: nothing where all cuts were made."""
        return f" [{self.text()} %]" if self.made < self.tried else ""


NAMES = "In brackets beside a name: % of its cuts made / refused / failed, where not all were made."
HOLLOW = f"Hollow, and last: made under half of its cuts. {NAMES}"


def percent(part, whole):
    return f"{min(99, max(1, round(100 * part / whole))):.0f}" if 0 < part < whole else f"{100 * part // whole:.0f}"


def is_outside(table, programs):
    """Of each row: on a kind of sheet that the method declares not to take: it refuses all cuts there, for one and the same
    reason. A program declares nothing: what it refuses counts."""
    groups = table.groupby([table[c] for c in (*VARIANT, "sheet")])
    all_refused = (table["status"] == "refused").groupby([table[c] for c in (*VARIANT, "sheet")]).transform("all")
    return all_refused & (groups["reason"].transform("nunique") == 1) & ~table["method"].isin(programs)


def shares(everything, failed, programs):
    """{(method, parameter): Share}; each cut counts once. \\param everything  rows, all repetitions; failed  of each row"""
    table = everything.assign(failed=failed, outside=is_outside(everything, programs), refused=everything["status"] == "refused")
    cuts = table.groupby(VARIANT + cut_columns(table))[["failed", "outside", "refused"]].any()
    kinds = pd.DataFrame({"made": ~cuts["failed"], "outside": cuts["outside"], "refused": cuts["refused"] & ~cuts["outside"],
                          "wrong": cuts["failed"] & ~cuts["refused"]})
    return {variant: Share(**row) for variant, row in kinds.groupby(level=VARIANT).sum().astype(int).to_dict("index").items()}


def of_run(run, programs):
    """shares() of a load.Run."""
    everything = run.everything()
    return shares(everything, np.arange(len(everything)) >= len(run.rows), programs)


def over_base(table, column, difference=False):
    """The column over that of BASE on the same cut (or minus it), of the cuts that both made; NaN elsewhere. None where the table
    has no BASE. \\param table  with `failed`, each cut once"""
    base = of(table, BASE)
    if base.empty:
        return None
    key = cut_columns(table)
    values = base.loc[~base["failed"]].set_index(key)[column]
    beside = values.reindex(pd.MultiIndex.from_frame(table[key])).to_numpy()
    here = table[column].where(~table["failed"])
    with np.errstate(divide="ignore", invalid="ignore"):
        found = here - beside if difference else here / beside
    return found.where(np.isfinite(found))


def fair_values(here, base, column, key, few):
    """The values of a method's cuts. One that made `few` gets those of BASE's cuts, times the median of its ratios to them on the
    cuts that both made: easy cuts alone would flatter it. \\param here, base  each cut once; key  columns that name a cut"""
    own = here[column].dropna()
    if not few or base.empty:
        return own
    pairs = here[[*key, column]].merge(base[[*key, column]], on=key, suffixes=("", "_base"))
    return base[column].dropna() * (pairs[column] / pairs[f"{column}_base"]).median()


def counted(table, failed):
    """The Share of rows of one method that are a cut each. \\param failed  of each row: not made, or wrong"""
    refused = failed & (table["status"] == "refused")
    return Share(int((~failed).sum()), int(refused.sum()), int((failed & ~refused).sum()))


def last_if_few(order, counts):
    """Those that made under half of their cuts after all others; else in the order given."""
    return sorted(order, key=lambda variant: counts.get(variant, Share()).is_few)
