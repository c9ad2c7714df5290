#!/usr/bin/env python3
"""The rooms of the house: what may include what. A room may include itself and those listed for it, of its own library or
one below; no arrow goes up.
And no two files define a type of one name: the linker keeps one of their functions for both, and says nothing.
The graphs in docs/reference/architecture.md are drawn from the same table, what links what is compared with CMake's words.
usage: tests/check_includes.py [--draw]
  exit code 1 and a line per include that breaks the order, per entry of the table that no file needs, and per second type
  --draw  puts the graphs into docs/reference/architecture.md"""

import pathlib
import re
import sys

LIBRARIES = {  # from the ground up: a library's rooms, and the libraries below it that it may use
    "cut": [],
    "oracle": [],  # the oracle shares no code with what it judges
    "judge": ["cut", "oracle"],
    "files": ["cut"],
    "fem": ["cut"],
    "scenes": ["cut", "files", "fem"],
    "bench": ["cut", "oracle", "judge", "files", "fem", "scenes"],
    "command_line": ["cut", "oracle", "judge", "files", "fem", "scenes", "bench"],
}
ROOMS = {  # from the ground up: a room (a folder, or one file), its library, and the rooms below it that it may use
    "base": ("cut", []),
    "mesh": ("cut", ["base"]),
    "path": ("cut", ["base", "mesh"]),
    "cut": ("cut", ["base", "mesh", "path"]),
    "cases": ("cut", ["base", "mesh", "path"]),
    "methods": ("cut", ["base", "mesh", "path", "cut"]),
    "oracle": ("oracle", []),
    "judge": ("judge", ["base", "mesh", "path", "cut", "oracle"]),
    "files": ("files", ["base", "mesh", "path"]),
    "fem/algebra": ("fem", ["base"]),
    "fem/elements": ("fem", ["base", "mesh", "fem/algebra"]),
    "fem/linear": ("fem", ["base", "mesh", "fem/algebra"]),  # it knows of no element
    "fem/constraints": ("fem", ["base", "mesh", "fem/linear"]),
    "fem/multigrid": ("fem", ["base", "fem/algebra", "fem/linear"]),
    "fem/solvers": ("fem", ["base", "fem/algebra", "fem/linear", "fem/multigrid"]),
    "fem/tips": ("fem", ["base", "mesh", "fem/elements", "fem/linear"]),
    "fem/model": ("fem", ["base", "mesh", "fem/elements", "fem/linear", "fem/constraints"]),
    "fem/time": ("fem", ["base", "mesh", "fem/algebra", "fem/elements", "fem/linear", "fem/solvers", "fem/model"]),
    "simulation": ("fem", ["base", "mesh", "path", "cut", "cases", "fem/elements", "fem/linear", "fem/solvers", "fem/model",
                           "fem/time"]),
    "scenes": ("scenes", ["base", "mesh", "path", "cases", "files", "fem/elements", "fem/solvers", "simulation"]),
    "processes": ("bench", ["base"]),
    "programs": ("bench", ["base", "mesh", "path", "cut", "files", "judge", "processes"]),
    "problems/common": ("bench", ["base", "mesh", "path", "cut", "fem"]),
    "problems/in_plane": ("bench", ["base", "mesh", "fem", "problems/common"]),
    "problems/out_of_plane": ("bench", ["base", "mesh", "fem", "problems/common"]),
    "problems/in_motion": ("bench", ["base", "mesh", "fem", "problems/common", "problems/out_of_plane"]),
    "problems": ("bench", ["base", "problems/common", "problems/in_plane", "problems/out_of_plane", "problems/in_motion"]),
    "records": ("bench", ["base", "mesh", "cut", "judge", "files", "scenes", "simulation"]),
    "study": ("bench", ["base", "mesh", "path", "cut", "cases", "judge", "fem", "scenes", "processes", "programs",
                        "problems/common", "records", "simulation"]),
    "study/robustness": ("bench", ["base", "mesh", "path", "cut", "cases", "files", "oracle", "judge", "processes",
                                   "programs", "records", "study"]),
    "study/stability": ("bench", ["base", "mesh", "path", "cut", "cases", "fem", "judge", "records", "simulation",
                                  "study"]),
    "study/run_experiment": ("bench", ["records", "study", "study/robustness", "study/stability"]),
}
FORBIDDEN = ("filesystem", "fstream", "thread", "mutex", "atomic", "unistd.h")  # in the libraries `cut` and `judge`: files, processes

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


used = set()  # pairs of rooms
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
        if ROOMS[room][0] in ("cut", "judge") and (include := re.match(r"#include <(.*)>", line)) and include[1] in FORBIDDEN:
            fault(f"{name}:{number}: {room} reads and writes strings and arrays; <{include[1]}> belongs to harness/files")
        if not (include := re.match(r'#include "((?:harness|methods|experiments|tests)/[^"]*)"', line)):
            continue
        other = room_of(include[1])
        used.add((room, other))
        if other != room and (other is None or not covers(ROOMS[room][1], other)):
            fault(f"{name}:{number}: {room} must not include {other or include[1]}; move what is shared to a room below both")

for room, (_, allowed) in ROOMS.items():
    for name in allowed:
        if not any((room, other) in used for other in ROOMS if covers([name], other)):
            fault(f"the table: {room} may use {name}, but no file of it does; take the entry away")

# A library has the files of its rooms, and links those that the table says.
sources = (root / "harness/CMakeLists.txt").read_text()
for library, text in re.findall(r"add_library\(cutbench_(\w+) STATIC\n(.*?)\)", sources, re.S):
    for name in text.split():
        if name.endswith(".cpp") and ROOMS[room_of("harness/" + name)][0] != library:
            fault(f"harness/CMakeLists.txt: {name} is not of the library {library}")


def reduced(below):
    """Without the arrows that others imply. `below`: {name: all names below it}."""
    return {name: [b for b in names if not any(b in below[other] for other in names)] for name, names in below.items()}


def all_below(direct):
    """{name: all below it, in the order of the table}"""
    reach = {}
    for name, names in direct.items():  # from the ground up
        reach[name] = [b for b in direct if b in names or any(b in reach[n] for n in names)]
    return reach


linked = {}
for file in ("harness/CMakeLists.txt", "experiments/CMakeLists.txt"):
    text = (root / file).read_text()
    for library, names in re.findall(r"target_link_libraries\(cutbench_(\w+) PUBLIC ([^)]*)\)", text):
        if library in LIBRARIES:
            linked.setdefault(library, set()).update(n for n in re.findall(r"cutbench_(\w+)", names) if n in LIBRARIES)
for library, below in reduced(LIBRARIES).items():
    if linked.get(library, set()) != set(below):
        fault(f"{library}: CMake links {sorted(linked.get(library, []))}, the table says {below}")


def drawn():
    """{title of a graph: its text}, in Mermaid's language, from the ground up."""
    def arrows(below):
        return "\n".join(f"  {name.replace('/', '_')} --> {b.replace('/', '_')}" for name, names in below.items() for b in names)
    libraries = "graph TD\n" + arrows({name: names for name, names in reduced(LIBRARIES).items()})
    direct = {room: [other for other in ROOMS if other != room and (room, other) in used] for room in ROOMS}
    rooms = "graph TD\n"
    for library in LIBRARIES:
        names = [room for room, (owner, _) in ROOMS.items() if owner == library]
        boxes = "".join(f"    {name.replace('/', '_')}[{name}]\n" for name in names)
        if names:
            rooms += f'  subgraph library_{library}["cutbench::{library}"]\n{boxes}  end\n'
    return {"links": libraries, "includes": rooms + arrows(reduced(all_below(direct)))}


architecture = root / "docs/reference/architecture.md"
text = architecture.read_text()
for title, graph in drawn().items():
    block = f"<!-- graph: {title} -->\n```mermaid\n{graph}\n```\n"
    text = re.sub(rf"<!-- graph: {title} -->\n```mermaid\n.*?\n```\n", lambda _, block=block: block, text, flags=re.S)
    if block not in text:
        fault(f"docs/reference/architecture.md has no graph of {title}")
if text != architecture.read_text():
    if "--draw" in sys.argv[1:]:
        architecture.write_text(text)
    else:
        fault("docs/reference/architecture.md: a graph is not what the code is; tests/check_includes.py --draw draws it anew")


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
