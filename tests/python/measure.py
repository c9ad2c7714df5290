#!/usr/bin/env python3
"""What the Python package costs beside C++, and what two threads gain: two minutes on a machine that does nothing else.
usage: PYTHONPATH=build/python/package tests/python/measure.py build/python/cutbench_python_overhead [--instructions]
  --instructions  of a cut, counted by callgrind, instead of times: the same on every machine, busy or not; some minutes"""

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
    return sheet, sheet.vertices.copy(), sheet.triangles.astype(np.int64)


def as_text(sheet):
    numbers = [len(sheet.vertices), len(sheet.triangles), len(PATH), *sheet.vertices.ravel(), *sheet.triangles.ravel(), *PATH.ravel()]
    return " ".join(repr(x.item() if hasattr(x, "item") else x) for x in numbers)


def in_cpp(program, sheet, times):
    said = subprocess.run([program, METHOD, str(times)], input=as_text(sheet), capture_output=True, text=True, check=True).stdout
    rows = [line.split() for line in said.splitlines()]
    return [float(us) for us, _ in rows], int(rows[0][1])


def in_python(vertices, triangles, times):
    taken = []
    for _ in range(times):
        start = time.thread_time_ns()
        made = cutbench.cut(vertices, triangles, PATH, METHOD)
        count = len(made.vertices) and len(made.rest) and len(made.triangles)
        taken.append(1e-3 * (time.thread_time_ns() - start))
        del made  # as C++ does it: after the clock
    return taken, count


def overhead(program):
    print("triangles  C++ us  Python us  more us (of 8 pairs)   more %  wanted  (processor time; medians of runs in turns)")
    for resolution in RESOLUTIONS:
        sheet, vertices, triangles = arrays(resolution)
        times = max(20, 200000 // resolution)
        pairs = []
        for _ in range(8):
            cpp, count = in_cpp(program, sheet, times)
            python, same = in_python(vertices, triangles, times)
            assert count == same
            pairs.append((np.median(cpp), np.median(python)))
        cpp, python = np.median(pairs, axis=0)
        more = np.sort([there - here for here, there in pairs])
        most = max(50.0, 0.01 * cpp)
        print(f"{resolution:9} {cpp:7.1f} {python:10.1f} {np.median(more):8.1f} ({more[0]:.1f} to {more[-1]:.1f}) "
              f"{100 * np.median(more) / cpp:8.1f} {most:7.1f}  {'yes' if np.median(more) <= most else 'NO'}", flush=True)


def instructions_of_a_cut(command, text=""):
    """From two numbers of cuts, so that what comes before and after them drops out. `command` gives the words for a number."""
    few, many = 5, 25
    counts = [int(re.search(r"Collected : (\d+)", subprocess.run(
        ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *command(times)], input=text, capture_output=True,
        text=True, check=True).stderr)[1]) for times in (few, many)]
    return (counts[1] - counts[0]) / (many - few)


def instructions(program):
    print("triangles  C++, thousands  Python, thousands  more, thousands  more, %  (instructions of a cut)")
    for resolution in RESOLUTIONS:
        cpp = instructions_of_a_cut(lambda times: [program, METHOD, str(times)], as_text(arrays(resolution)[0]))
        python = instructions_of_a_cut(lambda times: [sys.executable, __file__, "cuts", str(resolution), str(times)])
        print(f"{resolution:9} {cpp / 1e3:15.0f} {python / 1e3:18.0f} {(python - cpp) / 1e3:16.0f} "
              f"{100 * (python / cpp - 1):8.2f}", flush=True)


def threads():
    sheets = [cutbench.Sheet.family("grid", 12800), cutbench.Sheet.family("delaunay", 12800)]

    def work(sheet):
        for case in range(60):
            sheet.cut(sheet.random_cut("curved", 3, case), "warp_and_refine")

    gains = []
    for _ in range(7):
        start = time.perf_counter()
        for sheet in sheets:
            work(sheet)
        one = time.perf_counter() - start
        start = time.perf_counter()
        both = [threading.Thread(target=work, args=(sheet,)) for sheet in sheets]
        for thread in both:
            thread.start()
        for thread in both:
            thread.join()
        gains.append(one / (time.perf_counter() - start))
    print(f"two threads, two sheets: {np.median(gains):.2f} times as fast as one ({min(gains):.2f} to {max(gains):.2f}), wanted "
          f"1.7; load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")


if sys.argv[1] == "cuts":  # what --instructions counts
    in_python(*arrays(int(sys.argv[2]))[1:], int(sys.argv[3]))
elif sys.argv[2:] == ["--instructions"]:
    instructions(sys.argv[1])
else:
    overhead(sys.argv[1])
    threads()
