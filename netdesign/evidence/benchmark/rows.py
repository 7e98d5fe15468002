"""One line of the benchmark's result."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Path = Literal["fast", "reference", "plain"]
Method = Literal["steady", "transient"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """One method on one mesh.

    Attributes
    ----------
    scene, method : str
        What was solved, and how.
    path : str
        ``fast`` kernel; its meshes solved in scikit-fem (``reference``); scikit-fem on
        even meshes, without grading, each from the start (``plain``).
    elements, degrees_of_freedom : int
        Of the finer mesh.
    wall_s : float
        Shortest of the repeated timings: what else runs can only lengthen one [s].
    error : float
        Worse of the end pulls, relative, against a mesh twice as fine as the
        finest that is measured [-].
    stated_error : float
        What the solution itself says [-].
    linear_solves, rounds : int
        Of both meshes.
    peak_mb : float
        Most memory that Python and NumPy held at once, beyond what they held before;
        SciPy's sparse factors are not seen [MB].
    """

    scene: str
    method: Method
    path: Path
    elements: int
    degrees_of_freedom: int
    wall_s: float
    error: float
    stated_error: float
    linear_solves: int
    rounds: int
    peak_mb: float
