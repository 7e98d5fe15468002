"""Cells of checks: utilisation with its bar, demand with what governs it."""

from __future__ import annotations

from netdesign.report.blocks.table import Cell, rich_cell, text_cell
from netdesign.report.blocks.text import SMALL, Badge, Content, Piece, Sketch, strong
from netdesign.report.view.check_view import Bar, CheckView
from netdesign.report.words import MISSING, VerdictWords, Words

_OVER, _BELOW = "#b23a1e", "#7d838b"  # of a bar: beyond utilisation 1, and below


def badge_cell(verdict: VerdictWords) -> Cell:
    """Symbol and word of a verdict."""
    return rich_cell((Badge(verdict),))


def strong_cell(text: str) -> Cell:
    """Text that stands out."""
    return rich_cell(strong(text))


def draw_bar(bar: Bar) -> Sketch:
    """Ratio bar: the utilisation, its band in white, and a mark at 1."""
    colour = _OVER if bar.is_over else _BELOW
    return Sketch(
        '<svg class="bar" viewBox="0 0 150 12" preserveAspectRatio="xMinYMid" '
        'aria-hidden="true"><path stroke="#e9ecef" stroke-width="6" d="M0 6h150"/>'
        f'<path stroke="{colour}" stroke-width="6" d="M0 6h{bar.value}"/>'
        f'<path stroke="#fff" stroke-width="2" d="M{bar.low} 6H{bar.high}"/>'
        '<path stroke="#1b1e22" stroke-width="1.5" d="M100 0v12"/></svg>'
    )


def show_utilisation(check: CheckView, look: str = "ratio") -> Content:
    """Utilisation with its band, and the bar of both."""
    used = Piece(check.utilisation, look)
    if check.bar is None:
        return (used,)
    band = Piece(f" {check.band}", "band") if check.band != MISSING else Piece("")
    return (used, band, draw_bar(check.bar))


def demand_cell(check: CheckView | None, words: Words) -> Cell:
    """One place of a check: verdict, utilisation, demand, what governs, its case."""
    if check is None:
        return text_cell(MISSING)
    told = [f"E_d {check.demand}"] if check.demand != MISSING else []
    told += [check.loads] if check.loads else []
    if check.case_short != MISSING:
        told.append(check.case_short.replace(" / ", "/"))
    below = Piece(words.join(told), SMALL, has_symbols=True)
    return rich_cell((Badge(check.verdict, "sign"), *show_utilisation(check), below))
