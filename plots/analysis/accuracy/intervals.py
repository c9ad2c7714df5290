"""95 % intervals of the ranking: what other kinds of problems could give."""

import numpy as np

from analysis import load
from analysis.accuracy.ranking import made_by_all
from analysis.load import of
from analysis.methods.kinds import TWICE, in_words, kind_of


def interval(table, column):
    """The mean of a ratio, minus one, in percent, and the ends of its 95 % interval, in words, by drawing as many kinds of problems as
    there are. Kinds weigh alike, however many cases they have."""
    logs = np.log(table.loc[table[column] > 0, column])
    means = logs.groupby(table["kind"]).mean()
    ends = np.quantile(load.drawn_means(means), [0.025, 0.975])
    return 100 * np.expm1(means.mean()), in_words(np.round(100 * np.expm1(ends)) + 0.0)  # no -0


def print_intervals(records):
    """Of records at_equal_unknowns(); nothing where they are of one size of sheets, or of problems of no kind."""
    records = records.ranked()
    table = records.table[records.table["direct"]]
    table = table.assign(kind=[kind_of("centre_crack" if p == TWICE else p) for p in table["problem"]])
    table = table[table["kind"].notna() & table["ratio_equal"].notna()]
    if table.empty:
        return
    rows = []
    for sheet in ["all", *records.sheets]:
        common = made_by_all(table if sheet == "all" else table[table["sheet"] == sheet])
        for variant, look in records.methods.items():
            made = of(common, variant)
            if len(made):
                rows.append([sheet, look.label, *interval(made, "ratio_equal"), *interval(made, "ratio")])
    load.print_table(f"Excess error, %, solved directly, with its 95 % interval by drawing the {table['kind'].nunique()} kinds of problems "
                     f"anew ({', '.join(dict.fromkeys(table['kind']))})",
                     ["sheet", "method", "at equal unknowns", "its 95 %", "over as many triangles", "its 95 %"], rows)
