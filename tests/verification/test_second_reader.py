"""The second reader's own script against the reference numbers of the statics note.

Three readings of the same point: the note, this script, and the program, which
`test_rows_redone.py` compares with the script. Numbers are the note's, to its digits.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse import lil_matrix
from scipy.sparse.linalg import spsolve

from tests.verification.second_reader import guideline, resistance, statics
from tests.verification.second_reader.widths import spread_end_effect

rad = math.radians
TILT, SPLAY, GAMMA = rad(15.0), rad(25.0), rad(30.0)
HEIGHTS = {"R1": (2.5, 2.5, 2.5), "R4": (3.5, 4.0, 3.5), "R5": (4.0, 4.5, 4.0)}


def build(name, theta):
    height, uphill, downhill = HEIGHTS[name]
    return statics.place(height, rad(theta), TILT, uphill, downhill)


# -- A1: the end guy's push --------------------------------------------------------

PUSHED = [
    ("R1", 25, 34.293, 1.2668, 0.3968),
    ("R1", 35, 30.462, 1.2290, 0.3690),
    ("R4", 25, 31.858, 1.2421, 0.3785),
    ("R4", 35, 28.483, 1.2114, 0.3567),
    ("R5", 25, 32.146, 1.2449, 0.3805),
    ("R5", 35, 28.718, 1.2134, 0.3581),
]


@pytest.mark.parametrize(("name", "theta", "alpha", "post", "guy"), PUSHED)
def test_push_of_an_end_guy_abreast_of_the_head(name, theta, alpha, post, guy):
    section = build(name, theta)
    push = statics.pull_of_end_guy(section, GAMMA)
    size = math.hypot(*push)
    assert size == pytest.approx(math.tan(GAMMA), rel=1e-12)
    found = statics.hold(push, section)
    fall = math.atan2(section.head[1], section.head[0] - section.uphill[0])
    assert math.degrees(fall) == pytest.approx(alpha, abs=6e-4)
    assert found[0] / size == pytest.approx(post, abs=6e-5)
    assert found[1] / size == pytest.approx(guy, abs=6e-5)
    # closed form by the law of sines: T / sin(tau) = C / cos(alpha) = V / cos(..)
    closing = math.cos(TILT + fall)
    assert found[0] / size == pytest.approx(math.cos(fall) / closing, rel=1e-12)
    assert found[1] / size == pytest.approx(math.sin(TILT) / closing, rel=1e-12)


@pytest.mark.parametrize("name", HEIGHTS)
def test_push_of_an_end_guy_abreast_of_the_base_lies_along_the_post(name):
    section = build(name, 25)
    push = statics.pull_of_end_guy(section, GAMMA, at=section.base[0])
    found = statics.hold(push, section)
    assert found == pytest.approx((math.hypot(*push), 0.0, 0.0), abs=1e-12)


def test_push_over_the_assumed_ranges():
    """Tilt 10 to 20 degrees, e_1 0.75 to 1.25 D_K."""
    found = np.array(
        [
            statics.hold((0.0, -1.0), statics.place(1.0, rad(25), rad(t), e, 1.0))[:2]
            for t in (10, 20)
            for e in (0.75, 1.25)
        ]
    )
    assert found.min(axis=0) == pytest.approx([1.132, 0.227], abs=6e-4)
    assert found.max(axis=0) == pytest.approx([1.519, 0.672], abs=6e-4)


# Compression and tension in the section [kN] whose pull the end support takes, H [kN],
# diameters of guys and end guy [mm], area of the post [cm2].
ENDS = {
    "R1": (101.26, 49.79, 2.255 / 4.0, 131.4, 18, 28, 34.0),
    "R4": (153.89, 75.28, 1.8135 / 3.0, 201.1, 24, 36, 54.25),
    "R5": (266.62, 139.63, 1.872 / 3.0, 347.8, 24, 40, 78.08),
}
SHARED = {
    "R1": ((42.7, 126), (58.0, 124)),
    "R4": ((67.2, 192), (89.3, 189)),
    "R5": ((106.3, 345), (149.9, 337)),
}
DOWNHILL = {"R1": 9.8, "R4": 14.9, "R5": 8.9}


def pull_truss(name, *, at_base, guys=None, end_guy=None):
    section = build(name, 25)
    post, guy, share, along, small, large, area = ENDS[name]
    pull = [
        share * (post * p - guy * g)
        for p, g in zip(section.post, section.guy, strict=True)
    ]
    ropes = {
        "uphill": guys or rope_stiffness(small),
        "downhill": guys or rope_stiffness(small),
        "end guy": end_guy or rope_stiffness(large),
        "post": area * 1e-4 * resistance.STEEL,
    }
    at = section.base[0] if at_base else None
    reach = statics.reach_of_end_guy(section, GAMMA, at)
    bars = statics.build_end_truss(section, SPLAY, ropes, reach=reach, at=at)
    return statics.solve_truss((*section.head, 0.0), bars, (*pull, along)), bars


def rope_stiffness(diameter_mm):
    return 0.46 * diameter_mm**2 * 100.0  # mm2 GPa = kN


@pytest.mark.parametrize("name", SHARED)
@pytest.mark.parametrize("place", [0, 1], ids=["base", "head"])
def test_truss_of_the_row_s_end(name, place):
    guy, end_guy = SHARED[name][place]
    found, _ = pull_truss(name, at_base=place == 0)
    assert found["outer uphill"] == pytest.approx(guy, rel=3e-3)
    assert found["end guy"] == pytest.approx(end_guy, abs=0.6)
    if place == 0:
        assert found["outer downhill"] == pytest.approx(DOWNHILL[name], abs=0.1)


def test_stiffer_guys_draw_more_of_the_rope_s_pull():
    found, _ = pull_truss("R5", at_base=False, guys=25e3, end_guy=35e3)
    assert found["outer uphill"] == pytest.approx(187.0, rel=5e-3)


def test_truss_without_splayed_guys_at_work_is_the_program_s_rule():
    """Guys without stiffness: all of H goes into the end guy, C and T by (A1.2)."""
    section = build("R4", 25)
    reach = statics.reach_of_end_guy(section, GAMMA)
    stiff = {"uphill": 1e3, "downhill": 1e3, "end guy": 1e9, "post": 1e9}
    bars = statics.build_end_truss(section, 1e-6, stiff, reach=reach)
    found = statics.solve_truss((*section.head, 0.0), bars, (0.0, 0.0, 100.0))
    push = statics.pull_of_end_guy(section, GAMMA)
    post, guy, _ = statics.hold(push, section)
    assert found["end guy"] == pytest.approx(100.0 / math.cos(GAMMA), rel=1e-6)
    assert -found["post"] == pytest.approx(100.0 * post, rel=1e-6)
    both = found["outer uphill"] + found["inner uphill"]
    assert both == pytest.approx(100.0 * guy, rel=1e-6)


# -- A2, A7: bars ------------------------------------------------------------------


@pytest.mark.parametrize(
    ("degrees", "used"), [(50, 1.543), (30, 1.142), (25, 1.029), (20, 0.921)]
)
def test_bar_as_lateral_anchor_beside_its_axis(degrees, used):
    bar = resistance.compute_bar(0.050 - 2.0 * 0.96e-3, 500e3)
    held = resistance.bend_bar(bar, rad(degrees), 0.005) / 1.495
    assert 433.86 / held == pytest.approx(used, abs=1e-3)


@pytest.mark.parametrize(
    ("lever", "used"),
    [(5, 0.839), (20, 1.301), (50, 2.227), (100, 3.769), (120, 4.386), (125, 4.540)],
)
def test_free_length_of_a_bar(lever, used):
    bar = resistance.compute_bar(0.040 - 2.0 * 0.96e-3, 500e3)
    held = resistance.bend_bar(bar, rad(12.10492), lever / 1e3) / 1.495
    assert 266.66455 / held == pytest.approx(used, abs=6e-4)


@pytest.mark.parametrize(
    ("modulus", "ratio"), [(5e3, 3.1), (2e4, 2.2), (1e5, 1.5), (1e6, 0.82)]
)
def test_lever_of_a_bar_in_elastic_ground(modulus, ratio):
    """(A7.1): a lever of 4.59 D / E_s^(1/4), E_s in MPa."""
    diameter = 0.040
    bending = resistance.STEEL * math.pi * diameter**4 / 64.0
    lever = resistance.find_ground_lever(modulus, bending)
    assert lever / diameter == pytest.approx(ratio, abs=0.06)
    assert lever / diameter == pytest.approx(4.59 / (modulus / 1e3) ** 0.25, rel=2e-3)


def test_lever_of_a_tube():
    """76.1 x 8 mm, E_s 20 MPa: 146 mm."""
    bending = resistance.STEEL * math.pi * (0.0761**4 - 0.0601**4) / 64.0
    assert resistance.find_ground_lever(20e3, bending) == pytest.approx(0.146, abs=6e-4)


def test_moment_of_a_beam_on_elastic_ground_by_finite_differences():
    """E I w'''' + E_s w = 0 with V = 1 at the mouth, clamped far below."""
    modulus, bending = 20e3, resistance.STEEL * math.pi * 0.04**4 / 64.0
    beta = (modulus / (4.0 * bending)) ** 0.25
    count = 3000
    step = 10.0 / beta / count
    # nodes -2 .. count + 2; the ghosts at the mouth: M = 0, V = 1; none at the far end
    size = count + 5
    matrix, load = lil_matrix((size, size)), np.zeros(size)
    for k in range(2, count + 3):
        matrix[k, k - 2 : k + 3] = bending / step**4 * np.array([1, -4, 6, -4, 1])
        matrix[k, k] += modulus
    matrix[0, 1:4] = 1, -2, 1
    matrix[1, 0:5] = -1, 2, 0, -2, 1
    load[1] = 2.0 * step**3 / bending
    matrix[size - 2, size - 2] = matrix[size - 1, size - 1] = 1.0
    moved = spsolve(matrix.tocsr(), load)
    moments = bending * np.diff(moved, 2) / step**2
    lever = resistance.find_ground_lever(modulus, bending)
    assert np.abs(moments[1:-3]).max() == pytest.approx(lever, rel=1e-4)


# -- A3: the guideline's load ------------------------------------------------------


def build_guideline(name):
    slope, thick, glide, altitude, spacing, height, up, down, slack, stiffness = {
        "R1": (30, 2.5, 1.2, 1870, 4.0, 2.5, 2.5, 2.5, 0.05, 8e3),
        "R2": (35, 2.8, 1.2, 1880, 3.5, 3.0, 3.0, 3.0, 0.06, 10e3),
        "R4": (40, 3.9 * math.cos(rad(40)), 1.8, 1860, 3.0, 3.5, 4.0, 3.5, 0.08, 15e3),
        "R5": (45, 3.5, 2.4, 1840, 3.0, 4.0, 4.5, 4.0, 0.08, 20e3),
    }[name]
    return guideline.Row(
        slope=rad(slope),
        height=height,
        snow=thick / math.cos(rad(slope)),
        glide=glide,
        altitude=altitude,
        spacing=spacing,
        tilt=TILT,
        uphill=up,
        downhill=down,
        slack=slack,
        stiffness=stiffness,
        inclination=(rad(25), rad(35)),
    )


# foot anchor, uphill guy, post inside [kN]; load case 1 alone, of today's height
TODAY = {
    "R1": (None, 23.14, 69.25),
    "R2": (70.14, 27.32, 80.19),
    "R4": (100.6, 36.80, 98.11),
    "R5": (197.6, 78.33, 186.4),
}
BY_HEIGHT = {
    "R1": (64.33, 23.14, 69.25),
    "R2": (88.28, 35.62, 92.67),
    "R4": (144.0, 65.70, 137.2),
    "R5": (273.1, 127.3, 245.7),
}
DIMENSIONED = {
    "R1": (70.09, 25.53, 75.60),
    "R2": (91.13, 36.93, 95.73),
    "R4": (144.1, 65.74, 137.3),
    "R5": (270.0, 125.8, 243.0),
}
MEMBERS = ("foot_anchor", "uphill_guy", "post")


@pytest.mark.parametrize("name", BY_HEIGHT)
def test_load_of_the_guideline(name):
    row = build_guideline(name)
    kinds = (
        (TODAY, {"heights": (row.snow,), "parts": (1.0,)}),
        (BY_HEIGHT, {"heights": (row.full,)}),
        (DIMENSIONED, {"heights": (row.full,), "dimensioned": True}),
    )
    for numbers, how in kinds:
        found = guideline.find_largest(row, shares=(0.35,), turns=11, **how)
        for member, number in zip(MEMBERS, numbers[name], strict=True):
            if number is not None:
                assert found[member] == pytest.approx(number, rel=6e-4), member


def test_dimensioning_form_over_the_real_slope():
    ratios = []
    for slope in (30, 35, 40, 45, 50):
        row = replace(build_guideline("R4"), slope=rad(slope))
        form = row.glide * row.factor * row.full**2 * 0.8
        ratios.append(form / guideline.press_along(row, row.full))
    assert ratios == pytest.approx([1.138, 1.049, 1.001, 0.9855, 1.001], abs=6e-4)


# -- A5: widths at a row's end -----------------------------------------------------


@pytest.mark.parametrize(
    ("spacing", "ratio", "length", "last", "second"),
    [
        (4.0, 2.50, 2.5 / 3.0, 4.083, 5.43),
        (3.5, 2.50, 1.0, 4.250, 10.20),
        (3.0, 3.25, 3.5 / 3.0, 5.292, 24.58),
        (3.0, 4.00, 4.0 / 3.0, 6.833, 39.51),
        (4.0, 0.850, 0.3, None, 0.24),
        (3.5, 0.850, 0.3, None, 0.31),
        (3.0, 1.045, 0.3, None, 0.52),
        (3.0, 1.240, 0.3, None, 0.62),
    ],
)
def test_second_support(spacing, ratio, length, last, second):
    extra = spread_end_effect(ratio, length, spacing)
    assert 100.0 * extra[1] / spacing == pytest.approx(second, abs=6e-3)
    if last:
        assert spacing / 2.0 + ratio * length == pytest.approx(last, abs=6e-4)


@pytest.mark.parametrize("length", [0.3, 0.9, 1.4, 2.0])
def test_end_effect_between_supports_by_the_integral_of_the_lever(length):
    places = (np.arange(20_000) + 0.5) / 20_000 * length
    levers = [
        np.clip(1.0 - abs(places - k), 0.0, None).mean() * length for k in (0, 1, 2)
    ]
    shares = spread_end_effect(1.0, length, 1.0)
    assert shares == pytest.approx(levers, abs=1e-8)


# -- A6: posts ---------------------------------------------------------------------

# Area [cm2], second moment [cm4], length [m], modulus [cm3], width [mm], E_d of the end
# [kN], pressure of the guideline [kPa].
POSTS = {
    "R1": (34.00, 317.5, 2.7, 144.1, 120, 211.7215, 5.725467),
    "R4": (54.25, 889.2, 3.7, 311.5, 160, 326.9785, 14.916087),
    "R5": (78.08, 2003.0, 4.2, 569.6, 200, 569.4360, 27.76704),
}
ECCENTRIC = {  # by mm at head and foot
    "R1": {(0, 0): 0.539, (25, 25): 0.783, (50, 50): 0.990, (60, 0): 0.999},
    "R4": {(0, 0): 0.669, (25, 25): 0.859, (80, 80): 1.221, (80, 0): 1.031},
    "R5": {(0, 0): 0.885, (25, 25): 1.079, (100, 100): 1.604, (100, 0): 1.312},
}
BY_GLIDE = {"R1": (1.0, 0.511), "R4": (2.2, 0.691), "R5": (3.4, 1.331)}


@pytest.mark.parametrize("name", ECCENTRIC)
def test_eccentric_post(name):
    area, second, length, modulus, width, force, pressure = POSTS[name]
    buckling = resistance.buckle(area * 1e-4, second * 1e-8, length, 235e3, "c")
    post = (*buckling, modulus * 1e-6 * 235e3)
    snow = 1.5 * pressure * width / 1e3 * length**2 / 8.0
    for (head, foot), used in ECCENTRIC[name].items():
        ends = head / 1e3, foot / 1e3
        held = resistance.compress_bent_post(post, 2.0 * snow, *ends, 1.05)
        assert force / held == pytest.approx(used, abs=6e-4)
    efficiency, used = BY_GLIDE[name]
    held = resistance.compress_bent_post(post, efficiency * snow, 0.0, 0.0, 1.05)
    assert force / held == pytest.approx(used, abs=6e-4)


def test_moment_of_a_strut_with_a_load_and_two_end_moments():
    place = np.linspace(0.0, 1.0, 100_001)
    for first, last in ((3.0, 1.0), (0.0, 2.0), (5.0, 0.0), (40.0, 0.0), (2.0, 2.0)):
        moments = first + (last - first) * place + 16.0 * place * (1.0 - place)
        found = resistance.combine_moments(4.0, first, last)
        assert found == pytest.approx(moments.max(), rel=1e-9)
        if abs(first - last) <= 16.0:  # (A6.1)
            middle = (first + last) / 2.0 + (first - last) ** 2 / 64.0
            assert found == pytest.approx(4.0 + middle, rel=1e-12)


# -- B6, B8: ground ----------------------------------------------------------------


@pytest.mark.parametrize(
    ("tilt", "surcharge", "weight"),
    [(10, 0.748, 0.616), (15, 0.626, 0.459), (20, 0.507, 0.323)],
)
def test_inclined_load_on_a_plate(tilt, surcharge, weight):
    found = resistance.incline_bearing(rad(tilt))
    assert found == pytest.approx((surcharge, weight), abs=6e-4)


@pytest.mark.parametrize(
    ("cohesion", "dry", "wet", "slabs"),
    [
        (32, 346.8, 310.7, (1.42, 1.07)),
        (20, 232.8, 196.4, (1.15, 0.80)),
        (10, 136.5, 0.0, (0.92, 0.57)),
    ],
)
def test_wedge_with_and_without_water(cohesion, dry, wet, slabs):
    soil = (cohesion / 1.25, math.atan(math.tan(rad(36)) / 1.25), 20.0)
    pulls, slope = (rad(11.8310590), rad(30.6910162)), rad(40)
    for number, drained in ((dry, True), (wet, False)):
        found = min(
            resistance.lift_wedge(soil, depth, 3.0, slope, pulls, drained=drained)
            for depth in (1.3680806, 2.7361611)
        )
        assert found == pytest.approx(number, abs=0.06)
    found = [resistance.hold_slab(soil, 2.736, slope, drained=one) for one in (1, 0)]
    assert found == pytest.approx(slabs, abs=6e-3)
