"""Writes the input workbook of `site/columns/office.toml`, empty or with lines."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from importlib.resources import files
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from netdesign.checks import list_standards
from netdesign.edge.input_files import find_resource
from netdesign.edge.output import write_files
from netdesign.site.columns.all_tables import (
    MONITORING,
    UNCERTAINTY,
    WINTER,
    load_file,
)
from netdesign.site.columns.office import (
    PARTS,
    PROJECT_HEADS,
    Column,
    load_columns,
    load_plan,
    name_measure,
)
from netdesign.site.declared_sheet import GROUPS, name_group
from netdesign.site.template.form import (
    Form,
    Tables,
    add_sheet,
    count_lines,
    find_plan,
    is_further,
    list_shown,
    name_column,
    say_accepted,
    say_empty,
    say_unit,
    say_why,
    start_workbook,
    write_about,
)
from netdesign.words.catalogue import Language, render
from netdesign.words.message import say

if TYPE_CHECKING:  # slow to import and only needed to write a workbook
    from xlsxwriter.worksheet import Worksheet

DEFAULT = ("project", "rows", "net_types", "anchor_types")
WITH: Mapping[str, str] = {
    **{"snow": "layers", "tests": "tests", "parts": "parts", "declared": "declared"},
    **{"winter": WINTER.name, "monitoring": MONITORING.name},
    "reliability": UNCERTAINTY.name,
}
_FIRST = 5  # row of the first line, from 0: title, groups, names, units, if empty
_LINES = 24  # of a sheet of an add-on
_WIDE = 18  # columns, of a sheet whose headings are narrow
_NOTE = {"x_scale": 1.6, "y_scale": 0.8, "font_size": 9, "author": ""}


def render_input(
    tables: Tables,
    language: Language = "en",
    more: Sequence[str] = (),
    measures: Mapping[tuple[str, str], str] | None = None,
    notes: Sequence[Mapping[str, str]] = (),
) -> bytes:
    """Input workbook with some lines; the same bytes each time.

    Parameters
    ----------
    tables : mapping
        Lines by table and key, as `office.toml` has them; words in English.
    language : str
        Of sheets, headings, words and notes: ``en``, ``fr`` or ``de``.
    more : sequence of str
        Further sheets, by their names in `WITH`; those with lines are always there.
    measures : mapping, optional
        What the unit cell of a column says it measures, by table and key.
    notes : sequence of mapping
        On cells of the rows, in their order, by key.
    """
    content = BytesIO()
    workbook = start_workbook(content, language)
    sheets = [*DEFAULT, *_list_further(tables, more)]
    form = Form(workbook, language, sheets, tables, measures or {})
    for sheet in form.sheets:
        _write(form, sheet)
    _write_notes(form)
    rows = workbook.worksheets()[1]
    keys = [column.field.key for column in list_shown(form, "rows")]
    size = {"x_scale": 2.4, "y_scale": 1.6, "author": ""}
    for line, of_line in enumerate(notes, start=_FIRST):
        for key, note in of_line.items():
            rows.write_comment(line, keys.index(key), note, size)
    rows.activate()
    workbook.close()
    return content.getvalue()


def _list_further(tables: Tables, more: Sequence[str]) -> Iterator[str]:
    """Sheets beside the usual ones: asked for, or with lines."""
    nets = load_columns("net_types")
    structure = {column.field.key for column in nets if column.group == "structure"}
    is_built = any(structure & net.keys() for net in tables.get("net_types", ()))
    for name, sheet in WITH.items():
        is_parts = name == "parts"
        has_lines = any(map(tables.get, PARTS if is_parts else (sheet,)))
        if name in more or has_lines or (is_parts and is_built):
            yield sheet


def _write(form: Form, name: str) -> None:
    table = PARTS[0] if name == "parts" else name
    title = find_plan(table).name_in(form.language)
    sheet = add_sheet(form, title)
    sheet.set_margins(0.4, 0.4, 0.5, 0.6)
    sheet.set_footer(f"&L&F&R{form.text('page')} &P / &N")
    sheet.write_string(0, 0, title, form.style("title"))
    sheet.set_row(0, 20)
    if name == "project":
        _write_project(form, sheet)
    elif name == "parts":
        _write_parts(form, sheet)
    else:
        _write_table(form, sheet, name)


def _write_table(form: Form, sheet: Worksheet, table: str) -> None:
    columns = list_shown(form, table)
    if not is_further(table):
        about = load_file("office")["sheets"][table]["about"][form.language]
        sheet.write_string(0, 2, about, form.style("about"))
    group = ""
    for number, column in enumerate(columns):
        sheet.write_blank(
            1, number, None, form.style("group" if column.group else "bold")
        )
        if column.group and column.group != group:
            group = column.group
            sheet.write_string(
                1, number, form.text(group, "groups"), form.style("group")
            )
        sheet.set_column(number, number, _find_width(form, column, len(columns)))
    _write_block(form, sheet, _FIRST - 3, columns, table)
    if len(columns) > 15:
        sheet.set_zoom(90)
    sheet.freeze_panes(_FIRST, 1)
    sheet.repeat_rows(0, _FIRST - 1)


def _write_parts(form: Form, sheet: Worksheet) -> None:
    sheet.write_string(0, 1, form.text("parts"), form.style("about"))
    row = 2
    for table in PARTS:
        about = load_file("office")["sheets"][table]["about"][form.language]
        columns = list_shown(form, table)
        heads = [about, *[""] * (len(columns) - 1)]
        sheet.write_row(row, 0, heads, form.style("group"))
        _write_block(form, sheet, row + 1, columns, table)
        row += 5 + _count_lines(form, table)
    sheet.set_column(0, 0, 15)
    sheet.set_column(1, 11, 11)


def _count_lines(form: Form, table: str) -> int:
    """Number of lines of a form: at least the usual, and four beyond the filled."""
    usual: int = load_file("office")["sheets"].get(table, {}).get("lines", _LINES)
    return max(usual, len(form.tables.get(table, ())) + 4)


def _write_block(
    form: Form, sheet: Worksheet, row: int, columns: Sequence[Column], table: str
) -> None:
    """Write headings, units and assumed values, and below them the lines."""
    count = _count_lines(form, table)
    last = row + 2 + count
    sheet.set_row(row, 30 if len(columns) < _WIDE else 52)
    sheet.set_row(row + 2, 34 if len(columns) < _WIDE else 44)
    for number, column in enumerate(columns):
        _write_heading(form, sheet, row, number, column)
        for line in range(row + 3, last + 1):
            sheet.write_blank(line, number, None, form.style_cell(column))
        if column.need:
            _mark_missing(form, sheet, (row + 3, number, last), column, len(columns))
        if rule := _say_rule(form, column):
            sheet.data_validation(row + 3, number, last, number, rule)
    numbers = {column.field.key: number for number, column in enumerate(columns)}
    for line, cells in enumerate(form.tables.get(table, ()), start=row + 3):
        for key, value in cells.items():
            if key in numbers and value != "":
                _write_value(
                    form, sheet, line, numbers[key], columns[numbers[key]], value
                )


def _write_heading(
    form: Form, sheet: Worksheet, row: int, number: int, column: Column
) -> None:
    style = "head yes" if column.need else "head"
    sheet.write_string(row, number, name_column(form, column, True), form.style(style))
    sheet.write_comment(row, number, _say_note(form, column), _NOTE)
    label = form.text("unit") if number == 0 else say_unit(form, column)
    style = "unit yes" if column.choice else "unit"
    sheet.write_string(row + 1, number, label, form.style(style))
    if column.choice:
        names = [
            name_measure(column.choice, measure, form.language)
            for measure in load_file("office")["choices"][column.choice]
        ]
        rule = {
            "validate": "list",
            "source": names,
            "input_message": form.text("choose"),
        }
        sheet.data_validation(row + 1, number, row + 1, number, rule)
    empty = form.text("empty") if number == 0 else say_empty(column, form.language)
    sheet.write_string(row + 2, number, empty, form.style("empty"))


def _write_value(
    form: Form, sheet: Worksheet, row: int, number: int, column: Column, value: object
) -> None:
    style = form.style_cell(column)
    if isinstance(value, Mapping):
        value = value[form.language]
    if isinstance(value, str):
        sheet.write_string(row, number, _translate(form, column, value), style)
    else:
        sheet.write_number(row, number, value, style)


def _translate(form: Form, column: Column, value: str) -> str:
    """Translate a word into the language of the workbook; ids and names stay."""
    if value in column.field.words:
        return render(column.field.name_word(value), form.language)
    is_check = (column.field.table, column.field.key) == ("declared", "check")
    return name_group(value, form.language) if is_check and value in GROUPS else value


def _mark_missing(
    form: Form,
    sheet: Worksheet,
    place: tuple[int, int, int],
    column: Column,
    count: int,
) -> None:
    """Show needed cells yellow while empty, in the first line and in begun lines."""
    from xlsxwriter.utility import xl_col_to_name as letter

    first, number, last = place
    line = f"$A{first + 1}:${letter(count - 1)}{first + 1}"
    cell = f"{letter(number)}{first + 1}"
    rule = f'AND({cell}="",OR(COUNTA({line})>0,ROW()={first + 1}))'
    is_proof = column.field.key in ("pull_out", "proven")
    if is_proof and column.field.table == "anchor_types" and "tests" in form.sheets:
        tests = load_plan("tests").name_in(form.language)
        end = _FIRST + _count_lines(form, "tests")
        ids = f"'{tests}'!$A${_FIRST + 1}:$A${end}"
        rule = f"AND({rule},COUNTIF({ids},$A{first + 1})=0)"
    sheet.conditional_format(
        *(first, number, last, number),
        {"type": "formula", "criteria": f"={rule}", "format": form.style("missing")},
    )


def _say_rule(form: Form, column: Column) -> dict[str, Any] | None:
    """Drop-down of a cell, or a prompt with accepted content and assumed value."""
    accepted = say_accepted(column, form.language)
    is_number = column.field.kind in ("number", "count")
    empty = say_empty(column, form.language)
    lines = [
        f"{form.text(key)}: {text}"
        for key, text in (("accepted", accepted if is_number else ""), ("empty", empty))
        if text
    ]
    rule: dict[str, Any] = {"validate": "any"}
    names = _list_choices(form, column)
    if names:
        rule = {"validate": "list", "source": names, "error_type": "warning"}
    if lines:
        title = name_column(form, column)[:32]
        rule |= {"input_title": title, "input_message": "\n".join(lines)[:255]}
    return rule if names or lines else None


def _list_choices(form: Form, column: Column) -> list[str] | str:
    """Words of a cell, or the cells of the ids that it may name."""
    own = column.field
    if own.words:
        return [render(own.name_word(word), form.language) for word in own.words]
    if (own.table, own.key) == ("project", "standard"):
        return list(list_standards())
    if (own.table, own.key) == ("declared", "check"):
        return [name_group(group, form.language) for group in GROUPS]
    table = own.refers_to
    if table not in form.sheets:
        return []
    name = load_plan(table).name_in(form.language)
    return f"='{name}'!$A${_FIRST + 1}:$A${_FIRST + _count_lines(form, table)}"


def _say_note(form: Form, column: Column) -> str:
    if not column.has:  # of a sheet of an add-on
        return column.texts["note"][form.language]
    source = say_why(column, form.language)
    stated = (form.text("source"), source) if source else None
    label, text = stated or (form.text("has"), form.text(column.has, "who"))
    return f"{column.texts['note'][form.language]}\n{label}: {text}."


def _find_width(form: Form, column: Column, count: int) -> float:
    """Width of a column for the longest word of its heading, and for its cells."""
    words = name_column(form, column, True).replace("/", " ").split()
    least = 14.0 if count < 9 else 7.5 if count < _WIDE else 6.4
    if column.field.refers_to or column.field.words:
        least = max(least, 10.5)
    return max(least, column.width, 1.15 * max(map(len, words)) + 1.0)


def _write_project(form: Form, sheet: Worksheet) -> None:
    """Write sheet Project, whose lines hold for the whole site."""
    sheet.write_string(0, 2, form.text("range"), form.style("about"))
    heads = {
        field.key: field.label_in(form.language)
        for field in load_plan("project").fields
    }
    widths = (27, 34, 8, 24, 30, 15, 52)
    for number, (key, width) in enumerate(zip(PROJECT_HEADS, widths, strict=True)):
        sheet.write_string(2, number, heads[key], form.style("head"))
        sheet.set_column(number, number, width)
    (project,) = form.tables.get("project") or ({},)
    for row, column in enumerate(load_columns("project"), start=3):
        sheet.set_row(row, 26)
        style = "head yes" if column.need else "head"
        sheet.write_string(row, 0, name_column(form, column), form.style(style))
        sheet.write_blank(row, 1, None, form.style_cell(column))
        if project.get(column.field.key, "") != "":
            _write_value(form, sheet, row, 1, column, project[column.field.key])
        if column.need:
            rule = {"type": "blanks", "format": form.style("missing")}
            sheet.conditional_format(row, 1, row, 1, rule)
        if (rule_of_cell := _say_rule(form, column)) is not None:
            sheet.data_validation(row, 1, row, 1, rule_of_cell)
        write_about(form, sheet, (row, 2), PROJECT_HEADS[2:], column)
    sheet.freeze_panes(3, 1)
    sheet.repeat_rows(0, 2)


_NOTE_KEYS = ("item", "unit", "accepted", "empty", "has", "meaning")
_NOTE_WIDTHS = (13, 25, 12, 16, 27, 15, 62)
_PICTURE_ROW, _PICTURE_ROWS = 6, 22


def _write_notes(form: Form) -> None:
    """Sheet Notes: colours, the section with its names, every column."""
    sheet = add_sheet(form, render(say("sheet.notes"), form.language))
    for number, width in enumerate(_NOTE_WIDTHS):
        sheet.set_column(number, number, width)
    sheet.write_string(0, 0, form.text("title"), form.style("title"))
    sheet.write_blank(2, 0, None, form.style("yes"))
    sheet.write_string(2, 1, form.text("needed"))
    sheet.write_blank(3, 0, None, form.style("cell"))
    sheet.write_string(3, 1, form.text("optional"))
    sheet.write_string(4, 0, form.text("range"))
    sheet.write_string(5, 0, form.text("section"), form.style("bold"))
    picture = files(__package__).joinpath(f"section.{form.language}.png").read_bytes()
    options = {"image_data": BytesIO(picture), "description": form.text("section")}
    scale = {"x_scale": 0.6, "y_scale": 0.6, "object_position": 3}
    sheet.insert_image(_PICTURE_ROW, 0, "section.png", options | scale)
    row = _PICTURE_ROW + _PICTURE_ROWS + 1
    for name in (name for name in form.sheets if not is_further(name)):
        for table in PARTS if name == "parts" else (name,):
            row = _write_meanings(form, sheet, row, table) + 1


def _write_meanings(form: Form, sheet: Worksheet, row: int, table: str) -> int:
    """Columns of a table with what they mean; returns the row below."""
    plan = load_plan(table)
    title = plan.name_in(form.language)
    if table in PARTS:
        about = load_file("office")["sheets"][table]["about"][form.language]
        title = f"{title}: {about}"
    titles = [title, *[""] * (len(_NOTE_WIDTHS) - 1)]
    sheet.write_row(row, 0, titles, form.style("group"))
    sheet.write_row(row + 1, 0, ["", *map(form.text, _NOTE_KEYS)], form.style("head"))
    columns = list_shown(form, table)
    for line, column in enumerate(columns, start=row + 2):
        sheet.write_blank(line, 0, None, form.style("yes" if column.need else "cell"))
        texts = write_about(form, sheet, (line, 1), _NOTE_KEYS, column)
        lines = max(map(count_lines, texts, _NOTE_WIDTHS[1:]))
        sheet.set_row(line, 13.0 * lines)
    return row + 2 + len(columns)


INPUT_EXAMPLE_FILE = "example_input.toml"


def load_input_example() -> dict[str, Sequence[Mapping[str, object]]]:
    """Lines of the example site, by table and key of `site/columns/office.toml`."""
    file = find_resource("templates") / INPUT_EXAMPLE_FILE
    tables = tomllib.loads(file.read_text(encoding="utf-8"))
    project = tables.pop("project")
    return {
        "project": [project],
        **{
            name: [
                dict(zip(table["columns"], line, strict=False))
                for line in table["lines"]
            ]
            for name, table in tables.items()
        },
    }


def write_site_workbook(
    path: str | Path,
    *,
    example: bool = False,
    overwrite: bool = False,
    language: Language = "en",
    more: Sequence[str] = (),
) -> None:
    """Write an input workbook to fill in, or the built-in example site.

    Parameters
    ----------
    path : str or Path
        The xlsx file to write.
    example : bool
        Fill in the example site.
    overwrite : bool
        Replace a file that exists.
    language : str
        Of sheets, headings, words and notes: ``en``, ``fr`` or ``de``. The importer
        reads all three.
    more : sequence of str
        Further sheets: ``snow``, ``tests``, ``parts``, ``declared``, or of an add-on.

    Raises
    ------
    OutputError
        If the file exists and may not be replaced, or cannot be written.
    """
    tables = load_input_example() if example else {}
    content = render_input(tables, language, more)
    write_files({Path(path): content}, overwrite=overwrite)
