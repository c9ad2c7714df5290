#!/usr/bin/env python3
"""The rooms of the house: what may include what. A room may include itself and those listed for it, of its own library or
one below; no arrow goes up.
And no two files define a type of one name: the linker keeps one of their functions for both, and says nothing.
usage: tests/check_includes.py      exit code 1 and a line per include that breaks the order, and per second type"""

import pathlib
import re
import sys

LIBRARIES = {  # from the ground up: a library's rooms, and the libraries below it that it may use
    "cut": [],
    "oracle": [],  # the oracle shares no code with what it judges
    "fem": ["cut"],
    "files": ["cut", "fem"],
    "bench": ["cut", "fem", "files", "oracle"],
}
ROOMS = {  # from the ground up: a room (a folder, or one file), its library, and the rooms below it that it may use
    "base": ("cut", []),
    "mesh": ("cut", ["base"]),
    "path": ("cut", ["base", "mesh"]),
    "cut": ("cut", ["base", "mesh", "path"]),
    "cases": ("cut", ["base", "mesh", "path"]),
    "methods": ("cut", ["base", "mesh", "path", "cut"]),
    "oracle": ("oracle", []),
    "fem/algebra": ("fem", ["base"]),
    "fem/elements": ("fem", ["base", "mesh", "fem/algebra"]),
    "fem/linear": ("fem", ["base", "mesh", "fem/algebra"]),  # it knows of no element
    "fem/constraints": ("fem", ["base", "mesh", "fem/algebra", "fem/linear"]),
    "fem/multigrid": ("fem", ["base", "mesh", "fem/algebra", "fem/linear"]),
    "fem/solvers": ("fem", ["base", "fem/algebra", "fem/linear", "fem/multigrid"]),
    "fem/tips": ("fem", ["base", "mesh", "fem/algebra", "fem/elements", "fem/linear", "fem/constraints", "fem/solvers"]),
    "fem/model": ("fem", ["base", "mesh", "fem/algebra", "fem/elements", "fem/linear", "fem/constraints"]),
    "fem/time": ("fem", ["base", "mesh", "fem/algebra", "fem/elements", "fem/linear", "fem/constraints", "fem/solvers",
                         "fem/model"]),
    "simulation": ("fem", ["base", "mesh", "path", "cut", "cases", "fem/elements", "fem/linear", "fem/solvers", "fem/model",
                           "fem/time"]),
    "files": ("files", ["base", "mesh", "path", "cases", "fem/elements", "fem/solvers", "simulation"]),
    "judge": ("bench", ["base", "mesh", "path", "cut", "oracle"]),
    "processes": ("bench", ["base"]),
    "programs": ("bench", ["base", "mesh", "path", "cut", "files", "judge", "processes"]),
    "problems/common": ("bench", ["base", "mesh", "path", "cut", "fem"]),
    "problems/in_plane": ("bench", ["base", "mesh", "fem", "problems/common"]),
    "problems/out_of_plane": ("bench", ["base", "mesh", "fem", "problems/common"]),
    "problems/in_motion": ("bench", ["base", "mesh", "fem", "problems/common", "problems/out_of_plane"]),
    "problems": ("bench", ["base", "problems/common", "problems/in_plane", "problems/out_of_plane", "problems/in_motion"]),
    "records": ("bench", ["base", "mesh", "cut", "files", "judge", "simulation"]),
    "study": ("bench", ["base", "mesh", "path", "cut", "cases", "fem", "files", "judge", "processes", "programs",
                        "problems/common", "records", "simulation"]),
    "study/robustness": ("bench", ["base", "mesh", "path", "cut", "cases", "files", "oracle", "judge", "processes",
                                   "programs", "records", "study"]),
    "study/stability": ("bench", ["base", "mesh", "path", "cut", "cases", "fem", "files", "judge", "processes", "records",
                                  "simulation", "study"]),
    "study/run_experiment": ("bench", ["records", "study", "study/robustness", "study/stability"]),
}
FORBIDDEN = ("filesystem", "fstream", "thread", "mutex", "atomic", "unistd.h")  # in the library `cut`: files, processes

root = pathlib.Path(__file__).resolve().parent.parent
faults = 0


def fault(text):
    global faults
    print(text)
    faults += 1


def room_of(place):
    """The room of a file, `harness/mesh/sheet.h`: the longest name in the table that it begins with."""
    place = place.removeprefix("harness/")
    if place.startswith("methods/"):
        return "methods"
    for room in (place.rsplit(".", 1)[0], place.rsplit("/", 1)[0]):
        if room in ROOMS:
            return room
    return None


def covers(allowed, room):
    """Is the room allowed: by its name, or as one of a group, such as `fem`, that is no room itself?"""
    return any(room == name or (name not in ROOMS and room.startswith(name + "/")) for name in allowed)


listed = []
for room, (library, allowed) in ROOMS.items():
    for below in [r for r in ROOMS if covers(allowed, r)]:
        if below not in listed:
            fault(f"the table: {room} uses {below}, which is not below it")
        if ROOMS[below][0] not in [library, *LIBRARIES[library]]:
            fault(f"the table: {room} is of the library {library}, which may not use {ROOMS[below][0]}, of {below}")
    listed.append(room)

for file in sorted([*root.glob("harness/**/*.[hc]*"), *root.glob("methods/**/*.[hc]*")]):
    if file.suffix not in (".h", ".cpp"):
        continue
    name = str(file.relative_to(root))
    room = room_of(name)
    if room is None:
        fault(f"{name}: is in no room; add its folder to the table")
        continue
    for number, line in enumerate(file.read_text().splitlines(), 1):
        if ROOMS[room][0] == "cut" and (include := re.match(r"#include <(.*)>", line)) and include[1] in FORBIDDEN:
            fault(f"{name}:{number}: {room} reads and writes strings and arrays; <{include[1]}> belongs to harness/files or above")
        if not (include := re.match(r'#include "((?:harness|methods|experiments|tests)/[^"]*)"', line)):
            continue
        other = room_of(include[1])
        if other != room and (other is None or not covers(ROOMS[room][1], other)):
            fault(f"{name}:{number}: {room} must not include {other or include[1]}; move what is shared to a room below both")

# A library has the files of its rooms.
sources = (root / "harness/CMakeLists.txt").read_text()
for library, text in re.findall(r"add_library\(cutbench_(\w+) STATIC\n(.*?)\)", sources, re.S):
    for name in text.split():
        if name.endswith(".cpp") and ROOMS[room_of("harness/" + name)][0] != library:
            fault(f"harness/CMakeLists.txt: {name} is not of the library {library}")


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
                fault(f"{file.relative_to(root)}: {name} is a type of {first[name].relative_to(root)}, too; give it another name")
sys.exit(faults > 0)
