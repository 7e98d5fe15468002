"""Options of reading, and the annotated copy, from the command line."""

import openpyxl
import pytest

from tests.make import load_rows, write_site
from tests.site.csv_folder import write_csv_folder

SHEETS = {
    "Rows": [
        "row;slope ψ [deg];snow height [m vertical];glide factor N;"
        "upslope length L [m];net type;post spacing b [m]",
        "R1;38,500;3,75;2,5;20;N1;3,5",
    ],
    "Net types": ["net type;effective height D_K [m]", "N1;3,5"],
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
    assert "38.500 or 38500" in marked["Rows"]["B2"].comment.text


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
    tables = load_rows(["R1"])
    tables["project"][0]["standard"] = "swiss-guideline-2007"
    write_site(path, tables)
    told = "the site names the limit profile swiss-guideline-2007; eurocode is used"
    other = call("check", path, "--dry-run", "--standard", "eurocode")
    assert told in other.err
    same = call("check", path, "--dry-run", "--standard", "swiss-guideline-2007")
    assert told not in same.err + call("check", path, "--dry-run").err
