"""Shares of some quantities in a whole as bars, one below the other."""

from __future__ import annotations

from collections.abc import Sequence

from netdesign.report.drawing.plain_svg import (
    ACCENT,
    TEXT_PT,
    WIDTH,
    Chart,
    measure_words,
)
from netdesign.report.words import Words

_LINE, _BAR = 11.0, 7.0  # from bar to bar, height of a bar [pt]
_BETWEEN_BARS = 6.0  # beside a bar [pt]
_NUMBER = 26.0  # room of a number [pt]


def draw_shares(shares: Sequence[tuple[str, float]], title: str, words: Words) -> str:
    """SVG of the bars, the largest first.

    Parameters
    ----------
    shares : sequence of (str, float)
        Name and share of each, from 0 to 1; at least one.
    title : str
        What is shown.
    words : Words
        Of the language.
    """
    ranked = sorted(shares, key=lambda one: -one[1])
    left = max(measure_words(label, TEXT_PT) for label, _ in ranked) + _BETWEEN_BARS
    room = 0.6 * WIDTH - left - _NUMBER
    sketch, texts = Chart(language=words.language), []
    for place, (label, share) in enumerate(ranked):
        top = place * _LINE + 0.5 * (_LINE - _BAR)
        base = top + 0.5 * _BAR + 0.35 * TEXT_PT
        shown = words("reliability.percent", share=words.show_fixed(100.0 * share, 0))
        sketch.text(left - _BETWEEN_BARS, base, label, anchor="end")
        sketch.rectangle(left, top, max(0.5, room * share), _BAR, ACCENT)
        sketch.text(left + room * share + _BETWEEN_BARS, base, shown)
        texts.append(words("show.label", label=label, text=shown))
    told = words("drawing.with_values", what=title, values=tuple(texts))
    return sketch.write(len(ranked) * _LINE + 2.0, told)
