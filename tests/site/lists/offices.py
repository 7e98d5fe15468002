"""Five lists in the style of offices, and what each heading of them means.

Made for the tests: German, French and English, xlsx and csv, with title blocks, units
in headings and below them, groups, columns that no check needs, remarks and sums. A
meaning is a column of the input workbook (`rows.slope_angle`), with what it measures
where that is a choice; `ignore`; or `ask`, where the heading alone cannot say it.
"""

import csv
import tomllib
from dataclasses import dataclass
from pathlib import Path

import openpyxl


@dataclass(frozen=True)
class OfficeSheet:
    """A sheet: title lines, headings with their meanings, a row of units, lines."""

    name: str
    titles: tuple
    headings: dict
    lines: tuple
    units: tuple = ()
    below: tuple = ()


@dataclass(frozen=True)
class OfficeList:
    """A list of an office, its language and its file."""

    file: str
    language: str
    sheets: tuple
    delimiter: str = ";"

    def write(self, folder):
        """Write it; its place."""
        path = folder / self.file
        if path.suffix == ".csv":
            (sheet,) = self.sheets
            with path.open("w", encoding="utf-8", newline="") as file:
                csv.writer(file, delimiter=self.delimiter).writerows(_list_rows(sheet))
            return path
        book = openpyxl.Workbook()
        book.remove(book.active)
        for sheet in self.sheets:
            made = book.create_sheet(sheet.name)
            for line in _list_rows(sheet):
                made.append(line)
        book.save(path)
        book.close()
        return path


def _list_rows(sheet):
    """Lines of a sheet from its titles to what stands below."""
    rows = [*sheet.titles, tuple(sheet.headings)]
    rows += [sheet.units] if sheet.units else []
    return [list(one) for one in (*rows, *sheet.lines, *sheet.below)]


def _freeze(lines):
    return tuple(tuple(None if one == "" else one for one in line) for line in lines)


def _load(sheets, **of_list):
    made = []
    for kept in sheets:
        one = {"titles": [], "units": [], "below": [], **kept}
        (one["units"],) = _freeze([one["units"]])
        lines = {key: _freeze(one[key]) for key in ("titles", "lines", "below")}
        made.append(OfficeSheet(**(one | lines)))
    return OfficeList(sheets=tuple(made), **of_list)


_KEPT = Path(__file__).with_name("offices.toml").read_text(encoding="utf-8")
OFFICES = tuple(_load(**one) for one in tomllib.loads(_KEPT).values())
TYROL, VALAIS, _, CONSULTANT, _ = OFFICES
