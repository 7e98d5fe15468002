"""Sheet Declared: checks by their names in any language, every fault with its cell."""

from dataclasses import replace

import pytest

from netdesign.checks import Declaration, Proof
from netdesign.site.declared_sheet import DECLARABLE
from netdesign.structure.members import DEPENDENT_MODES, MEMBER_MODES
from netdesign.words.catalogue import LANGUAGES, name_check, render
from tests.each import each
from tests.small_site import build_row, build_site, resist

HEADINGS = ["rows", "what it proves", "document", "author", "date"]
SOUND_LINE = ["R1", "Post base, bearing", "Report G-17", "B. Rüegg", "2026-03-09"]


def with_lines(book, *lines):
    book["Declared"] = [HEADINGS, *map(list, lines)]
    return book


def test_a_line_is_read_with_its_cell_and_found_for_its_row_only(book):
    site = with_lines(book, SOUND_LINE).read()
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
def test_a_line_may_be_of_all_rows(book, word):
    line = [word, *SOUND_LINE[1:4], None]
    site = with_lines(book, line).read()
    for row in site.rows:
        found = site.find_declaration(row, "post_base", "bearing")
        assert (found.proof.document, found.proof.date) == ("Report G-17", "")


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_check_is_known_by_the_name_that_reports_give_it(book, language):
    """Whatever stands on a support has one at the end, which is another check."""
    named = [
        (member, mode, position)
        for member, mode in DECLARABLE
        for position in ("", "edge")
        if not position or not (member in ("net", "structure") or mode == "lateral")
    ]
    lines = [
        ["R2", render(name_check(*one), language), "Report", "A. B.", None]
        for one in named
    ]
    site = with_lines(book, *lines).read()
    assert [(one.member, one.mode, one.position) for one in site.declared] == named
    for one in named:
        place = one[2] or "intermediate"
        found = site.find_declaration(site.rows[1], *one[:2], place)
        assert (found.member, found.mode, found.position) == one


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
def test_a_fault_is_one_finding_with_its_cell(book, column, value, rule):
    line = list(SOUND_LINE)
    line["ABCDE".index(column)] = value
    (finding,) = with_lines(book, line).refuse()
    assert (finding.sheet, finding.cell) == ("Declared", f"{column}2")
    assert str(finding.rule) == rule


@pytest.mark.parametrize("second", ["R1", "all"])
def test_a_check_declared_twice_is_a_finding_that_names_the_first(book, second):
    again = [second, *SOUND_LINE[1:]]
    (finding,) = with_lines(book, SOUND_LINE, again).refuse()
    assert finding.cell == "B3"
    assert str(finding.rule) == "is declared twice: also in Declared!B2"
