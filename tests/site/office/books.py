"""Input workbooks with drawn values, written with openpyxl and no template."""

import openpyxl

from netdesign.site.columns.fields import SheetPlan
from netdesign.site.columns.office import PARTS, load_columns, load_plan
from netdesign.words.catalogue import render
from netdesign.words.message import say

MARKS = {"en": ".", "fr": ",", "de": ","}
UNIT = {"en": "unit", "fr": "unité", "de": "Einheit"}
EMPTY = {"en": "if empty", "fr": "si vide", "de": "wenn leer"}
TO = {"en": "to", "fr": "à", "de": "bis"}


def name_unit(column, measures, language):
    """Unit cell of a column: of several measures the one that is asked for."""
    if column.choice:
        measure = measures.get((column.field.table, column.field.key), "")
        return render(say(f"choice.{column.choice}.{measure}"), language)
    return column.unit if column.field.units else None


def say_value(column, value, language):
    """Value as a user of that language types it: a word, a range, a number."""
    if isinstance(value, tuple):
        low, high = (f"{end:g}".replace(".", MARKS[language]) for end in value)
        return f"{low} {TO[language]} {high}"
    if value in column.field.words:
        return render(column.field.name_word(value), language)
    return value


def write_office(path, tables, language="en", measures=None):
    """Workbook of lines by table and key; returns the cells of all values.

    ``measures`` has what the unit cells say, by table and key.
    """
    measures = {
        ("rows", "snow"): "vertical",
        ("net_types", "slack"): "slack",
        ("layers", "thickness"): "normal",
        **(measures or {}),
    }
    book = openpyxl.Workbook()
    book.remove(book.worksheets[0])
    places = {}
    for table, lines in tables.items():
        plan = load_plan(table)
        name = plan.name_in(language)
        sheet = book[name] if name in book.sheetnames else book.create_sheet(name)
        if table == "project":
            _write_project(sheet, plan, lines, language, places)
            continue
        if table in PARTS:
            sheet.append([None])
            sheet.append([f"block of {table}"])
        keys = list(dict.fromkeys(key for line in lines for key in line))
        columns = {one.field.key: one for one in load_columns(table)}
        sheet.append([columns[key].field.label_in(language) for key in keys])
        units = [name_unit(columns[key], measures, language) for key in keys]
        words = [columns[key].said or None for key in keys]
        if any(units):
            units[0] = (
                units[0] or {"en": "unit", "fr": "unité", "de": "Einheit"}[language]
            )
            sheet.append(units)
            words[0] = EMPTY[language]
            sheet.append(words)
        for number, line in enumerate(lines):
            row = sheet.max_row + 1
            for column, key in enumerate(keys, start=1):
                if key in line:
                    cell = sheet.cell(row, column)
                    cell.value = say_value(columns[key], line[key], language)
                    places[table, number, key] = (name, cell.coordinate)
    book.save(path)
    return places


def _write_project(sheet, plan: SheetPlan, lines, language, places):
    heads = {one.key: one.label_in(language) for one in plan.fields}
    sheet.append([heads["item"], heads["value"], heads["unit"]])
    columns = {one.field.key: one for one in load_columns("project")}
    for key, value in lines.items():
        column = columns[key]
        row = sheet.max_row + 1
        sheet.cell(row, 1).value = column.field.label_in(language)
        sheet.cell(row, 2).value = say_value(column, value, language)
        sheet.cell(row, 3).value = column.field.unit or None
        places["project", 0, key] = (sheet.title, f"B{row}")
