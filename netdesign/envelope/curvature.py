"""Gap between the cases of a grid, from the curvature of the forces."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from netdesign.envelope.extremes import Extreme
from netdesign.envelope.ranges import Case
from netdesign.envelope.run import CaseResult


def estimate_hidden(extreme: Extreme, results: Sequence[CaseResult]) -> Extreme:
    """Extreme with the largest rise of a parabola over its samples.

    Through three neighbouring samples with second difference D a parabola rises at
    most |D| / 8 above the larger of two neighbours; the rises along the axes are added.
    With two samples only, or a failed neighbour, nothing is known along an axis.

    Parameters
    ----------
    extreme : Extreme
        Largest force of one member.
    results : sequence of CaseResult
        All cases of the grid.

    Returns
    -------
    Extreme
        With what may hide about its governing case.
    """
    forces = {
        result.case: result.member_forces[extreme.member].value
        for result in results
        if extreme.member in result.member_forces
    }
    cases = [result.case.values for result in results]
    size, unknown = 0.0, []
    for axis in extreme.governing.case.values:
        samples = sorted({values[axis] for values in cases})
        if len(samples) == 1:
            continue
        difference = _second_difference(extreme.governing.case, axis, samples, forces)
        if difference is None:
            unknown.append(axis)
        else:
            size += abs(difference) / 8.0
    return replace(extreme, hidden=size, unknown=tuple(unknown))


def _second_difference(
    case: Case, axis: str, samples: Sequence[float], forces: Mapping[Case, float]
) -> float | None:
    """Second difference of the force beside a case along an axis, or None."""
    if len(samples) < 3:
        return None
    place = samples.index(case.values[axis])
    middle = min(max(place, 1), len(samples) - 2)
    values = [
        forces.get(case.with_value(axis, samples[middle + step])) for step in (-1, 0, 1)
    ]
    before, at, after = values
    if before is None or at is None or after is None:
        return None
    return before - 2.0 * at + after
