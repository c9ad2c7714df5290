#!/usr/bin/env python3
"""Is results/reference what experiments/publish.toml says, of one suite version and of clean trees? And does
experiments/publish do what it promises, on a small project of its own? Prints every disagreement; exit code 1 if there is any.
usage: check_published.py PROGRAM, that of this tree"""

import csv
import importlib.machinery
import importlib.util
import json
import lzma
import re
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
REFERENCE = ROOT / "results" / "reference"
loader = importlib.machinery.SourceFileLoader("publish", str(ROOT / "experiments/publish"))
publish = importlib.util.module_from_spec(importlib.util.spec_from_loader("publish", loader))
sys.dont_write_bytecode = True
loader.exec_module(publish)

# Stages of the publication before, which wait to be made anew at the commit that all others name
WAITING = {
    "comparison", "parameters", "whole_step", "accuracy", "motion", "out_of_plane", "remedies", "one_change", "tips",
    "rounds", "stability", "limits", "robustness", "recommend", "swirl", "closed", "models", "claims",
}
problems = []


def expect(what, condition):
    if not condition:
        problems.append(what)


def names_of(stages):
    names = {"publish.json"} | set(publish.OF_OTHERS) | set(publish.FROM_RECORDS)
    for stage in stages.values():
        names |= set().union(*publish.published(stage), stage.get("made_last", []))
    return names


def suites(tables):
    """The suite versions of all their rows."""
    versions = set()
    for table in tables:
        with lzma.open(table, "rt", encoding="utf-8", newline="") as rows:
            versions |= {row["suite_version"] for row in csv.DictReader(rows)}
    return versions


def check_reference(program):
    stages = tomllib.loads((ROOT / "experiments/publish.toml").read_text(encoding="utf-8"))
    made, there = names_of(stages), {f.name for f in REFERENCE.iterdir()}
    made |= {name for name in there if name.removesuffix(".caption.txt") + ".png" in made}
    for name in sorted(there - made):
        problems.append(f"results/reference/{name}: no stage of experiments/publish.toml makes it")
    for name in sorted(made - there - {"publish.json"}):
        problems.append(f"results/reference/{name} is missing; experiments/publish makes it")
    about = publish.read_about(REFERENCE)
    expect(f"results/reference/publish.json: stages {', '.join(about)}, and experiments/publish.toml has others", set(about) == set(stages))
    versions = set()
    for waits in (False, True):
        here = [name for name in about if (name in WAITING) == waits]
        commits = {about[name]["commit"] for name in here}
        expect(f"results/reference: stages {', '.join(here)} of {len(commits)} commits; publish them at one", len(commits) <= 1)
        of_these = set()
        for name in here:
            files, records = publish.published(stages[name])
            of_these |= suites(REFERENCE / file for file in records)
            for file in (REFERENCE / file for file in files if file.endswith(".context.json")):
                named = json.loads(file.read_text(encoding="utf-8"))["commit"]
                expect(f"results/reference/{file.name}: of commit {named[:7]}, unlike publish.json", named in commits)
        expect(f"results/reference: rows of suite versions {', '.join(sorted(of_these))}; publish them at one commit", len(of_these) <= 1)
        versions |= of_these
    said = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
    today = re.search(r"suite version (\d+)", said)[1]
    expect(f"results/reference: rows of suite version {max(versions)}, and the program's is {today}",
           max(map(int, versions)) <= int(today))
    for file in sorted(REFERENCE.glob("*.context.json")):
        context = json.loads(file.read_text(encoding="utf-8"))
        expect(f"results/reference/{file.name}: of a tree with changes that no commit holds", context["dirty"] is False)
        expect(f"results/reference/{file.name}: its command has a path of one machine: {context['command']}",
               " /" not in context["command"])


# --- a small project ----------------------------------------------------------------------------------------------------

ROWS = ("suite_version,problem,step_s,budget,reason,kept,kept_us,left_us\n5,a,0.0041666666666666666,0,,1.23456789,123456.789,1\n"
        "5,a,1,100,,,,1\n5,b,1,0,it broke,2.99999998,2.99999998,1\n")
PACKED = ["suite_version,problem,step_s,budget,reason,kept,kept_us", "5,a,0.0041666666666666666,0,,1.23457,1.235e5", "5,a,1,100,,,",
          "5,b,1,0,it broke,2.99999998,3"]


def git(folder, *words):
    subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@b", *words], cwd=folder, check=True,
                   capture_output=True)


def make_project(folder):
    for part in ("harness", "methods", "experiments", "plots", "plots/pages", "results/reference", "results/a"):
        (folder / part).mkdir(parents=True)
        (folder / part / "keep").write_text("", encoding="utf-8")
    (folder / "CMakeLists.txt").write_text("", encoding="utf-8")
    (folder / "plots/pages/readme.py").write_text("", encoding="utf-8")
    (folder / "results/reference/publish.json").write_text("{}", encoding="utf-8")
    (folder / ".gitignore").write_text("/results/*\n!/results/reference/\n", encoding="utf-8")
    git(folder, "init", "-q")
    git(folder, "add", "-A")
    git(folder, "commit", "-qm", "all")
    publish.ROOT, publish.RESULTS, publish.WORK = folder, folder / "results", folder / "results/publish"
    publish.WORK.mkdir()


def refusal(function, *arguments):
    try:
        function(*arguments)
    except SystemExit as stopped:
        return str(stopped)
    return ""


def check_clean_tree(folder):
    expect("a clean tree is refused", publish.clean_commit())
    (folder / "harness/new").write_text("x", encoding="utf-8")
    expect("a changed tree is not refused by name", "harness/new" in refusal(publish.clean_commit))
    (folder / "harness/new").unlink()


def check_resumed(folder):
    state = publish.read_state(False)
    state["done"].append("first")
    publish.write_state(state)
    expect("what is done is forgotten", publish.read_state(False)["done"] == ["first"])
    expect("--quick takes what is done for its own", publish.read_state(True)["done"] == [])
    (folder / "plots/keep").write_text("x", encoding="utf-8")
    git(folder, "commit", "-qam", "a figure")
    expect("records depend on figures", publish.read_state(False)["done"] == ["first"])
    (folder / "methods/keep").write_text("x", encoding="utf-8")
    git(folder, "commit", "-qam", "a method")
    expect("records of older code are kept", publish.read_state(False)["done"] == [])


def check_side_by_side(folder):
    wait = "timeout 20 sh -c 'test -f a && until test -f c; do sleep 0.05; done'"
    stages = {"a": {"commands": ["touch a"]}, "b": {"one_core": True, "commands": [wait]},
              "c": {"one_core": True, "commands": ["touch c"]}, "d": {"commands": ["test -f c"]}}
    state = {"quick": False, "done": [], "seconds": {}}
    count, pinned = publish.os.cpu_count, publish.on_core
    publish.os.cpu_count, publish.on_core = lambda: 2, lambda core: []
    try:
        told = refusal(publish.run_stages, stages, state, "c0ffee")
    finally:
        publish.os.cpu_count, publish.on_core = count, pinned
    expect(f"stages of one core run one after the other: {told}", not told and sorted(state["done"]) == list("abcd"))
    told = refusal(publish.run_stages, {"e": {"one_core": True, "experiments": ["e"]}}, state, "c0ffee")
    expect(f"shards on all cores beside another stage: {told}", "one_core" in told)
    expect("the seconds of a stage are missing", sorted(state["seconds"]) == list("abcd"))


def check_assembled(folder):
    reference = folder / "results/reference"
    (folder / "results/a/records.csv").write_text(ROWS, encoding="utf-8")
    (folder / "results/a/context.json").write_text('{"dirty": false}', encoding="utf-8")
    for file in ("a.txt", "a.png", "a.caption.txt"):
        (folder / "results/a" / file).write_text("text", encoding="utf-8")
    (folder / "results/a/a.md").write_text("[a](a/a.png) [b](b.md)", encoding="utf-8")
    for old in ("old.png", "tracking.md"):
        (reference / old).write_text(old, encoding="utf-8")
    stages = {"s": {"records": ["a"], "direct": ["a"], "columns": ["kept", "kept_us"],
                    "files": ["renamed.txt=a/a.txt", "a/a.png", "a/a.md", "table.csv.xz=a/records.csv"]}}
    state = {"seconds": {"s": 90.0}}
    new = folder / "results/publish/reference"
    publish.write_about({"s": {"commit": "beef"}, "other": {"commit": "beef"}}, reference)
    publish.begin(new, whole=False)
    publish.assemble(stages, state, "c0ffee", new)
    expect("what is not accepted is in results/reference", not (reference / "a.png").exists())
    publish.begin(new, whole=False)
    expect("another part of the stages removes what is not accepted yet", (new / "a.png").is_file())
    check_accepted(new, reference)
    expect("a part of the stages removes what others made", (reference / "old.png").is_file())
    commits = {name: about["commit"] for name, about in publish.read_about(reference).items()}
    expect(f"publish.json has the wrong commits: {commits}", commits == {"s": "c0ffee", "other": "beef"})
    publish.begin(new, whole=True)
    publish.assemble(stages, state, "c0ffee", new)
    (reference / "tracking.md").write_text("newer", encoding="utf-8")
    check_accepted(new, reference)
    expect("publish.json tells of what is gone", list(publish.read_about(reference)) == ["s"])
    expect("a file that no stage makes stays", not (reference / "old.png").exists())
    expect("what experiments/track keeps there goes", (reference / "tracking.md").read_text(encoding="utf-8") == "newer")
    expect("what is accepted can be accepted again", "nothing to accept" in refusal(publish.accept, new))
    rows, direct, table = (lzma.decompress((reference / name).read_bytes()).decode().splitlines()
                           for name in ("a.records.csv.xz", "a.direct.records.csv.xz", "table.csv.xz"))
    expect(f"other records than those to be published: {rows}", rows == PACKED)
    expect(f"other rows than those of the direct solve: {direct}", direct == [PACKED[0], PACKED[1], PACKED[3]])
    expect(f"another table: {table}", table[0] == ROWS.splitlines()[0] and len(table) == 4)
    expect("not under its name", (reference / "renamed.txt").read_text(encoding="utf-8") == "text")
    expect("a link to a figure leads away", (reference / "a.md").read_text(encoding="utf-8") == "[a](a.png) [b](b.md)")
    expect("a figure without its caption", (reference / "a.caption.txt").is_file())
    about = publish.read_about(reference)["s"]
    expect(f"publish.json: {about}", about["commit"] == "c0ffee" and about["minutes"] == 1.5)
    packed = (reference / "a.records.csv.xz").read_bytes()
    publish.begin(new, whole=True)
    publish.assemble(stages, state, "c0ffee", new)
    expect("the same records are packed differently", (new / "a.records.csv.xz").read_bytes() == packed)
    unknown = {"s": stages["s"] | {"columns": ["kept_us", "spelt_us"]}}
    expect("columns that no record has are not named", "spelt_us" in refusal(publish.assemble, unknown, state, "c0ffee", new))
    full = {"s": {"full_files": ["a/a.txt"]}}
    publish.assemble(full, state | {"quick": True}, "c0ffee", new)
    expect("--quick wants a file of a full run", not (new / "a.txt").exists())
    publish.assemble(full, state, "c0ffee", new)
    expect("a file of a full run is missing", (new / "a.txt").is_file())
    for file in ("kept.png", "kept.caption.txt", "other.png"):
        (folder / "results/a" / file).write_text("text", encoding="utf-8")
    copies = [f"cp results/a/{file} {{folder}}" for file in ("kept.png", "kept.caption.txt", "other.png")]
    publish.make_last({"s": {"last": copies, "made_last": ["kept.png"]}}, reference)
    expect("what is made last is missing", (reference / "kept.png").is_file() and (reference / "kept.caption.txt").is_file())
    expect("what else the last commands make stays", not (reference / "other.png").exists())
    expect("the last commands remove what was there", (reference / "renamed.txt").is_file())
    (folder / "results/a/context.json").write_text('{"dirty": true}', encoding="utf-8")
    expect("records of a changed tree are published", "changed" in refusal(publish.assemble, stages, state, "c0ffee", new))


def check_accepted(new, reference):
    """Accepts, but for a picture that is too heavy."""
    before = {file.name: file.read_bytes() for file in reference.iterdir()}
    (new / "heavy.png").write_bytes(bytes(1_000_000))
    told = refusal(publish.accept, new)
    expect(f"too heavy a picture is accepted: {told}", "heavy.png" in told)
    expect("what is refused changes results/reference", before == {file.name: file.read_bytes() for file in reference.iterdir()})
    (new / "heavy.png").unlink()
    expect("a release is not accepted", not refusal(publish.accept, new) and (reference / "publish.json").is_file())


check_reference(sys.argv[1])
with tempfile.TemporaryDirectory() as temporary:
    make_project(Path(temporary))
    check_clean_tree(Path(temporary))
    check_resumed(Path(temporary))
    check_side_by_side(Path(temporary))
    check_assembled(Path(temporary))
print("\n".join(problems))
sys.exit(bool(problems))
