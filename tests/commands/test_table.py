"""``netdesign table``: a study that is given, found beside the site, or refused."""

import json
import shutil

import pytest

from tests.make import write_site, write_tiny
from tests.program import QUICK

SHOWN = ("foot_anchor", "uphill_anchor", "downhill_anchor")


@pytest.fixture(scope="module")
def checked(tmp_path_factory):
    """A folder with a site, and its study in another folder."""
    from tests.program import call_program

    folder = tmp_path_factory.mktemp("checked")
    write_tiny(folder / "site.xlsx")
    asked = ("--out", "study", "--no-html", "--no-excel", "--quiet")
    call_program("check", "site.xlsx", *QUICK, *asked, cwd=folder)
    return folder


@pytest.fixture
def beside(checked, tmp_path):
    """A folder of its own with the same site."""
    shutil.copy(checked / "site.xlsx", tmp_path)
    return tmp_path


def read(call, *options):
    ended = call("table", "site.xlsx", "--json", *options)
    assert ended.code == 0, ended.err
    (row,) = json.loads(ended.out)["rows"]
    return {(one["anchor"], one["position"]): one for one in row["anchors"]}, ended.err


def test_forces_without_a_study(call, beside):
    found, _ = read(call)
    for anchor in SHOWN:
        assert found[anchor, "intermediate"]["guideline_kN"] > 0.0
    assert {one["coupled_kN"] for one in found.values()} == {None}


@pytest.mark.parametrize("place", ["study.json", "netdesign-out/study.json"])
def test_a_study_beside_the_site_is_found(call, checked, beside, place):
    (beside / place).parent.mkdir(exist_ok=True)
    shutil.copy(checked / "study" / "study.json", beside / place)
    found, told = read(call)
    assert told == ""
    assert found == read(call, "--study", str(checked / "study" / "study.json"))[0]
    for anchor in SHOWN:
        one = found[anchor, "intermediate"]
        assert one["ratio"] == one["coupled_kN"] / one["guideline_kN"]


def test_a_study_of_another_site_is_told_and_refused(call, checked, beside):
    write_tiny(beside / "site.xlsx", lambda of: of["rows"][0].update(slope_angle=38.4))
    found, _ = read(call)
    shutil.copy(checked / "study" / "study.json", beside)
    again, told = read(call)
    assert again == found
    assert "study.json" in told
    given = call("table", "site.xlsx", "--study", "study.json")
    assert (given.code, given.out) == (3, "")


def test_a_damaged_study_beside_the_site_is_passed_over(call, beside):
    (beside / "study.json").write_text("{}", encoding="utf-8")
    assert read(call)[1] == ""
    assert call("table", "site.xlsx", "--study", "study.json").code == 3


@pytest.mark.parametrize("language", ["en", "fr", "de"])
@pytest.mark.parametrize("width", [80, 100])
def test_no_line_is_wider_than_the_terminal(
    call, monkeypatch, checked, beside, language, width
):
    monkeypatch.setenv("COLUMNS", str(width))
    shutil.copy(checked / "study" / "study.json", beside)
    ended = call("table", "site.xlsx", "--language", language)
    heading, *lines = ended.out.splitlines()[1:]
    table = [line for line in lines if len(line) == len(heading)]  # rich fills them up
    assert len(heading) <= width
    assert any("(" in line and ")" in line for line in table)


def test_a_row_that_is_not_there_is_a_refusal(call, beside):
    assert call("table", "site.xlsx", "--row", "R9").code == 2
    assert call("table").code == 2


OFFICE = {
    "project": [{}],
    "rows": [
        {"id": "R1", "slope_angle": 36.7, "snow": 3.31, "glide_factor": 1.83}
        | {"altitude": 2113, "net_type": "N", "post_spacing": 3.47}
    ],
    "net_types": [{"id": "N", "net_height": 3.02}],
}


def test_office_data_alone_are_enough(call, tmp_path):
    """No net, no support, no anchors, no ranges, no length: nobody has solved it."""
    write_site(tmp_path / "office.xlsx", OFFICE)
    ended = call("table", "office.xlsx", "--json")
    assert ended.code == 0, ended.err
    (row,) = json.loads(ended.out)["rows"]
    forces = {(x["anchor"], x["position"]): x["guideline_kN"] for x in row["anchors"]}
    for anchor in SHOWN:
        assert forces[anchor, "edge"] is not None
        assert forces[anchor, "intermediate"] > 0.0
    assert row["reason"] is None
    assert row["notes"] != []  # what is assumed
