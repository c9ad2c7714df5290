#!/usr/bin/env python3
"""The rooms of the house: what may include what. A room may include itself and those listed for it; no arrow goes up.
And no two files define a type of one name: the linker keeps one of their functions for both, and says nothing.
usage: tests/check_includes.py      exit code 1 and a line per include that breaks the order, and per second type"""

import pathlib
import re
import sys

ROOMS = {  # from the ground up: a room and the rooms below it that it may use
    "harness/base": [],
    "harness/mesh": ["base"],
    "harness/path": ["base", "mesh"],
    "harness/cut": ["base", "mesh", "path"],
    "harness/fem/algebra": ["base"],
    "harness/fem/elements": ["base", "mesh", "fem/algebra"],
    "harness/fem/linear": ["base", "mesh", "fem/algebra"],  # it knows of no element
    "harness/fem/multigrid": ["base", "mesh", "fem/algebra", "fem/linear"],
    "harness/fem/solvers": ["base", "fem/algebra", "fem/linear", "fem/multigrid"],
    "harness/fem/constraints": ["base", "mesh", "fem/algebra", "fem/linear"],
    "harness/fem/tips": ["base", "mesh", "fem/elements", "fem/linear"],
    "harness/fem/model": ["base", "mesh", "fem/algebra", "fem/elements", "fem/linear", "fem/constraints"],
    "harness/fem/time": ["base", "mesh", "fem/algebra", "fem/elements", "fem/linear", "fem/solvers", "fem/model"],
    "harness/oracle": [],  # the oracle shares no code with what it judges
    "harness/judge": ["base", "mesh", "path", "cut", "measure"],
    "harness/cases": ["base", "mesh", "path"],
    "harness/programs": ["base", "mesh", "path", "cut", "measure", "judge"],
    "harness/problems": ["base", "mesh", "path", "cut", "fem"],
    "harness/simulation": ["base", "mesh", "path", "cut", "fem", "cases"],
    "harness/records": ["base", "mesh", "cut", "fem", "judge", "scene"],
    "harness/study": ["base", "mesh", "path", "cut", "fem", "measure", "judge", "cases", "truth", "scene",
                    "records", "program"],
    "harness/study/robustness": ["base", "mesh", "path", "cut", "measure", "judge", "cases", "records", "run", "program"],
    "harness/study/stability": ["base", "mesh", "path", "cut", "fem", "judge", "cases", "scene", "records", "run"],
    "harness": ["records", "run", "robustness", "stability"],  # run_experiment
    "methods": ["base", "mesh", "path", "cut"],
}

root = pathlib.Path(__file__).resolve().parent.parent
faults = 0
for file in sorted([*root.glob("harness/**/*.[hc]*"), *root.glob("methods/**/*.[hc]*")]):
    if file.suffix not in (".h", ".cpp"):
        continue
    name = file.relative_to(root)
    room = "methods" if name.parts[0] == "methods" else str(name.parent)
    for number, line in enumerate(file.read_text().splitlines(), 1):
        if not (include := re.match(r'#include "((?:harness|methods|experiments|tests)/.*)/[^/]*"', line)):
            continue
        other = include[1]
        allowed = other == room or (room == "methods" and other.startswith("methods")) or \
            other in ["harness/" + r for r in ROOMS[room]]
        if not allowed:
            print(f"{name}:{number}: {room} must not include {other}; move what is shared to a room below both")
            faults += 1


def types_of(file):
    """The names of types in a named namespace itself: not in another type."""
    namespace, anonymous = "", False
    for line in file.read_text().splitlines():
        if found := re.match(r"namespace (\S+) \{", line):
            namespace = found[1]
        anonymous = line == "namespace {" or (anonymous and line != "}  // namespace")
        found = re.match(r"(?:template <[^>]*>\s*)?(?:struct|class|enum class) (\w+)\b(?!<|::)[^;(]*(?:\{|$)", line)
        if found and not anonymous:
            yield f"{namespace}::{found[1]}"


first = {}
for folder in ("harness", "methods", "experiments", "tests"):
    for file in sorted(root.glob(f"{folder}/**/*.[hc]*")):
        if file.suffix not in (".h", ".cpp"):
            continue
        for name in types_of(file):
            if first.setdefault(name, file) != file:
                print(f"{file.relative_to(root)}: {name} is a type of {first[name].relative_to(root)}, too; give it another name")
                faults += 1
sys.exit(faults > 0)
