"""Tools that people cut meshes with today, beside two methods of this project: the table of docs/reference/tools.md, as Markdown.

usage: experiments/tools [--set random|catalogue] [--tools NAME,NAME] [--only PREFIX] [--jobs N] [--out RECORDS.csv]

Problems: 60 random ones (tests/cases/tools) and the catalogue's single cuts. The tools are rows of experiments/programs.toml.
Every result is judged by `cutbench score`."""

import argparse
import csv
import json
import os
import statistics
import subprocess
import sys
import tarfile
import tempfile
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CUTBENCH = ROOT / "build/release/cutbench"
BASE = "conventional_split"
SECONDS = 120  # for a cut
TOOLS = {  # name: who opens the cut, what the tool was made for
    BASE: ("itself", "cutting sheets; method of this project"),
    "warp_and_refine": ("itself", "cutting sheets with good shapes; method of this project"),
    "gmsh_crack": ("itself: Crack", "meshes for finite elements; meshes the sheet anew"),
    "blender_intersect": ("itself", "modelling; single precision"),
    "vtk_clip": ("itself: two outputs", "pictures of data; clips by a level set, which has no tip"),
    "cgal_split": ("itself", "exact Boolean operations on surfaces"),
    "constrainautor": ("the adapter", "triangulations in the browser; triangulates the sheet anew"),
}
HEAD = ["tool", "random: right / refused / wrong", "catalogue: right / refused / wrong", "who opens the cut", "largest aspect ratio",
        "over that of conventional_split", "vertices added", "in the tool, ms", "process, ms", "made for"]


SHEET = """effect = "none: the sheet at rest is written"
truth = "none"
duration = 1e-9
[sheet]
family = "{}"
size = 1.0
resolution = {}
[material]
density = 1.0
stiffness = 1.0
poisson = 0.3
bending = 0.0
[integrator]
name = "symplectic_euler"
step = 1e-9
"""


def write_sheet(file):
    """As its name says, such as delaunay800.obj."""
    family = file.stem.rstrip("0123456789")
    file.with_suffix(".toml").write_text(SHEET.format(family, file.stem.removeprefix(family)))
    subprocess.run([CUTBENCH, "simulate", file.with_suffix(".toml"), "--out", file], check=True, stdout=subprocess.DEVNULL)


def random_problems(folder):
    with tarfile.open(ROOT / "tests/cases/tools/problems.tar.xz") as archive:
        archive.extractall(folder)
    rows = list(csv.DictReader((folder / "problems.csv").open()))
    (folder / "sheets").mkdir()
    for sheet in sorted({row["sheet"] for row in rows}):
        write_sheet(folder / sheet)
    return [row | {"set": "random"} for row in rows]


def catalogue_problems(folder):
    """Of each case its first sheet, where one cut is asked for. 600 problems are the catalogue and a few more."""
    subprocess.run([ROOT / "build/release/cutbench_suite_problems", folder, "600", "4"], check=True, stderr=subprocess.DEVNULL)
    rows = csv.DictReader((folder / "problems.csv").open())
    return [row | {"set": "catalogue"} for row in rows if row["family"] == "catalogue" and row["cuts"] == "1"
            and not row["id"].rpartition("_")[2].isdigit()]


def commands():
    rows = tomllib.loads((ROOT / "experiments/programs.toml").read_text())["methods"]
    programs = {row["name"]: row["command"] for row in rows if isinstance(row, dict)}
    own = f"{CUTBENCH} cut --mesh {{mesh}} --path {{path}} --out {{out}} --report {{time}} --method "
    return {name: programs.get(name, own + name) for name in TOOLS}


def timed(command, log):
    """Exit code (124: out of time) and the processor time of the process and its children, in microseconds."""
    process = subprocess.Popen(["timeout", str(SECONDS), "sh", "-c", command], cwd=ROOT / "experiments", stdout=log, stderr=log)
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, 1e6 * (used.ru_utime + used.ru_stime)


def outcome_of(code, own, problem, files):
    """Outcome, verdict, and what `score` measured."""
    if code == 3 or own.get("status") == "refused":
        return "refused", "refused", {}
    if not files["{out}"].exists():
        return "wrong", "timed_out" if code == 124 else "no_result", {}
    done = subprocess.run([CUTBENCH, "score", "--mesh", problem["sheet"], "--path", problem["path"], "--result", files["{out}"],
                           "--json"], capture_output=True, text=True)
    if done.returncode not in (0, 1):
        return "wrong", "not_readable", {}
    score = json.loads(done.stdout)
    return "right" if score["verdict"] == "ok" else "wrong", score["verdict"], score


def run(tool, command, problem):
    with tempfile.TemporaryDirectory() as name:
        files = {"{mesh}": problem["sheet"], "{path}": problem["path"], "{out}": Path(name) / "out.obj",
                 "{time}": Path(name) / "time.json"}
        for word, file in files.items():
            command = command.replace(word, str(file))
        with open(Path(name) / "log", "w+") as log:
            code, process_us = timed(command, log)
            log.seek(0)
            said = [line for line in log.read().splitlines() if line.strip()] or [""]
        own = json.loads(files["{time}"].read_text()) if files["{time}"].exists() else {}
        outcome, verdict, score = outcome_of(code, own, problem, files)
    return {"tool": tool, "problem": problem["id"], "set": problem["set"], "family": problem["family"],
            "outcome": outcome, "verdict": verdict, "reason": "" if outcome == "right" else said[-1], "process_us": process_us,
            "tool_us": own.get("us", own.get("cpu_us")), "ar_max_cut": score.get("ar_max_cut"),
            "vertices_added": score.get("vertices_added")}


def median(values):
    values = [v for v in values if v is not None]
    return f"{statistics.median(values):,.3g}" if values else "-"


def counts(rows, name):
    here = [row["outcome"] for row in rows if row["set"] == name]
    return " / ".join(str(here.count(outcome)) for outcome in ("right", "refused", "wrong")) if here else "-"


def table_row(tool, rows, base):
    """Shapes and numbers of vertices: right results for random cuts that do not graze a vertex. Times: 800 triangles."""
    mine = [row for row in rows if row["tool"] == tool]
    right = [row for row in mine if row["outcome"] == "right" and row["set"] == "random" and "graze" not in row["family"]]
    small = [row for row in mine if row["set"] == "random" and "800_" in row["problem"]]
    ratios = [row["ar_max_cut"] / base[row["problem"]] for row in right if row["problem"] in base]
    return [f"`{tool}`", counts(mine, "random"), counts(mine, "catalogue"), TOOLS[tool][0],
            median(row["ar_max_cut"] for row in right), median(ratios), median(row["vertices_added"] for row in right),
            median(row["tool_us"] / 1e3 for row in small if row["tool_us"]), median(row["process_us"] / 1e3 for row in small),
            TOOLS[tool][1]]


def print_table(tools, rows):
    base = {row["problem"]: row["ar_max_cut"] for row in rows if row["tool"] == BASE and row["outcome"] == "right"}
    for line in (HEAD, ["---"] * len(HEAD), *(table_row(tool, rows, base) for tool in tools)):
        print("|", " | ".join(line), "|")
    print("\nMedians. Aspect ratios and vertices: right results for random cuts, those that graze a vertex left out; the ratio is "
          f"taken cut by cut, over the cuts that `{BASE}` made, too. Times: processor time of random cuts of 800 triangles.\n")
    for tool in tools:
        wrong = [f"{row['problem']} ({row['verdict']})" for row in rows if row["tool"] == tool and row["outcome"] == "wrong"]
        if wrong:
            print(f"- `{tool}` wrong: {', '.join(wrong)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--set", choices=["random", "catalogue"])
    parser.add_argument("--tools", type=lambda text: text.split(","), default=list(TOOLS))
    parser.add_argument("--only", default="", metavar="PREFIX", help="problems whose id begins so")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--out", type=Path, metavar="RECORDS.csv")
    arguments, load = parser.parse_args(), os.getloadavg()[0]
    if unknown := set(arguments.tools) - set(TOOLS):
        parser.error(f"--tools: no {', '.join(sorted(unknown))}; there are {', '.join(TOOLS)}")
    subprocess.run([ROOT / "experiments/build", "cutbench", "cutbench_cgal_split", "cutbench_suite_problems"], check=True,
                   stdout=sys.stderr)
    packages = ROOT / "experiments/examples/cdt2d"
    fetch = ["npm", "ci", "--silent", "--no-audit", "--no-fund", "--prefix", packages]
    if not (packages / "node_modules/delaunator").is_dir() and subprocess.run(fetch, stdout=sys.stderr).returncode:
        print("npm can't fetch delaunator and constrainautor here: that tool is left out", file=sys.stderr)
        arguments.tools = [tool for tool in arguments.tools if tool != "constrainautor"]
    with tempfile.TemporaryDirectory() as name:
        problems = []
        for kind, make in (("random", random_problems), ("catalogue", catalogue_problems)):
            if arguments.set in (None, kind):
                folder = Path(name) / kind
                problems += [row | {"sheet": folder / row["sheet"], "path": folder / row["path"]} for row in make(folder)
                             if row["id"].startswith(arguments.only)]
        command = commands()
        jobs = [(tool, command[tool], problem) for problem in problems for tool in arguments.tools]
        with ThreadPoolExecutor(arguments.jobs) as pool:
            rows = list(pool.map(lambda job: run(*job), jobs))
    if arguments.out and rows:
        with arguments.out.open("w", newline="") as file:
            writer = csv.DictWriter(file, rows[0])
            writer.writeheader()
            writer.writerows(rows)
    print_table(arguments.tools, rows)
    if load > 0.75 * os.cpu_count():
        print(f"\nnote: the machine was busy at the start (load {load:.1f} on {os.cpu_count()} cores): times came out long")


if __name__ == "__main__":
    main()
