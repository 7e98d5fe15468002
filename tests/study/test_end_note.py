"""Own end effect beside the profile's, as a note that decides nothing."""

import math
from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.envelope.ranges import Interval, Ranges
from netdesign.haefeli.slab import Slab
from netdesign.planview.end_effect import compute_end_effect
from netdesign.snow.creep_law import BOUTILLIER_2004, GAGLIARDINI_1997
from netdesign.study.effects import find_effects, list_end_notes
from netdesign.words.catalogue import LANGUAGES, render
from tests.each import each
from tests.small_site import build_row

STANDARD = load_standard("swiss-guideline-2007")
RANGES = Ranges.of(
    density=Interval(low=243.0, high=391.0, count=2),
    friction_angle=Interval(low=0.4, high=0.4, count=1),
    inclination=Interval(low=0.5, high=0.5, count=1),
)
ROW = build_row("R7", gap=1.3, glide_factor=2.1)


def notes(row=ROW, standard=STANDARD, law=BOUTILLIER_2004):
    return list_end_notes(row, RANGES, law, find_effects(row, standard, RANGES))


def test_note_has_both_effects_over_the_same_length():
    (note,) = notes()
    given = note.arguments
    # (S9) by hand: A = 1.3 m, N = 2.1
    assert given["factor"] == pytest.approx((0.92 + 0.65 * 2.1) * 0.65, rel=1e-12)
    assert given["length"] == pytest.approx(0.6 * 0.65, rel=1e-12)
    assert given["width"] == pytest.approx(given["factor"] * 0.39, rel=1e-12)
    assert given["density"] == pytest.approx(317.0)
    own = compute_end_effect(
        Slab(thickness=ROW.snow_thickness, slope_angle=ROW.slope_angle, density=317.0),
        gap=1.3,
        glide_factor=2.1,
        length=0.39,
    )
    assert (given["free"], given["free_width"]) == (own.free.factor, own.free.width)
    assert (given["pulled"], given["pulled_width"]) == (
        own.pulled.factor,
        own.pulled.width,
    )


@pytest.mark.parametrize(
    ("gap", "key"),
    [
        (0.5, "row.own_end_effect_larger"),
        (1.8, "row.own_end_effect"),
        (math.inf, "row.own_end_effect"),
    ],
)
def test_note_says_where_the_profile_gives_less(gap, key):
    (note,) = notes(replace(ROW, gap=gap))
    assert note.key == key
    width = note.arguments["width"]
    assert (note.arguments["free_width"] > width) is key.endswith("larger")


@each("language", LANGUAGES)
@each("gap", [0.5, math.inf])
def test_note_shows_its_numbers_in_every_language(language, gap):
    (note,) = notes(replace(ROW, gap=gap))
    shown = render(note, language).replace(",", ".")
    for name in ("factor", "free", "free_width", "pulled", "pulled_width"):
        assert f"{note.arguments[name]:.2f}" in shown


def test_no_note_without_an_end_or_a_rule():
    assert notes(replace(ROW, gap=0.0)) == []
    bare = replace(
        STANDARD,
        values=tuple(v for v in STANDARD.values if not v.id.startswith("end.")),
    )
    assert notes(standard=bare) == []


def test_no_note_on_snow_that_the_law_does_not_take():
    assert notes(law=GAGLIARDINI_1997) == []
