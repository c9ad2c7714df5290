#!/usr/bin/env python3
"""How plain are the documents? Prints of README.md, CONTRIBUTING.md and docs/ (but the notebook) the words kept by hand, the lengths
of sentences, the numbers per 100 words and the words per picture. Tables, code, headings and what is filled in from records (between
markers, plots/pages/fill.py) do not count as words kept by hand.
usage: tests/check_prose.py [--pages]      exit code 1 where README.md is over one of its bounds"""

import re
import statistics
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MOST_WORDS = {"README.md": 500, "all": 14000}
MEDIAN, LONG, MOST_LONG, MOST_NUMBERS = 12, 30, 3.0, 3.0  # words, words, % of the sentences, per 100 words


def without_code(text):
    text = re.sub(r"^```.*?^```", "", text, flags=re.S | re.M)
    text = re.sub(r"<!--table .*?<!--/table-->", "", text, flags=re.S)
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    text = re.sub(r"^(?: {4}|\t)(?! *(?:[-*]|\d+\.) ).*$", "", text, flags=re.M)  # indented code, but not lists in lists
    return re.sub(r"^ *(\||#).*$", "", text, flags=re.M)


def blocks(text):
    """Paragraphs and items of lists, in plain words."""
    for block in re.split(r"\n\s*\n|\n(?= *(?:[-*]|\d+\.) )", text):
        block = re.sub(r"!\[[^\]]*\]\([^)]*\)", "", block)
        block = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", block)
        block = re.sub(r"^\s*(?:[-*]|\d+\.)\s+", "", block)
        block = " ".join(re.sub(r"[*_]{2}", "", block).split())
        if block:
            yield block


def words(text):
    return [word for word in text.split() if re.search(r"\w", word)]


def numbers(text):
    return len(re.findall(r"(?<![\w.])[-+]?\d[\d,.]*", re.sub(r"`[^`]*`", "", text)))


def measure(text):
    """Words, lengths of sentences, numbers and pictures of a page."""
    found = list(blocks(without_code(text)))
    sentences = [len(words(s)) for block in found for s in re.split(r"(?<=[.!?])\)?\s+", block)]
    return {"words": sum(len(words(b)) for b in found), "sentences": [n for n in sentences if n > 0],
            "numbers": sum(numbers(b) for b in found), "pictures": len(re.findall(r"!\[[^\]]*\]\(", text)) + text.count("```mermaid")}


def together(measures):
    return {key: sum((m[key] for m in measures), [] if key == "sentences" else 0) for key in ("words", "sentences", "numbers", "pictures")}


def figures(measured):
    lengths = measured["sentences"] or [0]
    return {"words": measured["words"], "median": statistics.median(lengths),
            "long": 100 * sum(n > LONG for n in lengths) / len(lengths),
            "numbers": 100 * measured["numbers"] / max(1, measured["words"]), "pictures": measured["pictures"]}


def line(name, found):
    per_picture = f"{found['words'] / found['pictures']:.0f}" if found["pictures"] else "-"
    return (f"{name}: {found['words']:,} words; sentences of {found['median']:g} words in the median, {found['long']:.1f} % over {LONG}; "
            f"{found['numbers']:.1f} numbers per 100 words; a picture per {per_picture} words")


def faults(found, most):
    if found["words"] > most:
        yield f"{found['words']:,} words, at most {most:,}"
    if found["median"] > MEDIAN:
        yield f"sentences of {found['median']:g} words in the median, at most {MEDIAN}"
    if found["long"] > MOST_LONG:
        yield f"{found['long']:.1f} % of the sentences over {LONG} words, at most {MOST_LONG:g} %"
    if found["numbers"] > MOST_NUMBERS:
        yield f"{found['numbers']:.1f} numbers per 100 words, at most {MOST_NUMBERS:g}"


def check_the_check():
    page = "# Head\n\nOne two three. Four [five](a.md)?\n\n    code 12\n\n| a | 3 |\n\n- A list of `4` and 5.\n<!--table t-->6<!--/table-->\n![p](p.png)\n"
    found = measure(page)
    assert (found["words"], found["sentences"], found["numbers"], found["pictures"]) == (11, [3, 2, 6], 1, 1), found


def main():
    check_the_check()
    pages = {"README.md": ROOT / "README.md", "CONTRIBUTING.md": ROOT / "CONTRIBUTING.md"}
    pages |= {str(p.relative_to(ROOT)): p for p in sorted((ROOT / "docs").rglob("*.md")) if "notebook" not in p.parts}
    measured = {name: measure(page.read_text(encoding="utf-8")) for name, page in pages.items()}
    if "--pages" in sys.argv[1:]:
        for name, found in measured.items():
            print(line(name, figures(found)))
    whole, readme = figures(together(measured.values())), figures(measured["README.md"])
    all_words = len(words(re.sub(r"<!--.*?-->", "", pages["README.md"].read_text(encoding="utf-8"), flags=re.S)))
    print(f"{line('README.md', readme)}; with tables and code {all_words} words")
    print(line(f"all {len(pages)} pages", whole))
    for fault in faults(whole, MOST_WORDS["all"]):
        print(f"all pages: {fault}")
    wrong = list(faults(readme | {"words": all_words}, MOST_WORDS["README.md"]))
    print("".join(f"README.md: {fault}\n" for fault in wrong), end="")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
