"""What decides each member of a net row: one value for matrix, schedule and pages."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from netdesign.checks.check import Check
from netdesign.outcome import SEVERITY, Verdict
from netdesign.report.words import Words
from netdesign.structure.members import EndMember, Member, NetPart
from netdesign.study.records import RowStudy
from netdesign.study.scopes import (
    STRUCTURE,
    Scope,
    find_governing,
    find_highest,
    list_of_scope,
)

# Anchors by the columns of the first page.
ANCHORS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "foot": (Member.FOOT_ANCHOR,),
        "uphill": (Member.UPHILL_ANCHOR,),
        "downhill": (Member.DOWNHILL_ANCHOR,),
        "end": (EndMember.LATERAL_ANCHOR, EndMember.END_GUY_ANCHOR),
    }
)
ANCHOR_MEMBERS = tuple(member for group in ANCHORS.values() for member in group)
PARTS: tuple[str, ...] = (
    *(Member.UPHILL_GUY, Member.DOWNHILL_GUY),
    *(Member.POST, Member.POST_BASE, Member.POST_FOOT),
    *NetPart,
    EndMember.END_GUY,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Rated:
    """Checks of one member or group, and the one of them that is shown.

    Attributes
    ----------
    verdict : Verdict
        The worst of the checks.
    check : Check
        That decides; where a document decides, the most used one of the others.
    by_guideline : float or None
        Largest utilisation by the guideline's load alone [-].
    """

    verdict: Verdict
    check: Check
    by_guideline: float | None

    @property
    def used(self) -> float | None:
        """Utilisation of the check that is shown [-]."""
        return self.check.used


def rate(checks: Sequence[Check]) -> Rated | None:
    """Verdict and deciding check of some checks; None without any."""
    if not checks:
        return None
    verdict = min((check.verdict for check in checks), key=SEVERITY.index)
    forces = [check for check in checks if check.is_of_force]
    pool = [force for force in forces if force.verdict is verdict]
    if verdict is Verdict.DECLARED:
        pool = [force for force in forces if force.used is not None] or pool
    shown = max(pool or forces or checks, key=_rank)
    by_guideline = [force.utilisation_by_guideline for force in forces]
    return Rated(
        verdict=verdict,
        check=shown,
        by_guideline=max((x for x in by_guideline if x is not None), default=None),
    )


def _rank(check: Check) -> tuple[bool, float, float]:
    """A check without a utilisation before all others: its force alone is known.

    Not that of a direction: the anchor's own resistances are known beside it.
    """
    is_alone = check.used is None and check.mode != "direction"
    return is_alone, check.used or 0.0, check.demand_kN or 0.0


def list_anchor(row: RowStudy, members: Sequence[str]) -> list[Check]:
    """Checks of some anchors and of their ground, without the links above them."""
    checks = list_of_scope(row.checks, Scope.ANCHORS)
    return [check for check in checks if check.member in members]


def list_part(row: RowStudy, members: Sequence[str]) -> list[Check]:
    """Checks of some parts of the structure; of anchors those of their links."""
    checks = list_of_scope(row.checks, Scope.STRUCTURE)
    return [check for check in checks if check.member in members]


def find_structure(row: RowStudy) -> Check | None:
    """Line that stands for the structure: an approval, or that nothing is given."""
    return next((check for check in row.checks if check.member == STRUCTURE), None)


def rate_scope(row: RowStudy, scope: Scope) -> Rated | None:
    """Verdict and deciding check of a scope."""
    return rate(list_of_scope(row.checks, scope))


def find_demand(checks: Sequence[Check]) -> float | None:
    """Largest design force of some checks, wherever along the row [kN].

    That across a base which slides is another force.
    """
    forces = (x.demand_kN for x in checks if x.is_of_force and x.mode != "sliding")
    return max((force for force in forces if force is not None), default=None)


def find_deciding(row: RowStudy) -> Check | None:
    """Check that decides a row: without a resistance, that of the largest force."""
    whole = find_structure(row)
    if whole is not None and whole.verdict is row.verdict is Verdict.DECLARED:
        return whole
    forces = [check for check in row.checks if check.is_of_force]
    pool = [force for force in forces if force.verdict is row.verdict]
    return max(pool, key=_rank) if pool else find_governing(row.checks)


def find_shown(row: RowStudy) -> Check | None:
    """Check that is named beside a row: the deciding one, else the most used."""
    if row.verdict is Verdict.DECLARED:
        return find_worked(row)
    return find_deciding(row)


def find_worked(row: RowStudy) -> Check | None:
    """Check of a force that is worked out: the deciding one, else the most used.

    What a document proves comes last: of such a row the anchors have the word.
    """
    deciding = find_deciding(row)
    is_whole = deciding is not None and deciding.is_of_force
    if is_whole and row.verdict is not Verdict.DECLARED:
        return deciding
    forces = [check for check in row.checks if check.is_of_force]
    own = [force for force in forces if force.verdict is not Verdict.DECLARED]
    return find_highest(own or forces)


def find_needed(check: Check) -> float | None:
    """Least characteristic resistance with which a check passes [kN]."""
    return next(
        (x.bound for x in check.changes if x.unit == "kN" and x.sense == "at least"),
        None,
    )


def show_need(check: Check, words: Words) -> str:
    """``needs R_k ≥ 231 kN``; "" of a check that nothing of that kind turns."""
    needed = find_needed(check)
    if needed is None or check.verdict in (Verdict.PASS, Verdict.DECLARED):
        return ""
    return words("rated.needs", least=words.show_minimum(needed))
