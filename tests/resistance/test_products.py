"""Products by name: their numbers against one another, and what names mean.

Figures from elsewhere: FACTS.md, section 14.
"""

import math
import random
import string
import tomllib
from itertools import pairwise
from pathlib import Path

import pytest

from netdesign.resistance.catalogue import (
    compute_box,
    compute_tube,
    join,
    load_catalogue,
    load_products,
)
from netdesign.resistance.products import find_bar, find_product
from netdesign.words.catalogue import LANGUAGES, render
from tests.each import each

SERIES = load_products()["section"]["series"]
BEAMS = [f"{name}{size}" for name, one in SERIES.items() for size in one["sizes"]]
BARS = [(one, size) for one in load_products()["bar"] for size in one["diameters"]]
HOLLOW = [
    f"{bar['series']} {mark}"
    if bar["series"] == "TITAN"
    else f"{bar['series']}{'-' if len(mark) > 2 else '/'}{mark}"
    for family in load_products()["hollow"]["family"]
    for bar in family["bars"]
    for mark in bar["marks"]
    if not mark.isalpha()
]


def one(name, quantity, unit=1.0):
    """Value of a quantity that a name leaves no choice of."""
    low, high = find_product(name).values[quantity]
    assert low == high
    return low / unit


def integrate(widths, depth, strips=20_000):
    """Area and second moment of a symmetrical section, of strips by their height."""
    step = depth / strips
    heights = [(k + 0.5) * step - depth / 2.0 for k in range(strips)]
    area = sum(widths(z) for z in heights) * step
    return area, sum(widths(z) * z * z for z in heights) * step


def beam_width(z, h, b, web, flange, root):
    """Width of an I-section at the height z, with its root fillets."""
    below = h / 2.0 - flange - abs(z)  # under the flange
    if below < 0.0:
        return b
    if below > root:
        return web
    return web + 2.0 * (root - math.sqrt(root**2 - (root - below) ** 2))


def compute_beam_side(h, b, web, flange, root):
    """Second moment about the weak axis; of the fillets by their centroid."""
    fillet = (1.0 - math.pi / 4.0) * root**2
    lever = web / 2.0 + root * (10.0 - 3.0 * math.pi) / (12.0 - 3.0 * math.pi)
    own = 1.0 / 3.0 - math.pi / 16.0 - 1.0 / (36.0 - 9.0 * math.pi)
    plates = 2.0 * flange * b**3 / 12.0 + (h - 2.0 * flange) * web**3 / 12.0
    return plates + 4.0 * (own * root**4 + fillet * lever**2)


@each("name", BEAMS)
def test_tables_of_beams_are_what_their_dimensions_give(name):
    words = ("depth", "width", "web_thickness", "flange_thickness", "root_radius")
    h, b, web, flange, root = (one(name, word) for word in words)
    area, strong = integrate(lambda z: beam_width(z, h, b, web, flange, root), h)
    weak = compute_beam_side(h, b, web, flange, root)
    given = {
        "area": area,
        "second_moment_strong": strong,
        "second_moment_weak": weak,
        "section_modulus_strong": 2.0 * strong / h,
        "section_modulus_weak": 2.0 * weak / b,
    }
    for quantity, value in given.items():
        assert one(name, quantity) == pytest.approx(value, rel=1e-3), quantity


@pytest.mark.parametrize("series", SERIES)
def test_larger_beams_are_larger(series):
    for small, large in pairwise(SERIES[series]["sizes"].values()):
        assert all(a < b for a, b in zip(small[5:], large[5:], strict=True))


@pytest.mark.parametrize(
    ("name", "area", "strong", "weak", "modulus"),
    [  # as printed in tables of mills, cm2, cm4, cm3
        ("HEB120", 34.0, 864, 318, 144),
        ("IPE 140", 16.4, 541, 44.9, 77.3),
        ("HEA 160", 38.8, 1673, 616, 220),
        ("HEB200", 78.1, 5696, 2003, 570),
        ("CHS 76.1x3.6", 8.20, 54.0, 54.0, 14.2),
    ],
)
def test_values_known_from_elsewhere(name, area, strong, weak, modulus):
    assert one(name, "area", 1e-4) == pytest.approx(area, rel=2e-3)
    assert one(name, "second_moment_strong", 1e-8) == pytest.approx(strong, rel=2e-3)
    assert one(name, "second_moment_weak", 1e-8) == pytest.approx(weak, rel=2e-3)
    assert one(name, "section_modulus_strong", 1e-6) == pytest.approx(modulus, rel=5e-3)


@each(
    "name, quantity, cold, hot",
    [  # EN 10219-2 and EN 10210-2 as mills print them, cm2, cm4
        ("SHS 80x4", ("area", 1e-4), 11.7, 12.0),
        ("SHS 80x4", ("second_moment_strong", 1e-8), 111, 114),
        ("SHS 100x5", ("area", 1e-4), 18.4, 18.7),
        ("SHS 100x5", ("second_moment_strong", 1e-8), 271, 279),
        ("SHS 100x8", ("area", 1e-4), 27.2, 28.8),
        ("SHS 200x12.5", ("area", 1e-4), 87.0, 92.1),
        ("RHS 80x40x4", ("second_moment_weak", 1e-8), 21.5, 22.2),
    ],
)
def test_boxes_are_hot_finished_or_cold_formed(name, quantity, cold, hot):
    word, unit = quantity
    low, high = find_product(name).values[word]
    assert low / unit == pytest.approx(cold, rel=5e-3)
    assert high / unit == pytest.approx(hot, rel=5e-3)


def test_a_box_is_what_its_strips_add_up_to():
    def width(z, h, b, r):
        into = max(abs(z) - (h / 2.0 - r), 0.0)
        return b - 2.0 * (r - math.sqrt(r**2 - into**2))

    found = compute_box(0.1, 0.06, 0.008, outer=0.02, inner=0.012)
    area, second = integrate(
        lambda z: (
            width(z, 0.1, 0.06, 0.02)
            - (width(z, 0.084, 0.044, 0.012) if abs(z) < 0.042 else 0.0)
        ),
        0.1,
    )
    assert found["area"] == pytest.approx(area, rel=1e-5)
    assert found["second_moment_strong"] == pytest.approx(second, rel=1e-5)
    turned = compute_box(0.06, 0.1, 0.008, outer=0.02, inner=0.012)
    assert turned["second_moment_weak"] == found["second_moment_strong"]
    assert turned["section_modulus_weak"] == found["section_modulus_strong"]
    assert found["section_modulus_strong"] == found["second_moment_strong"] / 0.05


def test_a_tube_has_the_radius_of_gyration_of_a_ring():
    tube = compute_tube(0.1, 0.01)
    ratio = tube["second_moment_strong"] / tube["area"]
    assert ratio == pytest.approx((0.1**2 + 0.08**2) / 16.0)
    assert (tube["outer_diameter"], tube["inner_diameter"]) == (0.1, 0.08)
    assert tube["depth"] == tube["width"] == 0.1


@each("bar, size", BARS)
def test_a_bar_is_its_area_times_its_strength(bar, size):
    name = {"B500": "B500B Ø", "950/1050": "950/1050 Ø"}.get(bar["id"], bar["id"])
    found = find_product(f"{name} {size:g} mm")
    assert found.id == f"{bar['id']} {size:g}"
    assert found.family == "solid bar"
    values = found.values
    area = math.pi / 4.0 * (size * 1e-3) ** 2
    assert values["area"] == pytest.approx((area, area))
    for word in ("yield", "ultimate"):
        low, high = values[f"{word}_strength"]
        assert values[f"{word}_force"] == pytest.approx((area * low, area * high))
    assert values["yield_strength"][1] < values["ultimate_strength"][0] * 1.01


@pytest.mark.parametrize(
    ("name", "force", "ultimate"),
    [  # makers' sheets, kN
        ("GEWI 63.5", 1758, 2217),
        ("Swiss GEWI 28", 308, 357),
        ("GEWI Plus 43", 973, 1162),
        ("950/1050 47", 1650, 1820),
        ("Macalloy 36", 850, 1049),
    ],
)
def test_forces_are_those_of_makers_sheets(name, force, ultimate):
    assert one(name, "yield_force", 1e3) == pytest.approx(force, rel=5e-3)
    assert one(name, "ultimate_force", 1e3) == pytest.approx(ultimate, rel=5e-3)


def test_grades_that_share_a_name_are_a_range():
    low, high = find_product("GEWI 28").values["yield_force"]
    assert (low / 1e3, high / 1e3) == pytest.approx((308, 339), rel=5e-3)
    assert find_product("SWISS GEWI").values["outer_diameter"] == (0.012, 0.05)
    assert find_product("SWISS GEWI").values["yield_strength"] == (5e8, 5e8)
    low, high = find_product("SWISS GEWI").values["yield_force"]
    assert (low / 1e3, high / 1e3) == pytest.approx((57, 981), rel=0.01)


@each("name", HOLLOW)
def test_a_hollow_bar_is_a_ring_of_its_area(name):
    found = find_product(name)
    assert found.family == "hollow bar"
    values = found.values
    if "outer_diameter" in values:
        for outer, inner, area in zip(
            values["outer_diameter"],
            values["inner_diameter"]
            if values["outer_diameter"][0] < values["outer_diameter"][1]
            and values["inner_diameter"][0] < values["inner_diameter"][1]
            else 2 * values["inner_diameter"][:1],
            values["area"],
            strict=True,
        ):
            assert math.pi / 4.0 * (outer**2 - inner**2) == pytest.approx(
                area, rel=0.01
            )
            assert inner < outer <= values["nominal_diameter"][0]
    low, high = values["yield_force"]
    least, most = values["area"]
    assert values["yield_strength"] == pytest.approx((low / least, high / most))
    assert 4e8 < low / least < 7e8
    if "ultimate_force" in values:
        assert values["ultimate_force"][0] > 1.04 * high


@pytest.mark.parametrize("series", ["R32", "R38", "R51", "T76"])
def test_stronger_hollow_bars_have_more_steel(series):
    (family,) = (
        one
        for one in load_products()["hollow"]["family"]
        if one["source"] == "dywi_drill"
    )
    bars = [bar for bar in family["bars"] if bar["series"] == series]
    for less, more in pairwise(bars):
        assert less["area"] < more["area"]
        assert less["inner_diameter"] > more["inner_diameter"]
        assert less["ultimate_force"] < more["ultimate_force"]
        assert str(less["ultimate_force"]) == less["marks"][0]
    whole = find_product(f"IBO {series}").values
    assert whole["area"][0] == bars[0]["area"] * 1e-6
    assert whole["area"][1] >= bars[-1]["area"] * 1e-6


def test_a_quantity_that_one_of_several_lacks_is_left_out():
    assert "outer_diameter" not in find_product("R25N").values
    assert "ultimate_force" in find_product("TITAN 40/16").values
    assert "ultimate_force" not in find_product("TITAN 73/53").values


def test_products_of_one_name_are_joined_in_what_both_have():
    known, bare = find_product("R32N"), find_product("R25N")
    both = [(product.values, product.sources[0]) for product in (known, bare)]
    for fitting in (both, both[::-1]):
        joined = join("both", "hollow bar", fitting)
        assert set(joined.values) == set(bare.values) <= set(known.values)
        assert joined.values["nominal_diameter"] == (0.025, 0.032)
        assert joined.values["ultimate_force"] == pytest.approx((2e5, 2.8e5))
        assert set(joined.sources) == {*known.sources, *bare.sources}


def test_ropes_break_as_their_norm_says():
    values = find_product("6x19-IWRC Ø18 1770").values
    assert values["breaking_force"][1] == pytest.approx(0.356 * 18**2 * 1770)
    assert values["rope_diameter"] == pytest.approx((0.018, 0.018))
    assert values["grade"] == (1.77e9, 1.77e9)
    both = find_product("6x36 18 mm")
    assert both.values["breaking_force"] == pytest.approx(
        (0.330 * 18**2 * 1570, 0.356 * 18**2 * 2160)
    )


@pytest.mark.parametrize(("name", "wires"), [("1x7", 7), ("1x19", 19), ("1x37", 37)])
def test_spiral_ropes_break_by_the_area_of_their_wires(name, wires):
    across = {7: 3, 19: 5, 37: 7}[wires]
    found = find_product(f"{name} Ø 14,5 mm")
    wire = math.pi / 4.0 * (0.0145 / across) ** 2
    low, _ = found.values["breaking_force"]
    loss = {7: 0.90, 19: 0.88, 37: 0.87}[wires]
    assert low == pytest.approx(loss * wires * wire * 1.57e9)


def test_every_construction_is_meant_by_a_name():
    meant = load_products()["rope"]["strands"].values()
    ropes = load_catalogue()["rope"]["construction"]
    assert set().union(*meant) == {rope.partition("-")[0] for rope in ropes}


def test_every_product_has_sources_in_every_language():
    names = [*BEAMS, *HOLLOW, "IBO R32", "SHS 80x4", "CHS 76.1x3.6", "Seil Ø18"]
    names += [f"{bar['id']} Ø{size:g}" for bar, size in BARS]
    for name in names:
        found = find_product(name)
        assert found.sources
        for source in found.sources:
            assert all(render(source, language) for language in LANGUAGES)


_SPELLINGS = Path(__file__).with_name("spellings.toml")
SPELLINGS = tomllib.loads(_SPELLINGS.read_text(encoding="utf-8"))


@each(
    "name, meant",
    [(name, key) for key, names in SPELLINGS["meant"].items() for name in names],
)
def test_a_name_is_read_as_offices_write_it(name, meant):
    assert find_product(name).id.casefold() == meant.casefold()


@each("name", SPELLINGS["none"])
def test_a_name_that_holds_none_or_several_gives_none(name):
    assert find_product(name) is None


def test_a_thousand_names_that_are_none_give_none():
    draw = random.Random(35)
    words = ("post", "Anker", "ancrage", "amont", "talseitig", "guy", "foot", "type")
    words += ("rock", "Fels", "rocher", "scree", "hauban", "upslope", "old", "neu")
    for _ in range(1_000):
        parts = draw.sample(words, draw.randint(0, 2))
        ident = "".join(draw.choices(string.ascii_uppercase, k=draw.randint(1, 2)))
        parts.append(f"{ident}{draw.choice(['', ' ', '-', '.'])}{draw.randint(1, 99)}")
        if draw.random() < 0.5:
            parts.append(f"{draw.randint(1, 9)}.{draw.randint(0, 9)} m")
        if draw.random() < 0.3:
            parts.append(f"{draw.randint(50, 500)} kN")
        draw.shuffle(parts)
        name = draw.choice([" ", ", ", " / "]).join(parts)
        assert find_product(name) is None, name


@each(
    "part",
    ["b500 ", "b 500 b ", "1x", "76.1x", "Ø ", "seil", "d=", "l=1", "gewi ", "9.9"],
)
def test_no_text_takes_long_to_read(part):
    """Patterns that try every way of a repeated part would never end."""
    for name in ("GEWI " + part * 100 + "!", part * 100 + "b500b ß²®½"):
        found = find_product(name)
        assert found is None or found.family in ("solid bar", "rope")


@pytest.mark.parametrize(
    ("name", "product", "diameter", "strengths"),
    [
        ("Stab 32 mm 500/550", "500/550 32", 32.0, (500e6, 550e6)),
        ("Stabanker 550/620 Ø 28", "550/620 28", 28.0, (550e6, 620e6)),
        ("barre 25 mm 670/800", "670/800 25", 25.0, (670e6, 800e6)),
        ("GEWI 32 500/550", "GEWI 32", 32.0, (500e6, 550e6)),  # its own entry
    ],
)
def test_a_bar_named_by_its_steel(name, product, diameter, strengths):
    found = find_product(name)
    assert (found.id, found.family) == (product, "solid bar")
    assert found.values["outer_diameter"] == (diameter / 1e3, diameter / 1e3)
    assert found.values["yield_strength"][0] == strengths[0]
    assert found.values["ultimate_strength"][0] == strengths[1]
    yields = strengths[0] * math.pi / 4.0 * (diameter / 1e3) ** 2
    assert found.values["yield_force"][0] == pytest.approx(yields, rel=1e-12)


@pytest.mark.parametrize("name", ["Stab 500/550", "Anker 500/550 kN", "B 500/550"])
def test_a_steel_without_a_diameter_is_no_product(name):
    assert find_product(name) is None


NAMES_OF_BARS = ("GEWI", "SWISS GEWI", "GEWI Plus", "SAS 500", "SAS 670")


@each("name", NAMES_OF_BARS)
def test_a_bar_in_a_size_that_nobody_makes_is_no_bar(name):
    made = {d for bar, d in BARS if find_bar(f"{name} {d:g}")}
    assert made
    rng = random.Random(name)
    written = {whole for d in made for whole in (math.floor(d), math.ceil(d))}
    drawn = {rng.randint(11, 99) for _ in range(40)} - written
    assert all(find_bar(f"{name} {size}") is None for size in drawn)
    assert find_bar(name) is None
