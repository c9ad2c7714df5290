#!/usr/bin/env python3
"""Are the numbers and tables of README.md and docs/ those of the published records, and do the conclusions hold? And would
plots/pages/fill.py say so if not: a stale number, a stale table, a broken condition, an unknown name, a marker alone?
usage: tests/check_filled.py      a line per fault; exit code 1 if there is any"""

import contextlib
import io
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "plots"))
from pages import fill
from pages.facts import table

PAGE = """A first one. Two is <!--=made.up-->3<!--/-->.<!--if made_up--> `<!--=unknown-->`

<!--table made_up-->
| a |
<!--/table-->
"""
FILLED = PAGE.replace("-->3<", "-->2<").replace("| a |\n", "| n |\n| --- |\n| 2 |\n")
problems = []


def expect(words, true):
    if not true:
        problems.append(words)


def stopped(filler, text):
    try:
        with contextlib.redirect_stderr(io.StringIO()):
            filler.filled(text, "page")
    except SystemExit as end:
        return str(end.code or "")
    return None


def check_the_check():
    table.number("made.up")(lambda published: str(published))
    table.table("made_up")(lambda published: (["n"], [[str(published)]]))
    table.condition("made_up", "that it is two")(lambda published: published == 2)
    filler = fill.Filler(2)
    expect("a page is not filled as it should be", filler.filled(PAGE, "page") == FILLED)
    expect(f"a stale number and a stale table: said is {filler.faults}",
           len(filler.faults) == 2 and "made.up is 2, the page says 3" in filler.faults[0] and "made_up is stale" in filler.faults[1])
    filler = fill.Filler(2)
    expect("a page that is right is changed", filler.filled(FILLED, "page") == FILLED and not filler.faults)
    filler = fill.Filler(7)
    filler.filled(FILLED, "page")
    expect(f"a broken condition: said is {filler.faults}",
           any('"Two is 7."' in fault and "that it is two" in fault for fault in filler.faults))
    for text in ("A <!--=nothing.there-->1<!--/-->", "A <!--=made.up-->1", "A <!--if nothing-->", "1<!--/-->", "- <!--=made.up-->2<!--/-->"):
        expect(f"{text} is taken", stopped(fill.Filler(2), text) is not None)


def main():
    check_the_check()
    done = subprocess.run([sys.executable, "-W", "ignore", ROOT / "plots/pages/fill.py", "--check"], capture_output=True, text=True, check=False)
    if done.returncode:
        problems.append((done.stdout + done.stderr).strip())
    print("\n".join(problems), end="\n" * bool(problems))
    return bool(problems)


if __name__ == "__main__":
    sys.exit(main())
