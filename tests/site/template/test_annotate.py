import openpyxl
import pytest
from openpyxl.comments import Comment

from netdesign.outcome import SiteDataError
from netdesign.site.reader import read_site
from netdesign.site.template.annotate import annotate_workbook


def annotate(path, copy):
    with pytest.raises(SiteDataError) as caught:
        read_site(path)
    copy.write_bytes(annotate_workbook(path, caught.value.findings))
    return openpyxl.load_workbook(copy)


def test_a_mended_copy_is_read_clean_and_its_marks_go(book, tmp_path):
    book["Rows"][1][1] = "4O"
    copy = annotate(book.save(), tmp_path / "copy.xlsx")
    assert "is not a number" in copy["Rows"]["B2"].comment.text
    copy["Rows"]["B2"].value = 40
    copy["Rows"]["C3"].value = "x"
    copy.save(tmp_path / "again.xlsx")
    again = annotate(tmp_path / "again.xlsx", tmp_path / "copy2.xlsx")
    assert again["Rows"]["B2"].comment is None
    assert again["Rows"]["B2"].fill.fill_type is None
    assert again["Rows"]["C3"].comment is not None
    again["Rows"]["C3"].value = 2.5
    again.save(tmp_path / "clean.xlsx")
    assert read_site(tmp_path / "clean.xlsx").notes == ()


def test_a_comment_of_the_engineer_stays(book, tmp_path):
    book["Rows"][1][1] = "4O"

    def remark(workbook):
        workbook["Rows"]["B2"].comment = Comment("from the survey", "engineer")

    copy = annotate(book.save(remark), tmp_path / "copy.xlsx")
    text = copy["Rows"]["B2"].comment.text
    assert text.startswith("from the survey")
    assert "is not a number" in text
