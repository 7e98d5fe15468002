"""Parts of the interval of a utilisation, each with its source."""

from __future__ import annotations

from collections.abc import Iterable

from netdesign.checks import CheckResult
from netdesign.envelope.extremes import Extreme
from netdesign.site.model import NetRow
from netdesign.snow.creep_law import CREEP_LAWS
from netdesign.study.member_check import MemberCheck, RowCheck
from netdesign.study.probe import Probe
from netdesign.study.records import (
    SpreadRecord,
)
from netdesign.words.message import Message, say
from netdesign.words.names import name


def list_spreads(
    task: RowCheck, one: MemberCheck, extreme: Extreme
) -> list[SpreadRecord]:
    """Parts of the interval of a utilisation, the creep law's for comparison.

    A floor cuts off what lies below it.
    """
    used, scale = one.result.utilisation, _find_scale(one)
    if used is None or scale is None or used.value == 0.0:
        return []
    unknown = tuple(name("axis", axis) for axis in extreme.unknown)
    numerical = max(used.value, _use_at_cases(one, extreme))
    spreads = [
        SpreadRecord(
            source=say("spread.numerical_error"),
            low=used.low,
            high=numerical,
            in_verdict=True,
            note=_note_floor(one),
        ),
        SpreadRecord(
            source=say("spread.between_cases"),
            low=used.value,
            high=used.value + used.high - numerical,
            in_verdict=True,
            note=say("spread.unknown_along", axes=unknown) if unknown else None,
        ),
    ]
    if task.probe is not None and extreme.force.value > 0.0:
        spreads += _list_creep_laws(task.probe, task.row, extreme, scale)
    return spreads


def list_end_spreads(result: CheckResult, extreme: Extreme) -> list[SpreadRecord]:
    """Parts of the interval of an end member, in proportion to its rope's force."""
    used, largest = result.utilisation, extreme.widened.high
    if used is None or used.value == 0.0:
        return []
    numerical = max(used.value, used.high * extreme.force.high / largest)
    return [
        SpreadRecord(
            source=say("spread.numerical_error"),
            low=used.low,
            high=numerical,
            in_verdict=True,
        ),
        SpreadRecord(
            source=say("spread.between_cases"),
            low=used.value,
            high=used.value + used.high - numerical,
            in_verdict=True,
        ),
    ]


def _use_at_cases(one: MemberCheck, extreme: Extreme) -> float:
    """Utilisation by the coupled force without what may hide between the cases [-]."""
    use, demand = one.use, one.demand
    if demand is None or use is None:
        return 0.0
    along = demand.along.high / demand.on_support if one.is_by_panel else 0.0
    return use * (demand.load.apply(extreme.force).high + along)


def _find_scale(one: MemberCheck) -> float | None:
    """Utilisation for each N of the solved force [1/N]; None without a resistance.

    What the load along the row adds counts in proportion.
    """
    use, demand = one.use, one.demand
    if demand is None or use is None:
        return None
    largest = demand.largest
    if largest.high == 0.0:
        return use * demand.load.share
    along = demand.along.high / demand.on_support if one.is_by_panel else 0.0
    return use * (demand.load.apply(largest).high + along) / largest.high


def _note_floor(one: MemberCheck) -> Message | None:
    is_floor = one.demand is not None and one.demand.governs == "guideline"
    return say("spread.floor_governs") if is_floor else None


def _list_creep_laws(
    probe: Probe, row: NetRow, extreme: Extreme, scale: float
) -> Iterable[SpreadRecord]:
    laws = {k: law for k, law in CREEP_LAWS.items() if k != probe.law.name}
    results = probe.solve_all(
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
