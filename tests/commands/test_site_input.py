"""Options of reading, and the annotated copy, from the command line."""

import openpyxl
import pytest

from tests.short_example import write_short_example
from tests.site.csv_folder import write_csv_folder

SHEETS = {
    "Nets": [
        "id;slope angle [deg];snow thickness [m];upslope length [m];ground law;"
        "net height [m];net stiffness [kN/m];post spacing [m]",
        "R1;38,500;2,75;20;free;3,5;9000;3,5",
    ],
    "Ranges": [
        "quantity;low;high",
        "density [kg/m3];270;400",
        "friction angle [deg];15;45",
    ],
}


@pytest.fixture
def site(tmp_path):
    return write_csv_folder(tmp_path / "site", SHEETS)


def test_a_refused_site_is_given_back_with_its_findings(call, site, tmp_path):
    ended = call("check", site, "--annotate", "marked.xlsx")
    assert ended.code == 3
    assert "is ambiguous: 38.500 or 38500" in ended.err
    assert "wrote marked.xlsx" in ended.err
    faults = ended.err.count("; accepted: ")  # how the file was read is no fault
    assert f"\n{faults} finding" in ended.err
    assert "the file was read with" in ended.err
    marked = openpyxl.load_workbook(tmp_path / "marked.xlsx")
    assert "38.500 or 38500" in marked["Nets"]["B2"].comment.text


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--annotate", "marked.csv"), "must end in .xlsx"),
        (("--annotate", "site.xlsx"), "must be another file than the site's"),
        (("--delimiter", "ab"), "one sign such as ';', or tab"),
        (("--decimal-mark", "dot"), "'dot' is not one of 'comma', 'point'"),
        (("--delimeter", ";"), "Did you mean '--delimiter'"),
    ],
)
def test_wrong_options_of_reading_end_with_2(call, tmp_path, options, message):
    (tmp_path / "site.xlsx").write_text("x")
    ended = call("check", "site.xlsx", *options)
    assert ended.code == 2
    assert message in ended.err


def test_a_profile_other_than_the_site_names_is_told(call, tmp_path):
    path = tmp_path / "site.xlsx"
    write_short_example(path, ["R1"])
    book = openpyxl.load_workbook(path)
    (cell,) = (row[1] for row in book["Project"] if row[0].value == "standard")
    cell.value = "swiss-guideline-2007"
    book.save(path)
    told = "the site names the limit profile swiss-guideline-2007; eurocode is used"
    other = call("check", path, "--dry-run", "--standard", "eurocode")
    assert told in other.err
    same = call("check", path, "--dry-run", "--standard", "swiss-guideline-2007")
    assert told not in same.err + call("check", path, "--dry-run").err
