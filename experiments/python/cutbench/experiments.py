"""Experiments, their records, and advice. What takes long runs in a process of its own, which is this one's copy: so
functions of this session can be methods, and nothing that happens there harms the session."""

import json
import marshal
import multiprocessing
import os
import pty
import re
import sys
import tempfile
import zlib
from pathlib import Path

from . import _core
from .errors import InputError, OutputError, RunError
from .method import function_name, method_of
from .simulation import Scene
from .tables import table

CALIBRATION = Path(__file__).with_name("recommend_calibration.toml")


def _child(arguments, methods, scene, terminal, output):
    os.dup2(terminal, 2)
    os.dup2(output, 1)
    code = _core.command_line(arguments, [method_of(method, {}) for method in methods], scene and scene._core)
    sys.stdout.flush()
    os._exit(code)


def _run_program(arguments, methods=(), scene=None, say=print, progress=None):
    """Runs the program with the arguments, and with a Scene where it asks for the file of one. Its output is said at the end.

    Returns:
        The exit code: 0, or 1 where a result is not as it should be; and the lines that it wrote to standard error.
    """
    reader, terminal = pty.openpty()
    with tempfile.TemporaryFile() as output:
        child = multiprocessing.get_context("fork").Process(
            target=_child, args=(arguments, methods, scene, terminal, output.fileno()))
        child.start()
        os.close(terminal)
        try:
            errors = _follow(reader, progress)
            child.join()
        except BaseException:  # such as an interrupt: what is on disk can be resumed
            child.terminate()
            child.join()
            raise
        finally:
            os.close(reader)
        output.seek(0)
        text = output.read().decode(errors="replace")
    if child.exitcode == 2:
        raise InputError(errors[-1] if errors else "bad input")
    if child.exitcode not in (0, 1):
        raise RunError(f"the run's process ended with code {child.exitcode}: {' '.join(errors[-3:])}")
    for line in errors:
        print(line, file=sys.stderr)
    if say and text:
        say(text, end="")
    return child.exitcode, errors


def _follow(reader, progress):
    """Reads until the other end is closed. The progress is told; the other lines are returned."""
    lines, rest = [], b""
    while True:
        try:
            more = os.read(reader, 65536)
        except OSError:  # how Linux says that nobody writes any more
            more = b""
        *parts, rest = re.split(rb"[\r\n]+", rest + more) if more else [rest, b""]
        for part in parts:
            text = re.sub(rb"\x1b\[\w", b"", part).decode(errors="replace")
            if found := re.search(r": +(\d+) % of (\d+) cases", text):
                if progress:
                    progress(int(found[1]), int(found[2]))
            elif text and not text.startswith("running "):  # what recommend is at
                lines.append(text)
        if not more:
            return lines


class _Bar:
    """tqdm's, where it is there."""

    def __init__(self, name):
        try:
            from tqdm.auto import tqdm
            self._bar = tqdm(total=100, desc=name, unit="%")
        except ImportError:
            self._bar = None

    def __call__(self, percent, cases):
        if self._bar is not None:
            self._bar.update(percent - self._bar.n)

    def close(self):
        if self._bar is not None:
            self._bar.close()


def _version(function):
    """Differs where the function's own code does: rows of another version are not taken over."""
    code = getattr(function, "__code__", None)
    return f"{zlib.crc32(marshal.dumps(code)):08x}" if code else "0"


def run(experiment, methods=None, cases=None, resolutions=None, repetitions=None, seed=None, out="results", jobs=None,
        quiet=False):
    """Runs an experiment, as `cutbench run` does; what was interrupted goes on where it stopped.

    Args:
        experiment: a TOML file, such as "experiments/method_comparison.toml".
        methods: names of the experiment's, and functions as further methods; all of the experiment's where it is None.
        cases, resolutions, repetitions, seed: instead of the experiment's.
        out: the folder of results; "results" of the folder that you are in, where it is not given.
        jobs: processes, where no times are recorded.
        quiet: no progress bar and no summary.

    Returns:
        The records (see records()). Their `verdict` says what is not ok.
    """
    functions = [method for method in methods or () if callable(method)]
    names = [method if isinstance(method, str) else function_name(method) for method in methods or ()]
    arguments = ["run", os.fspath(experiment), "--out", os.fspath(out)]
    for option, value in (("--methods", ",".join(names)), ("--cases", cases), ("--repetitions", repetitions),
                          ("--resolutions", ",".join(map(str, resolutions or ()))), ("--seed", seed), ("--jobs", jobs)):
        if value not in (None, ""):
            arguments += [option, str(value)]
    if functions:
        arguments += ["--more-methods", ",".join(f"{function_name(f)}={_version(f)}" for f in functions)]
    stem = Path(experiment).stem
    bar = None if quiet else _Bar(stem)
    try:
        code, errors = _run_program(arguments, functions, say=None if quiet else print, progress=bar)
    finally:
        if bar:
            bar.close()
    folder = Path(out) / stem
    if not (folder / "records.csv").exists():
        raise OutputError(errors[-1] if errors else f"{folder}: no records were written")
    return records(folder)


def records(folder):
    """The records of a run: a pandas.DataFrame with a row for each measurement. `frame.attrs` has the columns' units
    (`units`, by name), their labels (`labels`) and the run's context (`context`).

    Args:
        folder: that holds records.csv and context.json, or the file itself.
    """
    import pandas
    file = Path(folder)
    file = file / "records.csv" if file.is_dir() else file
    if not file.exists():
        raise InputError(f"{file}: is not there; give the folder of a run, such as results/method_comparison")
    frame = pandas.read_csv(file, low_memory=False)
    columns = json.loads(_core.columns_json())
    frame.attrs["units"] = {name: columns[name]["unit"] for name in frame if name in columns}
    frame.attrs["labels"] = {name: columns[name]["label"] for name in frame if name in columns}
    context = file.with_name("context.json")
    frame.attrs["context"] = json.loads(context.read_text()) if context.exists() else {}
    return frame


def _report(command, scene, options, methods=(), quiet=False):
    scene = scene if isinstance(scene, Scene) else Scene(scene)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "report.json"
        _run_program([command, "scene", *options, "--report", str(file)], methods, scene, say=None if quiet else print)
        if not file.exists():
            raise RunError("the run wrote no report")
        return json.loads(file.read_text())


def _options(**values):
    """Options of a command: lists are separated by commas, True is a flag, None is left out."""
    options = []
    for name, value in values.items():
        if value is None or value is False:
            continue
        options.append("--" + name.replace("_", "-"))
        if value is not True:
            options.append(",".join(value) if isinstance(value, (list, tuple)) else str(value))
    return options


def recommend(scene, max_error=None, max_ms=None, methods=None, solvers=None, quantity=None, time_limit=None,
              calibration=None, quiet=False, reference=False, exhaustive=False, chord_tolerance=None):
    """The cheapest method, solver, resolution and step for a scene whose error is small enough, as `cutbench recommend`
    finds it.

    Args:
        scene: a TOML file, a Scene, whose sheet may be of arrays, or a dict that makes one.
        max_error: relative, such as 0.05; of the largest gape or deflection at the end (`quantity`).
        max_ms: milliseconds of processor time for a simulated second.
        methods, solvers: names to choose from.
        time_limit: s of processor time for each run.
        calibration: how well extrapolated values are known; the benchmark's own where it is None.
        reference: the converged value alone, without max_error.
        exhaustive: runs and times all, also what can't be the cheapest.
        chord_tolerance: of cuts, in mean rest edges.

    Returns:
        A dict: what `--report` writes. `chosen` is None where nothing is certain.
    """
    options = _options(max_error=max_error, max_ms=max_ms, methods=methods, solvers=solvers, quantity=quantity,
                       time_limit=time_limit, calibration=calibration or CALIBRATION, reference=bool(reference),
                       exhaustive=bool(exhaustive), chord_tolerance=chord_tolerance)
    return _report("recommend", scene, options, quiet=quiet)


def ablate(scene, method="conventional_split", resolution=None, time_limit=None, quiet=False, chord_tolerance=None,
           **parameters):
    """What each part of a scene's model is worth: the change of the result without it, and the time saved, as `cutbench
    ablate` finds it.

    Args:
        scene: a TOML file, a Scene, whose sheet may be of arrays, or a dict that makes one.
        method: a name or a function. resolution: triangles, instead of the scene's.
        time_limit: s of processor time for each run.
        chord_tolerance: of cuts, in mean rest edges.
        **parameters: of the method.

    Returns:
        A table with a row for the whole model and for each part that is left out.
    """
    functions = () if isinstance(method, str) else (method,)
    options = _options(method=function_name(method) if functions else method, resolution=resolution,
                       time_limit=time_limit, chord_tolerance=chord_tolerance)
    for key, value in parameters.items():
        options += ["--set", f"{key}={value}"]
    return table(_report("ablate", scene, options, functions, quiet))
