"""The table of USAGE.md on empty cells, from the columns of the input workbook.

``python -m tests.site.columns.empty_cells`` writes it into USAGE.md.
"""

from pathlib import Path

import netdesign
from netdesign.site.columns.all_tables import load_file
from netdesign.site.columns.office import PARTS, TABLES, load_columns
from netdesign.site.template.form import say_empty
from netdesign.words.catalogue import render
from netdesign.words.message import say

USAGE = Path(netdesign.__file__).parent / "USAGE.md"
HEAD = ("| sheet | columns | if empty |", "|---|---|---|")


def build_table():
    """Lines of the table: one for each thing that empty cells of a sheet mean."""
    lines = list(HEAD)
    for table in TABLES:
        by_meaning = {}
        for column in load_columns(table):
            means = say_empty(column, "en") or "refused"
            by_meaning.setdefault(means, []).append(name_column(column))
        lines += [
            f"| {name_table(table)} | {'; '.join(names)} | {means} |"
            for means, names in by_meaning.items()
        ]
    return "\n".join(lines) + "\n"


def name_column(column):
    """Name with the unit that the template shows, where there is one."""
    name = render(column.field.name, "en")
    return f"{name} [{column.unit}]" if column.unit.strip("-") else name


def name_table(table):
    """Title of a sheet; of a block of sheet Parts, that of the block."""
    if table in PARTS:
        return load_file("office")["sheets"][table]["about"]["en"]
    return render(say(f"sheet.{table}"), "en")


def find_table(text):
    """Table as it stands in a text: from its head to the first blank line."""
    start = text.index(HEAD[0])
    return text[start : text.index("\n\n", start) + 1]


def write_table():
    """Put the table in the place of the one that stands in USAGE.md."""
    text = USAGE.read_text(encoding="utf-8")
    USAGE.write_text(text.replace(find_table(text), build_table()), encoding="utf-8")


if __name__ == "__main__":
    write_table()
