"""Page, workbook, view and terminal say the same, check by check."""

import io

import pytest
from build_study import build_study
from reading import PageReader, read_rows, read_workbook
from rich.console import Console

from netdesign.report.excel import render_workbook
from netdesign.report.html import render_html
from netdesign.report.terminal import print_summary
from netdesign.report.view import build_view
from netdesign.report.words import VERDICTS, show_number

STUDY = build_study()


@pytest.fixture(scope="module")
def page():
    return PageReader(render_html(STUDY))


@pytest.fixture(scope="module")
def book():
    return read_workbook(render_workbook(STUDY))


def show(key, value):
    return value if isinstance(value, str) else show_number(key, value)


def test_checks_agree(page, book):
    sheet = iter(read_rows(book["Checks"], "No."))
    for row in build_view(STUDY).rows:
        (table,) = page.tables[f"{row.anchor}-checks"]
        for check, cells in zip(row.checks, table[1:], strict=True):
            line = next(sheet)
            assert cells[0] == f"{check.title} {check.source}"
            assert line["Clause"] in ("-", *check.source.split("; "))
            assert line["Resistance from"] in ("-", *check.source.split("; "))
            assert cells[1] == check.demand == show("demand_kN", line["E_d [kN]"])
            assert cells[2] == check.resistance == show("demand_kN", line["R_d [kN]"])
            low, high = (
                show("utilisation", line[f"μ {end}"]) for end in ("low", "high")
            )
            band = f"{low} to {high}" if check.bar else ""
            assert cells[3] == f"{show('utilisation', line['μ'])} {band}".strip()
            assert cells[4] == f"{check.verdict.symbol} {line['Verdict']}"
            assert cells[5].startswith(line["Reason"])


@pytest.mark.parametrize(
    ("section", "sheet", "attribute"),
    [("extremes", "Envelope", "extremes"), ("inputs", "Inputs", "inputs")],
)
def test_tables_agree(page, book, section, sheet, attribute):
    lines = read_rows(book[sheet], "Net row")
    for row in build_view(STUDY).rows:
        table = getattr(row, attribute)
        (shown,) = page.tables[f"{row.anchor}-{section}"]
        assert shown[0] == [column.heading for column in table.columns]
        assert shown[1:] == [[cell.text for cell in cells] for cells in table.rows]
        mine = [line for line in lines if line["Net row"] == row.id]
        for cells, line in zip(table.rows, mine, strict=True):
            for cell, value in zip(cells, list(line.values())[1:], strict=True):
                if cell.number is None:
                    assert value == cell.text
                else:  # a workbook stores 16 digits
                    assert value == pytest.approx(cell.number, rel=1e-15)


def test_verdicts_agree(page, book):
    stream = io.StringIO()
    print_summary(STUDY, Console(file=stream, width=200))
    lines = stream.getvalue().splitlines()
    summary = read_rows(book["Summary"], "No.")
    shown = [cells for cells in page.tables["summary"][0][1:] if len(cells) > 2]
    for index, row in enumerate(STUDY.rows):
        word = VERDICTS[row.verdict].word
        assert shown[index][1].endswith(f" {word}")
        assert summary[index]["Verdict"] == word
        assert word in lines[1 + index]
        assert shown[index][3] in lines[1 + index]
    overall = VERDICTS[STUDY.verdict].word
    assert book["Summary"]["C3"].value == overall
    assert lines[-1].startswith(f"Verdict: {overall}")
    assert f"{overall}" in "".join(page.text)


def test_provenance_agrees(page, book):
    cells = {line[0]: line[1] for line in page.tables["provenance"][0][1:]}
    sheet = {
        line["Item"]: line["Value"] for line in read_rows(book["Provenance"], "Item")
    }
    assert cells == sheet
    assert cells["Command"] == STUDY.provenance.command
    assert cells["Site file, SHA-256"] == STUDY.provenance.site_sha256
    assert cells["Limit profile, SHA-256"] == STUDY.profile.sha256
