"""``netdesign map`` from the command line, in three languages."""

import tomllib

import openpyxl
import pytest

from tests.short_example import write_short_example


@pytest.fixture
def site(tmp_path):
    """One row, with a heading that may be two quantities."""
    path = tmp_path / "site.xlsx"
    write_short_example(path, ["R1"])
    book = openpyxl.load_workbook(path)
    sheet = book["Nets"]
    sheet.cell(1, sheet.max_column + 1).value = "Werkhöhe [m]"
    book.create_sheet("Prezzi")
    book.save(path)
    return path


def test_a_refusal_names_the_command_and_its_file_is_used(call, site, tmp_path):
    refused = call("check", site, "--dry-run")
    assert refused.code == 3
    assert "netdesign map site.xlsx writes a file" in refused.err
    assert call("map", site).err.splitlines()[1:] == [
        "1 to be answered, at the question marks"
    ]
    place = tmp_path / "site.map.toml"
    text = place.read_text(encoding="utf-8")
    place.write_text(text.replace('= "?"', '= "ignore"'), encoding="utf-8")
    read = call("check", site, "--dry-run")
    assert read.code == 0
    assert "is read with the answers of site.map.toml (sha256 " in read.out


def test_a_file_of_answers_is_kept_unless_told(call, site, tmp_path):
    (tmp_path / "site.map.toml").write_text('[sheets]\nPrezzi = "ignore"\n')
    assert call("map", site).code == 2
    assert call("map", site, "--force").code == 0
    text = (tmp_path / "site.map.toml").read_text(encoding="utf-8")
    assert '"Prezzi" = "ignore"' in text


@pytest.mark.parametrize(
    ("language", "told"),
    [("fr", "point d'interrogation"), ("de", "Jedes Fragezeichen")],
)
def test_the_file_speaks_the_language_asked_for(call, site, tmp_path, language, told):
    assert call("map", site, "--language", language).code == 0
    assert told in (tmp_path / "site.map.toml").read_text(encoding="utf-8")


def test_a_heading_that_is_not_understood_is_asked_for_where_one_lacks(call, tmp_path):
    path = tmp_path / "site.xlsx"
    write_short_example(path, ["R1"])
    book = openpyxl.load_workbook(path)
    (cell,) = (one for one in book["Nets"][1] if one.value == "post spacing [m]")
    cell.value = "bay [m]"
    book.save(path)
    assert call("check", path, "--dry-run").code == 3
    assert "1 to be answered" in call("map", path).err
    place = tmp_path / "site.map.toml"
    text = place.read_text(encoding="utf-8")
    assert '\n"bay [m]" = "?"' in text
    answered = text.replace('"bay [m]" = "?"', '"bay [m]" = "post spacing [m]"')
    place.write_text(answered, encoding="utf-8")
    assert call("check", path, "--dry-run").code == 0


def test_an_unknown_heading_is_asked_for_and_one_of_no_part_left_out(call, tmp_path):
    path = tmp_path / "site.xlsx"
    write_short_example(path, ["R1"])
    book = openpyxl.load_workbook(path)
    sheet = book["Nets"]
    sheet.cell(1, sheet.max_column + 1).value = "zul. Ankerkraft [kN]"
    sheet.cell(2, sheet.max_column).value = 250
    sheet.cell(1, sheet.max_column + 1).value = "Remarks"
    book.save(path)
    assert "1 to be answered" in call("map", path).err
    text = (tmp_path / "site.map.toml").read_text(encoding="utf-8")
    assert '\n"zul. Ankerkraft [kN]" = "?"' in text
    assert "cells: 250" in text
    assert '# "Remarks" = "ignore"' in text


def test_a_sure_guess_is_the_first_answer_and_it_is_read(call, tmp_path):
    path = tmp_path / "site.xlsx"
    write_short_example(path, ["R1"])
    book = openpyxl.load_workbook(path)
    (cell,) = (one for one in book["Nets"][1] if one.value == "post spacing [m]")
    cell.value = "Abstände der Stützen [m]"
    book.save(path)
    assert call("check", path, "--dry-run").code == 3
    assert "nothing is left" in call("map", path).err
    text = (tmp_path / "site.map.toml").read_text(encoding="utf-8")
    assert '"Abstände der Stützen [m]" = "post spacing"' in text
    assert "post spacing 97" in text
    read = call("check", path, "--dry-run")
    assert read.code == 0
    assert "is read as" in read.out


def test_a_list_of_unknown_headings_is_asked_for_whole(call, tmp_path):
    path = tmp_path / "site.xlsx"
    write_short_example(path, ["R1"])
    book = openpyxl.load_workbook(path)
    for cell in book["Anchors"][1]:
        cell.value = f"x {cell.value}" if cell.value else None
    book.save(path)
    columns = sum(bool(cell.value) for cell in book["Anchors"][1])
    call("map", path)
    text = (tmp_path / "site.map.toml").read_text(encoding="utf-8")
    assert len(tomllib.loads(text)["headings"]["Anchors"]) == columns


def test_what_is_left_open_stays_in_the_file(call, site, tmp_path):
    call("map", site)
    before = (tmp_path / "site.map.toml").read_text(encoding="utf-8")
    assert "1 to be answered" in call("map", site, "--force").err
    after = (tmp_path / "site.map.toml").read_text(encoding="utf-8")
    still = [line.split("  #")[0] for line in before.splitlines() if '= "?"' in line]
    assert still == [x.split("  #")[0] for x in after.splitlines() if '= "?"' in x]
