"""Tables of a study for Python: pandas is loaded where one is asked for.

Columns have their unit at the end of their name, as those of files have; ratios have
none. Texts are English.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape
from typing import TYPE_CHECKING

from netdesign.checks.check import Check
from netdesign.outcome import SEVERITY
from netdesign.study.scopes import SCOPES, Scope, list_of_scope
from netdesign.words.catalogue import render
from netdesign.words.message import say

if TYPE_CHECKING:
    from pandas import DataFrame

    from netdesign.study.records import RowStudy, Study

_ANCHORS = (
    *("row", "anchor", "position", "E_k_kN", "E_d_kN", "R_d_kN"),
    *("utilisation", "verdict", "assumed", "missing"),
)
_CHECKS = (
    *("row", "member", "mode", "position", "type", "verdict", "utilisation"),
    *("utilisation_low", "utilisation_high", "demand_kN", "resistance_kN"),
)
_OPEN = ("row", "kind", "text", "needs_kN")
_FORCES = (
    *("row", "force", "low_kN", "value_kN", "high_kN", "bound_kN"),
    *("density_kg_m3", "friction_deg", "inclination_deg"),
)


def list_anchors(study: Study) -> DataFrame:
    """Check that decides each anchor of each net row, by its position along the row."""
    return _build(_ANCHORS, [line for row in study.rows for line in _of_row(row)])


def list_checks(study: Study) -> DataFrame:
    """Checks of all net rows, one line each."""
    lines = [
        (
            *(row.id, check.member, check.mode, check.position, check.resistance_type),
            *(check.verdict.value, check.utilisation, *check.utilisation_band),
            *(check.demand_kN, check.resistance_kN),
        )
        for row in study.rows
        for check in row.checks
    ]
    return _build(_CHECKS, lines)


def list_open(study: Study) -> DataFrame:
    """Reasons why checks are not proven, each once in a net row."""
    lines = [
        (row.id, point.kind.value, render(point.text, "en"), point.needs_kN)
        for row in study.rows
        for point in row.open
    ]
    return _build(_OPEN, lines)


def list_forces(study: Study) -> DataFrame:
    """Largest forces of each net row, characteristic, and the case of each."""
    lines = [
        (
            *(row.id, force.quantity, force.low_kN, force.value_kN, force.high_kN),
            *(force.bound_kN, force.case.density_kg_m3, force.case.friction_deg),
            force.case.inclination_deg,
        )
        for row in study.rows
        for force in row.forces
    ]
    return _build(_FORCES, lines)


def _build(columns: Sequence[str], lines: Sequence[Sequence[object]]) -> DataFrame:
    from pandas import DataFrame

    records = [dict(zip(columns, line, strict=True)) for line in lines]
    return DataFrame(records, columns=list(columns))


def _of_row(row: RowStudy) -> Iterator[tuple[object, ...]]:
    groups: dict[tuple[str, str], list[Check]] = {}
    for check in list_of_scope(row.checks, Scope.ANCHORS):
        if check.is_of_force:
            groups.setdefault((check.member, check.position), []).append(check)
    assumed = ", ".join(render(assumed.input, "en") for assumed in row.assumed)
    for (member, position), checks in groups.items():
        check = min(checks, key=_rank)
        missing = dict.fromkeys(str(x.message) for check in checks for x in check.open)
        yield (
            *(row.id, member, position, check.read("E_k"), check.demand_kN),
            *(check.resistance_kN, check.used, check.verdict.value),
            *(assumed, "; ".join(missing)),
        )


def _rank(check: Check) -> tuple[int, bool, float]:
    """The worst verdict first; in it a check without a resistance, then by use."""
    used = check.used
    return SEVERITY.index(check.verdict), used is not None, -(used or 0.0)


def write_repr(study: Study) -> str:
    """``<Study Gratboden: 8 rows, FAIL, swiss-guideline-2007>``."""
    what_if = ", what-if" if study.what_if else ""
    verdict = study.verdict.value
    rows = f"{len(study.rows)} rows"
    name = study.project.name
    return f"<Study {name!r:.60}: {rows}, {verdict}{what_if}, {study.profile.id}>"


def write_html(study: Study) -> str:
    """Verdict of each scope of each net row as a table; every text is escaped."""
    heads = ("row", "verdict", *(str(scope.value) for scope in SCOPES))
    table = _build(heads, [tuple(_list_texts(row)) for row in study.rows])
    return f"<p>{escape(write_repr(study)[1:-1])}</p>{table.to_html(index=False)}"


def _list_texts(row: RowStudy) -> Iterator[str]:
    yield row.id
    yield str(say(f"verdict.{row.verdict.value}"))
    for scope in row.scopes.values():
        used = "" if scope.utilisation is None else f" {scope.utilisation:.2f}"
        yield f"{say(f'verdict.{scope.verdict.value}')}{used}"
