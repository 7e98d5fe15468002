"""Rows of run time against error, and the figures that sum them up."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median
from typing import Literal

from netdesign.evidence.runner import fit_order

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


@dataclass(frozen=True, slots=True, kw_only=True)
class Summary:
    """Figures over all scenes; None where there are too few rows.

    Attributes
    ----------
    times_faster : float or None
        Time of the plain path over that of the fast one on the same mesh, hence at
        equal error; median over all scenes and meshes [-].
    least_times_faster, most_times_faster : float or None
        Over the same.
    times_faster_at_error : float or None
        Time of scikit-fem on even meshes over that of the fast path at equal error;
        median over all scenes and even meshes [-].
    cost_order : float or None
        Median over the scenes of p in time ~ degrees of freedom^p, fast path [-].
    worst_cost_order : float or None
        Largest p of a scene [-].
    error_order : float or None
        Median over the scenes of q in error ~ degrees of freedom^-q/2 [-].
    """

    times_faster: float | None
    least_times_faster: float | None
    most_times_faster: float | None
    times_faster_at_error: float | None
    cost_order: float | None
    worst_cost_order: float | None
    error_order: float | None


def summarise(rows: Sequence[Row]) -> Summary:
    """Summary of the steady rows."""
    steady = [row for row in rows if row.method == "steady"]
    ratios = compare_paths(steady)
    at_error = compare_at_error(steady)
    by_scene: dict[str, list[Row]] = defaultdict(list)
    for row in steady:
        if row.path == "fast":
            by_scene[row.scene].append(row)
    fitted = [group for group in by_scene.values() if len(group) > 2]
    costs = [
        fit_order([r.degrees_of_freedom for r in group], [r.wall_s for r in group])
        for group in fitted
    ]
    orders = [
        -2.0 * fit_order([r.degrees_of_freedom for r in g], [r.error for r in g])
        for g in fitted
    ]
    return Summary(
        times_faster=median(ratios) if ratios else None,
        least_times_faster=min(ratios, default=None),
        most_times_faster=max(ratios, default=None),
        times_faster_at_error=median(at_error) if at_error else None,
        cost_order=median(costs) if costs else None,
        worst_cost_order=max(costs, default=None),
        error_order=median(orders) if orders else None,
    )


def compare_paths(rows: Sequence[Row]) -> list[float]:
    """Time of the plain path over that of the fast one, wherever both were measured.

    Both are on one mesh, so their errors are equal to the solvers' tolerances.
    """
    fast = {(r.scene, r.elements): r.wall_s for r in rows if r.path == "fast"}
    return [
        row.wall_s / fast[row.scene, row.elements]
        for row in rows
        if row.path == "reference" and (row.scene, row.elements) in fast
    ]


def compare_at_error(rows: Sequence[Row]) -> list[float]:
    """Time of each plain row over the least that the fast path takes for its error.

    The fast path counts with the cheapest of its meshes that is at least as accurate;
    plain rows more accurate than all of them are left out.
    """
    ratios = []
    for row in rows:
        if row.path != "plain":
            continue
        as_good = [
            fast.wall_s
            for fast in rows
            if fast.path == "fast"
            and fast.scene == row.scene
            and fast.error <= row.error
        ]
        if as_good:
            ratios.append(row.wall_s / min(as_good))
    return ratios
