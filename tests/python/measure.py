#!/usr/bin/env python3
"""What the Python package costs beside C++, and what two threads gain: two minutes on a machine that does nothing else.
usage: PYTHONPATH=build/python/package tests/python/measure.py build/python/tests/libcutbench_python_overhead.so [--instructions]
  --instructions  of a cut, counted by callgrind, instead of times: the same on every machine, busy or not; some minutes"""

import ctypes
import os
import re
import subprocess
import sys
import threading
import time

import numpy as np

import cutbench

PATH = np.array([[-0.1, 0.313], [0.42, 0.47], [0.63, 0.55]])
METHOD = "conventional_split"


RESOLUTIONS = (200, 800, 3200, 12800)


def arrays(resolution):
    sheet = cutbench.Sheet.family("grid", resolution)
    return sheet.vertices.copy(), sheet.triangles.astype(np.int64)


def in_cpp(library, vertices, triangles):
    library.us_of_a_cut.restype = ctypes.c_double
    us = library.us_of_a_cut(METHOD.encode(), *[word for array in (vertices, triangles, PATH)
                                                for word in (ctypes.c_size_t(len(array)), ctypes.c_void_p(array.ctypes.data))])
    assert us > 0
    return us


def in_python(vertices, triangles):
    start = time.thread_time_ns()
    made = cutbench.cut(vertices, triangles, PATH, METHOD)
    count = len(made.vertices) and len(made.rest) and len(made.triangles)
    us = 1e-3 * (time.thread_time_ns() - start)
    assert count > len(triangles)
    return us  # and frees the cut after the clock, as C++ does


def overhead(library):
    print("triangles  C++ us  Python us  more us (quartiles)   more %  wanted  (processor time; medians of cuts in turns)")
    for resolution in RESOLUTIONS:
        made_of = arrays(resolution)
        times = 400000 // resolution
        pairs = [(in_cpp(library, *made_of), in_python(*made_of)) for _ in range(max(100, times))]
        cpp, python = np.median(pairs, axis=0)
        few, more, much = np.quantile([there - here for here, there in pairs], (0.25, 0.5, 0.75))
        most = max(50.0, 0.01 * cpp)
        print(f"{resolution:9} {cpp:7.1f} {python:10.1f} {more:8.1f} ({few:.1f} to {much:.1f}) {100 * more / cpp:10.1f} "
              f"{most:7.1f}  {'yes' if more <= most else 'NO'}", flush=True)


def instructions_of_a_cut(*which):
    """From two numbers of cuts, so that what comes before and after them drops out."""
    few, many = 5, 25
    counts = [int(re.search(r"Collected : (\d+)", subprocess.run(
        ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", sys.executable, __file__, sys.argv[1], *which, str(times)],
        capture_output=True, text=True, check=True).stderr)[1]) for times in (few, many)]
    return (counts[1] - counts[0]) / (many - few)


def instructions():
    print("triangles  C++, thousands  Python, thousands  more, thousands  more, %  (instructions of a cut)")
    for resolution in RESOLUTIONS:
        cpp, python = (instructions_of_a_cut(which, str(resolution)) for which in ("cpp", "python"))
        print(f"{resolution:9} {cpp / 1e3:15.0f} {python / 1e3:18.0f} {(python - cpp) / 1e3:16.0f} "
              f"{100 * (python / cpp - 1):8.2f}", flush=True)


def wall_time(runs):
    start = time.perf_counter()
    runs()
    return time.perf_counter() - start


def in_threads(work, sheets):
    both = [threading.Thread(target=work, args=(sheet,)) for sheet in sheets]
    for thread in both:
        thread.start()
    for thread in both:
        thread.join()


def in_processes(work, sheets):
    children = []
    for sheet in sheets:
        children.append(os.fork())
        if children[-1] == 0:
            work(sheet)
            os._exit(0)
    for child in children:
        os.waitpid(child, 0)


def two_at_a_time():
    """A run takes most of a second: what starting a thread costs, and its first pages of memory, should not count."""
    sheets = [cutbench.Sheet.family("grid", 12800), cutbench.Sheet.family("delaunay", 12800)]

    def work(sheet):
        for case in range(500):
            sheet.cut(sheet.random_cut("curved", 3, case), "warp_and_refine")

    for name, both in (("two threads", in_threads), ("two processes, what this machine can", in_processes)):
        gains = []
        for _ in range(7):
            one = wall_time(lambda: [both(work, [sheet]) for sheet in sheets])
            gains.append(one / wall_time(lambda: both(work, sheets)))
        print(f"{name}: two sheets {np.median(gains):.2f} times as fast as one after the other ({min(gains):.2f} to "
              f"{max(gains):.2f}); wanted of threads: 1.7; load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores", flush=True)


library = ctypes.CDLL(os.path.abspath(sys.argv[1]))
if sys.argv[2:] == ["--instructions"]:
    instructions()
elif len(sys.argv) > 2:  # what --instructions counts
    which, resolution, times = sys.argv[2:]
    made_of = arrays(int(resolution))
    for _ in range(int(times)):
        in_cpp(library, *made_of) if which == "cpp" else in_python(*made_of)
else:
    overhead(library)
    two_at_a_time()
