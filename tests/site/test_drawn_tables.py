"""Drawn tables of anchor types: every cell is read as it was typed, or asked for."""

from decimal import Decimal

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from openpyxl.worksheet.cell_range import CellRange

from netdesign.site.cells.cells import Cell, Sheet, Workbook, group_by_row
from netdesign.site.columns.fields import convert_unit
from netdesign.site.columns.office import load_plan
from netdesign.site.tables import find_table, read_rows

PLAN = load_plan("anchor_types")
SHEET = PLAN.name_in("en")
MEASURED = [field for field in PLAN.fields if field.kind == "number" and field.units]
SHOWN = {"deg": "°", "m": "m", "kN/m": "kN/ml", "-": "-", "%": "%", "gon": "gon"}
STRANGE = ("Observations", "Lieu-dit", "Prix (CHF)", "Masse [t]", "Datum", "Fornitore")
PARTS = ("Secteur Nord", "Abschnitt Ost", "Settore 2", "Zone A")
TOTALS = ("Total", "Sous-total", "Zwischensumme", "Summe", "Totale")


@st.composite
def columns(draw):
    """A field, its heading in some language, where its unit stands, that unit."""
    chosen = draw(
        st.lists(
            st.sampled_from(MEASURED), min_size=3, unique_by=lambda field: field.key
        )
    )
    drawn = []
    for field in chosen:
        name = draw(st.sampled_from(field.raw_names))
        unit = draw(st.sampled_from(field.units))
        place = draw(st.sampled_from(["heading", "cells", "units row"]))
        drawn.append((field, name, unit, place))
    if any(place == "units row" for *_, place in drawn):
        drawn = [
            (*one[:3], "units row" if one[3] == "cells" else one[3]) for one in drawn
        ]
    return drawn


def draw_value(draw, field, unit):
    """A number within the bounds, with few decimals, in a unit."""
    low, high = field.bounds
    for _ in range(20):
        digits = draw(st.integers(min_value=-2000, max_value=90000))
        number = Decimal(digits).scaleb(-draw(st.integers(0, 2)))
        if low <= convert_unit(float(number), unit, field.unit) <= high:
            return number
    return None


@st.composite
def tables(draw):
    """Lines of a messy sheet, and what each of its numbers is."""
    fields = draw(columns())
    strangers = draw(st.lists(st.sampled_from(STRANGE), unique=True, max_size=2))
    order = draw(st.permutations([*fields, *strangers]))
    id_heading = draw(st.sampled_from(["anchor type", "ANKERTYP", "Type d'ancrage"]))
    headings, units = [id_heading], [None]
    for one in order:
        if isinstance(one, str):
            headings.append(one)
            units.append(None)
            continue
        _, name, unit, place = one
        is_above = place == "heading" and unit != "-"
        headings.append(f"{name} [{SHOWN.get(unit, unit)}]" if is_above else name)
        units.append(SHOWN.get(unit, unit) if place == "units row" else None)
    lines = [["Titre"], headings]
    if any(units):
        lines.append(units)
    truth = {}
    for number in range(draw(st.integers(1, 3))):
        if draw(st.booleans()):
            lines.append([draw(st.sampled_from(PARTS))])
        cells = [draw_cell(draw, one, truth, f"R{number}") for one in order]
        lines.append([f"R{number}", *cells])
        if draw(st.booleans()):
            lines.append([draw(st.sampled_from(TOTALS))])
    return lines, truth, strangers


def draw_cell(draw, column, truth, row):
    """What is typed into a cell; its value goes to ``truth`` by row and key."""
    if isinstance(column, str):
        return "x"
    field, _, unit, place = column
    number = draw_value(draw, field, unit)
    if number is None:
        return None
    truth[row, field.key] = convert_unit(float(number), unit, field.unit)
    text = str(number)
    if draw(st.booleans()):
        text = text.replace(".", ",")
    if place == "cells" and unit != "-":
        return f"{text}{draw(st.sampled_from(['', ' ']))}{SHOWN.get(unit, unit)}"
    return draw(st.sampled_from([text, float(number)]))


def put_in_sheet(lines):
    cells = [
        Cell(file="f.xlsx", sheet=SHEET, row=row, column=column, value=one)
        for row, line in enumerate(lines, start=1)
        for column, one in enumerate(line, start=1)
        if one is not None
    ]
    title = CellRange("A1:D1")
    sheet = Sheet(
        file="f.xlsx",
        name=SHEET,
        rows=group_by_row(cells),
        merged=(title,),
    )
    return Workbook(file="f.xlsx", sha256="", sheets=(sheet,), unread=())


@settings(max_examples=120)
@given(tables())
def test_every_number_is_read_as_typed_or_asked_for_and_every_column_told(drawn):
    lines, truth, strangers = drawn
    findings = []
    table = find_table(put_in_sheet(lines), PLAN, findings)
    assert table is not None
    rows = {row["id"].word: row for row in read_rows(table, findings)}
    faults = [one for one in findings if one.severity == "error"]
    told = {(one.cell, one.text) for one in findings}
    for (row, key), value in truth.items():
        reading = rows[row][key]
        if reading.state == "given":
            assert reading.value == pytest.approx(value, rel=1e-12, abs=1e-12)
        else:  # the field is required or its column is asked for: never left silently
            assert reading.state == "faulty" or faults
    for row, readings in rows.items():  # and nothing that nobody typed
        given_keys = {key for key, one in readings.items() if one.state == "given"}
        assert given_keys - {"id"} <= {key for name, key in truth if name == row}
    for heading in strangers:
        assert any(heading in text for _, text in told)


@settings(max_examples=150)
@given(st.permutations(range(len(PLAN.fields))), st.data())
def test_a_heading_never_gives_two_columns(order, data):
    """Two columns of one field are refused, whatever their headings."""
    field = PLAN.fields[order[0]]
    one, other = (data.draw(st.sampled_from(field.raw_names)) for _ in range(2))
    lines = [["anchor type", one, other], ["R1", 3, 4]]
    findings = []
    table = find_table(put_in_sheet(lines), PLAN, findings)
    if field.key == "id":
        assert any("again" in str(finding.rule) for finding in findings)
        return
    assert any(
        finding.cell == "C1" and finding.severity == "error" for finding in findings
    )
    assert table.columns[field.key].number == 2
