"""Resistances from dimensions, read from the type sheets of a workbook."""

import math
import re

import pytest

from netdesign.site.reader import read_site
from netdesign.words.catalogue import render
from tests.each import each


def add_columns(sheets, name, **columns):
    """Columns with one value for the first type of a sheet; clears the second."""
    head, first = sheets[name][:2]
    for label, value in columns.items():
        head.append(label)
        first.append(value)


def resistance(site, member, mode):
    return next(
        r for r in site.rows[0].resistances if (r.member, r.mode) == (member, mode)
    )


BOND = {
    "kind of anchor": "bar",
    "drill diameter [mm]": 90,
    "bond length [m]": 3.0,
    "ground": "gravel",
    "fabric sleeve": "no",
}


def test_bar_and_bond(sheets, save):
    sheets["Anchors"][1][1:] = [None, None, None]
    add_columns(
        sheets,
        "Anchors",
        **{"bar diameter [mm]": 28, "bar strength [N/mm2]": 500, **BOND},
    )
    site = read_site(save(sheets))
    tendon = resistance(site, "foot_anchor", "tendon")
    assert tendon.value == pytest.approx(math.pi / 4 * 0.028**2 * 500e6, rel=1e-12)
    assert str(tendon.derivation) == "π/4 · (28 mm)² · 500 MPa"
    pull_out = resistance(site, "foot_anchor", "pull_out")
    assert pull_out.value / 1e3 == pytest.approx(80.6, abs=0.05)
    assert pull_out.basis == "computed"
    assert "95 kPa (gravel, grouting A; secondary: FHWA" in str(pull_out.derivation)
    assert pull_out.source == "Anchors!H2"


def test_tests_stand_in_the_place_of_a_value(sheets, save):
    sheets["Anchors"][1][2:] = [None, None]
    add_columns(
        sheets,
        "Anchors",
        **{
            "number of tests": 3,
            "least tested resistance [kN]": 270,
            "mean tested resistance [kN]": 290,
        },
    )
    found = resistance(read_site(save(sheets)), "foot_anchor", "pull_out")
    assert (found.value, found.basis) == (None, "tested")
    assert (found.tests.count, found.tests.least) == (3, 270e3)
    assert found.source == "Anchors!F2"


def test_rope_and_post(sheets, save):
    sheets["Ropes"][1][1] = sheets["Posts"][1][1] = None
    add_columns(
        sheets,
        "Ropes",
        **{
            "rope diameter [mm]": 20,
            "construction": "6x36-IWRC",
            "rope grade [MPa]": 1770,
        },
    )
    add_columns(
        sheets,
        "Posts",
        **{
            "section area [cm2]": 34,
            "second moment of area [cm4]": 318,
            "buckling length [m]": 3.0,
            "yield strength [MPa]": 235,
            "buckling curve": "c",
        },
    )
    site = read_site(save(sheets))
    rope = resistance(site, "uphill_guy", "rope")
    assert rope.value / 1e3 == pytest.approx(0.75 * 252.05, rel=1e-3)
    assert "(6x36-IWRC; secondary: Tech" in str(rope.derivation)
    assert "; wedge; assumed: EN 1993-1-11" in str(rope.derivation)
    post = resistance(site, "post", "compression")
    assert "courbe c" in render(post.derivation, "fr")
    assert "Knicklinie c" in render(post.derivation, "de")
    assert post.value / 1e3 == pytest.approx(411.1, rel=1e-3)


def test_bearing_has_the_value_of_its_post_type_or_none(sheets, save):
    blank = resistance(read_site(save(sheets)), "post_base", "bearing")
    assert (blank.value, blank.basis, blank.type_id) == (None, "", "P1")
    add_columns(sheets, "Posts", **{"bearing resistance [kN]": 240})
    found = resistance(read_site(save(sheets)), "post_base", "bearing")
    assert (found.value, found.source) == (240e3, "Posts!C2")


@pytest.mark.parametrize(
    ("columns", "told"),
    [
        (
            BOND | {"ground": "gravle"},
            "is not a known word (ground); accepted: clay-soft",
        ),
        (
            {
                "number of tests": 2,
                "least tested resistance [kN]": 300,
                "mean tested resistance [kN]": 290,
            },
            "exceeds the mean in Anchors!G2",
        ),
        (
            {"number of tests": 2, "mean tested resistance [kN]": 300},
            "needs more beside it: least tested resistance",
        ),
        (
            {
                "number of tests": 2,
                "least tested resistance [kN]": 300,
                "mean tested resistance [kN]": 310,
            },
            "is given beside pull-out resistance in Anchors!C2",
        ),
    ],
)
def test_contradictions_and_gaps_are_refused(sheets, save, refused, columns, told):
    add_columns(sheets, "Anchors", **columns)
    assert told in "\n".join(str(finding) for finding in refused(save(sheets)))


TESTS = {
    "number of tests": 3,
    "least tested resistance [kN]": 200,
    "mean tested resistance [kN]": 230,
}


def test_tests_govern_over_the_dimensions_of_a_bond(sheets, save):
    """Both are kept, as every supplier's table has them; which one counts is told."""
    sheets["Anchors"][1][2:] = [None, None]
    add_columns(sheets, "Anchors", **TESTS, **BOND)
    site = read_site(save(sheets))
    (pulled,) = {
        one
        for one in site.rows[0].resistances
        if (one.member, one.mode) == ("foot_anchor", "pull_out")
    }
    assert (pulled.tests.count, pulled.value) == (3, None)
    told = [one for one in site.findings if one.rule.key == "type.governs"]
    assert "number of tests in Anchors!E2 governs" in str(told[0])


@pytest.mark.parametrize(
    ("kind", "told"),
    [
        (None, "needs more beside it: kind of anchor"),
        ("rope anchor", "does not fit kind of anchor"),
    ],
)
def test_a_lever_arm_of_what_does_not_bend_is_refused(
    sheets, save, refused, kind, told
):
    """Without a kind its bending would be checked nowhere."""
    columns = {"lever arm [mm]": 287.3, "kind of anchor": kind}
    add_columns(sheets, "Anchors", **columns)
    (finding,) = refused(save(sheets))
    assert told in str(finding)
    assert re.search("bar(,| or) micropile", str(finding))


def test_grouting_that_a_rock_has_no_value_for_is_refused(sheets, save, refused):
    sheets["Anchors"][1][2:] = [None, None]
    add_columns(sheets, "Anchors", **(BOND | {"ground": "granite", "grouting": "B"}))
    (finding,) = refused(save(sheets))
    assert "grouting in granite = 'B': must be one of A" in str(finding)


def test_a_drilled_hole_asks_for_its_ground(sheets, save):
    """The ground of the net row would do, too: without either nothing is proven."""
    sheets["Anchors"][1][2:] = [None, None]
    add_columns(sheets, "Anchors", **{k: v for k, v in BOND.items() if k != "ground"})
    (pulled,) = {
        one
        for one in read_site(save(sheets)).rows[0].resistances
        if (one.member, one.mode) == ("foot_anchor", "pull_out")
    }
    assert pulled.value is None
    assert "the ground of type" in str(pulled.lack)


def test_a_bond_in_a_ground_without_bond_stress_is_refused(sheets, save, refused):
    sheets["Anchors"][1][2:] = [None, None]
    add_columns(sheets, "Anchors", **(BOND | {"ground": "scree"}))
    (finding,) = refused(save(sheets))
    assert "ground = 'scree': must be one of clay-soft" in str(finding)


ROPE = ("tendon", "rope")  # factors of a tendon that may be a rope


@each(
    "name, kind, efficiency, share, factors",
    [
        ("A1", "bar", None, 1.0, ()),
        ("A1", "micropile", None, 1.0, ()),
        ("A1", "rope anchor", None, 0.8, ROPE),
        ("A1", "rope anchor", 0.9, 0.9, ROPE),
        ("A1", None, None, 0.8, ROPE),
        ("A1", None, 1.0, 1.0, ROPE),
        ("GEWI 32", None, None, 1.0, ()),  # a bar by its name
    ],
)
def test_tendon_by_the_kind_of_anchor(
    sheets, save, name, kind, efficiency, share, factors
):
    sheets["Anchors"] = [
        ["id", "tendon resistance [kN]", "kind of anchor", "loop efficiency"],
        [name, 431, kind, efficiency],
    ]
    sheets["Nets"] = [[*sheets["Nets"][0]], [*sheets["Nets"][1]]]
    sheets["Nets"][1][sheets["Nets"][0].index("foot anchor")] = name
    found = resistance(read_site(save(sheets)), "foot_anchor", "tendon")
    assert found.value == pytest.approx(share * 431e3, rel=1e-12)
    assert found.factored_as == factors
    assert (found.derivation is None) is (not factors)


@each(
    "name, kind, tendon, outer, inner",
    [
        ("Stab 32 mm 500/550", "bar", math.pi / 4 * 32.0**2 * 500.0, 32.0, 0.0),
        ("GEWI 63.5", "micropile", math.pi / 4 * 63.5**2 * 555.0, 63.5, 0.0),
        ("IBO R32-210", "micropile", 160e3, 29.1, 20.3),
        ("A1", "bar", None, None, None),
    ],
)
def test_section_and_steel_of_a_bar_follow_from_its_name(
    sheets, save, name, kind, tendon, outer, inner
):
    """By hand, pi/4 d^2 f [N]; a hollow bar by its maker's yield force."""
    sheets["Anchors"] = [
        ["id", "kind of anchor", "lever arm [mm]"],
        [name, kind, 10],
    ]
    sheets["Nets"][1][sheets["Nets"][0].index("foot anchor")] = name
    sheets["Nets"][2:] = []
    row = read_site(save(sheets)).rows[0]
    found = {(one.member, one.mode): one for one in row.resistances}
    steel = found["foot_anchor", "tendon"]
    bent = found["foot_anchor", "bending"].dimensions
    if tendon is None:
        assert (steel.value, bent and bent.section) == (None, None)
        return
    assert steel.value == pytest.approx(tendon, rel=5e-3)
    assert 1e3 * bent.section.outer == pytest.approx(outer, rel=1e-9)
    assert 1e3 * bent.section.inner == pytest.approx(inner, rel=1e-9)


def test_ends_and_spiral_ropes(sheets, save, refused):
    """1x19: K = 0.88 x 19/25 x pi/4, by the wires that are there; swaged 0.9."""
    sheets["Ropes"] = [
        ["id", "rope diameter [mm]", "construction", "rope grade [MPa]", "termination"],
        ["G1", 22, "1x19", 1570, "swaged socket"],
    ]
    by_hand = 0.88 * 19.0 / 25.0 * math.pi / 4.0 * 22.0**2 * 1570.0
    for end, loss in (("swaged socket", 0.9), ("spelter socket", 1.0), ("socket", 0.9)):
        sheets["Ropes"][1][-1] = end
        found = resistance(read_site(save(sheets)), "uphill_guy", "rope")
        assert found.value == pytest.approx(loss * by_hand, rel=1e-6)
    sheets["Ropes"][1][-1] = "clips"
    (finding,) = refused(save(sheets))
    assert "not for a spiral rope, 1x19" in str(finding)
