"""What decides each member of a net row: one value for matrix, schedule and pages.

It is shown in a line of text: its sign, numbers, and a bar to scale.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from netdesign.checks.check import Check
from netdesign.outcome import SEVERITY, Verdict
from netdesign.report.blocks import (
    SMALL,
    Badge,
    Cell,
    Content,
    Piece,
    Sketch,
    write_plain,
)
from netdesign.report.words import MISSING, Words, show_verdict
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
    """

    verdict: Verdict
    check: Check

    @property
    def used(self) -> float | None:
        """Utilisation of the check that is shown [-]."""
        return self.check.used

    @property
    def by_guideline(self) -> float | None:
        """Utilisation of that check by the guideline's load alone [-].

        None where that has no force on its member: it only raises the ropes' pulls.
        """
        check = self.check
        return check.utilisation_by_guideline if check.read("E_g") else None


def rate(checks: Sequence[Check]) -> Rated | None:
    """Verdict and deciding check of some checks; None without any."""
    if not checks:
        return None
    verdict = min((check.verdict for check in checks), key=SEVERITY.index)
    forces = [check for check in checks if check.is_of_force]
    own = [force for force in forces if not _is_of_head(force)]
    pool = [force for force in own if force.verdict is verdict]
    if verdict is Verdict.DECLARED:
        pool = [force for force in forces if force.used is not None] or pool
    shown = max(pool or own or forces or checks, key=_rank)
    return Rated(verdict=verdict, check=shown)


def _rank(check: Check) -> tuple[bool, float, float]:
    """A check without a utilisation before all others: its force alone is known."""
    is_alone = check.used is None and not _is_of_head(check)
    return is_alone, check.used or 0.0, check.demand_kN or 0.0


def _is_of_head(check: Check) -> bool:
    """Only what the head takes is not known: the anchor's own resistances are."""
    return check.mode == "direction" and check.used is None


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


def show_need(check: Check, words: Words) -> str:
    """``needs R_k ≥ 231 kN``; "" of a check that nothing of that kind turns."""
    needed = check.needed_kN
    if needed is None or check.verdict in (Verdict.PASS, Verdict.DECLARED):
        return ""
    return words("rated.needs", least=words.show_minimum(needed))


_ONE, _END = 13.0, 17.0  # place of utilisation 1, and of the end of a bar
_HAS_ROOM = 10.0  # utilisation from which no second number stands beside it


def sign(verdict: Verdict, words: Words) -> Badge:
    """Symbol of a verdict; its word is for readers aloud."""
    return Badge(show_verdict(verdict, words), "sign")


def show_rated(rated: Rated | None, words: Words, *, has_guide: bool = True) -> Content:
    """Sign, utilisation, that of the guideline, and a bar; else the force alone.

    A force that was calculated is shown where no resistance is known. ``has_guide``
    is false where another column has the number of the guideline.
    """
    if rated is None:
        return (Piece(MISSING, "dash"),)
    first = sign(rated.verdict, words)
    if rated.used is not None:
        shown = Piece(show_used(rated.check, rated.used, words), "ratio")
        bar = draw_bar(rated.used, rated.by_guideline, is_failed=_fails(rated))
        guide = ""
        if rated.by_guideline is not None and has_guide and rated.used < _HAS_ROOM:
            guide = words.show_number("utilisation", rated.by_guideline)
        return (first, shown, Piece(f" {guide}", "beside"), bar)
    demand = rated.check.demand_kN
    if demand is None:
        return (first, Piece(words(f"verdict.{rated.verdict}").lower(), "beside"))
    force = words.show_with_unit("demand_kN", demand)
    if rated.verdict is Verdict.DECLARED:
        return (first, Piece(force, "ratio"))
    lack = Piece(words("rated.no_resistance"), SMALL, has_symbols=True)
    return (first, Piece(force, "ratio"), lack)


def show_used(check: Check, used: float, words: Words) -> str:
    """Utilisation; one far beyond 1 by what is assumed with that at the best ends."""
    if not is_span(check):
        return words.show_number("utilisation", used)
    at_best = words.show_number("utilisation", check.eased_low)
    return f"{at_best}–{words.show_fixed(used, 0)}"


def is_span(check: Check) -> bool:
    """A utilisation is shown from that at the best ends of what is assumed on."""
    return bool(check.eased_low) and _HAS_ROOM <= (check.used or 0.0) < math.inf


def show_answer(rated: Rated, words: Words, *, has_guide: bool = True) -> Content:
    """The same beside its force: without a resistance, what it needs."""
    if rated.used is not None:
        return show_rated(rated, words, has_guide=has_guide)
    told = show_need(rated.check, words) or words(f"verdict.{rated.verdict}").lower()
    return (sign(rated.verdict, words), Piece(told, has_symbols=True))


def used_cell(rated: Rated | None, words: Words, content: Content = ()) -> Cell:
    """Utilisation as a number with the sign of its verdict; else its content alone."""
    content = content or show_rated(rated, words)
    text = write_plain(content)
    if rated is None or rated.used is None or not math.isfinite(rated.used):
        return Cell(text=text, content=content)
    shown = words.show_number("utilisation", rated.used)
    return Cell(text=shown, number=rated.used, content=content, verdict=rated.verdict)


def _fails(rated: Rated) -> bool:
    return rated.verdict is Verdict.FAIL


def draw_bar(
    used: float, by_guideline: float | None = None, *, is_failed: bool = False
) -> Sketch:
    """Utilisation to scale: an upright at 1, a triangle at that by the guideline.

    A bar that would run out of its room is cut.
    """
    end = min(used * _ONE, _END)
    look = "bar failed" if is_failed else "bar"
    parts = [
        f'<svg class="{look}" viewBox="0 0 17 2.6" aria-hidden="true">',
        f'<path class="rail" d="M0 .9H{_ONE:g}"/>',
        f'<path class="fill" d="M0 .4H{end:.2f}v1H0z"/>',
    ]
    if used * _ONE > _END:
        parts.append('<path class="cut" d="M15 1.8l.6-1.8M15.8 1.8l.6-1.8"/>')
    parts.append(f'<path class="one" d="M{_ONE:g} 0v1.8"/>')
    if by_guideline is not None:
        place = min(by_guideline * _ONE, _END - 0.7)
        parts.append(f'<path class="guide" d="M{place:.2f} 1.4l-.7 1.2h1.4z"/>')
    return Sketch("".join((*parts, "</svg>")))
