"""Page, workbook, view and terminal say the same, check by check."""

import html
import io
import json
import re

import pytest
from rich.console import Console

from netdesign.report.page.html import render_html
from netdesign.report.sections.checks import (
    describe_resistance,
    list_lines,
    part_lines,
)
from netdesign.report.sections.quality import build_bounds
from netdesign.report.sections.scopes import describe_scopes, show_scope
from netdesign.report.terminal import print_summary
from netdesign.report.words import ENGLISH, VERDICTS, show_check
from netdesign.report.workbook.excel import render_workbook
from netdesign.study.document import write_document
from netdesign.study.governing import find_governing
from netdesign.study.scopes import SCOPES
from tests.report.build_study import build_study
from tests.report.reading import PageReader, read_checks, read_rows, read_workbook

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


def find_places(page, number):
    """Type, resistance, demand and utilisation of each check of forces, by title.

    Those told beside the table have type and demand of their member's line.
    """
    row = STUDY.rows[number]
    table, *_ = page.tables[f"row-{number + 1}-checks"]
    lines = [cells for cells in table[1:] if len(cells) > 1]
    found, shared = {}, {}
    alone, beside = part_lines(list(list_lines(row.checks)))
    for line, cells in zip(alone, lines, strict=True):
        shared.setdefault(line.demands, (cells[1], [cells[3], cells[5]]))
        for check, place in ((line.inside, cells[3:5]), (line.end, cells[5:7])):
            if check is None:
                assert place == ["-", "-"]
            else:
                used = place[1].split(" (")[0]  # near the limit with its interval
                found[show_check(ENGLISH, check)] = [*cells[1:3], place[0], used]
    for line in (one for lines in beside.values() for one in lines):
        text, (kind, demands) = line.describe(ENGLISH), shared[line.demands]
        assert text in told(page)
        first, _, ratios = text.rpartition(", ")
        resistance = first.rpartition(" ")[2]
        for check, demand, used in zip(
            (line.inside, line.end), demands, ratios.split(" / "), strict=True
        ):
            if check is not None:
                title = show_check(ENGLISH, check)
                found[title] = [kind, resistance, demand, used]
    return found


def read_step(book, check, symbol):
    """Value of a step of a check in the workbook; "-" where it has no such step."""
    line = check.steps.get(symbol)
    return book["Checks"][f"H{line}"].value if line else "-"


def test_checks_agree(page, book):
    sheet = iter(read_checks(book["Checks"]))
    for number, row in enumerate(STUDY.rows):
        places = find_places(page, number)
        for check in row.checks:
            line = next(sheet)
            assert (check.clause or "") in line.told
            assert line.resistance == describe_resistance(check, ENGLISH)
            assert line.verdict == ENGLISH(f"verdict.{check.verdict}")
            title = show_check(ENGLISH, check)
            assert (line.row, line.name) == (row.id, title)
            if title not in places:
                assert not check.is_of_force
                assert title in told(page)
                continue
            kind, resistance, demand, used = places[title]
            assert kind == (check.resistance_type or "-")
            assert resistance == show("resistance_kN", read_step(book, line, "R_d"))
            assert demand == show("demand_kN", read_step(book, line, "E_d"))
            assert used == show("utilisation", line.used[1])
            assert ENGLISH.show(check.reason) in line.told
            if check.open or check.gaps:  # more than its numbers say
                assert ENGLISH.show(check.told) in told(page)


def read_last_table(sheet):
    first = [line[0] for line in sheet.iter_rows(values_only=True)]
    start = len(first) - first[::-1].index("Net row")
    heads = [cell.value for cell in sheet[start]]
    lines = sheet.iter_rows(min_row=start + 1, values_only=True)
    return [dict(zip(heads, line, strict=True)) for line in lines]


def test_largest_forces_stand_in_the_workbook(book):
    lines = read_last_table(book["Cases"])
    for row in STUDY.rows:
        table = build_bounds(row, ENGLISH)
        mine = [line for line in lines if line["Net row"] == row.id]
        for cells, line in zip(table.rows, mine, strict=True):
            assert line["Member"] == cells[0].text
            assert as_cell(cells[1].number) == list(line.values())[2]


def test_every_step_of_the_page_stands_in_the_workbook(page, book):
    """Page and sheet have the same numbers, the page with four digits at least."""
    cells = [line[3:8] for line in book["Checks"].iter_rows(values_only=True)]
    values = {(one[0], one[4]) for one in cells if isinstance(one[4], float | int)}
    (table,) = page.tables["annex-checks"]
    told = " ".join(cell for line in table for cell in line)
    found = re.findall(r"(R d|μ|E d) = ([\d.]+)", told)
    assert len(found) > 10
    for symbol, text in found:
        name = symbol.replace(" ", "_")
        assert any(
            symbol_ == name and value == pytest.approx(float(text), rel=6e-4)
            for symbol_, value in values
        ), (symbol, text)


def test_verdicts_agree(page, book):
    stream = io.StringIO()
    print_summary(STUDY, Console(file=stream, width=200))
    lines = stream.getvalue().splitlines()
    summary = read_rows(book["Decision"], "No.")
    shown = page.tables["decision"][0][1:]
    for index, row in enumerate(STUDY.rows):
        word = ENGLISH(f"verdict.{row.verdict}")
        assert shown[index][1] == f"{VERDICTS[row.verdict].symbol} {word}"
        assert summary[index]["Verdict"] == word
        scopes = [show_scope(row, scope, ENGLISH)[0] for scope in SCOPES]
        assert shown[index][2:5] == scopes
        assert all(one in lines[1 + index] for one in scopes)
        assert describe_scopes(row, ENGLISH) in summary[index]["Reasons"]
        used = ENGLISH.show_number("utilisation", find_governing(row.checks).used)
        assert shown[index][6].split()[0] == used
        assert used in lines[1 + index]
    overall = ENGLISH(f"verdict.{STUDY.verdict}")
    assert book["Decision"]["C3"].value == overall
    assert lines[1 + len(STUDY.rows)].startswith(f"Verdict: {overall}")
    assert f"{overall}" in "".join(page.text)


def as_cell(value):
    """What a cell of the workbook holds of a number, or of none."""
    return "-" if value is None else pytest.approx(value, rel=1e-12)


def test_json_document_agrees_with_page_and_workbook(page, book):
    document = json.loads(write_document(STUDY))
    sheet = iter(read_checks(book["Checks"]))
    for number, row in enumerate(document["rows"]):
        places = find_places(page, number)
        titles = [show_check(ENGLISH, one) for one in STUDY.rows[number].checks]
        for check, title in zip(row["checks"], titles, strict=True):
            line = next(sheet)
            for key, symbol, place in (
                ("demand_kN", "E_d", 2),
                ("resistance_kN", "R_d", 1),
                ("utilisation", "μ", 3),
            ):
                assert read_step(book, line, symbol) == as_cell(check[key])
                if title in places:
                    assert places[title][place] == ENGLISH.show_number(key, check[key])


def test_all_cases_of_the_document_stand_in_the_workbook(book):
    lines = iter(read_rows(book["Cases"], "Net row"))
    for row in json.loads(write_document(STUDY))["rows"]:
        for case in row["cases"]:
            line = next(lines)
            for key, heading in (
                ("foot_anchor_kN", "Net anchor (foot) [kN]"),
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
    assert len(re.findall(r"\d,\d", text)) > 250
    document = json.loads(write_document(STUDY))
    del document["provenance"]["settings"]["accuracy"]  # a number, stored as a text
    typed = " ".join(list_strings(document))
    pointed = set(re.findall(r"[\w.+-]*\d\.\d[\w.+-]*", text))
    assert {one for one in pointed if one not in typed} <= set(
        STUDY.provenance.libraries.values()
    )


def test_provenance_agrees(page, book):
    cells = {line[0]: line[1] for line in page.tables["annex-verify"][1][1:]}
    sheet = {
        line["Item"]: line["Value"] for line in read_rows(book["Provenance"], "Item")
    }
    assert cells == sheet
    assert cells["Site file, SHA-256"] == STUDY.provenance.site_sha256
    assert cells["Limit profile, SHA-256"] == STUDY.profile.sha256
