"""Heights of a station in a csv file of their own, beside a site or without one."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from pathlib import Path

from netdesign.outcome import SiteDataError
from netdesign.site.cells.cells import UNDECLARED, TextFormat
from netdesign.site.cells.findings import Finding, fold_findings
from netdesign.site.cells.spreadsheet import read_workbook
from netdesign.site.columns.all_tables import WINTER
from netdesign.site.columns.fields import split_heading
from netdesign.site.model import StationWinter
from netdesign.site.snow_sheets import read_winter
from netdesign.site.tables import find_table
from netdesign.words.message import Message, say


def read_height_file(
    path: Path,
    text_format: TextFormat = UNDECLARED,
    row_ids: Collection[str] = (),
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

    Raises
    ------
    SiteDataError
        With all findings, if any of them is an error.
    """
    known = {name for field in WINTER.fields for name in field.names}
    workbook = read_workbook(
        path,
        lambda _: True,
        is_heading=lambda text: split_heading(text)[0] in known,
        text_format=text_format,
    )
    sheets = tuple(replace(one, name=WINTER.name) for one in workbook.sheets)
    findings = list(workbook.remarks)
    table = find_table(replace(workbook, sheets=sheets), WINTER, findings)
    winter = read_winter(table, dict.fromkeys(row_ids, ""), findings)
    is_refused = any(one.severity == "error" for one in findings)
    if winter is None or is_refused:
        if not is_refused:
            rule = say("winter_sheet.no_height")
            accepted = say("winter_sheet.heights")
            findings.append(workbook.finding(rule, accepted))
        raise SiteDataError(findings, fold_findings(findings))
    return replace(winter, file=path.name), tuple(findings)


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
