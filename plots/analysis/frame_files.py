"""Reads the frames that `cutbench simulate --frames` writes, and the description of what was simulated."""

import json
import xml.etree.ElementTree as xml
from dataclasses import dataclass, field

import numpy as np

from analysis.stop import stop


@dataclass
class Frame:
    """An opened sheet at one time. The lips of an incision have different vertices at the same rest positions."""
    time: float
    deformed: np.ndarray  # (vertices, 3), m
    rest: np.ndarray  # (vertices, 2), m
    triangles: np.ndarray  # (triangles, 3)
    cell: dict = field(default_factory=dict)  # per triangle: piece, aspect_ratio, strain
    held: np.ndarray = None  # (vertices,), is a pin or a load there? None in older files
    sky: np.ndarray = None  # the result of sky_seen() after its first call

    def lips(self):
        """(edges, 2): border edges that lie, in rest space, on another border edge; with the triangle of each."""
        edges = self.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
        owner = np.repeat(np.arange(len(self.triangles)), 3)
        twins = {tuple(e) for e in edges.tolist()}
        border = np.array([(b, a) not in twins for a, b in edges.tolist()], bool)
        edges, owner = edges[border], owner[border]
        places = [tuple(self.rest[[a, b]].ravel()) for a, b in edges]
        there = set(places)
        lip = np.array([(x2, y2, x1, y1) in there for x1, y1, x2, y2 in places], bool)
        return edges[lip], owner[lip]


def read_series(folder):
    """(time, file) of each frame that frames.pvd names."""
    try:
        entries = xml.parse(folder / "frames.pvd").getroot().iter("DataSet")
        return [(float(e.get("timestep")), folder / e.get("file")) for e in entries]
    except (OSError, xml.ParseError) as error:
        stop(f"{folder / 'frames.pvd'} can't be read: {error}; `cutbench simulate --frames` makes it")


def read_frame(folder, time):
    """The frame nearest to a time (s)."""
    return read_vtu(*min(read_series(folder), key=lambda frame: abs(frame[0] - time)))


def read_all(folder):
    return [read_vtu(*frame) for frame in read_series(folder)]


def read_vtu(time, file):
    arrays = {a.get("Name"): np.array(a.text.split(), float).reshape(-1, int(a.get("NumberOfComponents")))
              for a in xml.parse(file).getroot().iter("DataArray")}
    return Frame(time, arrays["deformed"], arrays["rest"][:, :2], arrays["connectivity"].astype(int).reshape(-1, 3),
                 {name: arrays[name][:, 0] for name in ("piece", "aspect_ratio", "strain")},
                 arrays["held"][:, 0] > 0 if "held" in arrays else None)


def read_description(folder):
    """What was simulated, from simulation.json. A verdict that is ok says which cuts were refused."""
    try:
        description = json.loads((folder / "simulation.json").read_text(encoding="utf-8"))
        if description["verdict"] == "ok" and description.get("cuts_refused"):
            description["verdict"] = f"ok, but {description['cuts_refused']} of {len(description['cuts'])} cuts refused"
        return description
    except (OSError, ValueError) as error:
        stop(f"{folder / 'simulation.json'} can't be read: {error}; `cutbench simulate --frames` makes it")
