"""Sheet Ends: other types for the first and last support of a row."""

import pytest

from netdesign.site.reader import read_site
from netdesign.structure.members import DEPENDENT_MODES, LIFTED_MODE, MEMBER_MODES

BESIDE_AXIS = tuple(
    (f"{one}_anchor", mode)
    for mode in ("bending", "direction")
    for one in ("foot", "uphill", "downhill")
)
HEADINGS = ["net row", "foot anchor", "uphill anchor", "uphill guy", "post"]


@pytest.fixture
def with_ends(sheets):
    sheets["Nets"][0] += ["uphill anchor"]
    for line in sheets["Nets"][1:]:
        line.append("A1")
    sheets["Anchors"].append(["A3", 731, 617, "tested"])
    sheets["Ends"] = [list(HEADINGS), ["R1", "A3", None, None, None]]
    return sheets


def values(resistances):
    return {(one.member, one.mode): one.value for one in resistances}


def test_named_types_are_those_of_the_end_and_blank_ones_are_as_inside(with_ends, save):
    first, second = read_site(save(with_ends)).rows
    inside, end = values(first.resistances), values(first.resistances_at("edge"))
    assert tuple(end) == (*MEMBER_MODES, *BESIDE_AXIS, *DEPENDENT_MODES, LIFTED_MODE)
    assert inside["foot_anchor", "tendon"] == 0.8 * 400e3  # or rope
    assert end["foot_anchor", "tendon"] == 0.8 * 731e3
    pulled = {(r.member, r.mode): r for r in first.resistances_at("edge")}
    assert pulled["foot_anchor", "pull_out"].tests.least == 617e3
    other = {key for key in end if end[key] != inside[key]}
    assert other == {("foot_anchor", "tendon")}
    assert second.end_resistances is None
    assert first.resistances_at("intermediate") is first.resistances


def test_a_row_whose_end_is_as_inside_has_the_same_types(with_ends, save):
    with_ends["Ends"] = [["net row", "types of the support"], ["R1", "as inside"]]
    row = read_site(save(with_ends)).rows[0]
    assert values(row.resistances_at("edge")) == values(row.resistances)
    assert values(row.resistances)["foot_anchor", "tendon"] == 0.8 * 400e3


@pytest.mark.parametrize(
    ("line", "cell", "told"),
    [
        (["R1", "A9", None, None, None], "B2", "A9"),
        (["R9", "A3", None, None, None], "A2", "R9"),
        ([None, "A3", None, None, None], "A2", ""),
    ],
)
def test_unknown_row_or_type_is_one_finding(with_ends, save, refused, line, cell, told):
    with_ends["Ends"][1] = line
    (finding,) = refused(save(with_ends))
    assert (finding.sheet, finding.cell, finding.text) == ("Ends", cell, told)


@pytest.mark.parametrize("word", ["all", "alle", "toutes", "All"])
def test_one_line_of_all_stands_for_every_row_without_its_own(with_ends, save, word):
    with_ends["Ends"] = [
        list(HEADINGS),
        ["R2", "A2", None, None, None],
        [word, "A3", None, None, None],
    ]
    found = [
        {one.member: one.type_id for one in row.resistances_at("edge")}["foot_anchor"]
        for row in read_site(save(with_ends)).rows
    ]
    assert found == ["A3", "A2"]
