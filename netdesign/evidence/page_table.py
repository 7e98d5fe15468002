"""Tables of evidence for pages: plain values, each shown as its column says."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from netdesign.report.blocks import (
    Cell,
    Column,
    Table,
    given_cell,
    number_cell,
    text_cell,
)
from netdesign.report.words import MISSING, Words
from netdesign.words.catalogue import load_texts

FORCE = "foot_size_kN_per_m"


@dataclass(frozen=True, slots=True, kw_only=True)
class Kind:
    """Kind of a column: how a value becomes a cell, and the quantity of its numbers."""

    show: Callable[[Words, Any], Cell]
    quantity: str = ""
    is_number: bool = True


@dataclass(frozen=True, slots=True)
class Field:
    """One column: its key in a file, its heading or the heading's key, its kind."""

    key: str
    heading: str
    kind: Kind


def tabulate(
    caption: str,
    fields: Sequence[Field],
    rows: Iterable[Sequence[object]],
    words: Words,
) -> Table:
    """Table of rows of plain values in a language."""
    texts = load_texts("en")
    return Table(
        caption=caption,
        columns=tuple(
            Column(
                heading=words(one.heading) if one.heading in texts else one.heading,
                quantity=one.kind.quantity,
                is_number=one.kind.is_number,
            )
            for one in fields
        ),
        rows=tuple(
            tuple(
                one.kind.show(words, value)
                for one, value in zip(fields, row, strict=True)
            )
            for row in rows
        ),
    )


def tabulate_items(
    caption: str,
    columns: Mapping[str, tuple[Kind, Callable[[Any], object]]],
    items: Iterable[object],
    words: Words,
) -> Table:
    """Table of a line for each item; a column's heading, kind and value of an item."""
    fields = [Field(heading, heading, kind) for heading, (kind, _) in columns.items()]
    rows = [[value(one) for _, value in columns.values()] for one in items]
    return tabulate(caption, fields, rows, words)


def numbers(form: str) -> Kind:
    """Kind of numbers in one of Python's forms; all digits stay in files."""

    def show(words: Words, value: float | None) -> Cell:
        text = MISSING if value is None else words.write(f"{value:{form}}")
        return Cell(text=text, number=value)

    return Kind(show=show)


def kilo(value: float | None) -> float | None:
    """Value in thousands; None stays."""
    return None if value is None else value / 1e3


def _show_time(words: Words, value: float | None) -> Cell:
    """Three significant digits without a power of ten."""
    if value is None:
        return Cell(text=MISSING)
    shown = float(f"{value:.3g}")
    return Cell(text=words.write(f"{shown:.10g}"), number=value)


def _show_change(words: Words, share: float | None) -> Cell:
    percent = None if share is None else 100.0 * share
    return number_cell(words, "change_percent", percent)


FORCES = Kind(
    show=lambda words, value: number_cell(words, FORCE, kilo(value)), quantity=FORCE
)
ERRORS = Kind(
    show=lambda words, value: number_cell(words, "error_kN_per_m", kilo(value)),
    quantity="error_kN_per_m",
)
CHANGES = Kind(show=_show_change, quantity="change_percent")
INCLINATIONS = Kind(show=given_cell, quantity="inclination_deg")
FRICTIONS = Kind(show=given_cell, quantity="friction_deg")
GIVEN = Kind(show=given_cell)
TIMES = Kind(show=_show_time)
TEXTS = Kind(show=lambda _, text: text_cell(text), is_number=False)
# Two forces in one cell, in kN of N; the ends of a range.
PAIRS = Kind(
    show=lambda words, pair: text_cell(
        words.write(" / ".join(f"{one / 1e3:.1f}" for one in pair))
    )
)
RANGES = Kind(
    show=lambda words, ends: text_cell(
        words("show.band", low=f"{ends[0]:.0f}", high=f"{ends[1]:.0f}")
    )
)
NUMBER_TEXTS = Kind(show=lambda _, text: text_cell(text))  # set as numbers are
