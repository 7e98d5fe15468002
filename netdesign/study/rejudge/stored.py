"""Reading of a stored net row, as judging it again needs it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from netdesign.envelope.parameters import PARAMETERS
from netdesign.outcome import Outcome
from netdesign.structure.members import Member, NetPart
from netdesign.study.case_records import CaseRecord, ExtremeRecord
from netdesign.study.records import RowStudy, Study
from netdesign.study.support_records import StaticsRecord
from netdesign.words.message import say

# Values of a row that follow, by the names of its fields.
Fields = Mapping[str, object]
Follow = Callable[[RowStudy, Study], Fields]
Spans = Mapping[str, tuple[float, float]]

RULES = "end.constant"  # names the rule of the row's end, not a value
# Forces that no case tells beside its others.
ALONE = (Member.POST_BASE, Member.POST_FOOT, NetPart.MESH)
# An anchor has the force of its guy.
GUY_OF: Mapping[str, Member] = {
    Member.UPHILL_ANCHOR: Member.UPHILL_GUY,
    Member.DOWNHILL_ANCHOR: Member.DOWNHILL_GUY,
}


def is_of_steady_states(study: Study) -> bool:
    """No history had a part in its forces, which need not be of one instant then."""
    return study.provenance.settings.get("method") == "steady"


def read_number(study: Study, setting: str) -> float:
    """Number of a setting; infinite, of which nothing follows, if it is none."""
    try:
        return float(study.provenance.settings.get(setting, math.inf))
    except ValueError:
        return math.inf


def read_spans(study: Study) -> Spans:
    """Ranges as they were understood, by the keys of a case."""
    spans = {}
    for quantity, parameter in PARAMETERS.items():
        if quantity == "slope_angle":
            continue  # of a row, and no range of a site
        name = say(f"column.quantities.{quantity}")
        ends = [
            echo.value
            for end in ("low", "high")
            for echo in study.range_inputs
            if echo.label == say(f"column.{end}_end", name=name)
        ]
        if len(ends) == 2 and all(isinstance(end, float) for end in ends):
            spans[parameter.key] = (float(ends[0]), float(ends[1]))
    return spans


def read_force(case: CaseRecord, member: str) -> float | None:
    """Force of a member in a case [kN]."""
    force: float | None = getattr(case, f"{member}_kN")
    return force


def list_solved(row: RowStudy) -> list[CaseRecord]:
    """Cases with numbers."""
    return [case for case in row.cases if case.outcome is Outcome.CONVERGED]


def find_largest(row: RowStudy, member: str) -> CaseRecord:
    """Case of a member's largest force; of equal ones the first point."""

    def rank(case: CaseRecord) -> tuple[float, ...]:
        return (-(read_force(case, member) or 0.0), *case.case.values.values())

    return min(list_solved(row), key=rank)


def find_drawn(row: RowStudy) -> CaseRecord | None:
    """Solved case that is drawn."""
    point = row.drawing.case if row.drawing else None
    return next((one for one in list_solved(row) if one.case == point), None)


def list_extremes(row: RowStudy) -> dict[str, ExtremeRecord]:
    """Largest forces by section and by panel."""
    by_panel = row.panel.extremes if row.panel else ()
    return {one.quantity: one for one in (*row.extremes, *by_panel)}


def measure_pull(state: StaticsRecord) -> float:
    """Larger pull of the net on one of its ends [kN/m]."""
    return max(
        math.hypot(state.foot_x_kN_per_m, state.foot_y_kN_per_m),
        math.hypot(state.head_x_kN_per_m, state.head_y_kN_per_m),
    )
