"""Changes that make a check pass, and limits of single values, in words."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from netdesign.outcome import Verdict
from netdesign.report.blocks.block import Block, Items, Paragraph
from netdesign.report.governing import find_shown, is_far_from_limit
from netdesign.report.words import MISSING, Words, name_heading, show_check, show_text
from netdesign.study.records import ChangeRecord, CheckRecord, HoldRecord, RowStudy

_FAR = 2.0  # times today's value, or its half: beyond it nobody would build
_SENSES = {
    "at least": "show.change_at_least",
    "at most": "show.change_at_most",
    "has": "show.change_has",
}


def show_changes(row: RowStudy, words: Words) -> tuple[str, tuple[Block, ...]]:
    """Heading and sentences of a row: what would make it pass, or the room left."""
    passes = row.verdict in (Verdict.PASS, Verdict.DECLARED)
    heading = words("heading.room_left" if passes else "heading.would_pass_with")
    told = [*_list_row_changes(row, words), *_list_room(row, words)]
    if told:
        return heading, (Items(items=tuple(told)),)
    is_far = all(map(is_far_from_limit, row.checks))
    key = "heading.no_change_needed" if is_far else "heading.no_change_alone"
    return heading, (Paragraph(text=words(key), look="none"),)


def _list_row_changes(row: RowStudy, words: Words) -> Iterator[str]:
    """Changes that turn checks; those with the same changes share a sentence."""
    told: dict[str, list[str]] = {}
    for check in row.checks:
        text = words.join(list_flips(check, words))
        if check.changes and text:
            told.setdefault(text, []).append(show_check(words, check))
    for text, names in told.items():
        yield words("show.label", label=words.join(names), text=text)


def _list_room(row: RowStudy, words: Words) -> Iterator[str]:
    """Limits of single values beyond which the check that is shown turns."""
    check = find_shown(row)
    limits = list_limits(check, words) if check else ()
    if check and limits:
        label = show_check(words, check)
        yield words("show.label", label=label, text=words.join(limits))


def list_flips(check: CheckRecord | None, words: Words) -> tuple[str, ...]:
    """Changes that turn one check, in short; none where no change alone does."""
    changes = check.changes if check else []
    return tuple(describe_flip(one, words) for one in changes if is_useful(one))


def is_useful(change: ChangeRecord) -> bool:
    """Somebody may build it: a resistance or type, or a number near today's.

    A post spacing of 0.3 m in the place of 3.5 m is none.
    """
    if change.bound is None:
        return False
    if change.unit == "kN" or not change.now:
        return True
    return 1.0 / _FAR <= change.bound / change.now <= _FAR


def describe_flip(change: ChangeRecord, words: Words) -> str:
    """One change and today's value: ``post spacing at most 1.42 m, now 4 m``."""
    text = describe_change(change, words)
    if change.now is None:
        return text
    now = round(change.now, 3) if change.unit == "m" else change.now  # cos of a slope
    return words("show.change_now", change=text, now=_show(now, change.unit, words))


def describe_change(change: ChangeRecord, words: Words) -> str:
    """One change in words: ``snow density at most 219 kg/m3``."""
    quantity = words.show(change.quantity)
    if change.bound is None:
        return words("show.change_none", quantity=quantity)
    bound = _show(change.bound, change.unit, words)
    return words(_SENSES[change.sense], quantity=quantity, bound=bound)


def _show(value: float | None, unit: str, words: Words) -> str:
    """Value with its unit; the search has rounded bounds to the side that passes."""
    return MISSING if value is None else words.show_quantity(value, unit)


def explain_change(change: ChangeRecord, words: Words) -> str:
    """One change with what it took, and what limits it."""
    text = describe_flip(change, words)
    if change.bound is not None:
        text = words("show.passes_with", change=text)
    if change.solves == 1:
        text = words("show.after_one_solve", change=text)
    elif change.solves:
        text = words("show.after_solves", change=text, count=change.solves)
    if change.note is None:
        return text
    return words("show.with_note", text=text, note=words.show(change.note))


def list_changes(rows: Sequence[tuple[str, CheckRecord]], words: Words) -> list[str]:
    """Lines of what turns each check, by net row; else why there is nothing."""
    found = [
        show_text(
            words(
                "show.label",
                label=words(
                    "show.row_and_check",
                    row=row,
                    check=show_check(words, check),
                    verdict=words(f"verdict.{check.verdict}"),
                ),
                text=explain_change(change, words),
            )
        )
        for row, check in rows
        for change in check.changes
        if is_useful(change)
    ]
    if found:
        return found
    is_far = all(is_far_from_limit(check) for _, check in rows)
    return [words("show.no_change" if is_far else "show.no_change_alone")]


def list_limits(check: CheckRecord | None, words: Words) -> tuple[str, ...]:
    """Limits of a check, each alone: ``holds while slack >= 0.021 (now 0.03)``."""
    if check is None:
        return ()
    key = _choose_sentence(check)
    return tuple(
        words(
            key,
            quantity=name_heading(words, hold.quantity),
            limit=_show_limit(check, hold, words),
            now=words.show_given(hold.now),
        )
        for hold in check.holds
        if hold.least is not None or hold.most is not None
    )


def _choose_sentence(check: CheckRecord) -> str:
    """Sentence of a limit: beyond it a check turns, or its force does.

    A check that carries its force may still not pass: a case without a result, a creep
    law out of its range, a declaration.
    """
    if not _carries(check):
        return "show.turns"
    return "show.holds" if check.verdict is Verdict.PASS else "show.within"


def _carries(check: CheckRecord) -> bool:
    """True where the largest force is within the resistance, as the record has it."""
    _, used = check.utilisation_band
    return used is not None and used <= 1.0


def _show_limit(check: CheckRecord, hold: HoldRecord, words: Words) -> str:
    limits = [
        f"{sign} {words.show_given(value)}"
        for sign, value in (("≥", hold.least), ("≤", hold.most))
        if value is not None
    ]
    if len(limits) == 1:
        return limits[0]
    key = "show.both" if _carries(check) else "show.either"
    return words(key, one=limits[0], other=limits[1])
