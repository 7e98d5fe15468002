"""Inputs as tables: those of one place cell by cell, and those of all rows."""

from __future__ import annotations

from collections.abc import Sequence

from netdesign.report.blocks.block import Part, section
from netdesign.report.blocks.table import (
    Cell,
    Column,
    Table,
    given_cell,
    name_columns,
    text_cell,
)
from netdesign.report.words import (
    MISSING,
    Words,
    show_text,
    show_unit,
    understand,
)
from netdesign.site.model import InputEcho
from netdesign.study.records import RowStudy, Study

DEFAULT = "default"  # cell of an input that nobody typed
_ACROSS = 12  # rows of nets beside each other on a page
_BY_DEFAULT, _DERIVED = "*", "‡"


def build_inputs(inputs: Sequence[InputEcho], caption: str, words: Words) -> Table:
    """List inputs as typed and as understood, each with its cell."""
    keys = ("input", "typed", "understood_as", "unit", "cell")
    headings = [words(f"heading.{key}") for key in keys]
    return Table(
        caption=caption,
        columns=name_columns(headings, numbers=(words("heading.understood_as"),)),
        rows=tuple(
            (
                text_cell(words.show(echo.label)),
                text_cell(
                    words.show(echo.derivation) if echo.derivation else echo.text
                ),
                given_cell(words, understand(echo, words)),
                text_cell(show_unit(echo.unit)),
                text_cell(
                    words("status.default") if echo.cell == DEFAULT else echo.cell
                ),
            )
            for echo in inputs
        ),
        empty=words("show.none"),
    )


def show_inputs(study: Study, words: Words) -> Part:
    """Section of all rows' inputs as understood, a column for each row."""
    starts = range(0, len(study.rows), _ACROSS)
    tables = [_build_inputs(study.rows[k : k + _ACROSS], words) for k in starts]
    shown = tables or [_build_inputs([], words)]
    return section(
        "inputs",
        words("heading.inputs_of_rows"),
        *(one.shown("site-inputs") for one in shown),
        look="wide",
    )


def _build_inputs(rows: Sequence[RowStudy], words: Words) -> Table:
    """Inputs of some rows; one that all of them leave empty is left out."""
    lines: dict[tuple[str, str], dict[str, InputEcho]] = {}
    for row in rows:
        for echo in row.inputs:
            place = (words.show(echo.label), echo.unit)
            lines.setdefault(place, {})[row.id] = echo
    columns: tuple[Column, ...] = name_columns(
        [
            *(words(f"heading.{key}") for key in ("input", "column_of", "unit")),
            *(show_text(row.id) for row in rows),
        ],
        numbers=(),
    )
    return Table(
        caption=words("caption.site_inputs"),
        columns=columns,
        rows=tuple(
            (
                text_cell(label),
                text_cell(_name_column(list(by_row.values()))),
                text_cell(show_unit(unit)),
                *(_show_input(by_row.get(row.id), words) for row in rows),
            )
            for (label, unit), by_row in lines.items()
            if any(echo.value not in ("", row_id) for row_id, echo in by_row.items())
        ),
        empty=words("show.none"),
    )


def _show_input(echo: InputEcho | None, words: Words) -> Cell:
    if echo is None or echo.value == "":
        return text_cell(MISSING)
    mark = _BY_DEFAULT if echo.cell == DEFAULT else ""
    text = show_value(echo, words)
    return text_cell(text + mark + (_DERIVED if echo.derivation else ""))


def show_value(echo: InputEcho, words: Words) -> str:
    """Input as it was typed; a length that follows from others, in cm."""
    value = understand(echo, words)
    if isinstance(value, str):
        return value
    is_length = echo.unit == "m" and echo.derivation
    return words.show_fixed(value, 2) if is_length else words.show_given(value)


def _name_column(echoes: Sequence[InputEcho]) -> str:
    """Sheet and column of an input, of the rows that have it: ``Nets!C``.

    A cell that several rows share stands whole: its value holds for all of them.
    """
    cells = [echo.cell for echo in echoes if echo.cell != DEFAULT]
    places = {
        one if cells.count(one) > 1 else one.rstrip("0123456789") for one in cells
    }
    return ", ".join(sorted(places))
