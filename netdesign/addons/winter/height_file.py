"""Heights of a station in a csv file of their own, beside a site or without one.

Files as stations publish them: a command names the columns, the unit and the words for
no reading; days may be written in any order of which one alone can be meant.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from datetime import date, datetime
from itertools import pairwise
from pathlib import Path
from typing import Any

from netdesign.addons.winter.winter_sheet import StationWinter, read_winter
from netdesign.outcome import SiteDataError
from netdesign.site.cells.cells import (
    UNDECLARED,
    Cell,
    Sheet,
    TextFormat,
    group_by_row,
)
from netdesign.site.cells.findings import Finding, fold_findings, refuse_file
from netdesign.site.cells.numbers import is_moment
from netdesign.site.cells.spreadsheet import read_workbook
from netdesign.site.columns.all_tables import WINTER
from netdesign.site.columns.fields import split_heading
from netdesign.site.tables import find_table
from netdesign.words.message import Message, say


@dataclass(frozen=True, slots=True, kw_only=True)
class HeightColumns:
    """Columns of a station's file by the options; all empty: those of sheet Winter.

    Attributes
    ----------
    date, height : str
        Headings as they stand in the file.
    unit : str
        Of the heights; "" where their heading has it.
    missing : tuple of str
        Words that stand for no reading.
    """

    date: str = ""
    height: str = ""
    unit: str = ""
    missing: tuple[str, ...] = ()


AS_HEADED = HeightColumns()


def build_columns(asked: Mapping[str, Any]) -> HeightColumns:
    """Columns of a file by the options of a command."""
    words = [word.strip() for word in (asked["missing"] or "").split(",")]
    names = {key: (asked[key] or "").strip() for key in ("date", "height", "unit")}
    return HeightColumns(**names, missing=tuple(word for word in words if word))


def read_height_file(
    path: Path,
    text_format: TextFormat = UNDECLARED,
    row_ids: Collection[str] = (),
    columns: HeightColumns = AS_HEADED,
) -> tuple[StationWinter, tuple[Finding, ...]]:
    """Series of a csv file of a station alone, and remarks on it.

    Parameters
    ----------
    path : Path
        A csv file with the columns of sheet Winter, whatever its name.
    text_format : TextFormat
        What is declared of the file's text.
    row_ids : collection of str
        Ids of the rows that it may name; with none, any.
    columns : HeightColumns
        What is said of its columns.

    Raises
    ------
    SiteDataError
        With all findings, if any of them is an error.
    """
    headings = {name for field in WINTER.fields for name in field.names}
    headings |= {columns.date, columns.height} - {""}
    try:
        workbook = read_workbook(
            path,
            lambda _: True,
            is_heading=lambda text: (
                not headings.isdisjoint((text.strip(), split_heading(text)[0]))
            ),
            text_format=text_format,
        )
    except SiteDataError as refused:
        findings = [entry for entry in refused.findings if isinstance(entry, Finding)]
        raise _offer_columns(findings) from refused
    sheets = tuple(
        replace(_arrange(sheet, columns), name=WINTER.name) for sheet in workbook.sheets
    )
    findings = list(workbook.remarks)
    table = find_table(replace(workbook, sheets=sheets), WINTER, findings)
    winter = read_winter(table, dict.fromkeys(row_ids, ""), findings)
    is_refused = any(finding.severity == "error" for finding in findings)
    if winter is None or is_refused:
        if not is_refused:
            rule = say("winter_sheet.no_height")
            accepted = say("winter_sheet.heights")
            findings.append(workbook.finding(rule, accepted))
        raise _offer_columns(findings)
    return replace(winter, file=path.name), tuple(findings)


def _offer_columns(findings: Sequence[Finding]) -> SiteDataError:
    """Refusal of a station's file, with the options that read it as it is."""
    lines = fold_findings(findings)
    own = [line for line in lines if line.key != "finding.ask_map"]
    return SiteDataError(findings, (*own, say("winter_sheet.name_columns")))


def _arrange(sheet: Sheet, columns: HeightColumns) -> Sheet:
    """Sheet with the named columns under our headings, days as ISO 8601 has them."""
    is_named = bool(columns.date and columns.height)
    if not is_named and (columns.date or columns.height):
        raise refuse_file(
            sheet.file, say("winter_sheet.one_column"), say("winter_sheet.columns")
        )
    places = _find_columns(sheet, columns if is_named else None)
    if places is None and is_named:
        rule = say("winter_sheet.no_column", date=columns.date, height=columns.height)
        raise refuse_file(sheet.file, rule, say("winter_sheet.columns"))
    if places is None:
        return sheet
    heading, day, height = places
    cells = [cell for line in sheet.rows.values() for cell in line.values()]
    if is_named:
        cells = _rename(sheet, cells, places, columns.unit)
    missing = {word.casefold() for word in columns.missing}
    cells = [
        cell
        for cell in cells
        if cell.row <= heading
        or cell.column != height
        or cell.text.strip().casefold() not in missing
    ]
    days = _read_days(
        sheet.file,
        [cell for cell in cells if cell.column == day and cell.row > heading],
    )
    read = [
        replace(cell, value=days[cell.row].isoformat())
        if cell.column == day and cell.row in days
        else cell
        for cell in cells
    ]
    return replace(sheet, rows=group_by_row(read))


def _rename(
    sheet: Sheet, cells: Sequence[Cell], places: _Columns, unit: str
) -> list[Cell]:
    """Cells of the days and the heights alone, under the headings of sheet Winter."""
    heading, day, height = places
    text = sheet.cell(heading, height).text
    unit = unit or split_heading(text)[1]
    titles = {day: "date", height: f"snow height [{unit}]" if unit else text}
    return [
        replace(cell, value=titles[cell.column]) if cell.row == heading else cell
        for cell in cells
        if cell.row >= heading and cell.column in titles
    ]


_Columns = tuple[int, int, int]  # row of the headings, columns of days and heights


def _find_columns(sheet: Sheet, named: HeightColumns | None) -> _Columns | None:
    """Columns by their names in the file, else by headings of sheet Winter."""
    known = {field.key: field.names for field in WINTER.fields}
    wanted = [known["date"], known["snow_height"]]
    if named:
        wanted = [frozenset([name.casefold()]) for name in (named.date, named.height)]
    for row, cells in sheet.rows.items():
        texts = {
            cell.text.strip().casefold() if named else split_heading(cell.text)[0]: k
            for k, cell in cells.items()
        }
        days, tops = ([texts[x] for x in texts if x in names] for names in wanted)
        if days and tops:
            return row, days[0], tops[0]
    return None


_NUMBERS = re.compile(r"(\d{1,4})([./-])(\d{1,2})\2(\d{1,4})\b(.*)", re.DOTALL)
_ORDERS = ("%d %m %Y", "%m %d %Y", "%Y %m %d")


def _read_days(file: str, cells: Sequence[Cell]) -> dict[int, date]:
    """Days by their rows, if one order of day, month and year can be meant.

    None where all are moments that any sheet may have.

    Raises
    ------
    SiteDataError
        If two can.
    """
    texts = [
        cell for cell in cells if isinstance(cell.value, str) and not cell.is_blank
    ]
    if all(is_moment(cell.text) for cell in texts):
        return {}
    orders = _list_orders(texts)
    if len(orders) > 1:
        rule = say("winter_sheet.which_day", text=texts[0].text.strip())
        raise refuse_file(file, rule, say("winter_sheet.iso_days"))
    rows = [cell.row for cell in texts]
    return dict(zip(rows, orders[0], strict=True)) if orders else {}


def _list_orders(cells: Sequence[Cell]) -> list[list[date]]:
    """Days of all cells, in each order in which all are days that ascend."""
    orders: list[list[date]] = []
    for order in _ORDERS:
        days = [_read_day(cell.text.strip(), order) for cell in cells]
        read = [day for day in days if day is not None]
        ascends = len(read) == len(days) and all(a < b for a, b in pairwise(read))
        if ascends and read not in orders:
            orders.append(read)
    return orders


def _read_day(text: str, order: str) -> date | None:
    """Day of a text in one order of its numbers; None if it is none."""
    parted = _NUMBERS.fullmatch(text)
    numbers = " ".join(parted.group(1, 3, 4)) if parted else ""
    for form in (order, order.lower()):  # years of four digits, or of two
        with suppress(ValueError):
            return datetime.strptime(numbers, form).date()
    return None


def complete_by_sheet(
    station: StationWinter, sheet: StationWinter | None
) -> tuple[StationWinter, Message | None]:
    """Station of a file with what it leaves open from sheet Winter, and a note on it.

    Parameters
    ----------
    station : StationWinter
        Of a height file.
    sheet : StationWinter or None
        Of the site whose rows it is to load.
    """
    if sheet is None:
        return station, None
    altitude = station.altitude
    has_factors = station.height_factor is not None or station.row_factors
    factors = station if has_factors else sheet  # never of two stations
    completed = replace(
        station,
        station=station.station or sheet.station,
        altitude=sheet.altitude if altitude is None else altitude,
        height_factor=factors.height_factor,
        row_factors=factors.row_factors,
    )
    if completed == station:
        return station, None
    note = say("winter_sheet.kept", file=station.file)
    return replace(completed, notes=(*station.notes, note)), note
