#!/usr/bin/env python3
"""What the Python package costs beside C++, and what two threads gain: two minutes on a machine that does nothing else.
usage: PYTHONPATH=build/python/package tests/python/measure.py build/python/cutbench_python_overhead"""

import os
import subprocess
import sys
import threading
import time

import numpy as np

import cutbench

PATH = np.array([[-0.1, 0.313], [0.42, 0.47], [0.63, 0.55]])
METHOD = "conventional_split"


def in_cpp(program, sheet, times):
    numbers = [len(sheet.vertices), len(sheet.triangles), len(PATH), *sheet.vertices.ravel(), *sheet.triangles.ravel(), *PATH.ravel()]
    text = " ".join(repr(x.item() if hasattr(x, "item") else x) for x in numbers)
    said = subprocess.run([program, METHOD, str(times)], input=text, capture_output=True, text=True, check=True).stdout
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
    for resolution in (200, 800, 3200, 12800):
        sheet = cutbench.Sheet.family("grid", resolution)
        vertices, triangles = sheet.vertices.copy(), sheet.triangles.astype(np.int64)
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


overhead(sys.argv[1])
threads()
