"""Limits of single values, beyond which a check turns, in words."""

from __future__ import annotations

from dataclasses import replace

from netdesign.outcome import Verdict
from netdesign.report.blocks.table import (
    Cell,
    Table,
    given_cell,
    name_columns,
    text_cell,
)
from netdesign.report.words import MISSING, Words, name_heading, show_check
from netdesign.study.records import CheckRecord, HoldRecord, RowStudy


def build_holds(row: RowStudy, words: Words) -> Table:
    """Limits of checks by single quantity, and where they have none.

    Checks of which the same is to be told share a line.
    """
    told: dict[tuple[str, str], list[CheckRecord]] = {}
    for check in row.checks:
        if check.holds:
            limits = words.join(list_limits(check, words))
            spans = words.join(_list_spans(check, words))
            told.setdefault((limits, spans), []).append(check)
    keys = ("check", "turns", "does_not_turn", "solves")
    headings = [words(f"heading.{key}") for key in keys]
    return Table(
        caption=words("caption.holds"),
        columns=name_columns(headings, numbers=headings[3:]),
        rows=tuple(
            (
                text_cell(words.join([show_check(words, one) for one in checks])),
                text_cell(limits),
                text_cell(spans),
                given_cell(
                    words, sum(hold.solves for one in checks for hold in one.holds)
                ),
            )
            for (limits, spans), checks in told.items()
        ),
        empty=words("heading.no_single_value"),
    )


def build_hold_numbers(row: RowStudy, words: Words) -> Table:
    """The same with a line for each quantity, all limits as numbers; for the workbook.

    A check holds, or would pass, between least and most; an empty end is none up to
    the end of the search.
    """
    told: dict[HoldRecord, list[CheckRecord]] = {}
    for check in row.checks:
        for hold in check.holds:
            told.setdefault(replace(hold, solves=0), []).append(check)
    keys = ("check", "quantity", "now", "turns", "searched", "remark")
    headings = [words(f"heading.{key}") for key in keys]
    return Table(
        caption=words("caption.hold_numbers"),
        columns=name_columns(headings, numbers=headings[2:5]),
        rows=tuple(
            (
                text_cell(words.join([show_check(words, one) for one in checks])),
                text_cell(name_heading(words, hold.quantity)),
                given_cell(words, hold.now),
                Cell(text=_show_ends(hold, words), ends=(hold.least, hold.most)),
                Cell(text="", ends=(hold.low, hold.high)),
                text_cell(words.show(hold.note)),
            )
            for hold, checks in told.items()
        ),
        empty=words("heading.no_single_value"),
    )


def _show_ends(hold: HoldRecord, words: Words) -> str:
    ends = (hold.least, hold.most)
    return " ".join(MISSING if one is None else words.show_given(one) for one in ends)


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


def _list_spans(check: CheckRecord, words: Words) -> list[str]:
    """Quantities with which a check does not turn, and how far was looked."""
    return [
        _name_span(hold, words)
        for hold in check.holds
        if hold.least is None and hold.most is None
    ]


def _name_span(hold: HoldRecord, words: Words) -> str:
    low, high = (words.show_number(hold.quantity, x) for x in (hold.low, hold.high))
    text = words("show.band", low=low, high=high)
    if hold.note is not None:
        text = words("show.with_note", text=text, note=words.show(hold.note))
    return words("show.label", label=name_heading(words, hold.quantity), text=text)
