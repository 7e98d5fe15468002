"""Parts of the interval of a utilisation, each with its source."""

from __future__ import annotations

from collections.abc import Iterable

from netdesign.envelope.extremes import Extreme
from netdesign.site.model import NetRow
from netdesign.snow.creep_law import CREEP_LAWS
from netdesign.study.case_solver import CaseSolver
from netdesign.study.judgement import MemberCheck
from netdesign.study.records import SpreadRecord
from netdesign.study.row_to_check import RowToCheck
from netdesign.words.message import Message, say
from netdesign.words.names import name


def list_spreads(
    task: RowToCheck, one: MemberCheck, extreme: Extreme
) -> list[SpreadRecord]:
    """Parts of the interval of a utilisation, the creep law's for comparison.

    A floor cuts off what lies below it. What the ropes load has none, and is not
    compared: it is in proportion to the rope's force.
    """
    force, use = one.force, one.use
    if force is None or use is None or not one.result.find_value("μ"):
        return []
    is_by_panel = force.is_by_panel

    def rate(solved: float) -> float:
        return use * force.find_high(solved / 1e3, is_by_panel=is_by_panel)

    largest = 1e3 * force.largest.high_kN
    scale = rate(largest) / largest if largest else use * force.share / 1e3
    unknown = tuple(name("axis", axis) for axis in extreme.unknown)
    is_floor = force.governs == "guideline"
    spreads = _split(
        one,
        rate(extreme.force.high),
        say("spread.floor_governs") if is_floor else None,
        say("spread.unknown_along", axes=unknown) if unknown else None,
    )
    if one.is_of_end:
        return spreads
    if task.solver is not None and extreme.force.value > 0.0:
        spreads += _list_creep_laws(task.solver, task.basis.row, extreme, scale)
    return spreads


def _split(
    one: MemberCheck, at_cases: float, *notes: Message | None
) -> list[SpreadRecord]:
    """Interval of a utilisation: numerical error, and what may hide between the cases.

    ``at_cases`` is its upper end at the solved cases.
    """
    used = one.result.find("μ")
    if used is None or used.value is None or used.low is None or used.high is None:
        return []
    numerical = max(used.value, at_cases)
    of_numbers, between = notes
    return [
        SpreadRecord(
            source=say("spread.numerical_error"),
            low=used.low,
            high=numerical,
            in_verdict=True,
            note=of_numbers,
        ),
        SpreadRecord(
            source=say("spread.between_cases"),
            low=used.value,
            high=used.value + used.high - numerical,
            in_verdict=True,
            note=between,
        ),
    ]


def _list_creep_laws(
    solver: CaseSolver, row: NetRow, extreme: Extreme, scale: float
) -> Iterable[SpreadRecord]:
    laws = {k: law for k, law in CREEP_LAWS.items() if k != solver.law.name}
    results = solver.solve_all(
        [(row, extreme.governing.case, law) for law in laws.values()]
    )
    for law, result in zip(laws, results, strict=True):
        force = result.member_forces.get(extreme.member)
        yield SpreadRecord(
            source=say("spread.creep_law", law=law),
            low=force.low * scale if force else None,
            high=force.high * scale if force else None,
            in_verdict=False,
            note=say("spread.in_governing_case") if force else result.reason,
        )
