"""Page, workbook, view and terminal say the same, check by check."""

import html
import io
import json
import re

import pytest
from rich.console import Console

from netdesign.report.page.html import render_html
from netdesign.report.summary import build_summary
from netdesign.report.terminal import print_summary
from netdesign.report.view.whole import build_view
from netdesign.report.words import ENGLISH
from netdesign.report.workbook.excel import render_workbook
from netdesign.study.document import write_document
from tests.report.build_study import build_study
from tests.report.reading import PageReader, read_rows, read_workbook

STUDY = build_study()
NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e[+-]\d+)?")
MARKED = re.compile(NUMBER.pattern.replace(r"\.", "[.,]", 1))


@pytest.fixture(scope="module")
def page():
    return PageReader(render_html(STUDY))


@pytest.fixture(scope="module")
def book():
    return read_workbook(render_workbook(STUDY))


def show(key, value):
    return value if isinstance(value, str) else ENGLISH.show_number(key, value)


def told(page):
    return " ".join(" ".join(page.text).split())


def find_places(page, row):
    """Title, resistance and cell of each check of forces, and lines of the others."""
    table, *further = page.tables[f"{row.anchor}-checks"]
    lines = [cells for cells in table[1:] if len(cells) > 1]
    found = {}
    for line, cells in zip(row.lines, lines, strict=True):
        for check, cell in ((line.inside, cells[2]), (line.end, cells[3])):
            if check is None:
                assert cell == "-"
            else:
                found[check.title] = (cells[0], cells[1], cell)
    return found, [cells for one in further for cells in one]


def test_checks_agree(page, book):
    sheet = iter(read_rows(book["Checks"], "No."))
    for row in build_view(STUDY).rows:
        places, further = find_places(page, row)
        for check in row.checks:
            line = next(sheet)
            assert line["Clause"] in ("-", *check.source.split("; "))
            assert line["Resistance from"] in ("-", *check.source.split("; "))
            assert check.demand == show("demand_kN", line["E_d [kN]"])
            assert check.resistance == show("demand_kN", line["R_d [kN]"])
            word = f"{check.verdict.symbol} {line['Verdict']}"
            if check.title not in places:
                source = f" ({check.source})".removesuffix(" (-)")
                assert [word, check.title + source, line["Reason"]] in further
                continue
            title, resistance, shown = places[check.title]
            source = check.source.removeprefix("-")
            assert title.endswith(f" {source}".rstrip())
            assert resistance == check.resistance
            low, high = (
                show("utilisation", line[f"μ {end}"]) for end in ("low", "high")
            )
            band = f"{low} to {high} " if check.bar else ""
            used = f"{word} {show('utilisation', line['μ'])} {band}"
            assert shown.startswith(f"{used}E d {check.demand}")
            if check.verdict.style != "pass":
                assert line["Reason"] in told(page)


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
            parts = [part for cell in cells for part in split(cell)]
            shown_values = list(line.values())[
                1 : len(parts) + 1
            ]  # a hidden one follows
            for part, value in zip(parts, shown_values, strict=True):
                if isinstance(part, str):
                    assert value == part
                else:  # a workbook stores 16 digits
                    assert value == pytest.approx(part, rel=1e-15)


def split(cell):
    """What the workbook has of a cell: its number, both ends, or its text."""
    if cell.ends is not None:
        return list(cell.ends)
    return [cell.text if cell.number is None else cell.number]


@pytest.mark.parametrize(
    ("sheet", "attribute"),
    [
        ("Actions", "actions"),
        ("Statics", "statics"),
        ("Statics of the guideline", "floor_statics"),
        ("Resistances", "resistances"),
    ],
)
def test_figures_agree(page, book, sheet, attribute):
    """Page and sheet have the same numbers, the page with five digits at least."""
    lines = read_rows(book[sheet], "Net row")
    for row in build_view(STUDY).rows:
        table = getattr(row.figures, attribute)
        shown = [cell for one in page.tables[f"{row.anchor}-figures"] for cell in one]
        shown = {text for cells in shown for text in cells}
        mine = [line for line in lines if line["Net row"] == row.id]
        assert mine
        for cells, line in zip(table.rows, mine, strict=True):
            for cell, value in zip(cells, list(line.values())[1:], strict=True):
                assert cell.text in shown
                if cell.number is None:
                    assert value == cell.text
                else:
                    assert value == pytest.approx(cell.number, rel=1e-15)
                    assert float(cell.text) == pytest.approx(cell.number, rel=6e-5)


def test_verdicts_agree(page, book):
    stream = io.StringIO()
    print_summary(build_summary(STUDY), Console(file=stream, width=200))
    lines = stream.getvalue().splitlines()
    summary = read_rows(book["Summary"], "No.")
    shown = [cells for cells in page.tables["summary"][1][1:] if len(cells) > 2]
    for index, row in enumerate(STUDY.rows):
        word = ENGLISH(f"verdict.{row.verdict}")
        assert shown[index][1].endswith(f" {word}")
        assert summary[index]["Verdict"] == word
        assert word in lines[1 + index]
        assert shown[index][3] in lines[1 + index]
    overall = ENGLISH(f"verdict.{STUDY.verdict}")
    assert book["Summary"]["C3"].value == overall
    assert lines[-1].startswith(f"Verdict: {overall}")
    assert f"{overall}" in "".join(page.text)


def as_cell(value):
    """What a cell of the workbook holds of a number, or of none."""
    return "-" if value is None else pytest.approx(value, rel=1e-12)


def test_json_document_and_stdout_agree_with_page_and_workbook(page, book):
    document = json.loads(write_document(STUDY))
    stream = io.StringIO()
    print_summary(build_summary(STUDY), Console(file=stream, width=200))
    printed = stream.getvalue().splitlines()[1:]
    sheet = iter(read_rows(book["Checks"], "No."))
    summary = [cells for cells in page.tables["summary"][1][1:] if len(cells) > 2]
    for number, row in enumerate(document["rows"]):
        view = build_view(STUDY).rows[number]
        places, _ = find_places(page, view)
        for check, title in zip(
            row["checks"], [one.title for one in view.checks], strict=True
        ):
            line = next(sheet)
            for key, heading in (
                ("demand_kN", "E_d [kN]"),
                ("resistance_kN", "R_d [kN]"),
                ("utilisation", "μ"),
            ):
                assert line[heading] == as_cell(check[key])
            if title in places:
                _, resistance, shown = places[title]
                assert resistance == ENGLISH.show_number(
                    "resistance_kN", check["resistance_kN"]
                )
                demand = ENGLISH.show_number("demand_kN", check["demand_kN"])
                assert f"E d {demand}" in shown
                used = ENGLISH.show_number("utilisation", check["utilisation"])
                assert f" {used} " in shown
        for text in summary[number][3:5]:
            assert text in printed[number]
        ratio, *band = summary[number][5].split(maxsplit=1)
        assert ratio in printed[number]
        assert all(text in printed[number] for text in band)


def test_all_cases_of_the_document_stand_in_the_workbook(book):
    lines = iter(read_rows(book["Cases"], "Net row"))
    for row in json.loads(write_document(STUDY))["rows"]:
        for case in row["cases"]:
            line = next(lines)
            for key, heading in (
                ("foot_anchor_kN", "Foot anchor [kN]"),
                ("error_percent", "Estimated error [%]"),
                ("balance_residual", "Balance residual"),
            ):
                assert line[heading] == as_cell(case[key])


@pytest.mark.parametrize("language", ["fr", "de"])
def test_languages_show_the_same_numbers_and_keys(page, language):
    other = PageReader(render_html(STUDY, language))
    assert other.ids == page.ids
    for section, tables in page.tables.items():
        for table, theirs in zip(tables, other.tables[section], strict=True):
            for cells, shown in zip(table, theirs, strict=True):
                for cell, text in zip(cells, shown, strict=True):
                    numbers = [
                        [found.replace(",", ".") for found in MARKED.findall(one)]
                        for one in (cell, text)
                    ]
                    assert numbers[0] == numbers[1]


def list_strings(part):
    """Texts of a document: names, clauses, what somebody typed."""
    if isinstance(part, dict | list):
        parts = part.values() if isinstance(part, dict) else part
        return [text for one in parts for text in list_strings(one)]
    return [part] if isinstance(part, str) else []


@pytest.mark.parametrize("language", ["fr", "de"])
def test_only_what_somebody_typed_has_a_point_in_french_and_german(language):
    """Clauses, types, cells and versions are as typed; numbers of ours never are."""
    page = re.sub(r"<style.*?</style>", "", render_html(STUDY, language), flags=re.S)
    labels = " ".join(re.findall(r'aria-label="([^"]*)"', page))
    text = html.unescape(re.sub(r"<[^>]*>", " ", page) + labels)
    assert len(re.findall(r"\d,\d", text)) > 500
    document = json.loads(write_document(STUDY))
    del document["provenance"]["settings"]["accuracy"]  # a number, stored as a text
    typed = " ".join(list_strings(document))
    pointed = set(re.findall(r"[\w.+-]*\d\.\d[\w.+-]*", text))
    assert {one for one in pointed if one not in typed} <= set(
        STUDY.provenance.libraries.values()
    )


def test_provenance_agrees(page, book):
    cells = {line[0]: line[1] for line in page.tables["provenance"][0][1:]}
    sheet = {
        line["Item"]: line["Value"] for line in read_rows(book["Provenance"], "Item")
    }
    assert cells == sheet
    assert cells["Command"] == STUDY.provenance.command
    assert cells["Site file, SHA-256"] == STUDY.provenance.site_sha256
    assert cells["Limit profile, SHA-256"] == STUDY.profile.sha256
