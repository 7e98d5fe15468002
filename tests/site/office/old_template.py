"""Workbooks of version 0.1, with a sheet Nets, as its template had them."""

import tomllib
from pathlib import Path

import xlsxwriter

from netdesign.site.columns.all_tables import load_old_plans
from netdesign.words.catalogue import render
from tests.make import name_heading

_FILE = Path(__file__).with_name("old_example.toml")


def load_example():
    """Lines of its example by sheet, as new each time."""
    return tomllib.loads(_FILE.read_text(encoding="utf-8"))


def write_old(path, lines, language="en"):
    """Workbook of lines by sheet and key, with every column of version 0.1."""
    book = xlsxwriter.Workbook(str(path))
    for name, plan in load_old_plans().items():
        sheet = book.add_worksheet(plan.name_in(language))
        for column, field in enumerate(plan.fields):
            sheet.write_string(0, column, name_heading(field, language))
            for row, line in enumerate(lines.get(name, ()), start=1):
                value = line.get(field.key)
                if value is not None:
                    sheet.write(row, column, _say(plan, field, value, language))
    book.close()
    return path


def _say(plan, field, value, language):
    """Word, item or quantity in a language; ids and names stay."""
    if value in field.words:
        return render(field.name_word(value), language)
    named = (one for one in plan.items if value in (one.key, one.label))
    return next((one.label_in(language) for one in named), value)
