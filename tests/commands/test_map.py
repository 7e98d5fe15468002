"""``netdesign map`` from the command line, in three languages."""

import json

import openpyxl
import pytest

from tests.short_example import write_short_example
from tests.site.lists.answer import answer_list
from tests.site.lists.offices import CONSULTANT


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


def test_an_own_list_is_mapped_once_and_read_by_every_command(call, tmp_path):
    path = CONSULTANT.write(tmp_path)
    assert call("table", path).code == 3
    assert call("map", path).code == 0
    refused = call("table", path)
    assert refused.code == 3
    assert "Net anchor" in refused.err
    answer_list(CONSULTANT, path)
    shown = call("table", path, "--json")
    assert shown.code == 0, shown.err
    rows = json.loads(shown.out)["rows"]
    assert [row["id"] for row in rows] == [
        line[0] for line in CONSULTANT.sheets[0].lines
    ]
    again = call("map", path, "--force")
    assert again.code == 0
    assert call("check", path, "--dry-run").code == 0
