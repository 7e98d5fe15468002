"""Workbooks as offices type them: read at the first or second run, cell by cell."""

import hashlib
import re

import openpyxl
import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.columns.fields import normalise
from netdesign.site.questions import write_questions
from netdesign.site.reader import read_site
from netdesign.site.titles import name_map
from tests.site.messy import french, german, swiss

OFFICES = {"french": french, "german": german, "swiss": swiss}
RUNS = {"french": 1, "german": 2, "swiss": 2}  # until the workbook is read


def answer(text, office):
    """The file of answers with every question mark answered as the office would."""
    lines = []
    for line in text.splitlines():
        asked, is_answer, rest = line.partition(" = ")
        if not is_answer or "?" not in rest.partition("  #")[0] or asked[0] == "#":
            lines.append(line)
        elif asked == "decimal_mark":
            lines.append('decimal_mark = "comma"')
        else:
            (given,) = (
                one
                for key, one in office.ANSWERS.items()
                if normalise(key) in normalise(asked)
            )
            lines.append(f'{asked} = "{given}"')
    return "\n".join(lines)


def read_as_an_office(path, office):
    """Site, and how many runs it took: the second one after ``netdesign map``."""
    try:
        return read_site(path), 1
    except SiteDataError:
        text, missing = write_questions(path)
        assert missing == len(re.findall(r'^[^#\n].*= "[^"]*\?', text, re.MULTILINE))
        name_map(path).write_text(answer(text, office), encoding="utf-8")
        return read_site(path), 2


@pytest.fixture(scope="module", params=OFFICES)
def read(request, tmp_path_factory):
    office = OFFICES[request.param]
    path = tmp_path_factory.mktemp("messy") / f"{request.param}.xlsx"
    office.build(path)
    site, runs = read_as_an_office(path, office)
    return request.param, office, path, site, runs


def test_a_messy_workbook_is_read_at_the_first_or_second_run(read):
    name, _, _, _, runs = read
    assert runs == RUNS[name]


def test_every_cell_of_the_net_rows_is_understood_as_it_was_meant(read):
    _, office, _, site, _ = read
    assert [row.id for row in site.rows] == list(office.ROWS)
    for row in site.rows:
        understood = {
            echo.label.key.rpartition(".")[2]: echo.value
            for echo in row.inputs
            if "!" in echo.cell and echo.value != "" and not echo.derivation
        }
        meant = {"id": row.id, **office.ROWS[row.id]}
        assert {key: understood[key] for key in meant} == pytest.approx(meant)
        assert understood.keys() == meant.keys()


def test_every_input_has_the_text_of_its_cell(read):
    _, _, path, site, _ = read
    book = openpyxl.load_workbook(path)
    echoes = [echo for row in site.rows for echo in row.inputs] + [*site.range_inputs]
    typed = [echo for echo in echoes if "!" in echo.cell and not echo.derivation]
    assert len(typed) > 12 * len(site.rows)
    for echo in typed:
        sheet, _, cell = echo.cell.partition("!")
        value = book[sheet][cell].value
        assert is_shown(echo.text, value, book[sheet][cell].number_format)


def is_shown(text, value, number_format):
    """A text is that of a cell, or its number with the unit of its column."""
    if number_format == "0%":
        return text in (str(value), f"{100 * value:g} %")
    return text == ("" if value is None else str(value)) or text.startswith(f"{value} ")


def test_ranges_and_types_are_as_they_were_meant(read):
    _, office, _, site, _ = read
    ends = {echo.label.key: [] for echo in site.range_inputs}
    for echo in site.range_inputs:
        ends[echo.label.key].append((str(echo.label), echo.value))
    lows = dict(ends["column.low_end"])
    highs = dict(ends["column.high_end"])
    names = {
        "density": "density",
        "friction_angle": "friction angle",
        "inclination": "net inclination",
    }
    for key, (low, high) in office.RANGES.items():
        assert lows[f"{names[key]}, low"] == pytest.approx(low)
        assert highs[f"{names[key]}, high"] == pytest.approx(high)
    for row in site.rows:
        given = [one for one in row.resistances if one.mode in MODES]
        assert len(given) == 9
        for one in given:
            meant = office.TYPES[one.type_id]
            # of a wedge socket: no list names the ends
            left = 0.75 if one.mode == "rope" else 1.0
            assert one.value == pytest.approx(left * 1e3 * meant[one.mode])
            if one.mode == "pull_out":
                assert one.basis == meant["basis"]


MODES = ("tendon", "pull_out", "rope", "compression")


def test_every_column_that_is_left_out_is_told(read):
    _, office, _, site, _ = read
    told = [one.text for one in site.findings if one.severity == "note"]
    for heading in office.LEFT_OUT:
        assert any(heading in text for text in told)


def test_a_hidden_copy_of_the_table_is_not_read(read):
    name, _, _, site, _ = read
    unread = {"french": "Lignes (ancien)", "german": "Netze (alt)", "swiss": "Prezzi"}
    assert any(one.sheet == unread[name] for one in site.findings)


def test_the_report_names_the_answers_with_their_digest(read):
    _, _, path, site, runs = read
    if runs == 1:
        assert site.map_file == ""
        return
    digest = hashlib.sha256(name_map(path).read_bytes()).hexdigest()
    assert (site.map_file, site.map_sha256) == (name_map(path).name, digest)
    assert any(digest in str(note) for note in site.notes)
