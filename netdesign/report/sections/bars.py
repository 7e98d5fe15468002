"""Utilisation in a line of text: its sign, numbers, and a bar to scale."""

from __future__ import annotations

import math

from netdesign.checks.check import Check
from netdesign.outcome import Verdict
from netdesign.report.blocks import (
    SMALL,
    Badge,
    Cell,
    Content,
    Piece,
    Sketch,
    write_plain,
)
from netdesign.report.sections.rated import Rated, show_need
from netdesign.report.words import MISSING, Words, show_verdict

_ONE, _END = 13.0, 17.0  # place of utilisation 1, and of the end of a bar
_HAS_ROOM = 10.0  # utilisation from which no second number stands beside it


def sign(verdict: Verdict, words: Words) -> Badge:
    """Symbol of a verdict; its word is for readers aloud."""
    return Badge(show_verdict(verdict, words), "sign")


def show_rated(rated: Rated | None, words: Words) -> Content:
    """Sign, utilisation, that of the guideline, and a bar; else the force alone.

    A force that was calculated is shown where no resistance is known.
    """
    if rated is None:
        return (Piece(MISSING, "dash"),)
    first = sign(rated.verdict, words)
    if rated.used is not None:
        shown = Piece(_show_used(rated.check, rated.used, words), "ratio")
        bar = draw_bar(rated.used, rated.by_guideline, is_failed=_fails(rated))
        guide = ""
        if rated.by_guideline is not None and rated.used < _HAS_ROOM:
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


def _show_used(check: Check, used: float, words: Words) -> str:
    """Utilisation; one far beyond 1 by what is assumed with that at the best ends."""
    if not is_span(check):
        return words.show_number("utilisation", used)
    at_best = words.show_number("utilisation", check.eased_low)
    return f"{at_best}–{words.show_fixed(used, 0)}"


def is_span(check: Check) -> bool:
    """A utilisation is shown from that at the best ends of what is assumed on."""
    return bool(check.eased_low) and _HAS_ROOM <= (check.used or 0.0) < math.inf


def show_answer(rated: Rated, words: Words) -> Content:
    """The same beside its force: without a resistance, what it needs."""
    if rated.used is not None:
        return show_rated(rated, words)
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
