"""Slips of the pen in a workbook: one number is altered, and who notices it.

Altered are all numbers that a verdict rests on: times and by 10, 100 and 1000, taken
for the number beside or below it, the heading's unit taken for the next one.
"""

from dataclasses import dataclass

from netdesign.outcome import SiteDataError
from netdesign.site.office.sheets import find_office_tables
from netdesign.site.reader import read_cells, read_site

TABLES = ("project", "rows", "net_types", "anchor_types", "ropes", "posts")
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
    """Cells with numbers, table by table: by line number and column."""
    found = find_office_tables(read_cells(path), [])
    for name in TABLES:
        table = found.tables[name]
        if table is None:
            continue
        yield {
            (number, reading.cell.column): reading.cell
            for number, line in zip(table.rows, found.lines[name], strict=True)
            for reading in line.values()
            if reading.cell is not None and isinstance(reading.cell.value, int | float)
        }


def list_slips(path):
    for numbers in list_numbers(path):
        columns = sorted({column for _, column in numbers})
        for (row, column), cell in numbers.items():
            for kind, factor in FACTORS.items() if cell.value else ():
                text = f"{cell.value * factor:.10g}"
                yield Slip(kind, cell.place, {cell.place: text})
            later = columns[columns.index(column) + 1 :][:1]
            beside = numbers.get((row, later[0])) if later else None
            below = numbers.get((row + 1, column))
            for kind, other in (("column", beside), ("line", below)):
                if other is not None and other.text != cell.text:
                    swapped = {cell.place: other.text, other.place: cell.text}
                    yield Slip(f"swapped with the next {kind}", cell.place, swapped)


def is_noticed(path, slip, known):
    """Whether reading says a word; ``known`` are those on the sound workbook."""
    try:
        site = read_site(path, instead=slip.instead)
    except SiteDataError:
        return True
    return any(str(one) not in known for one in site.findings)


def list_known(path):
    return {str(one) for one in read_site(path).findings}


def is_asked(path, slip):
    try:
        return bool(read_site(path, instead=slip.instead).questions)
    except SiteDataError:
        return True
