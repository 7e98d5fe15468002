"""Parts of the catalogue that bear a force: the next smaller one does not."""

import math
import random

import pytest

from netdesign.site.model import Resistance
from netdesign.study.remedies import find_size
from netdesign.words.catalogue import LANGUAGES, render
from netdesign.words.message import say
from tests.each import each

BAR = say("derivation.bar", diameter=25.0, strength=670.0)
BUCKLING = say(
    "derivation.buckling",
    **{"reduction": 0.5, "area": 34.0, "strength": 235.0, "slenderness": 1.0},
    **{"curve": "d", "imperfection": 0.76, "critical": 400.0, "modulus": 210000},
    **{"second_moment": 318.0, "length": 3.2, "origin": ""},
)


def build(mode, derivation=None, type_id="HEB 120"):
    return Resistance(
        member="foot_anchor",
        mode=mode,
        source="Anchors!B2",
        value=1e5,
        type_id=type_id,
        derivation=derivation,
    )


def test_a_bar_is_the_next_of_the_catalogue_of_its_steel():
    rng = random.Random(11)
    for _ in range(40):
        needed = rng.uniform(20.0, 1500.0)
        found = find_size(build("tendon", BAR), needed)
        diameter = found[0].arguments["diameter"]
        assert found[1] == pytest.approx(math.pi / 4.0 * diameter**2 * 0.67, rel=1e-9)
        assert found[1] >= needed
        smaller = find_size(build("tendon", BAR), 0.6 * needed)
        assert smaller[1] <= found[1]
    assert find_size(build("tendon", BAR), 5000.0) is None


def test_a_section_stays_in_its_series():
    names = []
    for needed in (50.0, 150.0, 400.0, 900.0):
        found = find_size(build("compression", BUCKLING), needed)
        assert found[1] >= needed
        names.append(found[0].arguments["name"])
    assert all(one.startswith("HEB") for one in names)
    sizes = [int(one.removeprefix("HEB")) for one in names]
    assert sizes == sorted(sizes)
    assert sizes[0] < sizes[-1]
    unknown = build("compression", BUCKLING, type_id="timber post")
    assert find_size(unknown, 50.0) is None


@each("language", LANGUAGES)
@each(
    "mode, how",
    [("tendon", BAR), ("compression", BUCKLING), ("rope", None)],
)
def test_each_part_has_its_sentence(mode, how, language):
    found = find_size(build(mode, how), 120.0)
    text = render(found[0], language)
    assert any(sign.isdigit() for sign in text)
    assert "{" not in text
