"""The whole chain of a row: mesh, ropes, links, steel over its life, ground."""

import math
import random
from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.outcome import Verdict
from netdesign.resistance.ground import AnchorType, Soil
from netdesign.site.model import Resistance
from netdesign.site.reader import read_site
from netdesign.structure.members import Member
from netdesign.study.judge import judge_site
from netdesign.study.row_to_check import CheckRun
from tests.each import each
from tests.grid import solve_site
from tests.make import load_rows, write_site

RUN = CheckRun(settings=SolverSettings(accuracy=0.05, levels=MESH_LEVELS[:2]))
NF = load_standard("nf-p-95-304-style")
WORST = (Verdict.FAIL, Verdict.NOT_PROVEN, Verdict.DECLARED, Verdict.PASS)


@pytest.fixture(scope="module")
def solved(tmp_path_factory):
    """Row R4, whose foot anchor is a bar, on three cases; all of it is stated."""
    cells = {"R4": {"post_count": 20, "ropes_at_supports": "slide"}}
    tables = load_rows(["R4"], cells=cells)
    tables["project"][0] |= {"friction_angle": 30, "inclination": 30}
    path = tmp_path_factory.mktemp("chain") / "site.xlsx"
    site = state_all(read_site(write_site(path, tables)))
    return site, solve_site(site, RUN)


def state_all(site):
    """Site of which somebody says what an office leaves to conditions of the study."""
    links = {
        name: tuple(replace(one, is_of_whole=True) for one in chain)
        for name, chain in site.links.items()
    }
    return replace(site, links=links)


def judge(solved, standard=NF, links=None, **changes):
    """Study of the row with some of its inputs changed; its forces stay."""
    site, rows = solved
    changed = replace(site, rows=tuple(replace(row, **changes) for row in site.rows))
    if links is not None:
        changed = replace(changed, links=links)
    study = judge_site(changed, rows, standard, RUN)
    return study, {check.id: check for check in study.rows[0].checks}


def change(resistances, member, **special):
    return tuple(
        replace(one, **special) if one.member == member else one for one in resistances
    )


@each(
    "member, wear, said",
    [
        ("foot_anchor", {"outer": None}, "bar diameter"),
        ("uphill_anchor", {"protection": "none"}, "no thickness to lose"),
    ],
)
def test_steel_of_which_something_is_not_said_is_not_proven(solved, member, wear, said):
    given = solved[0].rows[0].resistances
    found = tuple(
        replace(one, wear=replace(one.wear, **wear))
        if one.member == member and one.wear
        else one
        for one in given
    )
    _, checks = judge(solved, resistances=found)
    check = checks[f"{member}.tendon"]
    assert check.verdict is Verdict.NOT_PROVEN
    assert said in str(check.reason)


def test_a_chain_of_which_no_link_is_given_is_not_proven(solved):
    links = {name: one for name, one in solved[0].links.items() if name != "G28"}
    _, checks = judge(solved, links=links)
    check = checks["uphill_guy.connection"]
    assert check.verdict is Verdict.NOT_PROVEN
    assert "no link of type G28 is given on sheet Parts" in str(check.reason)


@each("seed", range(10))
def test_a_chain_that_nobody_calls_complete_has_a_usual_link(solved, seed):
    """0.5 of the rope, (R17a): it turns a pass into not proven, never into a fail."""
    draw = random.Random(seed)
    whole = {
        name: tuple(
            replace(one, kind="eye", limit=None, breaking=draw.uniform(60e3, 900e3))
            for one in links
        )
        for name, links in solved[0].links.items()
    }
    listed = {
        name: tuple(replace(one, is_of_whole=False) for one in links)
        for name, links in whole.items()
    }
    _, checks = judge(solved, links=whole)
    _, fewer = judge(solved, links=listed)
    steel = {"rope": "rope", "anchor": "tendon"}
    for name, check in fewer.items():
        if check.mode != "connection":
            assert check.verdict is checks[name].verdict
            continue
        mode = steel["anchor" if check.member.endswith("anchor") else "rope"]
        of_type = checks[name.replace("connection", mode)]
        own = checks[name].read("R_k")
        usual = 0.5 * next(
            one.value / 1e3
            for one in solved[0].catalogue
            if (one.type_id, one.mode) == (of_type.resistance_type, mode)
        )
        assert check.read("R_k") == pytest.approx(min(own, usual))
        was = checks[name].verdict
        decides = usual < own and check.demand_kN > usual / 1.5
        turned = Verdict.NOT_PROVEN if was is Verdict.PASS and decides else was
        assert check.verdict is turned, name
        if turned is not was:
            assert "chain = complete" in str(check.reason)


def test_of_anchors_of_guys_of_which_nobody_says_whose_they_are_the_worse_counts(
    solved,
):
    row = solved[0].rows[0]
    unsaid, own, shared = (
        judge(solved, guys=replace(row.guys, are_shared=way))[1]
        for way in (None, False, True)
    )
    assert unsaid.keys() == own.keys() == shared.keys()
    for name, check in unsaid.items():
        both = [own[name], shared[name]]
        worse = min(WORST.index(one.verdict) for one in both)
        assert WORST.index(check.verdict) <= worse, name
        used, *others = (one.utilisation for one in (check, *both))
        assert used is None or used >= max(filter(None, others)) * (1.0 - 1e-9), name


@each("seed", range(4))
def test_a_bore_that_runs_out_of_the_ground_fails(solved, seed):
    """Axes against the slope: a bond lies in the ground where its axis is above 0."""
    draw = random.Random(seed)
    axis = math.radians(draw.uniform(3.0, 40.0))
    member = draw.choice((Member.UPHILL_ANCHOR, Member.DOWNHILL_ANCHOR))
    assert "geometry.cover" not in judge(solved, axes=((member, axis),))[1]
    check = judge(solved, axes=((member, -axis),))[1]["geometry.cover"]
    assert check.verdict is Verdict.FAIL
    assert check.reason.key == "bores.leaves_ground"


def stand_in(solved, cohesion):
    """Study of the row in ground of that cohesion [Pa] instead of under a cover."""
    row = solved[0].rows[0]
    soil = Soil(cohesion=cohesion, friction=math.radians(34.3), weight=19.7e3)
    anchors = tuple((member, replace(kind, soil=soil)) for member, kind in row.anchors)
    held = tuple(
        Resistance(
            member=member,
            mode="wedge",
            source="Anchors!V5",
            basis="computed",
            type_id="A",
            dimensions=kind,
        )
        for member, kind in anchors
    )
    others = (one for one in row.resistances if one.mode != "wedge")
    resistances = (*others, *held)
    study, checks = judge(solved, anchors=anchors, resistances=resistances)
    return study, checks, soil


def test_ground_that_slides_by_itself_fails(solved):
    _, checks, _ = stand_in(solved, 1e3)
    check = checks["uphill_anchor.wedge"]
    assert check.verdict is Verdict.FAIL
    # 5 m along a bore that dips 15 degrees below level, on 40 degrees: 5 sin 55
    assert "A slab of the slope, 4.1 m deep, slides by itself" in str(check.reason)


def test_ground_that_others_check_has_no_wedge(solved):
    less = replace(NF, not_checked=("anchor_ground",))
    assert "uphill_anchor.wedge" in stand_in(solved, 43e3)[1]
    checks = judge(solved, less)[1]
    assert not [name for name in checks if "wedge" in name or "cover" in name]


def test_anchors_that_cross_in_the_ground_are_not_proven(solved):
    row = solved[0].rows[0]
    crossing = replace(row.guys, are_shared=False)
    check = judge(solved, guys=crossing)[1]["geometry.anchors"]
    assert check.verdict is Verdict.NOT_PROVEN
    assert "come as near as 0.00 m" in str(check.reason)


def test_a_row_above_too_near_leaves_the_anchors_not_proven(solved):
    near = judge(solved, upslope_length=9.7)[1]["geometry.anchors"]
    assert near.verdict is Verdict.NOT_PROVEN
    assert "a row above built alike" in str(near.reason)


@pytest.mark.parametrize(
    ("drilled", "bond", "depth"),
    # 35 degrees: (5.6 - 2.4 / 2) sin 35, else half of the length that is given
    [(5.6, 2.4, 2.5237), (5.6, None, 1.6060), (None, 2.4, 0.6883)],
)
def test_depth_of_a_bond_is_that_of_its_middle(drilled, bond, depth):
    kind = AnchorType(kind="bar", section=None, lever=None, drilled=drilled, bond=bond)
    assert kind.find_cover(math.radians(35.0)) == pytest.approx(depth, abs=1e-4)


@each("basis", ["computed", "tested"])
@each("axis", [-9.3, 14.1, 38.9, 49.2, 50.6, 63.0])
def test_no_bond_in_a_flat_borehole_is_proven(solved, axis, basis):
    """Of a slope of 40 degrees: flat below an axis of 50."""
    row = solved[0].rows[0]
    strong = change(
        row.resistances,
        Member.FOOT_ANCHOR,
        value=9e6,
        basis=basis,
        tests=None,
    )
    axes = {**dict(row.axes), Member.FOOT_ANCHOR: math.radians(axis)}
    _, checks = judge(solved, resistances=strong, axes=tuple(axes.items()))
    dip = axis - math.degrees(row.slope_angle)
    check = checks["foot_anchor.pull_out"]
    is_open = dip < 10.0
    assert (check.verdict is Verdict.NOT_PROVEN) is is_open, check.reason
    assert ("grout may run out" in str(check.reason)) is is_open


def test_notes_say_what_snow_the_guys_bear(solved):
    study, checks = judge(solved)
    (row,) = study.rows
    told = [str(note) for note in row.notes]
    (guys,) = (one for one in told if one.startswith("width of snow that a guy"))
    for name in ("Uphill guy", "Downhill guy"):
        demand = checks[f"{name.replace(' ', '_').lower()}.rope"].demand_kN
        assert (name in guys) is (demand > 0.0)
    no_reserve = change(solved[0].rows[0].resistances, "uphill_guy", value=1e3)
    weak = judge(solved, resistances=no_reserve)[0].rows[0].notes
    assert not [
        one for one in map(str, weak) if "Uphill guy" in one and "width of snow" in one
    ]
