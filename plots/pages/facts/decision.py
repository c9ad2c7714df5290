"""Which method? The rows of experiments/advice/which_method.toml with their numbers."""

import re
import tomllib

from analysis import load
from pages.facts.table import NUMBERS, table

FILE = load.REPOSITORY / "experiments/advice/which_method.toml"


def rows():
    return tomllib.loads(FILE.read_text(encoding="utf-8"))["rows"]


def answer(row):
    return f"`{row['method']}`" + (f" with `{row['setting']}`" if "setting" in row else "")


def filled(published, row, interval=False):
    """The sentence of a row with its number."""
    return row["says"].format(NUMBERS[row["number"] + (".interval" if interval else "")](published))


def with_values(published, text):
    """The text of FILE with the value of each row, which `cutbench recommend` prints."""
    return re.sub(r'^(number = "(.*)"\nvalue = ").*(")$', lambda m: m[1] + NUMBERS[f"{m[2]}.interval"](published) + m[3], text, flags=re.M)


def but(row):
    return "; " + row["but"] if "but" in row else ""


@table("decision_short")
def short(published):
    return ["if", "take", "you get"], [[row["if"], answer(row), filled(published, row) + but(row)] for row in rows()]


@table("decision")
def long(published):
    return ["if", "take", "you get", "because", "runner-up"], [
        [row["if"], answer(row), filled(published, row, interval=True), row["because"] + but(row), f"`{row['runner_up']}`: {row['runner_up_because']}"]
        for row in rows()]
