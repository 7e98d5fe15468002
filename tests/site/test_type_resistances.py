"""What types bear: by their numbers, tests, dimensions and names."""

import math
import random
from statistics import fmean

import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.reader import read_site
from netdesign.words.catalogue import LANGUAGES
from tests.each import each
from tests.make import find_cell, load_tables, read_tables, write_site


def tiny():
    """Tables of one row, whose anchors are of type A1."""
    return load_tables("tiny")


def refuse(path, tables):
    with pytest.raises(SiteDataError) as caught:
        read_site(write_site(path / "site.xlsx", tables))
    return [one for one in caught.value.findings if one.severity == "error"]


def find(site, member, mode):
    (row, *_) = site.rows
    return next(x for x in row.resistances if (x.member, x.mode) == (member, mode))


def name_anchor(tables, name, **cells):
    """The only anchor type is another one."""
    tables["anchor_types"] = [{"id": name, **cells}]
    for key in ("foot_anchor", "uphill_anchor", "downhill_anchor", "end_anchor"):
        tables["rows"][0][key] = name
    tables["links"] = [one for one in tables["links"] if one["type"] != "A1"]
    return tables


ROPE = ("tendon", "rope")  # factors of a tendon that may be a rope


@each(
    "name, kind, share, factors",
    [
        ("A1", "bar", 1.0, ()),
        ("A1", "micropile", 1.0, ()),
        ("A1", "rope anchor", 0.8, ROPE),
        ("A1", None, 0.8, ROPE),
        ("GEWI 32", None, 1.0, ()),  # a bar by its name
    ],
)
def test_tendon_by_the_kind_of_anchor(name, kind, share, factors):
    tables = name_anchor(tiny(), name, tendon=431, kind=kind)
    found = find(read_tables(tables), "foot_anchor", "tendon")
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
    name, kind, tendon, outer, inner
):
    """By hand, pi/4 d^2 f [N]; a hollow bar by its maker's yield force."""
    site = read_tables(name_anchor(tiny(), name, kind=kind, lever_arm=10))
    steel = find(site, "foot_anchor", "tendon")
    bent = find(site, "foot_anchor", "bending").dimensions
    if tendon is None:
        assert (steel.value, bent and bent.section) == (None, None)
        return
    assert steel.value == pytest.approx(tendon, rel=5e-3)
    assert 1e3 * bent.section.outer == pytest.approx(outer, rel=1e-9)
    assert 1e3 * bent.section.inner == pytest.approx(inner, rel=1e-9)


@each("seed", range(5))
def test_the_steel_of_a_bar_is_that_of_its_force_and_diameter(seed):
    draw = random.Random(seed)
    diameter, strength = draw.uniform(22, 50), draw.uniform(420, 900)
    force = math.pi / 4 * diameter**2 * strength / 1e3
    cells = {"kind": "bar", "tendon": force, "bar_diameter": diameter}
    site = read_tables(name_anchor(tiny(), "own bar", **cells))
    section = find(site, "foot_anchor", "bending").dimensions.section
    assert 1e3 * section.outer == pytest.approx(diameter, rel=1e-9)
    assert section.strength == pytest.approx(1e6 * strength, rel=1e-9)


def test_a_type_without_a_ground_stands_in_that_of_every_row():
    """Once its bond was worked out for the row's ground, and its id was unknown."""
    cells = {"kind": "bar", "tendon": 400, "drill_diameter": 90, "bond_length": 4}
    site = read_tables(name_anchor(tiny(), "A1", **cells))
    found = find(site, "foot_anchor", "pull_out")
    assert (found.type_id, found.value, found.basis) == ("A1", None, "")


@each("name", ["HEB 120", "HEA 160"])
def test_the_section_of_a_post_follows_from_its_name(name):
    tables = tiny()
    tables["posts"] = [{"id": name, "yield_strength": 235}]
    tables["net_types"][0]["post"] = name
    post = find(read_tables(tables), "post", "compression")
    assert post.value > 0.0
    assert "second moment" not in str(post.lack)
    assert post.buckling_length == pytest.approx(1.5 / math.cos(math.radians(15)) + 0.3)


@each("end, loss", [("swaged", 0.9), ("spelter", 1.0), (None, 0.75), ("included", 1.0)])
def test_the_ends_of_a_rope_take_their_share(end, loss):
    tables = tiny()
    tables["ropes"][0] |= {"termination": end}
    found = find(read_tables(tables), "uphill_guy", "rope")
    assert found.value == pytest.approx(loss * 1400e3, rel=1e-9)


def test_clips_are_not_for_a_spiral_rope(tmp_path):
    tables = tiny()
    spiral = {"id": "1x19 22 mm 1570", "rope": 320, "termination": "clips"}
    tables["ropes"].append(spiral)
    tables["net_types"][0]["uphill_guy"] = spiral["id"]
    found = refuse(tmp_path, tables)
    assert [one.rule.key for one in found] in (["type.clips_on_spiral"], [])


@each(
    "cells, key, told",
    [
        ({"lever_arm": 287.3}, "lever_arm", "needs more beside it: kind"),
        ({"lever_arm": 12, "kind": "rope anchor"}, "lever_arm", "does not fit kind"),
        ({"bar_diameter": 32, "kind": "rope anchor"}, "bar_diameter", "does not fit"),
        ({"tube_diameter": 114, "kind": "bar"}, "tube_diameter", "needs more beside"),
        ({"test_count": 3}, "test_count", "needs more beside it: pull-out"),
        (
            {"pull_out": 300, "proven": "tests", "test_count": 2, "test_mean": 290},
            "pull_out",
            "exceeds the mean in Anchors!",
        ),
        ({"ground": "gravle"}, "ground", "is not a known word"),
    ],
)
def test_contradictions_and_gaps_are_refused_at_their_cell(tmp_path, cells, key, told):
    (finding,) = refuse(tmp_path, name_anchor(tiny(), "A1", tendon=400, **cells))
    assert f"{finding.sheet}!{finding.cell}" == find_cell("anchor_types", key)
    assert told in str(finding)


# Single tests


def with_tests(tests, **cells):
    return name_anchor(tiny(), "A1", tendon=900, **cells) | {"tests": tests}


@each("language", LANGUAGES)
def test_tests_count_for_their_type_in_their_ground(tmp_path, language):
    draw = random.Random(language)
    forces = {
        ground: [round(draw.uniform(150.0, 400.0), 1) for _ in range(4)]
        for ground in ("scree", "rock")
    }
    tests = [
        {"type": "A1", "ground": ground, "force": force}
        for ground, listed in forces.items()
        for force in listed
    ]
    draw.shuffle(tests)
    for ground, listed in forces.items():
        tables = with_tests(tests)
        tables["rows"][0]["ground"] = ground
        path = write_site(tmp_path / "site.xlsx", tables, language)
        found = find(read_site(path), "foot_anchor", "pull_out")
        assert (found.ground, found.tests.count) == (ground, 4)
        assert found.tests.least == pytest.approx(1e3 * min(listed))
        assert found.tests.mean == pytest.approx(1e3 * fmean(listed))


PULLED = ("foot_anchor", "pull_out")


@each(
    "cells, key",
    [
        ({"type": "A99", "force": 200.0}, "type"),
        ({"type": "A1", "ground": "swamp", "force": 200.0}, "ground"),
        ({"type": "A1", "ground": "rock", "force": "much"}, "force"),
        ({"type": "A1", "ground": "rock", "force": 0.2}, "force"),
        ({"type": "A1", "ground": "scree", "force": 222.0}, "ground"),
    ],
)
def test_what_is_no_test_is_refused_in_its_cell(tmp_path, cells, key):
    own = {"ground": "till"} if cells.get("ground") == "scree" else {}
    found = refuse(tmp_path, with_tests([cells], **own))
    assert f"{found[0].sheet}!{found[0].cell}" == find_cell("tests", key)


def draw_tests(draw, count):
    forces = [round(draw.uniform(250.0, 310.0), 1) for _ in range(count)]
    return [{"type": "A1", "ground": "till", "force": x} for x in forces]


@each("seed", range(8))
def test_single_tests_beside_a_number_of_the_type_are_refused(tmp_path, seed):
    draw = random.Random(seed)
    tests = draw_tests(draw, draw.choice((2, 3, 5)))
    forces = [one["force"] for one in tests]
    alone = with_tests(tests, ground="till")
    assert find(read_tables(alone), *PULLED).tests.least == 1e3 * min(forces)
    typed = {"test_count": len(forces), "test_mean": 200.5, "pull_out": min(forces)}
    keys = draw.sample(sorted(typed), draw.randint(1, 3))
    typed = {key: typed[key] for key in keys}
    found = refuse(tmp_path, with_tests(tests, ground="till", **typed))
    assert {one.sheet for one in found} == {"Tests"}
    assert "Anchors!" in " ".join(map(str, found))


@each("seed", range(6))
def test_a_list_of_tests_that_stands_twice_is_asked_about(tmp_path, seed):
    path, draw = tmp_path / "site.xlsx", random.Random(seed)
    tests = draw_tests(draw, draw.choice((1, 3, 4)))
    pasted = [*tests, *map(dict, tests)]
    site = read_site(write_site(path, with_tests(pasted, ground="till")))
    again = [one for one in map(str, site.questions) if "again" in one]
    assert len(again) == len(tests)
    assert all(row.questions for row in site.rows)
    told = [one | {"displacement": 10.0 + k} for k, one in enumerate(pasted)]
    site = read_site(write_site(path, with_tests(told, ground="till")))
    assert not any("again" in one for one in map(str, site.questions))


# Links, and ropes between the posts


def test_links_of_a_type_make_its_chain_in_their_order():
    tables = tiny()
    shackle = {"type": "g1", "link": "shackle", "force": 64.2, "meaning": "limit"}
    plate = {"type": "A1", "link": "plate", "force": 501, "meaning": "strength"}
    tables["links"] = [
        {"type": "G1", "link": "thimble", "force": 213.5, "meaning": "strength"},
        {"type": "A1", "link": "eye", "force": 310},
        shackle | {"count": 2},
        plate | {"angle": 12, "chain": "complete"},
    ]
    site = read_tables(tables)
    assert [link.is_of_whole for link in site.links["A1"]] == [False, True]
    assert not any(link.is_of_whole for link in site.links["G1"])
    thimble, shackle = site.links["G1"]
    assert (thimble.kind, thimble.breaking, thimble.limit) == ("thimble", 213.5e3, None)
    assert (shackle.limit, shackle.count, shackle.angle) == (64.2e3, 2, None)
    assert site.links["A1"][0].breaking == 310e3
    assert site.links["A1"][1].angle == pytest.approx(0.20944, rel=1e-4)
    assert shackle.source.startswith("Parts!")


@each(
    "link",
    [
        {"type": "G19", "link": "eye", "force": 90},
        {"type": "G1", "link": "eye"},
        {"type": "G1", "link": "hook", "force": 90},
        {"type": "G1", "link": "eye", "force": 90, "meaning": "about"},
    ],
)
def test_a_link_that_is_none_is_one_finding(tmp_path, link):
    tables = tiny()
    tables["links"] = [link]
    (finding,) = refuse(tmp_path, tables)
    assert finding.sheet == "Parts"


# What is listed of empty cells


EMPTIED = {
    "design_life": ("project", "design_life"),
    "guy_anchors": ("net_types", "guy_anchors"),
    "mid_anchors": ("net_types", "mid_anchors"),
    "anchor_kind": ("anchor_types", "kind"),
    "end_guy_angle": ("net_types", "end_guy_angle"),
    "slack": ("net_types", "slack"),
    "upslope_length": ("rows", "upslope_length"),
    "altitude": ("rows", "altitude"),
}


@each("key", EMPTIED)
def test_what_is_emptied_is_listed_and_nothing_else(key):
    tables = tiny()
    whole = {one.key for row in read_tables(tables).rows for one in row.assumed}
    table, column = EMPTIED[key]
    tables[table][0].pop(column)
    less = {one.key for row in read_tables(tables).rows for one in row.assumed}
    beside = {"lever_arm"} if key == "anchor_kind" else set()
    assert less - whole == {key} | beside
