"""Checks of a row as a reader takes them in: inside and at the end on one line."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from netdesign.outcome import Verdict
from netdesign.report.view.check_view import SEVERITY, CheckView, view_check
from netdesign.report.words import VerdictWords, Words, show_verdict
from netdesign.study.records import CheckRecord
from netdesign.words.message import Message
from netdesign.words.names import name_check
from netdesign.words.text_field import Text

_MOST_USED = 3  # lines of a row that its summary shows
_PLAIN = "check.passes"  # what the table's numbers and its caption say already

_Viewed = tuple[CheckRecord, CheckView]  # a check and itself in words


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckLine:
    """One resistance with its demand inside the row and at its end.

    A check that stands at one place only leaves the other None. ``remarks`` is what
    the head of the table does not say already.
    """

    title: str
    source: str
    resistance: str
    inside: CheckView | None
    end: CheckView | None
    verdict: VerdictWords  # the worse of both
    is_met: bool
    most_used: float  # larger utilisation of both; 0 where none is known
    remarks: tuple[str, ...]


def list_lines(
    checks: Sequence[CheckRecord],
    words: Words,
    views: Sequence[CheckView] = (),
) -> tuple[CheckLine, ...]:
    """Checks of forces, in their order; those of one resistance share a line.

    ``views`` are the same checks in words, if they are known.
    """
    known = views or [view_check(check, words) for check in checks]
    places: dict[tuple[object, ...], list[_Viewed]] = {}
    for check, view in zip(checks, known, strict=True):
        if check.is_of_force:
            places.setdefault(_name_resistance(check), []).append((check, view))
    return tuple(
        _build_line(group, words)
        for together in places.values()
        for group in _split(together)
    )


def choose_lines(lines: Sequence[CheckLine]) -> tuple[CheckLine, ...]:
    """Those that do not pass, and the most used of the others, in their order."""
    used = sorted((line.most_used for line in lines), reverse=True)
    least = used[min(_MOST_USED, len(used)) - 1] if used else 0.0
    return tuple(line for line in lines if not line.is_met or line.most_used >= least)


def list_requirements(
    checks: Sequence[CheckRecord],
    words: Words,
    views: Sequence[CheckView] = (),
) -> tuple[CheckView, ...]:
    """Checks without a force: of geometry and directions, and those not solved."""
    known = views or [view_check(check, words) for check in checks]
    pairs = zip(checks, known, strict=True)
    return tuple(view for check, view in pairs if not check.is_of_force)


def _name_resistance(check: CheckRecord) -> tuple[object, ...]:
    return (
        check.member,
        check.mode,
        check.clause,
        check.resistance_type,
        check.resistance_basis,
        check.resistance_cell,
        check.resistance_kN,
    )


def _split(together: list[_Viewed]) -> list[list[_Viewed]]:
    """One inside and one at the end belong together; more never share a line."""
    places = [one.position == "edge" for one, _ in together]
    return [together] if places == [False, True] else [[one] for one in together]


def _build_line(viewed: list[_Viewed], words: Words) -> CheckLine:
    shown = {one.position == "edge": view for one, view in viewed}
    group = [one for one, _ in viewed]
    worst = min((one.verdict for one in group), key=SEVERITY.index)
    first = next(iter(shown.values()))
    return CheckLine(
        title=words.show(name_check(group[0].member, group[0].mode)),
        source=first.source,
        resistance=first.resistance,
        inside=shown.get(False),
        end=shown.get(True),
        verdict=show_verdict(worst, words),
        is_met=worst is Verdict.PASS,
        most_used=max(one.used or 0.0 for one in group),
        remarks=tuple(_list_remarks(group, words)),
    )


def _list_remarks(group: list[CheckRecord], words: Words) -> list[str]:
    """Reasons that say more than the numbers; told once where both places share it."""
    told = {
        one.position == "edge": words.show(one.reason)
        for one in group
        if not _is_plain(one.reason)
    }
    if (len(told) < len(group) and len(group) > 1) or len(set(told.values())) > 1:
        places = {False: words("heading.inside"), True: words("heading.at_end")}
        return [
            words("show.label", label=places[is_end], text=text)
            for is_end, text in told.items()
        ]
    return list(dict.fromkeys(told.values()))


def _is_plain(reason: Text) -> bool:
    """True of a pass about which its numbers say everything."""
    told: object = reason
    if isinstance(told, Message) and told.key == "load.reason":
        told = told.arguments["reason"]
    return isinstance(told, Message) and told.key == _PLAIN
