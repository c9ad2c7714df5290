"""Scenes made of others: keys replaced, random cuts in place of theirs. For experiments/realtime and experiments/solvers."""

import math


def curve(draw):
    """A cubic Bezier of 0.1 to 0.3 sides anywhere in the unit square, bent by up to a third of its length."""
    while True:
        length, angle = draw.uniform(0.1, 0.3), draw.uniform(0, 2 * math.pi)
        middle = [draw.uniform(0.05, 0.95), draw.uniform(0.05, 0.95)]
        along = [length * math.cos(angle), length * math.sin(angle)]
        across = [-along[1], along[0]]
        bends = [draw.uniform(-0.33, 0.33), draw.uniform(-0.33, 0.33)]
        points = [[middle[i] + (t - 0.5) * along[i] + bend * across[i] for i in (0, 1)]
                  for t, bend in ((0, 0), (1 / 3, bends[0]), (2 / 3, bends[1]), (1, 0))]
        if all(0 < x < 1 for point in points for x in point):
            return points


def scene_text(path, values, cuts=None):
    """The scene of a file with values in place of its own, by "section.key" ("key" before the first section); a
    value None leaves the key out. cuts: a time and a curve each, in place of its own; None: its own."""
    text = path.read_text(encoding="utf-8")
    own, _, rest = text.partition("[[cuts]]")
    lines, section = [], ""
    for line in own.splitlines():
        if line.startswith("["):
            section = line[1:].split("]")[0] + "."
        key = line.split("=")[0].strip()
        name = section + key
        if name not in values:
            lines.append(line)
        elif values[name] is not None:
            lines.append(f"{key} = {values[name]}")
    if cuts is None:
        return "\n".join(lines) + ("\n[[cuts]]" + rest if rest else "\n")
    for time, points in cuts:
        lines += ["[[cuts]]", f"time = {time}", f"bezier = {points}"]
    return "\n".join(lines) + "\n"
