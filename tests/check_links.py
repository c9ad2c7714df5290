#!/usr/bin/env python3
"""The documents: every relative link and anchor of the .md files and the notebooks leads somewhere.
usage: tests/check_links.py      exit code 1 and a line for each fault"""

import json
import pathlib
import re
import sys

SKIPPED = {"build", ".git", "node_modules"}
root = pathlib.Path(__file__).resolve().parent.parent
faults = []


def without_code(text):
    """Fenced, indented and inline code has no links."""
    text = re.sub(r"^```.*?^```", lambda code: "\n" * code[0].count("\n"), text, flags=re.S | re.M)
    text = re.sub(r"^(?: {4}|\t)(?! *[-*\d|]).*$", "", text, flags=re.M)
    return re.sub(r"`[^`\n]*`", lambda code: "`" + "x" * (len(code[0]) - 2) + "`", text)


def anchor_of(heading, seen):
    """As GitHub makes them: lower case, punctuation dropped, spaces to hyphens, repeated headings numbered."""
    heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").replace("*", "")
    anchor = re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")
    seen[anchor] = seen.get(anchor, -1) + 1
    return anchor if seen[anchor] == 0 else f"{anchor}-{seen[anchor]}"


def anchors(file):
    seen = {}
    text = re.sub(r"^```.*?^```", "", file.read_text(encoding="utf-8"), flags=re.S | re.M)
    return {anchor_of(line, seen) for line in re.findall(r"^#{1,6} +(.+?) *#*$", text, flags=re.M)}


def check_link(file, line, target):
    if re.match(r"[a-z][a-z0-9+.-]*:", target):  # another site
        return
    path, _, anchor = target.partition("#")
    place = file if not path else (file.parent / path).resolve()
    where = f"{file.relative_to(root)}:{line}: {target}"
    if not place.is_relative_to(root):
        faults.append(f"{where}: leads out of the project")
    elif not place.exists():
        faults.append(f"{where}: there is no such file")
    elif anchor and (place.suffix != ".md" or anchor not in anchors(place)):
        faults.append(f"{where}: there is no such heading")


def text_of(file):
    if file.suffix != ".ipynb":
        return file.read_text(encoding="utf-8")
    cells = json.loads(file.read_text(encoding="utf-8"))["cells"]
    return "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")


files = [f for end in ("*.md", "*.ipynb") for f in sorted(root.rglob(end)) if not SKIPPED & set(f.relative_to(root).parts)]
for file in files:
    text = without_code(text_of(file))
    for link in re.finditer(r"\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)", text):
        check_link(file, text.count("\n", 0, link.start()) + 1, link[1])

print("\n".join(faults), end="\n" if faults else "")
sys.exit(bool(faults))
