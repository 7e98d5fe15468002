"""Gap between the cases of a grid, from the curvature of the forces."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from netdesign.envelope.extremes import Extreme
from netdesign.envelope.ranges import Case
from netdesign.envelope.run import CaseResult

AXES = ("density", "friction_angle", "inclination")


@dataclass(frozen=True, slots=True, kw_only=True)
class EnvelopeGap:
    """How much larger a force may be between the cases than at them.

    Attributes
    ----------
    size : float
        Sum over the axes [N]; an estimate for smooth forces, not a bound.
    unknown : tuple of str
        Axes with two samples only, or with a failed neighbour: nothing is known.
    """

    size: float
    unknown: tuple[str, ...]


def estimate_gap(extreme: Extreme, results: Sequence[CaseResult]) -> EnvelopeGap:
    """Largest rise of a parabola over its samples, added up along the axes.

    Through three neighbouring samples with second difference D a parabola rises at
    most |D| / 8 above the larger of two neighbours.

    Parameters
    ----------
    extreme : Extreme
        Largest force of one member.
    results : sequence of CaseResult
        All cases of the grid.

    Returns
    -------
    EnvelopeGap
        At the governing case.
    """
    forces = {
        result.case: result.member_forces[extreme.member].value
        for result in results
        if result.is_converged
    }
    cases = [result.case for result in results]
    size, unknown = 0.0, []
    for axis in AXES:
        samples = sorted({getattr(case, axis) for case in cases})
        if len(samples) == 1:
            continue
        difference = _second_difference(extreme.governing.case, axis, samples, forces)
        if difference is None:
            unknown.append(axis)
        else:
            size += abs(difference) / 8.0
    return EnvelopeGap(size=size, unknown=tuple(unknown))


def _second_difference(
    case: Case, axis: str, samples: Sequence[float], forces: Mapping[Case, float]
) -> float | None:
    """Second difference of the force beside a case along an axis, or None."""
    if len(samples) < 3:
        return None
    place = samples.index(getattr(case, axis))
    middle = min(max(place, 1), len(samples) - 2)
    values = [
        forces.get(replace(case, **{axis: samples[middle + step]}))  # type: ignore[arg-type]
        for step in (-1, 0, 1)
    ]
    before, at, after = values
    if before is None or at is None or after is None:
        return None
    return before - 2.0 * at + after
