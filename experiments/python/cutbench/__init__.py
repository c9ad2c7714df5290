"""cutbench: cut deformable triangle sheets along paths, judge, simulate and compare (docs/reference/python.md).

>>> import cutbench
>>> sheet = cutbench.Sheet.family("grid", 800)
>>> cut = sheet.cut([[-0.1, 0.3], [0.6, 0.55]], method="warp_and_refine")
>>> cut.verdict
'ok'
"""

from ._core import cut_families, sheet_families
from .compare import compare
from .errors import CutError, InputError, OutputError, Refused, RunError, StepError
from .experiments import ablate, recommend, records, run
from .method import methods
from .parents import Constraints, Parents
from .paths import bezier, polyline, rays, read_path, write_path
from .score import Finding, Score, score
from .sheet import Cut, Sheet, cut
from .simulation import Pin, Scene, Simulation

__all__ = ["Constraints", "Cut", "CutError", "Finding", "InputError", "OutputError", "Parents", "Pin", "Refused",
           "RunError", "Scene", "Score", "Sheet", "Simulation", "StepError", "ablate", "bezier", "compare", "cut",
           "cut_families", "methods", "polyline", "rays", "read_path", "recommend", "records", "run", "score",
           "sheet_families", "write_path"]
