"""``netdesign map`` from the command line, in three languages."""

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
