"""Questions about numbers of a workbook: which, of which net rows, how they end."""

import math
import random

import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.columns.all_tables import SHEETS
from netdesign.site.reader import read_site
from netdesign.words.message import say
from tests.each import each
from tests.make import find_cell, load_tables, read_tables, write_site
from tests.site.plausible.office import alter, draw_office


def two_rows():
    """A post and a bar that the catalogue knows, of one of two rows."""
    tables = load_tables("tiny")
    (row,), (net,) = tables["rows"], tables["net_types"]
    tables["rows"].append({**row, "id": "R2", "net_type": "N2", "foot_anchor": "A2"})
    tables["net_types"].append({**net, "id": "N2", "post": "HEB 120"})
    tables["anchor_types"].append({**tables["anchor_types"][0], "id": "A2"})
    section = {"area": 34.01, "second_moment": 317.5, "section_modulus": 144.1}
    section |= {"post_width": 120, "yield_strength": 235, "buckling_length": 1.9}
    tables["posts"].append({"id": "HEB 120", **section})
    return tables


def test_nothing_is_asked_of_sound_tables():
    site = read_tables(two_rows())
    assert [row.id for row in site.rows if row.questions] == []
    assert site.questions == ()


@each(
    "table, line, key, typed, rows, told",
    [
        ("posts", 1, "second_moment", 3175, ["R2"], "HEB120: 317.5 cm⁴ (EN 10365)"),
        ("posts", 1, "area", 340, ["R2"], "HEB120: 34.01 cm²"),
        ("posts", 1, "section_modulus", 1441, ["R2"], "HEB120: 144.1 or 52.92 cm³"),
        ("posts", 1, "head_eccentricity", 62, ["R2"], "the 60 mm of an empty cell"),
        ("ropes", 0, "rope", 3500, ["R1", "R2"], "50 to 1500 kN"),
        ("anchor_types", 1, "tendon", 3000, ["R2"], "80 to 2500 kN"),
        ("rows", 0, "snow", 0.28, ["R1"], "0.8 to 6.5 m"),
        ("rows", 1, "upslope_length", 200, ["R2"], "4 to 100 m"),
        ("project", 0, "friction_angle", "1.5 to 30", ["R1", "R2"], "5 to 45°"),
        ("net_types", 0, "end_guy_angle", 3, ["R1"], "5 to 65°"),
        ("links", 1, "force", 6200, ["R1", "R2"], "20 to 2000 kN"),
    ],
)
def test_a_slip_is_asked_for_with_its_cell_and_its_rows(
    tmp_path, table, line, key, typed, rows, told
):
    """One of every sheet: none ends a study's other rows."""
    tables = alter(two_rows(), (table, line, key), typed)
    site = read_site(write_site(tmp_path / "site.xlsx", tables))
    (finding,) = [one for one in site.findings if one.severity == "question"]
    if table in ("project", "rows", "net_types", "anchor_types"):
        assert f"{finding.sheet}!{finding.cell}" == find_cell(table, key, line)
    assert [row.id for row in site.rows if row.questions] == rows
    (question,) = site.questions
    assert told in str(question)


def test_every_row_of_a_net_type_is_asked_about_its_outlier(tmp_path):
    """Once only the last row of the type was: the others passed on it."""
    tables = load_tables("tiny")
    (row,), (net,) = tables["rows"], tables["net_types"]
    kinds = ("N1", "N1", "N2", "N3", "N4")
    tables["rows"] = [
        {**row, "id": f"R{k}", "net_type": kind} for k, kind in enumerate(kinds)
    ]
    tables["net_types"] = [
        {**net, "id": one, "net_stiffness": 44_000 if one == "N1" else 3000}
        for one in dict.fromkeys(kinds)
    ]
    site = read_site(write_site(tmp_path / "site.xlsx", tables))
    assert [bool(one.questions) for one in site.rows] == [True, True, *[False] * 3]


SLIP = ("rows", 0, "upslope_length")
CELL = find_cell("rows", "upslope_length")
CONFIRMED = ("all", f"{CELL} = 200", "Drawing 12", "B. Rüegg", "2026-11-03")
KEYS = ("row", "check", "document", "author", "date")


def declare(tmp_path, line, typed=200):
    tables = alter(two_rows(), SLIP, typed)
    tables["declared"] = [dict(zip(KEYS, line, strict=True))]
    return write_site(tmp_path / "site.xlsx", tables)


def test_a_number_that_is_confirmed_is_not_asked_for_and_told(tmp_path):
    site = read_site(declare(tmp_path, CONFIRMED))
    assert (site.questions, site.declared) == ((), ())  # a number is no check
    (told,) = [str(one) for one in site.notes if "B. Rüegg" in str(one)]
    assert f"{CELL} = 200" in told


@each("typed", ["200", "200.0", "200,0", "2.0e2"])
def test_a_confirmed_number_is_confirmed_as_number(tmp_path, typed):
    line = ("all", f"{CELL} = {typed}", *CONFIRMED[2:])
    assert read_site(declare(tmp_path, line)).questions == ()


@pytest.mark.parametrize(
    ("line", "key", "told"),
    [
        (("all", f"{CELL} = 201", *CONFIRMED[2:]), "check", "holds"),
        ((*CONFIRMED[:4], None), "date", "empty"),
        (("all", "Row!E6 = 200", *CONFIRMED[2:]), "check", "no longer true"),
        (("R17", *CONFIRMED[1:]), "row", "no id"),
        ((*CONFIRMED[:2], None, *CONFIRMED[3:]), "document", "empty"),
    ],
)
def test_a_confirmation_that_does_not_hold_is_refused(tmp_path, line, key, told):
    with pytest.raises(SiteDataError) as caught:
        read_site(declare(tmp_path, line))
    found = [one for one in caught.value.findings if one.severity == "error"]
    places = {f"{one.sheet}!{one.cell}": str(one.rule) for one in found}
    assert told in places[find_cell("declared", key)]


def test_bounds_are_wider_than_what_is_usual():
    """A number that is refused need not be asked for."""
    every = [one for plan in SHEETS for one in (*plan.fields, *plan.items)]
    usual = [one for one in every if one.usual]
    assert len(usual) > 40
    for one in usual:
        least, most = one.bounds
        assert least <= one.usual.least < one.usual.most <= most, one.key
        assert str(say(f"plausible.source_{one.usual.source}"))


SURFACE = math.pi * 0.09 * 4.0  # of the bond [m2]
GROUNDS = {"till": (95, 335), "slate": (515, 1380), "gneiss": (35, 4200)}


@each(
    "ground, proven",
    [(one, proven) for one in GROUNDS for proven in ("calculated", "tests")],
)
def test_a_bond_that_its_ground_does_not_have_is_asked_about(ground, proven):
    """1.1 MPa in till, as a review found it."""
    low, high = GROUNDS[ground]
    room = 1.0 if proven == "calculated" else 1.5
    draw = random.Random(ground + proven)
    for seed in range(3):
        bonds = {
            "asked": (high * room * draw.uniform(1.05, 2.0), low / room * 0.9),
            "silent": (high * room * 0.95, low / room * 1.1),
        }
        for expected, values in bonds.items():
            for bond in values:
                pull = round(bond * SURFACE, 1)
                if not 45.0 < pull < 1900.0:  # asked about in any case
                    continue
                tables = draw_office(seed, rows=2)
                for line in tables["rows"]:
                    line["ground"] = ground
                for line in tables["anchor_types"]:
                    line["ground"] = ground
                tables["anchor_types"][0] |= {
                    **{"drill_diameter": 90, "bond_length": 4, "proven": proven},
                    **{"pull_out": pull, "tendon": round(min(pull / 0.78, 2400.0), 1)},
                }
                told = list(map(str, read_tables(tables).questions))
                found = [one for one in told if "is a bond of" in one]
                assert bool(found) == (expected == "asked"), (bond, told)


MOST_FALSE_ALARMS = 0.01


@pytest.mark.parametrize("sites", [10, pytest.param(200, marks=pytest.mark.long)])
def test_sensible_sites_are_asked_nothing(sites):
    """Drawn by what is built, not by what counts as usual here."""
    alarms = []
    for seed in range(5000, 5000 + sites):
        alarms += [str(one) for one in read_tables(draw_office(seed)).questions]
    assert len(alarms) <= MOST_FALSE_ALARMS * sites, alarms[:20]
