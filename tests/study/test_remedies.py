"""What makes a check pass: a type of the sheet."""

import random

import pytest

from netdesign.checks import load_standard
from netdesign.site.reader import read_site
from netdesign.snow.creep_law import BOUTILLIER_2004
from netdesign.study.remedies import find_type_change
from netdesign.study.row_to_check import Basis
from tests.make import find_cell, write_rows

PROFILE = load_standard("nf-p-95-304-style")
USED = (1, 2, 3)  # those of the row
LINES = range(8)  # of the types in sheet Anchors


@pytest.fixture(scope="module")
def workbook(tmp_path_factory):
    path = tmp_path_factory.mktemp("site") / "site.xlsx"
    write_rows(path, ["R1"])
    return path


def name_ground(line):
    """Cell with the ground of a type."""
    return find_cell("anchor_types", "ground", line)


def list_offers(site, demand):
    """Anchors of the row, each with the type that is offered for it [kN]."""
    (row,) = site.rows
    basis = Basis(site=site, row=row, standard=PROFILE, law=BOUTILLIER_2004)
    ends = row.row_end.resistances if row.row_end else ()
    for given in (*row.resistances, *ends):
        offer = find_type_change(basis, given, demand, None)
        if given.mode in ("tendon", "pull_out") and offer is not None:
            yield given, offer.quantity


@pytest.mark.long
def test_whatever_is_known_of_grounds_no_type_of_another_one_is_offered(workbook):
    dice = random.Random(20261124)
    kinds = set()
    for _ in range(40):
        ground = dice.choice(("till", "rock", ""))
        drawn = {name_ground(n): dice.choice(("till", "rock", "")) for n in LINES}
        built = {name_ground(n): dice.choice((ground, "")) for n in USED}
        instead = drawn | built | {find_cell("rows", "ground"): ground}
        instead = {cell: one for cell, one in instead.items() if one != "till"}
        site = read_site(workbook, instead=instead)
        grounds = {one.type_id: one.ground for one in site.catalogue}
        for given, told in list_offers(site, dice.uniform(230.0, 650.0)):
            ground = site.rows[0].ground_type or given.ground
            assert not ground or grounds[told.arguments["type"]] == ground
            kinds.add((bool(ground), given.mode))
    assert len(kinds) == 4  # known or not, of tendons and of pull-outs


def test_a_type_of_which_nobody_gives_the_ground_is_not_offered(workbook):
    """A32 would do with 0.8 x 1200 / 1.5 = 640 kN, A40 with 0.8 x 1300 / 1.5 = 693.

    Between them lies B50, whose 1100 kN lose 8 % by rust of 80 years.
    """
    unknown = {name_ground(0): ""}
    for instead, expected in (({}, "A32-tested"), (unknown, "B50-tested")):
        site = read_site(workbook, instead=instead)
        offers = {
            given.member: told
            for given, told in list_offers(site, 600.0)
            if given.mode == "tendon"
        }
        assert offers["foot_anchor"].key == "change.type_of_workbook"
        assert offers["foot_anchor"].arguments["type"] == expected
