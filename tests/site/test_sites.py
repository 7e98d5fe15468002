"""Three whole sites, in every kind of file that they may come in."""

import math

import openpyxl
import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.reader import read_site
from netdesign.site.template.annotate import annotate_workbook
from netdesign.snow.ground import build_ground_from_glide_factor
from tests.site.whole_sites import (
    DAMAGED_FINDINGS,
    FRENCH_HEIGHTS,
    FRENCH_SLOPES_PERCENT,
    damaged_site,
    french_site,
)


def assert_french(site):
    assert site.project.author == "É. Façade"
    assert [row.id for row in site.rows] == [f"F{k:02}" for k in range(1, 13)]
    for row, slope, height in zip(
        site.rows, FRENCH_SLOPES_PERCENT, FRENCH_HEIGHTS, strict=True
    ):
        angle = math.atan(float(slope.replace(",", ".")) / 100)
        thickness = float(height.replace(",", ".")) * math.cos(angle)
        assert row.slope_angle == pytest.approx(angle, rel=1e-14)
        assert row.snow_thickness == pytest.approx(thickness, rel=1e-14)
        assert (row.net_stiffness_per_m, row.slack) == (12.5e6, 0.05)
        assert row.upslope_length == 18.5
    sliding = build_ground_from_glide_factor(1.4, site.rows[2].snow_thickness)
    assert site.rows[2].ground == sliding
    assert site.rows[0].ground.kind == "no-slip"
    assert site.ranges["density"].high == 412.5
    values = {(one.member, one.mode): one.value for one in site.rows[0].resistances}
    assert values["foot_anchor", "tendon"] == 442_500.0
    assert values["downhill_anchor", "pull_out"] == 300_250.0
    notes = "\n".join(map(str, site.notes))
    rules = [str(one.rule) for one in site.findings]
    assert rules.count("is a note below the table: it is not read") == 2
    assert '"Remarque" is no known heading' in notes


def test_twelve_french_rows_with_commas_and_per_cent(save):
    assert_french(read_site(save(french_site())))


def test_a_damaged_site_gives_every_finding_at_once(save, refused):
    findings = refused(save(damaged_site()))
    errors = {
        (f"{f.sheet}!{f.cell}", str(f.rule)) for f in findings if f.severity == "error"
    }
    assert errors == DAMAGED_FINDINGS
    accepted = {f.cell: str(f.accepted) for f in findings}
    assert '(nearest: "A32" in Anchors!A2)' in accepted["I3"]
    assert '(nearest: "G18" in Ropes!A2)' in accepted["J3"]
    notes = {(f.sheet, f.cell) for f in findings if f.severity == "note"}
    assert notes == {("Nets", "K1"), ("Old", "")}


def test_the_damaged_site_comes_back_with_its_findings_marked(save, tmp_path):
    path = save(damaged_site())
    with pytest.raises(SiteDataError) as caught:
        read_site(path)
    findings = caught.value.findings
    copy = tmp_path / "copy.xlsx"
    copy.write_bytes(annotate_workbook(path, findings))
    before, after = openpyxl.load_workbook(path), openpyxl.load_workbook(copy)
    assert after.sheetnames[1:] == before.sheetnames
    marked = {
        (sheet.title, cell.coordinate): cell
        for sheet in after.worksheets[1:]
        for row in sheet.iter_rows()
        for cell in row
        if cell.comment is not None
    }
    assert set(marked) == {(f.sheet, f.cell) for f in findings if f.cell}
    for finding in findings:
        if finding.cell:
            cell = marked[finding.sheet, finding.cell]
            assert str(finding.rule) in cell.comment.text
            assert cell.fill.fill_type == "solid"
    for sheet in before.worksheets:
        for row in sheet.iter_rows():
            for cell in row:
                assert after[sheet.title][cell.coordinate].value == cell.value
    listed = [[cell.value for cell in row] for row in after.worksheets[0].iter_rows()]
    assert [line[5] for line in listed[1:]] == [str(f.rule) for f in findings]
