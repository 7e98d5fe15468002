"""Slips of the pen in a workbook: one number is altered, and who notices it.

Altered are all numbers that a verdict rests on: times and by 10, 100 and 1000, taken
for the number beside or below it, the heading's unit taken for the next one.
"""

import re
from dataclasses import dataclass

from netdesign.outcome import SiteDataError
from netdesign.site.columns.all_tables import (
    ANCHORS,
    ENDS,
    NETS,
    POSTS,
    RANGES,
    ROPES,
    SNOW,
)
from netdesign.site.reader import read_cells, read_site
from netdesign.site.tables import find_table, read_rows

PLANS = (NETS, RANGES, SNOW, ANCHORS, ROPES, POSTS, ENDS)
FACTORS = {
    "times 10": 10.0,
    "times 100": 100.0,
    "times 1000": 1000.0,
    "by 10": 0.1,
    "by 100": 0.01,
    "by 1000": 0.001,
}


@dataclass(frozen=True)
class Slip:
    kind: str
    place: str
    instead: dict[str, str]


def list_numbers(path):
    """Cells with numbers, sheet by sheet: by line number and heading."""
    workbook = read_cells(path)
    for plan in PLANS:
        table = find_table(workbook, plan, [])
        if table is None:
            continue
        found = {}
        for number, line in zip(table.rows, read_rows(table, []), strict=True):
            for key, reading in line.items():
                is_end = plan is RANGES and key in ("low", "high")
                if reading.cell is None or reading.cell.is_blank:
                    continue
                if is_end or isinstance(reading.value, float):
                    found[number, table.columns[key].number] = reading.cell
        yield table, found


def list_slips(path):
    for table, numbers in list_numbers(path):
        columns = sorted({column for _, column in numbers})
        for (row, column), cell in numbers.items():
            value = read(cell)
            if value is None:
                continue
            if value and not is_grouped(cell):
                for kind, factor in FACTORS.items():
                    text = f"{value * factor:.10g}"
                    yield Slip(kind, cell.place, {cell.place: text})
            index = columns.index(column)
            later = columns[index + 1 : index + 2]
            beside = numbers.get((row, later[0])) if later else None
            below = numbers.get((row + 1, column))
            for kind, other in (("column", beside), ("line", below)):
                if other is not None and other.text != cell.text:
                    swapped = {cell.place: other.text, other.place: cell.text}
                    yield Slip(f"swapped with the next {kind}", cell.place, swapped)
        yield from list_units(table, set(columns))


def read(cell):
    try:
        return float(cell.text.replace(",", ".").replace(" ", ""))
    except ValueError:
        return None


def is_grouped(cell):
    """A text such as 9.500, which this module would not read as the program does."""
    return isinstance(cell.value, str) and bool(re.search(r"[.' ]\d{3}", cell.text))


def list_units(table, filled):
    """Headings of filled columns, with the next unit that the column may have."""
    fields = {field.key: field for field in table.plan.fields}
    for key, column in table.columns.items():
        field, unit = fields[key], column.unit
        if column.number not in filled:
            continue
        heading = table.sheet.cell(table.heading_row, column.number)
        units = field.units
        if unit not in units or len(units) < 2 or unit not in heading.text:
            continue
        other = units[(units.index(unit) + 1) % len(units)]
        text = heading.text.replace(f"[{unit}]", f"[{other}]")
        if text != heading.text:
            yield Slip("unit", heading.place, {heading.place: text})


def is_noticed(path, slip, known):
    """Whether reading says a word; ``known`` are those on the sound workbook."""
    try:
        site = read_site(path, instead=slip.instead)
    except SiteDataError:
        return True
    return any(str(one) not in known for one in site.findings)


def list_known(path):
    return {str(one) for one in read_site(path).findings}
