"""Scopes of the checks of a net row, each with its verdict, and the governing check.

The anchors stand in the office's ground, a maker sells the structure, the siting is
where the row stands. Every check belongs to one scope; what bears on all belongs to
each.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import ClassVar

from netdesign.checks.check import Check
from netdesign.outcome import SEVERITY, Verdict, merge_verdicts
from netdesign.site.assumed import Assumed
from netdesign.structure.members import (
    EndMember,
    Member,
    NetPart,
)
from netdesign.words.message import Message, Text


@dataclass(frozen=True, kw_only=True)
class AssumedRecord:
    """What a net row leaves empty, and what it was searched over in its place."""

    input: Text
    text: Text  # range, value or word
    low: float | None  # in its unit; None of a word
    high: float | None
    unit: str
    source: Text


def record_assumed(assumed: Assumed) -> AssumedRecord:
    """Assumed range of a row as a study has it."""
    low, high = (None, None) if assumed.word else assumed.shown
    return AssumedRecord(
        input=assumed.name,
        text=assumed.text,
        low=low,
        high=high,
        unit=assumed.unit,
        source=assumed.why,
    )


class Scope(StrEnum):
    """What is asked of a net row."""

    ANCHORS = "anchors"
    STRUCTURE = "structure"
    SITING = "siting"


Scopes = frozenset[Scope]
SCOPES = tuple(Scope)
_ANCHORS, _STRUCTURE, _SITING = (frozenset((scope,)) for scope in SCOPES)
_FORCES, _ALL = _ANCHORS | _STRUCTURE, frozenset(SCOPES)

# In the place of a member: all that a net is built of above the ground.
STRUCTURE = Scope.STRUCTURE.value
BY_APPROVAL = f"{STRUCTURE}.approval"  # id of the check that an approval proves
# Scope of a check: by its id, else by its mode, else by its member.
_BY_ID: Mapping[str, Scopes] = {
    "geometry.anchors": _ANCHORS,
    "geometry.cover": _ANCHORS,
    "geometry.ends": _FORCES,
    "profile.named": _ALL,
}
_BY_MODE: Mapping[str, Scopes] = {"connection": _STRUCTURE}
_BY_MEMBER: Mapping[str, Scopes] = {
    Member.NET: _SITING,
    **dict.fromkeys(
        (Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR, Member.DOWNHILL_ANCHOR), _ANCHORS
    ),
    **dict.fromkeys((EndMember.LATERAL_ANCHOR, EndMember.END_GUY_ANCHOR), _ANCHORS),
    **dict.fromkeys((Member.UPHILL_GUY, Member.DOWNHILL_GUY), _STRUCTURE),
    **dict.fromkeys((Member.POST, Member.POST_BASE, Member.POST_FOOT), _STRUCTURE),
    **dict.fromkeys((EndMember.END_GUY, *NetPart, STRUCTURE), _STRUCTURE),
}
# Sheets and columns of numbers of which no force depends.
_ASKED_OF: Mapping[str, Scopes] = {
    "column.anchor_types.": _ANCHORS,
    "column.tests.": _ANCHORS,
    "column.links.": _STRUCTURE,
    "column.net_types.mesh_strength": _STRUCTURE,
    "column.posts.bearing": _STRUCTURE,
}
CLOSE = 0.9  # utilisation from which a passing check gets its limits
_PLAUSIBLE = "inputs.plausible"  # id of the check of numbers that can hardly be meant


def find_scopes(check: Check) -> Scopes:
    """Scopes that a check belongs to: one, or all that it bears on.

    A check of an unknown member, as in an altered study, belongs to all scopes.
    """
    if check.id == _PLAUSIBLE:
        asked = (_find_asked(point.message) for point in check.open)
        return frozenset().union(*asked)
    scopes = _BY_ID.get(check.id) or _BY_MODE.get(check.mode)
    return scopes or _BY_MEMBER.get(check.member, _ALL)


def is_of_structure(check: Check) -> bool:
    """A check of the structure alone, and no question about a number of it."""
    return check.id != _PLAUSIBLE and find_scopes(check) == _STRUCTURE


def _find_asked(question: Message) -> Scopes:
    """Scopes that the number of a question bears on; all that is not listed."""
    field = question.arguments.get("field")
    key = field.key if isinstance(field, Message) else ""
    scopes = (of for begin, of in _ASKED_OF.items() if key.startswith(begin))
    return next(scopes, _ALL)


def list_of_scope(checks: Iterable[Check], scope: Scope) -> list[Check]:
    """Checks of one scope, in their order."""
    return [check for check in checks if scope in find_scopes(check)]


@dataclass(frozen=True, kw_only=True)
class ScopeRecord:
    """Verdict of one scope, of a row or of all rows.

    Attributes
    ----------
    verdict : Verdict
        Of its own checks alone.
    utilisation : float or None
        Of the governing check [-]; None where it has none.
    governing : str
        Id of the check that decides; "" without any.
    assumed : int
        Number of values that are not given, and over which the row was searched.
    row : str or None
        Net row of the governing check; None in the record of a row.
    """

    LEAVES_OUT_NONE: ClassVar[tuple[str, ...]] = ("row",)

    verdict: Verdict
    utilisation: float | None
    governing: str
    assumed: int = 0
    row: str | None = None

    @property
    def rank(self) -> tuple[int, float]:
        """Place in an order: worst verdict first, then the largest utilisation."""
        return SEVERITY.index(self.verdict), -(self.utilisation or -1.0)


def sum_up_study(
    rows: Mapping[str, Mapping[Scope, ScopeRecord]], *, is_part: bool = False
) -> dict[Scope, ScopeRecord]:
    """Verdict of each scope of all rows, by their ids, with the row that decides.

    Of a part of a site nothing is proven, and no row decides that.
    """
    summed = {}
    for scope in SCOPES:
        of_rows = {row: scopes[scope] for row, scopes in rows.items()}
        more = [Verdict.NOT_PROVEN] if is_part else []
        worst = min(of_rows, key=lambda row: (of_rows[row].rank, row), default="")
        verdict = merge_verdicts(
            [*(record.verdict for record in of_rows.values()), *more]
        )
        decides = not worst or of_rows[worst].verdict is verdict
        summed[scope] = ScopeRecord(
            verdict=verdict,
            utilisation=of_rows[worst].utilisation if worst else None,
            governing=of_rows[worst].governing if worst else "",
            assumed=max((record.assumed for record in of_rows.values()), default=0),
            row=worst if decides else None,
        )
    return summed


def merge_scopes(
    records: Mapping[Scope, ScopeRecord], asked: Collection[str] = ()
) -> Verdict:
    """Worst verdict of the scopes that are asked for; of all where none is named."""
    return merge_verdicts(
        record.verdict
        for scope, record in records.items()
        if not asked or scope in asked
    )


def sum_up_row(
    checks: Sequence[Check], *, assumed: int = 0
) -> dict[Scope, ScopeRecord]:
    """Verdict of each scope of a row.

    ``assumed`` counts the values that its forces were searched over.
    """
    return {
        scope: _sum_up(
            list_of_scope(checks, scope),
            assumed if scope in _FORCES else 0,
        )
        for scope in SCOPES
    }


def _sum_up(checks: Sequence[Check], assumed: int) -> ScopeRecord:
    governing = find_governing(checks)
    is_by_approval = governing is not None and governing.id == BY_APPROVAL
    return ScopeRecord(
        verdict=merge_verdicts(check.verdict for check in checks),
        utilisation=governing.utilisation if governing else None,
        governing=governing.id if governing else "",
        assumed=0 if is_by_approval else assumed,
    )


def find_governing(checks: Sequence[Check]) -> Check | None:
    """Check that decides the verdict: the worst verdict, then the largest ratio."""
    return min(checks, key=lambda check: check.rank, default=None)


def find_highest(checks: Iterable[Check]) -> Check | None:
    """Check with the largest utilisation, of those that have one."""
    rated = [check for check in checks if check.used is not None]
    return max(rated, key=lambda check: check.used or 0.0, default=None)


def find_worst(checks: Iterable[Check]) -> Check | None:
    """Check of the largest utilisation by a solved case; None without any."""
    return find_highest(check for check in checks if check.case)


def is_far_from_limit(check: Check) -> bool:
    """True of a check that passes, and is told no change that would turn it."""
    _, used = check.utilisation_band
    return check.verdict is Verdict.PASS and (used is None or used < CLOSE)
