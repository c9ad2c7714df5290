"""Reads the records of a run, results/<stem>/records.csv and context.json (columns: results/README.md), and computes the
statistics that several figures use. A file that can't be read ends the program with one line and exit code 2."""

import argparse
import functools
import gzip
import itertools
import json
import lzma
import re
import shlex
import tomllib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from analysis.stop import stop

REPOSITORY = Path(__file__).resolve().parents[2]
SUITE_VERSIONS = ["2", "3", "4", "5", "6"]  # that can be read; older column names are renamed on reading
TEXT = ["suite_version", "sheet", "method", "parameter", "seed", "cache", "status", "verdict", "reason"]
TEXT_OF_SOME = ["cut_family", "problem", "solver", "primary",  # text in the records that have them
                "sweep", "cut", "pose", "integrator", "stress_stiffness", "mass", "bending"]
OLD_METHODS = {"cgal_whole_sheet (peer)": "cgal_whole_sheet (cross-check)", "peer": "cross_check"}
OLD_SOLVERS = {"local_global": "constant_factor"}
OPTIONAL = ["process_us"]  # read wherever it is: which methods are programs
COUNTS = ["resolution", "case", "repetition"]
OPENERS = {".gz": gzip.open, ".xz": lzma.open}  # of packed records, by the end of their name
VARIANT = ["method", "parameter"]
CUT = ["suite_version", "cut_family", "sheet", "resolution", "case"]  # names one cut, whatever the method


def family_column(table):
    """The column that says what was cut: accuracy records name a problem, all others a cut family."""
    return "problem" if "problem" in table else "cut_family"


def cut_columns(table):
    """CUT, with the name that the table has for its second column."""
    return [family_column(table) if c == "cut_family" else c for c in CUT]


def script_of(stem):
    """The script that draws it, from the repository."""
    found = sorted(REPOSITORY.glob(f"plots/figures/*/{stem}.py"))
    if not found:
        stop(f"plots/figures has no {stem}.py")
    return found[0].relative_to(REPOSITORY)


def results_folder(stem, description):
    """The folder named by --results, else results/<stem> of the repository."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--results", type=Path, metavar="DIR", default=REPOSITORY / "results" / stem,
                        help=f"holds records.csv and context.json, receives the figures (default: results/{stem})")
    return parser.parse_args().results


@dataclass
class Run:
    """`rows` are of the cuts that were made, `failed` of those that failed or were refused in any repetition (the
    oracle judges only the first); a measure that a row lacks is NaN."""
    rows: pd.DataFrame
    failed: pd.DataFrame
    context: dict

    def everything(self):
        return pd.concat([self.rows, self.failed])

    def select(self, **values):
        """The run with only the rows whose columns have the given values."""
        def chosen(table):
            for column, value in values.items():
                table = table[table[column] == value]
            return table
        return Run(chosen(self.rows), chosen(self.failed), self.context)

    def first_repetition(self):
        """For measures that no repetition changes: each cut once."""
        return Run(*(t.drop_duplicates(VARIANT + cut_columns(t)) for t in (self.rows, self.failed)), self.context)

    def variants(self, column):
        """(method, parameter) of the rows that have `column`, and of those with nothing but failures."""
        def found(table):
            return set(zip(table["method"], table["parameter"]))
        measured = found(self.rows[self.rows[column].notna()])
        return measured | (found(self.failed) - found(self.rows))


def read(folder, measures):
    """The run in `folder`; `measures` are the numeric columns the figure needs, beside the identifying ones."""
    return run_of(folder / "records.csv", folder / "context.json", measures)


def run_of(records, context, measures):
    table = read_records(records, TEXT + ["cut_family"] + COUNTS + measures)
    row_made = (table["verdict"] == "ok") & ~table["status"].isin(["failed", "refused"])
    made = row_made.groupby([table[c] for c in VARIANT + cut_columns(table)]).transform("all")
    return Run(table[made], table[~made], read_context(context))


def read_records(path, columns, all_columns=False):
    """The table with `columns` and those of OPTIONAL, or with all columns of the file, which must include `columns`. Names
    of older versions are replaced by those of today."""
    if not path.is_file():
        unfinished = path.with_name(path.name + ".part")
        stop(f"{unfinished} is of a run that has not ended; give the same command again to continue it" if unfinished.is_file()
             else f"{path} is missing; `cutbench run experiments/{path.parent.name}.toml --out results` makes it")
    try:
        with OPENERS.get(path.suffix, open)(path, "rt", encoding="utf-8", newline="") as file:
            start = 0
            while (line := file.readline()).startswith("#"):
                start = file.tell()
            names = new_names(line.strip().split(","))
            missing = [c for c in columns if c not in names.values()]
            if missing and line:
                stop(f"{path} lacks the column{'s' * (len(missing) > 1)} {', '.join(missing)}"
                     + "; experiments/publish.toml says which are published" * (path.suffix == ".xz"))
            file.seek(start)
            table = pd.read_csv(file, dtype=str, keep_default_na=False).rename(columns=names)
            if not all_columns:
                table = table[[*columns, *(c for c in OPTIONAL if c in table and c not in columns)]]
        if "solver" in table:
            table["solver"] = table["solver"].replace(OLD_SOLVERS)
        for column in table.columns.difference(TEXT + TEXT_OF_SOME):
            table[column] = table[column].replace("", "nan").astype(float)
        table = table.astype({column: int for column in COUNTS})
    except (OSError, ValueError, EOFError, lzma.LZMAError) as error:
        stop(f"{path} can't be read: {' '.join(str(error).split())}")
    if table.empty:
        stop(f"{path} has no rows")
    unknown = sorted(set(table["suite_version"]) - set(SUITE_VERSIONS)) if "suite_version" in table else []
    if unknown:
        stop(f"{path} is of suite version {', '.join(unknown)}; this program reads {', '.join(SUITE_VERSIONS)}; run the "
             "experiment again")
    return table


def read_counts(path, **options):
    """A table of counts as it is, but for names of older versions, which are replaced by those of today."""
    table = pd.read_csv(path, comment="#", keep_default_na=False, **options)
    table = table.rename(columns=new_names(table.columns))
    return table.assign(method=table["method"].replace(OLD_METHODS))


def new_names(columns):
    """The names that the columns of a record have today, by the name in the file: older versions had others."""
    old = {"scene": "problem" if "solver" in columns else "cut_family", "wedge_area": "wedge_area_rest2",
           "incision_error": "incision_error_rest", "knob": "parameter", "tie_us": "constrain_us"}
    return {c: old.get(c, c) for c in columns}


@functools.cache
def columns():
    """Of each column of the records: unit, label, direction ("lower", "higher" or "": which values are better), group and
    definition. The table of `cutbench columns --json`."""
    path = REPOSITORY / "results" / "columns.json"
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        stop(f"{path} can't be read: {error}; `cutbench columns --json` makes it")


def axis_label(column):
    """The label of a column with its unit."""
    about = columns()[column]
    unit = {"us": "µs", "deg": "°"}.get(about["unit"], about["unit"])
    return f"{about['label']} ({unit})" if unit else about["label"]


def group(name, derived):
    """The group of a column of a table, such as `eigenvalue_ratio_median`: that of the longest name in results/columns.json
    or `derived` ({name: group}, of what is computed from the records) that it begins with; "" where there is none."""
    groups = {"": ""} | {column: about["group"] for column, about in columns().items()} | derived
    return groups[max((column for column in groups if name.startswith(column)), key=len)]


def read_context(path):
    try:
        context = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        stop(f"{path} is missing; no figure is drawn without its commit, seed and machine")
    except (OSError, ValueError) as error:
        stop(f"{path} can't be read: {error}")
    if not isinstance(context, dict):
        stop(f"{path} is not an object of keys and values")
    if isinstance(context.get("command"), str):
        context["command"] = pasteable(context["command"])
    return context


def pasteable(command):
    """A command line of `cutbench run` for a shell. Contexts hold its words with a space between them, so the blanks in the
    command of a program have lost their quotes; it goes on to the next option that `run` has. What is quoted stays so."""
    option = "methods|command|resolutions|sweeps|cases|repetitions|seed|out|jobs|shard"

    def quoted(match):
        try:
            if len(shlex.split(match[2])) == 1:
                return match[0]
        except ValueError:  # an apostrophe in it
            pass
        return match[1] + shlex.quote(match[2])

    return re.sub(rf"( --command[ =])(.*?)(?= --(?:{option})[ =]|$)", quoted, command)


def programs(table, context):
    """Names of the methods that are programs of their own: with a time of the process in the records, given to `cutbench
    run` by --command, or with a command in its experiment file, where that is still there."""
    found = set(table.loc[table["process_us"].notna(), "method"]) if "process_us" in table else set()
    try:
        words = shlex.split(str(context.get("command") or "").replace(" --command=", " --command "))
    except ValueError:  # a quote without its other one
        words = []
    found |= {name.partition("=")[0] for option, name in zip(words, words[1:]) if option == "--command"}
    for file in (word for word in words if word.endswith(".toml")):
        try:
            methods = tomllib.loads((REPOSITORY / file).read_text(encoding="utf-8")).get("methods", [])
        except (OSError, ValueError):
            continue
        found |= {m["name"] for m in methods if isinstance(m, dict) and "command" in m and "name" in m}
    return found & set(table["method"])


def write_beside(path, text):
    """Writes the text of a script to a file beside its figures, and prints it."""
    try:
        path.write_text(text.lstrip("\n"), encoding="utf-8")
    except OSError as error:
        stop(f"{path} can't be written: {error.strerror}")
    print(path)
    print(text, end="")


def quartiles(table, by, column):
    """A row per value of `by`: q1, median, q3 and n of `column`; NaN is left out."""
    groups = table.dropna(subset=[column]).groupby(by)[column]
    return pd.DataFrame({"q1": groups.quantile(0.25), "median": groups.median(), "q3": groups.quantile(0.75),
                         "n": groups.size()})


def of(table, variant, sheet=None):
    """The rows of a (method, parameter), on one sheet or all."""
    here = table[(table["method"] == variant[0]) & (table["parameter"] == variant[1])]
    return here if sheet is None else here[here["sheet"] == sheet]


def quantiles(values, shares):
    """Of values that may be infinite, for what failed: linear between two neighbours, infinite where the one that counts is; NaN
    is left out."""
    values = np.asarray(values, float)
    values = np.sort(values[~np.isnan(values)])
    if not len(values):
        return np.full(len(shares), np.nan)
    places = (len(values) - 1) * np.asarray(shares)
    low, part = np.floor(places).astype(int), places - np.floor(places)
    high = np.minimum(low + 1, len(values) - 1)
    ends = values[[low, high]]
    with np.errstate(invalid="ignore"):  # the difference of two infinite ones
        between = ends[0] + part * (ends[1] - ends[0])
    return np.where((part == 0) | (ends[0] == ends[1]), ends[0], between)


def median(values):
    """The mean of the two middle ones where their number is even; values as quantiles() takes them."""
    return float(quantiles(values, [0.5])[0])


def drawn_means(values, draws=10000):
    """The means of all draws with replacement of as many (bootstrap): of at most six values of all draws there are, else of so many
    random ones."""
    values = np.asarray(values, float)
    if len(values) <= 6:
        return np.array(list(itertools.product(values, repeat=len(values)))).mean(axis=1)
    return np.random.default_rng(1).choice(values, (draws, len(values))).mean(axis=1)


def front_layers(x, y):
    """Per point the number of its front: 1 where no other is at least as small in both and smaller in one, 2 where
    only those of 1 are, and so on. 0 for points that are not finite."""
    points = np.column_stack([x, y]).astype(float)
    layers = np.zeros(len(points), int)
    left = np.isfinite(points).all(axis=1)
    layer = 0
    while left.any():
        layer += 1
        here = points[left]
        beaten = np.array([((here <= p).all(axis=1) & (here < p).any(axis=1)).any() for p in here])
        numbers = np.flatnonzero(left)[~beaten]
        layers[numbers] = layer
        left[numbers] = False
    return layers


def median_repetition(table, columns):
    """A row per method, parameter and cut: the medians over its repetitions."""
    return table.groupby(VARIANT + cut_columns(table))[columns].median().reset_index()


def ratio(numerator, denominator, draws=10000):
    """Geometric mean of the paired ratios, its bootstrap 95 % interval over the pairs, and their number."""
    with np.errstate(divide="ignore", invalid="ignore"):
        logs = np.log(np.asarray(numerator, float) / np.asarray(denominator, float))
    logs = logs[np.isfinite(logs)]
    if not len(logs):
        return np.nan, np.nan, np.nan, 0
    low, high = np.exp(np.quantile(drawn_means(logs, draws), [0.025, 0.975]))
    return np.exp(logs.mean()), low, high, len(logs)


def count(table):
    """Cuts in the table, each counted once however often it was repeated."""
    return len(table[VARIANT + cut_columns(table)].drop_duplicates())


def number(value, digits=3):
    """`digits` significant ones without exponent; a dash for NaN."""
    if value is None or np.isnan(value):
        return "-"
    if np.isinf(value) or value == 0:
        return f"{value:g}"
    return f"{value:.{max(0, digits - 1 - int(np.floor(np.log10(abs(value)))))}f}"


def print_table(title, columns, rows):
    """Text to the left, numbers to the right."""
    cells = [[c if isinstance(c, str) else number(c, 4) for c in row] for row in rows]
    widths = [max(map(len, column)) for column in zip(columns, *cells)]
    is_text = [all(isinstance(row[i], str) for row in rows) for i in range(len(columns))]
    print(f"\n{title}")
    for line in [columns] + cells:
        print("  ".join(c.ljust(w) if t else c.rjust(w) for c, w, t in zip(line, widths, is_text)).rstrip())


def write_page(path, text):
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        stop(f"{path} can't be written: {error.strerror}")
    print(path)
