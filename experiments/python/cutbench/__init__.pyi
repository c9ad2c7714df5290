"""Types of what there is to call. What it does, shapes and units are in the docstrings."""

from collections.abc import Callable, Sequence
from os import PathLike
from typing import Any, Literal, Self

import numpy
from numpy.typing import ArrayLike, NDArray

from ._core import Curve, Floats, Ints, PickedCurve
from ._core import cut_families as cut_families
from ._core import sheet_families as sheet_families

File = str | PathLike[str]
AnySheet = Sheet | Cut | tuple[ArrayLike, ArrayLike] | tuple[ArrayLike, ArrayLike, ArrayLike]
Path = Curve | PickedCurve | File | ArrayLike | Sequence[Curve | PickedCurve | ArrayLike]
MethodFunction = Callable[..., AnySheet]  # of a Sheet, a Curve, and its parameters by keyword
Method = str | MethodFunction
Rest = Literal["auto", "plane", "space"] | ArrayLike  # n x 2, n x 3, or m x 3 x 2: a position per corner, where seams are
Table = Any  # pandas.DataFrame; a list of dicts without pandas

class InputError(ValueError): ...
class OutputError(OSError): ...
class RunError(RuntimeError): ...

class CutError(RuntimeError):
    status: str
    verdict: str
    def __init__(self, message: str, status: str = "failed", verdict: str = "failed") -> None: ...

class Refused(CutError):
    def __init__(self, message: str) -> None: ...

class StepError(RuntimeError):
    verdict: str
    def __init__(self, message: str, verdict: str) -> None: ...

class _Mesh:
    vertices: Floats
    rest: Floats
    triangles: Ints
    texture: Floats | None
    pieces: Ints
    incision: Ints
    def plot(self, ax: Any = None, **how: Any) -> Any: ...
    def to_meshio(self) -> Any: ...

class Sheet(_Mesh):
    sewn: Ints
    given: Ints
    mean_edge: float
    def __init__(self, vertices: ArrayLike, triangles: ArrayLike, rest: Rest = "auto", texture: ArrayLike | None = None) -> None: ...
    @classmethod
    def read(cls, file: File, rest: Literal["auto", "vt", "plane", "space"] = "auto", triangulate: bool = False,
             sew: float | None = None) -> Self: ...
    @classmethod
    def family(cls, name: str = "grid", triangles: int = 800, size: float = 1.0) -> Self: ...
    def write(self, file: File) -> None: ...
    def random_cut(self, family: str = "curved", seed: int = 1, case: int = 0) -> list[Curve]: ...
    def cut(self, path: Path, method: Method = "warp_and_refine", chord_tolerance: float = 0.05, allow_miss: bool = False,
            **parameters: float) -> Cut: ...

class Parents:
    first: Ints
    vertices: Ints
    weights: Floats
    triangles: Ints
    def __init__(self, before: Sheet, first: Ints, vertices: Ints, weights: Floats, triangles: Ints) -> None: ...
    def carry(self, values: ArrayLike, of: Literal["sheet", "arrays"] | None = None) -> NDArray[Any]: ...

class Constraints:
    vertices: Ints
    masters: Ints
    weights: Floats
    phantoms: int
    polygons: list[Ints]
    polygon_triangles: list[Ints]
    def __init__(self, vertices: Ints, masters: Ints, weights: Floats, phantoms: int, polygons: list[Ints],
                 polygon_triangles: list[Ints]) -> None: ...

class Cut(_Mesh):
    before: Sheet
    sheet: Sheet
    path: list[Curve]
    method: str
    status: str
    reason: str
    crossed_triangles: int
    times: dict[str, float]
    parents: Parents
    constraints: Constraints
    polygons: list[Ints]
    quality: dict[str, Any]
    verdict: str
    def cut(self, path: Path, method: Method | None = None, chord_tolerance: float = 0.05, allow_miss: bool = False,
            **parameters: float) -> Cut: ...

class Finding:
    cause: str
    text: str
    mend: str
    place: NDArray[numpy.float64] | None
    cut: int | None

class Score:
    ok: bool
    verdict: str
    findings: list[Finding]
    problems: list[str]
    quality: dict[str, Any]
    svg: str
    def plot(self, ax: Any = None, **how: Any) -> Any: ...

class Scene:
    step: float
    duration: float
    dimension: int
    sheet: Sheet
    def __init__(self, scene: File | dict[str, Any] | None = None, sheet: AnySheet | dict[str, Any] | None = None,
                 **keys: Any) -> None: ...
    def with_resolution(self, triangles: int) -> Scene: ...

class Pin:
    def __init__(self, box: ArrayLike, axes: str = "xyz", velocity: Sequence[float] = (0, 0, 0)) -> None: ...

Each = Callable[[Simulation], Any] | None

class Simulation:
    scene: Scene
    x: Floats
    v: Floats
    rest: Floats
    triangles: Ints
    sheet: Sheet
    time: float
    energy: dict[str, float]
    cuts: list[dict[str, Any]]
    outcome: str
    cuts_refused: int
    verdict: str
    reason: str
    times: Table
    budget: Table
    cost: dict[str, Any]
    def __init__(self, scene: Scene | File | dict[str, Any], method: Method = "conventional_split", chord_tolerance: float = 0.05,
                 watch: bool = True, **parameters: float) -> None: ...
    def step(self, n: int = 1, each: Each = None) -> Self: ...
    def run(self, each: Each = None) -> Self: ...
    def cut(self, path: Path) -> dict[str, Any]: ...
    def pull(self, force: ArrayLike) -> None: ...
    def hold(self, pins: Pin | Sequence[Pin]) -> None: ...
    def show(self, ax: Any = None, **how: Any) -> Any: ...
    def animate(self, frames: int = 48, every: int = 4, each: Each = None, **how: Any) -> Any: ...

def cut(vertices: ArrayLike | Sheet | Cut, triangles: ArrayLike | None = None, path: Path | None = None,
        method: Method = "warp_and_refine", rest: Rest = "auto", chord_tolerance: float = 0.05, allow_miss: bool = False,
        texture: ArrayLike | None = None, **parameters: float) -> Cut: ...
def score(before: AnySheet, path: Path, after: AnySheet, chord_tolerance: float = 0.05, keeps_vertices: bool = False,
          deletes: bool = False) -> Score: ...
def compare(methods: Sequence[Method | tuple[Method, dict[str, float]]] | None = None, sheet: AnySheet | None = None,
            path: Path | None = None, chord_tolerance: float = 0.05) -> Table: ...
def methods() -> Table: ...
def polyline(points: ArrayLike, closed: bool = False) -> Curve | PickedCurve: ...
def bezier(points: ArrayLike, closed: bool = False) -> Curve | PickedCurve: ...
def rays(origins: ArrayLike, directions: ArrayLike, bezier: bool = False, closed: bool = False) -> PickedCurve: ...
def read_path(file: File) -> list[Curve | PickedCurve]: ...
def write_path(path: Path, file: File) -> None: ...
def run(experiment: File, methods: Sequence[Method] | None = None, cases: int | None = None,
        resolutions: Sequence[int] | None = None, repetitions: int | None = None, seed: int | str | None = None,
        out: File = "results", jobs: int | None = None, quiet: bool = False) -> Any: ...
def records(folder: File) -> Any: ...
def recommend(scene: Scene | File | dict[str, Any], max_error: float | None = None, max_ms: float | None = None,
              methods: Sequence[str] | None = None, solvers: Sequence[str] | None = None,
              quantity: Literal["gape", "deflection"] | None = None, time_limit: float | None = None,
              calibration: File | None = None, quiet: bool = False, reference: bool = False, exhaustive: bool = False,
              chord_tolerance: float | None = None) -> dict[str, Any]: ...
def ablate(scene: Scene | File | dict[str, Any], method: Method = "conventional_split", resolution: int | None = None,
           time_limit: float | None = None, quiet: bool = False, chord_tolerance: float | None = None,
           **parameters: float) -> Table: ...
