#!/usr/bin/env python3
"""Do plots/pages/history.py and experiments/track_wall find the changes that were put into numbers, and no others? Prints
every disagreement; exit code 1 if there is any. usage: check_tracking.py FOLDER to write into"""

import importlib.machinery
import importlib.util
import json
import math
import random
import subprocess
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
PAGES = ROOT / "plots/pages"
sys.path.insert(0, str(PAGES))
import history  # noqa: E402

loader = importlib.machinery.SourceFileLoader("track_wall", str(ROOT / "experiments/track_wall"))
track_wall = importlib.util.module_from_spec(importlib.util.spec_from_loader("track_wall", loader))
loader.exec_module(track_wall)

problems = []


def expect(what, condition):
    if not condition:
        problems.append(what)


def check_counts():
    for values, places in (([1000, 1000, 1004, 1004], []), ([1000, 1006, 1006], [1]), ([1000, 1000, 990], [2])):
        found = [c.at for c in history.steps("instructions", values)]
        expect(f"steps of {values}: {found}", found == places)
    found = history.steps("allocations", [0, 0, 1])
    expect(f"a counter from 0 to 1: {found}", len(found) == 1 and found[0].ratio == 2)


def check_times():
    """A step of 5 % under 1 % of noise is found where it is; in noise alone no more often than the level says."""
    draw, right, alarms = np.random.default_rng(7), 0, 0
    for _ in range(20):
        noise = np.exp(0.01 * draw.standard_normal(24))
        places = history.e_divisive(noise * np.where(np.arange(24) < 10, 1, 1.05))
        right += len(places) >= 1 and min(abs(place - 10) for place in places) <= 1
        alarms += bool(history.e_divisive(noise))
    expect(f"steps of 5 % found in {right} of 20", right >= 19)
    expect(f"false alarms in {alarms} of 20", alarms <= 4)  # 1 is expected; 5 or more has a probability of 0.26 %


def check_pairs():
    """Times with 1 % of noise, a machine that becomes slower meanwhile, and now and then a process that took half as long
    again."""
    draw = random.Random(3)

    def pair(number, slower):
        def noise():
            return draw.gauss(0, 0.01) + 0.002 * number + (0.4 if draw.random() < 0.05 else 0)
        return math.log(slower) + noise() - noise()

    def found(slower, runs):
        return sum(track_wall.probability([pair(i, slower) for i in range(40)]) < track_wall.LEVEL for _ in range(runs))
    alarms, caught = found(1, 1000), found(1.03, 200)
    expect(f"false alarms in {alarms} of 1000", alarms == 0)
    expect(f"slow-downs of 3 % found in {caught} of 200", caught > 140)
    quiet = [pair(i, 1) for i in range(40)]
    expect("the power does not grow with the change", track_wall.power(quiet, 0.01) < 0.05 < track_wall.power(quiet, 0.05))


def check_page(folder):
    def line(number, instructions):
        return {"commit": f"{number:040x}", "subject": f"a <{number}> & b", "date": f"2026-01-{number + 1:02d}T00:00:00Z",
                "tools": {"g++": "12"}, "rows": [{"id": "trace/800", "counters": {"allocations": 0}, "misses": 5,
                                                  "instructions": instructions}]}
    file, out = folder / "h.jsonl", folder / "h.html"
    counts = [1000, 1000, 2500, 2500, 500]
    lines = [line(i, n) for i, n in enumerate(counts)]
    file.write_text("".join(json.dumps(one) + "\n" for one in reversed(lines)), encoding="utf-8")  # sorted by date
    done = subprocess.run([sys.executable, PAGES / "history.py", "--file", file, "--out", out, "--url", "https://x.org/y/"],
                          capture_output=True, text=True, check=False)
    expect(f"history.py: {done.returncode} {done.stderr}", done.returncode == 0)
    page = out.read_text(encoding="utf-8")
    expect("the largest change does not come first", page.find("/ 5</span>") < page.find("x 2.5</span>"))
    expect("a change is not marked", page.count("<path ") == 2)
    expect("a commit is not linked", f'href="https://x.org/y/commit/{2:040x}"' in page)
    expect("a subject is not escaped", "a &lt;2&gt; &amp; b" in page and "a <2>" not in page)


check_counts()
check_times()
check_pairs()
check_page(Path(sys.argv[1]))
print("\n".join(problems))
sys.exit(1 if problems else 0)
