"""Sheet Declared: checks by their names in any language, every fault with its cell."""

from dataclasses import replace

import pytest

from netdesign.checks import Declaration, Proof
from netdesign.outcome import SiteDataError
from netdesign.site.declared_sheet import DECLARABLE
from netdesign.site.reader import read_site
from netdesign.structure.members import DEPENDENT_MODES, MEMBER_MODES
from netdesign.words.catalogue import LANGUAGES, render
from netdesign.words.names import name_check
from tests.each import each
from tests.small_site import build_row, build_site, resist

HEADINGS = ["rows", "what it proves", "document", "author", "date"]
SOUND_LINE = ["R1", "Post base, bearing", "Report G-17", "B. Rüegg", "2026-03-09"]


def with_lines(sheets, *lines):
    sheets["Declared"] = [HEADINGS, *map(list, lines)]
    return sheets


def the_finding(path):
    with pytest.raises(SiteDataError) as caught:
        read_site(path)
    (finding,) = [one for one in caught.value.findings if one.severity == "error"]
    return finding


def test_a_line_is_read_with_its_cell_and_found_for_its_row_only(sheets, save):
    site = read_site(save(with_lines(sheets, SOUND_LINE)))
    (found,) = site.declared
    assert (found.row_id, found.member, found.mode) == ("R1", "post_base", "bearing")
    document, author, date = SOUND_LINE[2:]
    proof = Proof(document=document, author=author, date=date, cell="Declared!B2")
    assert found.proof == proof
    first, second = site.rows
    assert site.find_declaration(first, "post_base", "bearing") is found
    assert site.find_declaration(second, "post_base", "bearing") is None
    assert site.find_declaration(first, "post", "compression") is None


@pytest.mark.parametrize("word", ["all", "Alle", "toutes"])
def test_a_line_may_be_of_all_rows(sheets, save, word):
    line = [word, *SOUND_LINE[1:4], None]
    site = read_site(save(with_lines(sheets, line)))
    for row in site.rows:
        found = site.find_declaration(row, "post_base", "bearing")
        assert (found.proof.document, found.proof.date) == ("Report G-17", "")


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_check_is_known_by_the_name_that_reports_give_it(sheets, save, language):
    lines = [
        ["R2", render(name_check(*subject), language), "Report", "A. B.", None]
        for subject in DECLARABLE
    ]
    found = read_site(save(with_lines(sheets, *lines))).declared
    assert [(one.member, one.mode) for one in found] == list(DECLARABLE)


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_check_of_the_end_is_known_by_its_name_and_is_of_the_end(
    sheets, save, language
):
    """Whatever stands on a support; the same check inside the row is another one."""
    of_supports = [
        one
        for one in DECLARABLE
        if one[0] not in ("net", "structure") and one[1] != "lateral"
    ]
    lines = [
        [
            "R2",
            render(name_check(*subject, position), language),
            "Report",
            "A. B.",
            None,
        ]
        for subject in of_supports
        for position in ("", "edge")
    ]
    site = read_site(save(with_lines(sheets, *lines)))
    row = site.rows[1]
    assert len(site.declared) == 2 * len(of_supports)
    for member, mode in of_supports:
        for position, expected in (("intermediate", ""), ("edge", "edge")):
            found = site.find_declaration(row, member, mode, position)
            assert (found.member, found.mode) == (member, mode)
            assert found.position == expected


@each("member, mode", [*MEMBER_MODES, *DEPENDENT_MODES])
@each("other", [None, "other"])
def test_a_declaration_holds_at_the_end_for_the_same_type_only(member, mode, other):
    """Another type has another resistance, which nobody has proven."""
    general = Declaration(
        row_id="R",
        member=member,
        mode=mode,
        proof=Proof(document="G-17", author="B. R.", date="", cell="Declared!B2"),
    )
    ends = other and tuple(
        replace(one, type_id=other if one.member == member else one.type_id)
        for one in resist()
    )
    row = build_row("R", end_resistances=ends)

    def find(position, *declared):
        site = build_site(row, declared=declared)
        return site.find_declaration(row, member, mode, position)

    assert find("intermediate", general) is general
    assert find("edge", general) is (None if other else general)
    of_end = replace(general, position="edge")
    assert find("edge", general, of_end) is find("edge", of_end) is of_end
    assert find("intermediate", general, of_end) is general
    assert find("intermediate", of_end) is None
    assert find("", of_end) is None
    for one, _ in MEMBER_MODES:
        is_other = bool(other) and one == member
        assert row.has_same_type_at_end(one) is not is_other


@pytest.mark.parametrize(
    ("column", "value", "rule"),
    [
        ("A", "R7", "is no id of sheet Rows"),
        ("A", None, "is empty"),
        ("B", "Post base, bearings", "is no check that may be declared"),
        ("B", "Net, slope", "is no check that may be declared"),
        ("B", "Net, height", "is no check that may be declared"),
        ("B", None, "is empty"),
        ("C", None, "is empty"),
        ("C", "  ", "is empty"),
        ("D", None, "is empty"),
        ("E", "last winter", "is no date"),
    ],
)
def test_a_fault_is_one_finding_with_its_cell(sheets, save, column, value, rule):
    line = list(SOUND_LINE)
    line["ABCDE".index(column)] = value
    finding = the_finding(save(with_lines(sheets, line)))
    assert (finding.sheet, finding.cell) == ("Declared", f"{column}2")
    assert str(finding.rule) == rule


@pytest.mark.parametrize("second", ["R1", "all"])
def test_a_check_declared_twice_is_a_finding_that_names_the_first(sheets, save, second):
    again = [second, *SOUND_LINE[1:]]
    finding = the_finding(save(with_lines(sheets, SOUND_LINE, again)))
    assert finding.cell == "B3"
    assert str(finding.rule) == "is declared twice: also in Declared!B2"
