"""Tables of the whole site: its rows beside each other."""

from __future__ import annotations

from collections.abc import Sequence

from netdesign.report.blocks.table import Cell, Column, Table, name_columns, text_cell
from netdesign.report.view.check_view import SEVERITY
from netdesign.report.view.tables import DEFAULT
from netdesign.report.words import (
    MISSING,
    VERDICTS,
    Words,
    show_member,
    show_text,
    show_unit,
    understand,
)
from netdesign.site.model import InputEcho
from netdesign.structure.members import CARRYING_MEMBERS, EndMember
from netdesign.study.records import CheckRecord, RowStudy, Study

_ACROSS = 12  # rows of nets beside each other on a page
_BY_DEFAULT, _DERIVED = "*", "‡"


def build_matrix(study: Study, words: Words) -> Table:
    """Worst verdict and largest utilisation of each row by members, and the rest."""
    known = {one.member for row in study.rows for one in row.checks if one.is_of_force}
    members = [one for one in (*CARRYING_MEMBERS, *EndMember) if one in known]
    columns = [show_member(words, one) for one in members]
    headings = [words("heading.net_row"), *columns, words("heading.rest")]
    return Table(
        caption=words("caption.matrix"),
        columns=name_columns(headings, numbers=()),
        rows=tuple(
            (
                text_cell(row.id),
                *(_sum_up(_list_of(row, one), words) for one in members),
                _sum_up([one for one in row.checks if not one.is_of_force], words),
            )
            for row in study.rows
        ),
        empty=words("heading.no_rows"),
    )


def _list_of(row: RowStudy, member: str) -> list[CheckRecord]:
    return [one for one in row.checks if one.member == member and one.is_of_force]


def _sum_up(checks: Sequence[CheckRecord], words: Words) -> Cell:
    """Symbol of the worst verdict, and the largest utilisation that is known."""
    if not checks:
        return text_cell(MISSING)
    worst = min((one.verdict for one in checks), key=SEVERITY.index)
    known = [one.used for one in checks if one.used is not None]
    symbol = VERDICTS[worst].symbol
    if not known:
        return text_cell(symbol)
    most = words.show_number("utilisation", max(known))
    return text_cell(f"{symbol} {most}")


def build_site_inputs(study: Study, words: Words) -> tuple[Table, ...]:
    """Inputs of all rows as understood, a column for each row, some rows at a time.

    An input that all of them leave empty is left out.
    """
    starts = range(0, len(study.rows), _ACROSS)
    return tuple(_build_inputs(study.rows[k : k + _ACROSS], words) for k in starts)


def _build_inputs(rows: Sequence[RowStudy], words: Words) -> Table:
    lines: dict[tuple[str, str], dict[str, InputEcho]] = {}
    for row in rows:
        for echo in row.inputs:
            place = (words.show(echo.label), echo.unit)
            lines.setdefault(place, {})[row.id] = echo
    columns: tuple[Column, ...] = (
        *name_columns(
            [words(f"heading.{key}") for key in ("input", "column_of", "unit")],
            numbers=(),
        ),
        *name_columns([show_text(row.id) for row in rows], numbers=()),
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
    value = understand(echo, words)
    text = value if isinstance(value, str) else _show_value(echo, value, words)
    mark = _BY_DEFAULT if echo.cell == DEFAULT else ""
    return text_cell(text + mark + (_DERIVED if echo.derivation else ""))


def _show_value(echo: InputEcho, value: float, words: Words) -> str:
    """Number that was typed, as it is; a length that follows from others, in cm."""
    is_length = echo.unit == "m" and echo.derivation
    return words.show_fixed(value, 2) if is_length else words.show_given(value)


def _name_column(echoes: Sequence[InputEcho]) -> str:
    """Sheet and column of an input, of the rows that have it: ``Nets!C``."""
    places = {echo.cell.rstrip("0123456789") for echo in echoes if echo.cell != DEFAULT}
    return ", ".join(sorted(places))
