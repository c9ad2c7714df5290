"""Figure 8 of the paper: distance and angle of the lips from those on a fine sheet."""

import functools

from analysis import frame_files, lips, load
from analysis.scenes import scene_frames

STEM = "fig8_edge_quality"
SCENES = {"patches": "bending: patches;\nsolver: direct", "hinges": "bending: hinges;\nsolver: direct",
          "cg": "bending: patches;\nCG to 0.01", "unconverged": "bending: patches;\nCG to 0.3"}
TIMES = (0.7, 1.5)  # s
FINE, COARSER = 7442, 3362  # triangles of the reference, and of another that shows what it is worth
COLUMNS = ["scene", "time, s", "method", "distance, mm", "angle, degrees", f"{COARSER} triangles: mm", "degrees", "verdict"]


class Reference:
    """Frames in <results>/reference/<bending>_<triangles>: direct solver, CGAL's constrained triangulation."""

    def __init__(self, results):
        self.folder = results / "reference"
        self.curve = lips.requested(f"{STEM}_patches")
        self.length = lips.distances_along(self.curve)[-1]

    def is_there(self):
        return all((self.folder / f"{bending}_{n}" / "frames.pvd").is_file()
                   for bending in ("patches", "hinges") for n in (FINE, COARSER))

    @functools.lru_cache(None)
    def at(self, bending, triangles, time):
        folder = self.folder / f"{bending}_{triangles}"
        if not (folder / "frames.pvd").is_file():
            load.stop(f"{folder} has no frames of the reference; experiments/reproduce {STEM} makes them")
        return lips.by_side(frame_files.read_frame(folder, time), self.curve)

    def difference(self, description, frame):
        """mm, degrees"""
        bending = description["bending"]
        offset, turn = lips.difference(lips.by_side(frame, self.curve), self.at(bending, FINE, round(frame.time, 6)),
                                       self.length)
        return 1000 * offset, turn

    def worth(self, bending, time):
        """What the lips of a sheet of half as many triangles differ by: mm, degrees."""
        offset, turn = lips.difference(self.at(bending, COARSER, time), self.at(bending, FINE, time), self.length)
        return 1000 * offset, turn


def measured(results):
    """[(scene, time, (method, parameter), mm, degrees, verdict)], and the worth {(scene, time): (mm, degrees)}."""
    reference, rows, worth = Reference(results), [], {}
    for scene in SCENES:
        for time in TIMES:
            for description, frame in scene_frames.read_shot(results, f"{STEM}_{scene}", time):
                method, _, parameter = description["method"].partition(" ")
                rows.append((scene, time, (method, parameter), *reference.difference(description, frame),
                             description["verdict"]))
                worth[scene, time] = reference.worth(description["bending"], round(frame.time, 6))
    return rows, worth


def turns_of(rows, scene, of_conventional):
    return [turn for s, _, (method, _), _, turn, _ in rows
            if s == scene and (method == "conventional_split") == of_conventional]


def swirls(rows):
    """Whether, with the direct solver, the angle of the conventional split's lips is more than 1.5 times that of any other
    method's."""
    return any(max(turns_of(rows, scene, True)) > 1.5 * max(turns_of(rows, scene, False)) for scene in ("patches", "hinges"))


def answer(rows):
    """The answer for the caption, with the ranges of the angles over methods and times."""
    def range_of(values):
        return f"{min(values):.1f}° to {max(values):.1f}°"
    direct = [f"{range_of(turns_of(rows, scene, True))} (bending by {scene}), those of the other methods by "
              f"{range_of(turns_of(rows, scene, False))}" for scene in ("patches", "hinges")]
    scene, time, method, off, *_ = max((r for r in rows if r[0] in ("patches", "hinges")), key=lambda r: r[3])
    cg, early = (range_of(turns_of(rows, scene, True) + turns_of(rows, scene, False)) for scene in ("cg", "unconverged"))
    gained = sorted({" ".join(method).strip() for *_, method, _, _, verdict in rows if verdict == "energy_growth"})
    return (f"With the direct solver, the lips of the conventional split differ in angle by {'; '.join(direct)}. The conventional "
            f"split {'swirls' if swirls(rows) else 'does not swirl'} more than the other methods. The largest distance is "
            f"that of {' '.join(method).strip()} after {time:g} s (bending by {scene}): {off:.0f} mm. By CG to a residual of "
            f"0.01: {cg}; by CG stopped at 0.3: {early}"
            + (f", and the energy grows by more than 1 % ({', '.join(gained)})." if gained else "."))


def print_numbers(rows, worth):
    table = [[SCENES[scene].replace("\n", " "), f"{time:g}", " ".join(method).strip(), offset, turn, *worth[scene, time], verdict]
             for scene, time, method, offset, turn, verdict in rows]
    load.print_table("Lips against those of a fine sheet, root mean squares", COLUMNS, table)
