"""How far single values may go before a check turns, in words."""

from __future__ import annotations

from netdesign.outcome import Verdict
from netdesign.report.view.table import Table, given_cell, name_columns, text_cell
from netdesign.report.words import Words, name_heading, show_check, show_given
from netdesign.study.records import CheckRecord, HoldRecord, RowStudy

# Of a check that passes, and of one that does not: one limit, two, none.
_PHRASES = {
    True: ("show.holds", "show.holds_both", "show.holds_nowhere"),
    False: ("show.turns", "show.turns_both", "show.turns_nowhere"),
}


def build_holds(row: RowStudy, words: Words) -> Table:
    """Every single quantity of every check: where it turns, and how far was looked."""
    keys = ("check", "verdict", "quantity", "now", "turns", "looked_at", "solves")
    headings = [words(f"heading.{key}") for key in (*keys, "remark")]
    return Table(
        caption=words("caption.holds"),
        columns=name_columns(headings, numbers=(headings[3], headings[6])),
        rows=tuple(
            (
                text_cell(show_check(words, check)),
                text_cell(words(f"verdict.{check.verdict}")),
                text_cell(name_heading(words, hold.quantity)),
                given_cell(hold.now),
                text_cell(_describe_limits(check, hold, words)),
                text_cell(_span(hold, words)),
                given_cell(hold.solves),
                text_cell(words.show(hold.note)),
            )
            for check in row.checks
            for hold in check.holds
        ),
        empty=words("heading.no_single_value"),
    )


def list_holds(check: CheckRecord | None, words: Words) -> tuple[str, ...]:
    """Limits of single values for one check, in short."""
    if check is None:
        return ()
    return tuple(
        words(
            "show.hold",
            quantity=name_heading(words, hold.quantity),
            limits=_describe_limits(check, hold, words),
            now=show_given(hold.now),
        )
        for hold in check.holds
    )


def _describe_limits(check: CheckRecord, hold: HoldRecord, words: Words) -> str:
    """``holds while >= 0.021``; ``would turn at >= 0.046`` of a check that fails."""
    one, both, nowhere = _PHRASES[check.verdict is Verdict.PASS]
    least = f"≥ {show_given(hold.least)}" if hold.least is not None else ""
    most = f"≤ {show_given(hold.most)}" if hold.most is not None else ""
    if not least and not most:
        return words(nowhere, span=_span(hold, words))
    if least and most:
        return words(both, least=least, most=most)
    return words(one, limit=least or most)


def _span(hold: HoldRecord, words: Words) -> str:
    low, high = show_given(hold.low), show_given(hold.high)
    return words("show.band", low=low, high=high)
