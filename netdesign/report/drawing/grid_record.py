"""Cases of a grid in the form of a searched envelope: one drawing serves both."""

from __future__ import annotations

import math
from collections.abc import Iterator

from netdesign.outcome import Outcome
from netdesign.study.case_records import (
    BoundRecord,
    CasePoint,
    EnvelopeRecord,
    ExtremeRecord,
    MapRecord,
)
from netdesign.study.records import RowStudy

_MOST_MAPS = 3  # side by side
_MAPPED = 3  # first quantities of a case: density, friction, inclination


def record_grid(row: RowStudy) -> EnvelopeRecord:
    """Maps of every member over the cases of a row; nothing bounds the force between.

    The force of a case without a result is NaN.
    """
    return EnvelopeRecord(
        axes=[],
        is_per_metre=False,
        is_closed=False,
        gap_asked_percent=0.0,
        certainty=0.0,
        resolved_share=0.0,
        cases=len(row.cases),
        skipped=0,
        skips_tested=0,
        failed=sum(one.outcome is not Outcome.CONVERGED for one in row.cases),
        bounds=[_record_member(row, one) for one in row.extremes],
        log=[],
    )


def _record_member(row: RowStudy, extreme: ExtremeRecord) -> BoundRecord:
    return BoundRecord(
        quantity=extreme.quantity,
        max_kN=extreme.max_kN,
        upper_bound_kN=extreme.max_kN,
        case=extreme.case.values,
        coincident_kN=extreme.coincident_kN,
        unexplained=None,
        drivers=[],
        flips=[],
        lines=[],
        maps=list(_list_maps(row, extreme)),
        confirmation=None,
    )


def _list_maps(row: RowStudy, extreme: ExtremeRecord) -> Iterator[MapRecord]:
    """Maps of some inclinations, with the governing one; others as in that case."""
    forces = {
        (one.case.inclination_deg, one.case.friction_deg, one.case.density_kg_m3): (
            getattr(one, f"{extreme.quantity}_kN")
        )
        for one in row.cases
        if _list_further(one.case) == _list_further(extreme.case)
    }
    if not forces:
        return
    axes = zip(*forces, strict=True)
    angles, frictions, densities = (sorted(set(axis)) for axis in axes)
    if len(angles) > _MOST_MAPS:
        angles = sorted({angles[0], extreme.case.inclination_deg, angles[-1]})
    for angle in angles:
        table = [[forces.get((angle, f, d)) for d in densities] for f in frictions]
        yield MapRecord(
            inclination_deg=angle,
            density_kg_m3=densities,
            friction_deg=frictions,
            force_kN=[[math.nan if x is None else x for x in line] for line in table],
        )


def _list_further(case: CasePoint) -> list[tuple[str, float]]:
    return [*case.values.items()][_MAPPED:]
