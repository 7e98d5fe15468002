"""Cells of a workbook that are read as if something else were typed there."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import replace

from netdesign.outcome import SiteDataError
from netdesign.site.cells.cells import (
    Cell,
    Sheet,
    Workbook,
    group_by_row,
    split_address,
)
from netdesign.site.cells.findings import Finding
from netdesign.site.model import InputEcho, NetRow, ReplacedCell
from netdesign.words.message import Message, say

_PLACE = re.compile(r"(?P<sheet>.+?)[!.](?P<column>[A-Za-z]{1,3})(?P<row>[1-9]\d{0,6})")


def split_replacement(text: str) -> tuple[str, str] | None:
    """Place and text of ``Nets.P8=A40``, the place as ``Nets!P8``; None of others."""
    place, sign, value = text.partition("=")
    found = _PLACE.fullmatch(place.strip())
    if not sign or found is None or not value.strip():
        return None
    address = f"{found['column'].upper()}{found['row']}"
    return f"{found['sheet']}!{address}", value.strip()


def write_replacement(cell: str, value: str) -> str:
    """The same as an option has it: with a point, which no shell takes for its own."""
    return f"{'.'.join(cell.rsplit('!', 1))}={value}"


def replace_cells(
    workbook: Workbook, instead: Mapping[str, str]
) -> tuple[Workbook, tuple[ReplacedCell, ...]]:
    """Workbook with other texts in some cells, and what was there.

    Parameters
    ----------
    workbook : Workbook
        As stored.
    instead : mapping of str to str
        Texts by place, such as ``Nets!P8``.

    Raises
    ------
    SiteDataError
        With every place on a sheet that is not read, and every text that is there
        already: a what-if that changes nothing would be the site as built.
    """
    findings: list[Finding] = []
    told: list[ReplacedCell] = []
    if not instead:
        return workbook, ()
    # two of one name are refused where they are read
    first = {sheet.name: sheet for sheet in reversed(workbook.sheets)}
    sheets = dict(first)
    names = {name.casefold(): name for name in sheets}
    for place, text in instead.items():
        typed, _, address = place.rpartition("!")
        name = names.get(typed.casefold())
        if name is None:
            accepted = say("accepted.words", words=tuple(sheets))
            rule = say("what_if.no_sheet", sheet=typed)
            findings.append(workbook.finding(rule, accepted))
            continue
        cell = find_cell(sheets[name], address)
        if cell.text == text:
            accepted = say("what_if.another_text")
            findings.append(cell.finding(say("what_if.same"), accepted))
            continue
        sheets[name] = _put(sheets[name], replace(cell, value=text, formula=""))
        told.append(ReplacedCell(cell=cell.place, was=cell.text, now=text))
    if findings:
        raise SiteDataError(findings)
    changed = tuple(
        sheets[sheet.name] if sheet is first[sheet.name] else sheet
        for sheet in workbook.sheets
    )
    return replace(workbook, sheets=changed), tuple(told)


def find_cell(sheet: Sheet, address: str) -> Cell:
    """Cell of a sheet at an address such as ``C14``."""
    column, row = split_address(address)
    return sheet.cell(row, column)


def _put(sheet: Sheet, cell: Cell) -> Sheet:
    """Sheet with one cell, its display format taken away: that was of another value."""
    plain = replace(
        cell, is_error=False, is_percent=False, is_thousandth=False, shown_unit=""
    )
    kept = [one for line in sheet.rows.values() for one in line.values()]
    others = [one for one in kept if (one.row, one.column) != (plain.row, plain.column)]
    return replace(sheet, rows=group_by_row([*others, plain]))


def mark_replaced(row: NetRow, replaced: Iterable[ReplacedCell]) -> NetRow:
    """Net row whose inputs say what the workbook has in the place of a what-if."""
    was = {one.cell: one.was for one in replaced}
    if not was:
        return row

    def tell(echo: InputEcho) -> InputEcho:
        if echo.cell not in was or echo.derivation is not None:
            return echo
        return replace(echo, derivation=describe_replaced(was[echo.cell]))

    return replace(row, inputs=tuple(map(tell, row.inputs)))


def describe_replaced(was: str) -> Message:
    """Text that a cell of the workbook holds, which a what-if replaced."""
    return say("what_if.instead", was=was) if was else say("what_if.instead_of_nothing")
