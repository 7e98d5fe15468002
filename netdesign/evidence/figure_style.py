"""SVG text of a matplotlib figure, in the style of the report's drawings.

Text stays text: it is laid out with the font that matplotlib brings along, so
that bytes do not depend on the machine, and the page sets it in its own font.
"""

from __future__ import annotations

import io
import re
from contextlib import AbstractContextManager
from html import escape
from typing import TYPE_CHECKING, Any

from netdesign.report.drawing.style import GREY, INK, TEXT_PT
from netdesign.words.catalogue import Language, set_marks

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_STYLE: dict[Any, Any] = {
    "svg.fonttype": "none",
    "font.family": "DejaVu Sans",
    "font.size": TEXT_PT,
    "axes.linewidth": 0.5,
    "axes.edgecolor": GREY,
    "axes.labelcolor": INK,
    "text.color": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "xtick.major.width": 0.5,
    "ytick.major.width": 0.5,
    "xtick.major.size": 2.5,
    "ytick.major.size": 2.5,
}
_NO_METADATA = {"Date": None, "Creator": None, "Format": None, "Type": None}


def use_style(name: str) -> AbstractContextManager[None]:
    """Set matplotlib up for the drawing ``name``, for the time of a ``with``."""
    import matplotlib

    return matplotlib.rc_context({**_STYLE, "svg.hashsalt": name})


def write_svg(
    figure: Figure, name: str, title: str, *, language: Language = "en"
) -> str:
    """SVG element of a figure, the same bytes each time.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        The drawing.
    name : str
        Of our making (``row-1-section``); keeps ids apart on one page.
    title : str
        What a screen reader says.
    language : Language
        Of the numbers beside the axes.
    """
    _set_numerals(figure, language)
    buffer = io.StringIO()
    with use_style(name):
        figure.savefig(buffer, format="svg", metadata=_NO_METADATA, transparent=True)
    text = buffer.getvalue()
    text = text[text.index("<svg") :]
    text = re.sub(r"<style[^>]*>.*?</style>", "", text, flags=re.DOTALL)
    text = re.sub(r' (id|xlink:href)="(#?)', rf' \1="\2{name}-', text)
    text = text.replace("url(#", f"url(#{name}-")
    return text.replace("<svg ", f'<svg role="img" aria-label="{escape(title)}" ', 1)


def _set_numerals(figure: Figure, language: Language) -> None:
    """Decimal marks of a language on all axes that number themselves."""
    from matplotlib.ticker import ScalarFormatter

    class Numerals(ScalarFormatter):
        """Numbers of an axis as its library writes them, with the language's mark."""

        def __call__(self, x: float, pos: int | None = None) -> str:
            return set_marks(super().__call__(x, pos), language)

    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            if type(axis.get_major_formatter()) is ScalarFormatter:
                axis.set_major_formatter(Numerals())
