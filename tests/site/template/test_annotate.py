import random
import zipfile

import openpyxl
import pytest
from openpyxl.comments import Comment

from netdesign.outcome import SiteDataError
from netdesign.site.columns.all_tables import FINDINGS_SHEETS
from netdesign.site.reader import read_site
from netdesign.site.template.annotate import annotate_workbook
from tests.site.csv_folder import write_csv_folder

FINDINGS_SHEET = FINDINGS_SHEETS["en"]


def annotate(path, copy):
    with pytest.raises(SiteDataError) as caught:
        read_site(path)
    copy.write_bytes(annotate_workbook(path, caught.value.findings))
    return openpyxl.load_workbook(copy)


def test_a_mended_copy_is_read_clean_and_its_marks_go(sheets, save, tmp_path):
    sheets["Nets"][1][1] = "4O"
    copy = annotate(save(sheets), tmp_path / "copy.xlsx")
    assert "is not a number" in copy["Nets"]["B2"].comment.text
    copy["Nets"]["B2"].value = 40
    copy["Nets"]["C3"].value = "x"
    copy.save(tmp_path / "again.xlsx")
    again = annotate(tmp_path / "again.xlsx", tmp_path / "copy2.xlsx")
    assert again["Nets"]["B2"].comment is None
    assert again["Nets"]["B2"].fill.fill_type is None
    assert again["Nets"]["C3"].comment is not None
    again["Nets"]["C3"].value = 2.5
    again.save(tmp_path / "clean.xlsx")
    assert read_site(tmp_path / "clean.xlsx").notes == ()


def test_a_comment_of_the_engineer_stays(sheets, save, tmp_path):
    sheets["Nets"][1][1] = "4O"

    def remark(workbook):
        workbook["Nets"]["B2"].comment = Comment("from the survey", "engineer")

    copy = annotate(save(sheets, remark), tmp_path / "copy.xlsx")
    text = copy["Nets"]["B2"].comment.text
    assert text.startswith("from the survey")
    assert "is not a number" in text


def test_findings_without_a_cell_are_in_the_list(sheets, save, tmp_path):
    sheets["Nets"][1][12] = "G7"
    sheets["Ranges"][1:2] = []
    copy = annotate(save(sheets), tmp_path / "copy.xlsx")
    listed = [[cell.value for cell in row] for row in copy[FINDINGS_SHEET].iter_rows()]
    assert [line[:3] for line in listed[1:]] == [
        ["error", "Nets", "M2"],
        ["error", "Ranges", None],
    ]
    link = copy[FINDINGS_SHEET]["C2"].hyperlink
    assert "Nets" in (link.location or link.target)


def test_a_csv_comes_back_as_a_workbook(tmp_path):
    nets = ["id;slope angle [deg];ground law", "R1;=1+1;free"]
    ranges = ["quantity;low;high", "density [kg/m3];270;400"]
    path = write_csv_folder(tmp_path / "site", {"Nets": nets, "Ranges": ranges})
    copy = annotate(path, tmp_path / "copy.xlsx")
    assert copy.sheetnames == [FINDINGS_SHEET, "Nets", "Ranges"]
    assert copy["Nets"]["B2"].value == "=1+1"
    assert copy["Nets"]["B2"].data_type == "s"  # text, and no formula
    assert copy["Nets"]["B2"].fill.fill_type == "solid"
    assert copy["Ranges"]["A2"].value == "density [kg/m3]"


def test_text_in_the_list_is_never_a_formula(sheets, save, tmp_path):
    sheets["Nets"][1][1] = "=HYPERLINK(1)"
    copy = annotate(save(sheets), tmp_path / "copy.xlsx")
    cell = copy[FINDINGS_SHEET]["E2"]
    assert (cell.value, cell.data_type) == ("=HYPERLINK(1)", "s")


def test_a_workbook_merged_all_over_is_not_opened(sheets, save, tmp_path):
    path = save(sheets, lambda book: book["Posts"].merge_cells("A9:B9"))
    with zipfile.ZipFile(path) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in parts.items():
            archive.writestr(name, content.replace(b'"A9:B9"', b'"A9:XFD9999"'))
    with pytest.raises(SiteDataError, match="too many merged cells"):
        annotate_workbook(path, [])


def test_a_part_that_only_the_copy_needs_may_be_damaged(sheets, save):
    def remark(workbook):
        workbook["Posts"]["A2"].comment = Comment("from the maker", "engineer")

    path = save(sheets, remark)
    with zipfile.ZipFile(path) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    comments = next(name for name in parts if "/comment" in name and ".xml" in name)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in parts.items():
            archive.writestr(name, b"<broken" if name == comments else content)
    assert len(read_site(path).rows) == 2
    with pytest.raises(SiteDataError, match="cannot be copied"):
        annotate_workbook(path, [])


@pytest.mark.parametrize("seed", range(8))
def test_merged_cells_are_marked_at_the_one_that_is_shown(save, sheets, tmp_path, seed):
    """Findings fall into hidden cells of any merged range, empty ones too."""
    rng = random.Random(seed)

    def merge(workbook):
        sheet = workbook["Nets"]
        row, column = rng.randint(1, 3), rng.randint(1, 12)
        sheet.merge_cells(
            start_row=row,
            start_column=column,
            end_row=row + rng.randint(1, 2),
            end_column=column + rng.randint(0, 2),
        )
        sheet.merge_cells("A6:B7")

    copy = annotate(save(sheets, merge), tmp_path / "copy.xlsx")
    listed = [[cell.value for cell in row] for row in copy[FINDINGS_SHEET].iter_rows()]
    marked = {cell.coordinate for row in copy["Nets"] for cell in row if cell.comment}
    for _, sheet, address, *_ in listed[1:]:
        if sheet == "Nets" and address:
            (shown,) = {
                merged.start_cell.coordinate
                for merged in copy["Nets"].merged_cells.ranges
                if address in merged
            } or {address}
            assert shown in marked
    again = annotate(tmp_path / "copy.xlsx", tmp_path / "again.xlsx")
    assert {
        cell.coordinate for row in again["Nets"] for cell in row if cell.comment
    } == marked
