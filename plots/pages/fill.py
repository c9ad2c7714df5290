#!/usr/bin/env python3
"""Fills the numbers of README.md, CONTRIBUTING.md, docs/ (but the notebook) and experiments/advice/which_method.toml in from the
published records, and draws docs/pictures/adversarial.svg. --check writes nothing: a line for each number that is stale and each
sentence whose condition no longer holds, and exit code 1 if there is any."""

import argparse
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from analysis import load
from pages import bars
from pages import facts  # noqa: F401  registers all
from pages.facts import decision, table
from pages.facts.published import Published

NUMBER = re.compile(r"<!--=([\w.]+)-->(.*?)<!--/-->", re.S)
TABLE = re.compile(r"<!--table (\w+)-->\n(.*?)<!--/table-->", re.S)
CONDITION = re.compile(r"<!--if (\w+)-->")
FIRST_IN_LINE = re.compile(r"^ {0,3}(?:[-*] |\d+\. )?<!--(?! *(?:/?table|graph|begin|end))[^>]*>?", re.M)  # GitHub takes such a line for HTML
MARKER = re.compile(r"<!--(?:=|table |/)")
MARKER_AS_CODE = re.compile(r"`<!--[^`\n]*`")
PICTURE = load.REPOSITORY / "docs/pictures/adversarial.svg"


def pages():
    found = [load.REPOSITORY / "README.md", load.REPOSITORY / "CONTRIBUTING.md", *sorted((load.REPOSITORY / "docs").rglob("*.md"))]
    return [page for page in found if "notebook" not in page.parts]


def markdown(head, rows):
    return "\n".join("| " + " | ".join(cells) + " |" for cells in [head, ["---"] * len(head), *rows]) + "\n"


def sentence_before(text):
    """The last sentence of a text, in plain words."""
    block = re.split(r"\n\s*\n|\n *(?:[-*]|\d+\.) ", "\n" + text)[-1]
    words = " ".join(re.sub(r"<!--.*?-->", "", block, flags=re.S).split())
    return re.split(r"(?<=[.!?])\**\s+(?=\S)", words)[-1].removeprefix("- ")


class Filler:
    def __init__(self, published):
        self.published, self.faults, self.known = published, [], {}

    def value(self, kind, name, where):
        """Of a number, table or condition, computed once."""
        functions = {"number": table.NUMBERS, "table": table.TABLES, "condition": table.CONDITIONS}[kind]
        if name not in functions:
            load.stop(f"{where}: no {kind} is named {name}; plots/pages/facts has them")
        if (kind, name) not in self.known:
            self.known[kind, name] = functions[name](self.published)
        return self.known[kind, name]

    def filled(self, text, where):
        """The text as the records have it; faults() of what was stale or does not hold."""
        shown = MARKER_AS_CODE.findall(text)
        text = MARKER_AS_CODE.sub("\0", text)
        text = NUMBER.sub(lambda m: self.number(m, where), text)
        text = TABLE.sub(lambda m: self.table(m, where), text)
        for found in CONDITION.finditer(text):
            self.judge(found[1], sentence_before(text[:found.start()]), where)
        if first := FIRST_IN_LINE.search(text):
            load.stop(f"{where}: a line begins with {first[0]}, which GitHub takes for HTML: begin it with a word")
        alone = MARKER.search(CONDITION.sub("", TABLE.sub("", NUMBER.sub("", text))))
        if alone:
            load.stop(f"{where}: the marker {alone[0]}... has no partner")
        return re.sub("\0", lambda _: shown.pop(0), text)

    def number(self, match, where):
        new = self.value("number", match[1], where)
        if match[2] != new:
            self.faults.append(f"{where}: {match[1]} is {new}, the page says {match[2]}")
        return f"<!--={match[1]}-->{new}<!--/-->"

    def table(self, match, where):
        new = markdown(*self.value("table", match[1], where))
        if match[2] != new:
            self.faults.append(f"{where}: the table {match[1]} is stale")
        return f"<!--table {match[1]}-->\n{new}<!--/table-->"

    def made(self, file, text, check):
        """A file that is made as a whole."""
        if not file.is_file() or file.read_text(encoding="utf-8") != text:
            self.faults.append(f"{file.relative_to(load.REPOSITORY)} is stale")
            if not check:
                file.write_text(text, encoding="utf-8")

    def judge(self, name, sentence, where):
        if not self.value("condition", name, where):
            self.faults.append(f'{where}: no longer holds: "{sentence}" It rests on: {table.WORDS[name]}')


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--results", type=Path, metavar="DIR", default=load.REPOSITORY / "results/reference")
    options = parser.parse_args()
    filler = Filler(Published(options.results))
    for page in pages():
        where, old = str(page.relative_to(load.REPOSITORY)), page.read_text(encoding="utf-8")
        new = filler.filled(old, where)
        if new != old and not options.check:
            page.write_text(new, encoding="utf-8")
            print(page)
    for row in decision.rows():
        filler.judge(row["rests_on"], row["if"], decision.FILE.name)
    choices = decision.FILE.read_text(encoding="utf-8")
    filler.made(decision.FILE, decision.with_values(filler.published, choices), options.check)
    filler.made(PICTURE, bars.of_outcomes(filler.published), options.check)
    broken = [fault for fault in filler.faults if options.check or "no longer holds" in fault]
    print("\n".join(broken + (["plots/pages/fill.py writes what is stale"] if options.check and broken else [])), end="\n" if broken else "")
    return bool(broken)


if __name__ == "__main__":
    sys.exit(main())
