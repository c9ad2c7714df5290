"""What experiments/track, experiments/history and experiments/track_wall share: builds, counts, files.

A row is one phase, counted by callgrind in build/release/cutbench_track, or one run of a program from its main() to its end:
`program/cut/...` and `program/simulate/...`, which older commits can be asked for too. Which rows there are says a TOML file:
experiments/tracked.toml, or one of a fork's own."""

import hashlib
import json
import os
import random
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
COMPILED = ["CMakeLists.txt", "harness", "methods", "experiments"]  # what the counted programs are made of
CACHE = ["--I1=32768,8,64", "--D1=32768,8,64", "--LL=8388608,16,64"]  # fixed: the machine's own would vary
ENVIRONMENT = []  # NAME=VALUE of the programs that are counted, which have no other: variables would move the stack

PATH = {"cuts": [{"bezier": [[-0.1, 0.3], [0.4, 0.2], [0.3, 0.9], [1.1, 0.6]]}]}
SCENE = """effect = "tracking"
truth = "none: its work is counted"
duration = 0.0416667
[sheet]
family = "grid"
size = 1.0
resolution = {triangles}
[material]
density = 2.2
stiffness = 1000.0
poisson = 0.45
bending = 4.2e-4
[physics]
bending = "patches"
gravity = [0.0, 0.0, -9.81]
[[pins]]
box = [[-inf, -inf], [1e-9, inf]]
[integrator]
name = "backward_euler"
step = 0.00416667
[solver]
name = "cg"
tolerance = 1e-2
[[cuts]]
time = 0.02
bezier = [[-0.1, 0.3], [0.4, 0.2], [0.3, 0.9], [1.1, 0.6]]
"""


def text_of(command, **options):
    return subprocess.run(command, capture_output=True, text=True, check=True, **options).stdout


def build(source, folder, targets, options=()):
    if folder == ROOT / "build/release":  # others may be building it, too
        assert not options
        subprocess.run([ROOT / "experiments/build", *targets], check=True)
        return
    environment = {"CMAKE_GENERATOR": "Ninja"} | os.environ
    subprocess.run(["cmake", "-S", source, "-B", folder, "-DCMAKE_BUILD_TYPE=Release", *options], check=True,
                   stdout=sys.stderr, env=environment)
    subprocess.run(["cmake", "--build", folder, "--target", *targets, "--parallel", str(os.cpu_count())], check=True,
                   stdout=sys.stderr)


def write(path, text):
    part = Path(f"{path}.part")
    part.write_text(text, encoding="utf-8")
    part.replace(path)


@contextmanager
def worktree(reference, root=ROOT):
    """A checkout of another commit, gone afterwards."""
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder) / "tree"
        subprocess.run(["git", "-C", root, "worktree", "add", "--detach", tree, reference], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            yield tree
        finally:
            subprocess.run(["git", "-C", root, "worktree", "remove", "--force", tree], check=False,
                           stdout=subprocess.DEVNULL)


def has_phases(tree):
    """Whether this commit counts phases; older ones have the file elsewhere, the first none."""
    return any((tree / "experiments" / file).exists() for file in ("benchmarks/track.cpp", "track.cpp"))


def commit_of(reference, root=ROOT):
    try:
        return text_of(["git", "-C", root, "rev-parse", "--verify", "--quiet", f"{reference}^{{commit}}"]).strip()
    except subprocess.CalledProcessError:
        sys.exit(f"{reference} is no commit of this clone; fetch it first, or clone without --depth")


def events(out):
    """The totals of a file of callgrind, and its calls into GMP: exact arithmetic, where a filter could not tell."""
    names, called, kinds, totals, calls = {}, None, [], [], 0
    with open(out, encoding="utf-8", errors="replace") as lines:
        for line in lines:
            if line.startswith("cfn="):
                number, _, name = line[4:].strip().partition(" ")
                names.setdefault(number, name)
                called = names[number]
            elif line.startswith("fn="):
                number, _, name = line[3:].strip().partition(" ")
                names.setdefault(number, name)
            elif line.startswith("calls=") and called and called.startswith("__gmp"):
                calls += int(line[6:].split()[0])
            elif line.startswith("events:"):
                kinds = line.split()[1:]
            elif line.startswith("totals:"):
                totals = map(int, line.split()[1:])
    sums = dict(zip(kinds, totals))
    return sums.get("Ir", 0), sums.get("D1mr", 0) + sums.get("D1mw", 0), calls


def callgrind(command, options, folder):
    out = Path(folder) / "callgrind.out"
    done = subprocess.run(["env", "-i", *ENVIRONMENT, "valgrind", "--quiet", "--tool=callgrind", "--cache-sim=yes", *CACHE, *options,
                           f"--callgrind-out-file={out}", *map(str, command)], capture_output=True, text=True,
                          check=False, cwd=folder)
    if done.returncode != 0:
        said = [line for line in (done.stderr or done.stdout).splitlines() if not line.startswith("--")]
        raise RuntimeError(f"`{' '.join(map(str, command))}` ended with {done.returncode}:\n" + "\n".join(said[:12]))
    return done.stdout, *events(out)


def write_sheet(path, triangles):
    """A square of jittered vertices, the same from every commit."""
    n, draw, lines = round((triangles / 2) ** 0.5), random.Random(1), []
    for j in range(n + 1):
        for i in range(n + 1):
            x = i + 0.2 * (0 < i < n) * (draw.random() - 0.5)
            y = j + 0.2 * (0 < j < n) * (draw.random() - 0.5)
            lines.append(f"v {x / n!r} {y / n!r} 0")
    for j in range(n):
        for i in range(n):
            a = j * (n + 1) + i + 1
            lines += [f"f {a} {a + 1} {a + n + 2}", f"f {a} {a + n + 2} {a + n + 1}"]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


class Tracked:
    """What a TOML file wants to be counted. `root`: the tree that holds it, this or another."""

    def __init__(self, file=ROOT / "experiments/tracked.toml"):
        try:
            table = tomllib.loads(Path(file).read_text(encoding="utf-8"))
        except (OSError, tomllib.TOMLDecodeError) as error:
            sys.exit(f"{file}: {error}")
        asked = ["git", "-C", Path(file).resolve().parent, "rev-parse", "--show-toplevel"]
        said = subprocess.run(asked, capture_output=True, text=True, check=False).stdout.strip()
        self.root = Path(said) if said else ROOT
        self.is_here = self.root == ROOT
        self.methods, self.solvers, self.phases, self.wall = (table.pop(key, []) for key in ("methods", "solvers", "phases", "wall"))
        self.programs = table.pop("programs", [])
        for program in self.programs:
            known = {"build", "cutbench", "methods", "sizes", "simulate"} if "cutbench" in program else {"build", "name", "command", "sizes"}
            missing = {"methods" if "cutbench" in program else "name"} - set(program)
            if set(program) - known or missing or not {"cutbench", "command"} & set(program):
                sys.exit(f"{file}: a program has `cutbench` and `methods`, or `name` and `command`; this one has {', '.join(program)}")
        if table:
            sys.exit(f"{file}: no key {', '.join(table)}; there are methods, solvers, phases, wall and programs")

    def has(self, row):
        """Whether a row of build/release/cutbench_track is wanted."""
        phase, *of, _ = row.split("/")
        wanted = {"embed": self.methods, "improve": self.methods, "cut": self.methods, "step": self.solvers}.get(phase, of)
        return phase in self.phases and set(of) <= set(wanted)

    def builds(self):
        return [program["build"] for program in self.programs if "build" in program]

    def rows(self):
        """{row: its program}"""
        found = {}
        for program in self.programs:
            sizes = program.get("sizes", [800])
            if "command" in program:
                found |= {f"program/cut/{program['name']}/{n}": program for n in sizes}
                continue
            found |= {f"program/cut/{method}/{n}": program for n in sizes for method in program["methods"]}
            found |= {f"program/simulate/{row}": program for row in program.get("simulate", [])}
        return found


class Programs:
    """The programs of one tree. `folder`: where its cutbench_track is, and its cutbench."""

    def __init__(self, tracked, tree, folder=None):
        self.tracked, self.tree, self.folder = tracked, Path(tree).resolve(), Path(folder or Path(tree) / "build/release").resolve()

    def build(self):
        for command in self.tracked.builds():
            subprocess.run(["sh", "-c", command], cwd=self.tree, check=True, stdout=sys.stderr)

    def of(self, cutbench):
        """A program of the tree; that of build/release is where this tree's was built."""
        return self.folder / "cutbench" if cutbench == "build/release/cutbench" else self.tree / cutbench

    def rows(self):
        """All that are wanted and can be counted here."""
        track = self.folder / "cutbench_track"
        phases = [row for row in text_of([track, "list"]).split() if self.tracked.has(row)] if track.exists() else []
        programs = [row for row, program in self.tracked.rows().items() if "command" in program or self.of(program["cutbench"]).exists()]
        return phases + programs

    def command(self, row, folder):
        """Of a row of a program. \param folder  where its files are written; it runs there"""
        _, what, method, triangles = row.split("/")
        program = self.tracked.rows()[row]
        if what == "cut":
            write_sheet(folder / "sheet.obj", int(triangles))
            (folder / "path.json").write_text(json.dumps(PATH), encoding="utf-8")
        else:
            (folder / "scene.toml").write_text(SCENE.format(triangles=triangles), encoding="utf-8")
        if "command" in program:
            files = {"{mesh}": "sheet.obj", "{path}": "path.json", "{out}": "out.obj", "{time}": "time.json"}
            words = [files.get(word, word) for word in shlex.split(program["command"])]
            words = [str(self.tree / word) if (self.tree / word).is_file() else word for word in words]
            return [shutil.which(words[0]) or words[0], *words[1:]]
        start = [self.of(program["cutbench"]), what]
        start += ["--mesh", "sheet.obj", "--path", "path.json"] if what == "cut" else ["scene.toml"]
        return [*start, "--method", method, "--out", "out.obj"]


def count_program(programs, row):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        of_main = [] if "command" in programs.tracked.rows()[row] else ["--toggle-collect=main"]
        _, instructions, misses, gmp = callgrind(programs.command(row, folder), of_main, folder)
        result = hashlib.sha1((folder / "out.obj").read_bytes()).hexdigest()[:16]
    _, what, _, triangles = row.split("/")
    return {"id": row, "phase": f"program {what}", "triangles": int(triangles), "unit": "runs", "units": 1,
            "counters": {"gmp_calls": gmp}, "fingerprint": result, "instructions": instructions, "misses": misses}


def count_phase(track, row, turns=0):
    """\\param turns  of an empty loop beside the row's work"""
    with tempfile.TemporaryDirectory() as folder:
        out, instructions, misses, gmp = callgrind([track, "count", row, *([str(turns)] if turns else [])],
                                                   ["--instr-atstart=no"], folder)
    result = json.loads(out)
    result["counters"]["gmp_calls"] = gmp
    return result | {"instructions": instructions, "misses": misses}


def count(programs, row):
    return count_program(programs, row) if row.startswith("program/") else count_phase(programs.folder / "cutbench_track", row)


@contextmanager
def timer(programs, row):
    """A function that runs the row in a process and returns its time in microseconds."""
    if not row.startswith("program/"):
        command = [programs.folder / "cutbench_track", "time", f"--benchmark_filter=^{row}/manual_time$", "--benchmark_min_time=0.02",
                   "--benchmark_format=json"]
        yield lambda: json.loads(text_of(command, env={}, stdin=subprocess.DEVNULL))["benchmarks"][0]["real_time"] / 1e3
        return
    with tempfile.TemporaryDirectory() as name:
        command = programs.command(row, Path(name))

        def run():
            start = time.perf_counter()
            subprocess.run(command, cwd=name, env={}, stdout=subprocess.DEVNULL, check=True)
            return (time.perf_counter() - start) * 1e6
        yield run


def selected(rows, quick, prefix):
    if quick:
        rows = [row for row in rows if row.endswith("/800")]
    rows = [row for row in rows if row.startswith(prefix or "")]
    if not rows:
        sys.exit(f"no row begins with {prefix}; build/release/cutbench_track list prints those of phases" if prefix else
                 "there is no row" + "; --quick keeps those of 800 triangles alone, so `sizes` has to name 800" * quick)
    return rows


def about(commit, root=ROOT):
    subject, date = text_of(["git", "-C", root, "show", "-s", "--format=%s%n%cI", commit]).splitlines()[:2]
    return {"format": 1, "commit": commit, "subject": subject, "date": date}


def tools_of(programs):
    tools = {}
    if (programs.folder / "cutbench_track").exists():  # the first commits have none
        tools = json.loads(text_of([programs.folder / "cutbench_track", "tools"]))["tools"]
    return tools | {"valgrind": text_of(["valgrind", "--version"]).strip(), "cache": " ".join(CACHE)}


def count_or_say(programs, row):
    """Old commits may hold an instruction that valgrind doesn't know: then the row has no counts."""
    try:
        return count(programs, row)
    except RuntimeError as error:
        print(f"not counted: {error}", file=sys.stderr)
        return {"id": row, "counters": {}}


def count_all(programs, commit, rows, count=count):
    """What a file of experiments/track holds. \param programs  of that commit"""
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        counted = list(pool.map(lambda row: count(programs, row), rows))
    return about(commit, programs.tracked.root) | {"tools": tools_of(programs), "rows": counted}
