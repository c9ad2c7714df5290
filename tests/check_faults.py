#!/usr/bin/python3
"""Faults put into the program's files, options, disk and process, each in a folder of its own. Each must end with its exit
code, with one line on standard error that says what is wrong (or nothing, where nothing is), in time, with no file changed
and none left behind.

    tests/check_faults.py build/release/cutbench            # exits with 1 and the faults that fell short
"""

import json
import math
import os
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PROGRAM = str(Path(sys.argv[1]).resolve())
LIMIT = 20  # s, of processor time: far more than any of these takes

SHEET = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"
PATH = '{"cuts":[{"bezier":[[-0.1,0.3],[0.3,0.9],[0.6,0.1],[1.1,0.7]]}]}'
CUT = "cut --mesh sheet.off --path path.json --out out.obj --method conventional_split"


def grid(n):
    """OBJ with rest positions, n x n squares."""
    lines = [f"v {i / n} {j / n} 0\nvt {i / n} {j / n}" for j in range(n + 1) for i in range(n + 1)]
    for j in range(n):
        for i in range(n):
            a = j * (n + 1) + i + 1
            for t in ((a, a + 1, a + n + 2), (a, a + n + 2, a + n + 1)):
                lines.append("f " + " ".join(f"{v}/{v}" for v in t))
    return "\n".join(lines) + "\n"


def polyline(points, **more):
    return json.dumps({"cuts": [{"polyline": points, **more}]})


def scene(integrator="", sheet="resolution = 50\n", head="duration = 0.05\n", rest=""):
    return (f'effect = "e"\ntruth = "t"\n{head}[sheet]\n{sheet}[integrator]\n{integrator or "step = 0.01"}\n{rest}')


class Fault:
    """`files` replace the good ones. `left`: new files that the program may leave. Signals are sent after `kill_after` s."""

    def __init__(self, command, code, says="", files=None, left=(), limits=None, kill=None, kill_after=0.0, out=""):
        self.command, self.code, self.says, self.files = command, code, says, files or {}
        self.left, self.limits, self.kill, self.kill_after, self.out = set(left), limits or {}, kill, kill_after, out

    def shortcomings(self):
        with tempfile.TemporaryDirectory() as folder:
            return list(self.run(Path(folder)))

    def run(self, folder):
        content = {"sheet.off": SHEET, "path.json": PATH, **self.files}
        for name, text in content.items():
            data = text if isinstance(text, bytes) else text.encode()
            (folder / name).write_bytes(data)

        def limit():
            resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            for what, value in self.limits.items():
                resource.setrlimit(what, (value, value))

        process = subprocess.Popen([PROGRAM, *self.command.split()], cwd=folder, preexec_fn=limit, text=True,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        if self.kill is not None:
            time.sleep(self.kill_after)
            process.send_signal(self.kill)
        out, error = process.communicate()
        if process.returncode != self.code:
            yield f"exit code {process.returncode}, not {self.code}: {error.strip()[:200]}"
        lines = [line for line in error.splitlines() if not line.startswith("note: ")]
        if self.kill is None and len(lines) != (1 if self.says else 0):
            yield f"{len(lines)} lines on standard error: {error[:200]!r}"
        if self.says not in error:
            yield f"does not say {self.says!r}: {error[:300]!r}"
        if self.out not in out:
            yield f"does not print {self.out!r}: {out[-300:]!r}"
        if any(len(line) > 400 for line in lines):
            yield f"a line of {max(map(len, lines))} characters"
        if "internal error" in error:
            yield "calls it an internal error"
        found = {str(f.relative_to(folder)) for f in folder.rglob("*") if f.is_file()}
        for name in sorted(found - set(content) - self.left):
            yield f"leaves {name}"
        for name, text in content.items():
            if name not in self.left and (folder / name).read_bytes() != (text if isinstance(text, bytes) else text.encode()):
                yield f"changes {name}"


def options():
    yield Fault("", 2, "no subcommand given")
    yield Fault("nonsense", 2, 'unknown subcommand "nonsense"')
    yield Fault("cut", 2, "is required; see cutbench cut --help")
    for more, says in [("--nonsense 1", "--nonsense"), ("--out", "--out"), ("--chord-tolerance 0", "must be positive"),
                       ("--chord-tolerance -1", "must be positive"), ("--chord-tolerance nan", "not a number"),
                       ("--chord-tolerance 1x", "not a number"), ("--chord-tolerance", "--chord-tolerance"),
                       ("--set a=1", "has no parameter"), ("--mesh sheet.off", "--mesh"),
                       ("--report none/r.json", "there is no folder none"), ("--report sheet.off", "take the place"),
                       ("--report path.json", "take the place"), ("--report out.obj", "take the place")]:
        yield Fault(f"{CUT} {more}", 2, says)
    one = "cut --mesh sheet.off --path path.json --out out.obj --method "
    yield Fault(one + "conventionl_split", 2, 'did you mean "conventional_split"?')
    yield Fault(one + "foo", 2, "unknown method \"foo\"; `cutbench methods` lists them")
    for parameter in ["bowyer_watson --set rounds=12", "bowyer_watson --set rounds=-1", "bowyer_watson --set rounds=0.5",
                 "bowyer_watson --set rounds=inf", "cgal_refine --set bound=1", "snap_or_split --set tolerance=0.6",
                 "split_and_tie --set thinness=-1", "vertex_snap --set reach=0.6", "longest_edge --set cap=101"]:
        yield Fault(one + parameter, 2, "must be")
    yield Fault(one + "bowyer_watson --set round=1", 2, "is set as rounds=VALUE")
    yield Fault(one + "bowyer_watson --set rounds=x", 2, "not a number")
    for out, says in [("out", "unknown mesh format"), ("out.stl", "unknown mesh format"), ("none/out.obj", "no folder none"),
                      ("sheet.off/out.obj", "no folder sheet.off")]:
        yield Fault(f"cut --mesh sheet.off --path path.json --out {out} --method conventional_split", 2, says)
    for command in ["run", "simulate", "score"]:
        yield Fault(command, 2, "is required")
        yield Fault(f"{command} --nonsense", 2, "see cutbench")
    yield Fault("run none.toml", 2, "none.toml: can't be read")
    yield Fault("simulate none.toml", 2, "none.toml: can't be read")


def meshes():
    for name, text, says in [
            ("a.off", "", "not a complete OFF"), ("a.off", "OFF\n", "not a complete OFF"),
            ("a.off", SHEET[:-8], "not a complete OFF"), ("a.off", SHEET.replace("3 0 2 3", "3 0 2 9"), ""),
            ("a.off", SHEET.replace("1 1 0", "nan 1 0"), ""), ("a.off", SHEET.replace("1 1 0", "1 1 7"), "unrolled"),
            ("a.off", SHEET.replace("1 1 0", "1e70 1 0"), ""), ("a.off", SHEET.replace("3 0 1 2", "3 0 0 2"), ""),
            ("a.off", SHEET.replace("3 0 1 2", "4 0 1 2 3"), ""), ("a.obj", "", ""), ("a.obj", "v 0 0 0\n", ""),
            ("a.obj", "v 0 0 0\nf 1 2 3\n", ""), ("a.obj", "f 1 2 3\n", ""), ("a.ply", "ply\n", ""),
            ("a.ply", b"\0\1\2\3", ""), ("a.stl", "solid\n", "unknown mesh format"), ("a.off", b"\xff" * 1000, ""),
            ("a.off", "OFF\n1000000000 1 0\n0 0 0\n", "not a complete OFF"),
            ("a.off", SHEET.replace("4 2 0", "4 -2 0"), ""), ("a.off", SHEET.replace("4 2 0", "4 99999999999999999999 0"), "")]:
        yield Fault(f"cut --mesh {name} --path path.json --out out.obj --method conventional_split", 2, says or name, {name: text})
    yield Fault("cut --mesh none.off --path path.json --out out.obj --method conventional_split", 2, "none.off: no such file")
    yield Fault("cut --mesh . --path path.json --out out.obj --method conventional_split", 2, ".")


def paths():
    good = '{"cuts":[{"polyline":[[0,0.5],[1,0.6]]}]}'
    for text, says in [
            ("", "it is empty"), ("{}", '"cuts" must be a list'), ("[]", "must be an object"), ('{"cuts":[]}', "give at least one"),
            ('{"cuts":1}', "must be a list"), ('{"cuts":[{}]}', "give either"), ('{"cuts":[[0,1]]}', "must be an object"),
            ('{"cuts":[{"polyline":[[0,0]]}]}', "at least 2 points"), ('{"cuts":[{"polyline":[]}]}', "at least 2 points"),
            ('{"cuts":[{"polyline":[[0,0],[1,1]],"closed":true}]}', "3 points when closed"),
            ('{"cuts":[{"polyline":[[0,0],[1,"1"]]}]}', "two numbers"), ('{"cuts":[{"polyline":[[0,0],[1]]}]}', "two numbers"),
            ('{"cuts":[{"polyline":[[0,0],[1,1e61]]}]}', "below 1e60"), ('{"cuts":[{"polyline":[[0,0],[1,1e400]]}]}', "too large"),
            ('{"cuts":[{"polyline":[[0,0],[1,NaN]]}]}', "can't stand here"), ('{"cuts":[{"bezier":[[0,0],[1,1],[2,2]]}]}', "4, 7, 10"),
            ('{"cuts":[{"bezier":[[0,0],[1,1],[1,0],[0,1]],"closed":true}]}', "end where it began"),
            ('{"cuts":[{"polylne":[[0,0],[1,1]]}]}', 'unknown key "polylne"'),
            ('{"cuts":[{"polyline":[[0,0],[1,1]],"closed":1}]}', "true or false"),
            ('{"cuts":[{"polyline":[[0,0],[1,1]],"space":"moon"}]}', '"rest" or "world"'),
            ('{"space":"world","cuts":[{"polyline":[[0,0,0],[1,1,0]]}]}', '"space" belongs to each cut'),
            ('{"cuts":[{"polyline":[[0,0],[1,1]],"space":"world"}]}', "a point in world space is"),
            ('{"cuts":[{"polyline":[[0,0,9],[1,1,9]],"space":"world"}]}', "misses"),
            (good + "x", "can't stand here"), ("[" * 100000, "not a path file"), (b"\0\1\377", "not a path file")]:
        yield Fault(CUT, 2, says, {"path.json": text})
    for n in range(4, len(good), 8):
        yield Fault(CUT, 2, "not a path file", {"path.json": good[:n]})
    yield Fault(CUT.replace("path.json", "none.json"), 2, "none.json: can't be read")
    # Millimetres for metres, and beside the sheet.
    millimetres = polyline([[200, 500], [800, 500]])
    yield Fault(CUT, 2, "misses the sheet: the path spans x 200 to 800, y 500 to 500, the sheet x 0 to 1, y 0 to 1",
                {"path.json": millimetres})
    yield Fault(CUT, 2, "cut 1: misses", {"path.json": json.dumps({"cuts": [{"polyline": [[0, 0.5], [1, 0.6]]},
                                                                            {"polyline": [[2, 0.5], [3, 0.6]]}]})})
    yield Fault(CUT, 2, "misses the sheet", {"path.json": polyline([[-0.1, 0.95], [0.2, 1.4], [-0.2, 1.2]])})
    yield Fault(CUT + " --allow-miss", 0, files={"path.json": millimetres}, left=["out.obj"], out="noop")
    yield Fault(CUT, 2, "over 1000 times", {"path.json": polyline([[0, 0], [1e6, 1e6]])})


def long_paths():
    """Many points where there is room for few. What is refused is refused soon."""
    draw = random.Random(1)
    here = [0.313, 0.517]
    cloud = lambda size, n: [[here[0] + size * draw.random(), here[1] + size * draw.random()] for _ in range(n)]
    circle = lambda n: [[here[0] + 1e-3 * math.cos(2 * math.pi * i / n), here[1] + 1e-3 * math.sin(2 * math.pi * i / n)]
                        for i in range(n)]
    for n in (1000, 100000):
        yield Fault(CUT, 0, files={"path.json": polyline([here] * n + [[0.8, 0.8]])}, left=["out.obj"], out="ok")
        yield Fault(CUT, 2, "in one triangle", {"path.json": polyline(cloud(1e-9, n))})
        yield Fault(CUT, 2, "in one triangle", {"path.json": polyline(cloud(1e-2, n))})
    yield Fault(CUT, 2, "in one triangle", {"path.json": polyline(circle(100000), closed=True)})
    yield Fault(CUT, 2, "in one triangle", {"path.json": polyline([[0.3 + 0.2 * (i % 2), 0.4] for i in range(100000)])})
    yield Fault(CUT, 0, files={"path.json": polyline(circle(500), closed=True)}, left=["out.obj"], out="ok")
    yield Fault(CUT.replace("sheet.off", "grid.obj"), 0, left=["out.obj"], out="ok", files={
        "grid.obj": grid(20), "path.json": polyline([[-0.1 + 1.2 * i / 16000, 0.5 + 0.3 * math.sin(6 * i / 16000)]
                                                     for i in range(16001)])})


def star(n):
    """n triangles round one vertex."""
    lines = ["OFF", f"{n + 1} {n} 0", "0 0 0"]
    lines += [f"{math.cos(2 * math.pi * i / n)} {math.sin(2 * math.pi * i / n)} 0" for i in range(n)]
    return "\n".join(lines + [f"3 0 {i + 1} {(i + 1) % n + 1}" for i in range(n)]) + "\n"


def many_triangles():
    """Round one vertex: time must not grow with the square of their number."""
    for method in ["conventional_split", "warp_and_refine"]:
        yield Fault(f"cut --mesh star.off --path path.json --out out.obj --method {method}", 0, left=["out.obj"], out="ok",
                    files={"star.off": star(4000), "path.json": polyline([[-0.5, 0.013], [0.5, 0.021]])})


def scenes():
    for text, says in [
            ("", '"effect" is missing'), ("x", "line 1"), (scene() + "foo = 1\n", "known are name, step, newton"),
            (scene("step = 1e-12"), "steps, more than 1e9"), (scene(head="duration = 1e300\n"), "steps, more than 1e9"),
            (scene(head="duration = inf\n"), "must be finite"), (scene(head="duration = -1\n"), "must be positive"),
            (scene("step = 0"), "must be positive"), (scene("step = nan"), "must be finite"), (scene("step = 1"), "the first step"),
            (scene("newton = 0"), "between 1 and"), (scene('name = "euler"'), "known are"), (scene("stp = 1"), 'did you mean "step"?'),
            (scene(head="foo = 1\n"), "known are effect, truth"), (scene(sheet="resolution = 51\n"), "2 n^2"),
            (scene(sheet="resolution = 0\n"), "between 1 and"), (scene(sheet='family = "grd"\n'), "known are grid"),
            (scene(sheet='file = "none.obj"\n'), "there is no file"), (scene(sheet='file = "bad.off"\n'), "not a complete OFF"),
            (scene(rest="[solver]\ntolerance = 1\n"), "below 1"), (scene(rest='[solver]\nname = "magic"\n'), "known are"),
            (scene(rest="[material]\ndensity = 0\n"), "must be positive"), (scene(rest="[material]\nstiffness = -1\n"), "positive"),
            (scene(rest="[material]\npoisson = 1\n"), "poisson"), (scene(rest="[physics]\ndimension = 4\n"), "is 2"),
            (scene(rest="[[cuts]]\ntime = 9\npolyline = [[0.1, 0.2], [0.8, 0.7]]\n"), "no step follows it"),
            (scene(rest="[[cuts]]\npolyline = [[0.1, 0.2]]\n"), "at least 2 points"),
            (scene(rest="[[cuts]]\npolyline = [[100.0, 200.0], [800.0, 200.0]]\n"), "cut 0: misses the sheet"),
            (scene(rest="[[cuts]]\nfamily = \"wavy\"\n"), "known are")]:
        yield Fault("simulate s.toml", 2, says, {"s.toml": text, "bad.off": "OFF\n"})
    for more, says in [("--resolution 51", "2 n^2"), ("--resolution -1", "--resolution"), ("--solver magic", "known are"),
                       ("--every 0", "--every"), ("--frames none/f", "f"), ("--out none/o.obj", "no folder none"),
                       ("--report none/r", "no folder none"), ("--steps none/s", "no folder none"), ("--time-limit 0", "--time-limit"),
                       ("--method foo", "unknown method")]:
        yield Fault(f"simulate s.toml {more}", 2, says, {"s.toml": scene()})
    # Verdicts: the program says them on its last line.
    falls = "[physics]\ngravity = [0.0, 0.0, -10.0]\n[[pins]]\nbox = [[-inf, -inf], [0.0, inf]]\n"
    explicit = 'name = "symplectic_euler"\nstep = 0.1\n'
    yield Fault("simulate s.toml", 1, files={"s.toml": scene(explicit, head="duration = 100.0\n", rest=falls)}, out="\nnot_finite at ")
    stiff = "[material]\nstiffness = 1e5\ndensity = 0.2\n[solver]\nname = \"cholmod\"\n"
    yield Fault("simulate s.toml", 1, files={"s.toml": scene("step = 0.04", head="duration = 1.0\n", sheet="resolution = 200\n",
                                                             rest=falls + stiff)}, out="\nenergy_growth at ")
    stalls = "[solver]\ntolerance = 1e-15\nmax_iterations = 1\n"
    yield Fault("simulate s.toml", 1, files={"s.toml": scene(rest=falls + stalls)}, out="\nsolver_stalled at ")
    hours = scene("step = 1e-5", head="duration = 1000.0\n", rest=falls)
    yield Fault("simulate s.toml --time-limit 0.01", 1, files={"s.toml": hours}, out="\ntimed_out at ")


def experiments():
    good = ('claim = "c"\nsheets = ["grid"]\nresolutions = [50]\ncut_families = ["curved"]\ncases = 1\nrepetitions = 1\n'
            'methods = ["conventional_split"]\n')
    for text, says in [
            ("", '"claim" is missing'), (good.replace("[50]", "[51]"), "2 n^2"), (good.replace("[50]", "[]"), "at least one"),
            (good.replace('"grid"', '"gird"'), "known are"), (good.replace("cases", "case"), 'did you mean "cases"?'),
            (good.replace("conventional", "conventionl"), 'did you mean "conventional_split"?'),
            (good.replace('["conventional_split"]', '["foo"]'), "`cutbench methods` lists them"), (good + "foo = 1\n", "known are"),
            (good.replace("cases = 1", "cases = 0"), "between 1 and"), (good + 'scene = "none.toml"\ncut_time = 0\n', "can't be read")]:
        yield Fault("run e.toml --out r --seed 1", 2, says, {"e.toml": text})
    for more, says in [("--shard 3/2", "shard"), ("--shard x", "shard"), ("--seed x", "seed"), ("--cases 0", "--cases"),
                       ("--methods foo", "foo"), ("--resolutions 51", "51")]:
        yield Fault(f"run e.toml --out r {more}", 2, says, {"e.toml": good})
    yield Fault("run e.toml --out sheet.off", 2, "can't be made", {"e.toml": good})


def disk_and_process():
    big = {"grid.obj": grid(20), "path.json": polyline([[-0.1, 0.31], [1.1, 0.7]])}
    cut = CUT.replace("sheet.off", "grid.obj")
    for out in ["out.obj", "out.off", "out.vtu"]:  # the default action of SIGXFSZ would end the program
        yield Fault(cut.replace("out.obj", out), 1, "can't be written (File too large)", big, limits={resource.RLIMIT_FSIZE: 1024})
    yield Fault(cut + " --report r.json", 1, "can't be written (File too large)", big, limits={resource.RLIMIT_FSIZE: 200})
    yield Fault(cut.replace("out.obj", "grid.obj"), 1, "can't be written (File too large)", big, limits={resource.RLIMIT_FSIZE: 1024})
    falls = scene(rest="[physics]\ngravity = [0.0, 0.0, -10.0]\n", sheet="resolution = 800\n")
    for more in ["--out o.obj", "--frames f", "--report r.json", "--steps s.csv"]:
        yield Fault(f"simulate s.toml {more}", 1, "can't be written (File too large)", {"s.toml": falls},
                    limits={resource.RLIMIT_FSIZE: 64})
    long = scene("step = 1e-5", head="duration = 100.0\n", sheet="resolution = 800\n")
    for number in (signal.SIGKILL, signal.SIGTERM):
        yield Fault("simulate s.toml --out o.obj --report r.json", -number, files={"s.toml": long}, kill=number, kill_after=0.3)


def main():
    faults = [*options(), *meshes(), *paths(), *long_paths(), *many_triangles(), *scenes(), *experiments(), *disk_and_process()]
    short = 0
    for fault in faults:
        found = fault.shortcomings()
        short += bool(found)
        for text in found:
            print(f"cutbench {fault.command} {str(fault.files)[:160]}\n    {text}")
    print(f"{len(faults)} faults, {short} fell short")
    sys.exit(1 if short else 0)


if __name__ == "__main__":
    main()
