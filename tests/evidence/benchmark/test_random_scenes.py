"""Random scenes: the same whenever drawn, within the ranges, of every kind."""

import math

import pytest

from netdesign.evidence.benchmark.scenes import (
    DENSITY_KG_M3,
    FRICTION_DEG,
    INCLINATION_DEG,
    SLACK,
    SLOPE_DEG,
    STIFFNESS_KN_PER_M,
    THICKNESS_M,
    UPSLOPE_LENGTH_M,
    draw_scene,
)
from netdesign.files.scene import SceneFile
from tests.each import each

DRAWN = [draw_scene(5, number) for number in range(300)]


def test_a_scene_is_the_same_whenever_it_is_drawn():
    assert draw_scene(5, 17) == DRAWN[17]
    assert draw_scene(5, 18) != DRAWN[17]
    assert draw_scene(6, 17) != DRAWN[17]


def test_every_scene_is_a_valid_scene_file():
    for tables in DRAWN:
        assert SceneFile.model_validate(tables).model_dump(exclude_unset=True) == tables


@each(
    "table, key, bounds",
    [
        ("slope", "angle_deg", SLOPE_DEG),
        ("snow", "thickness_m", THICKNESS_M),
        ("snow", "upslope_length_m", UPSLOPE_LENGTH_M),
        ("snow", "density_kg_m3", DENSITY_KG_M3),
        ("net", "inclination_deg", INCLINATION_DEG),
        ("net", "stiffness_kN_per_m", STIFFNESS_KN_PER_M),
        ("net", "slack", SLACK),
        ("net", "friction_deg", FRICTION_DEG),
    ],
)
def test_values_fill_their_range(table, key, bounds):
    values = [tables[table][key] for tables in DRAWN if key in tables[table]]
    low, high = bounds
    assert low <= min(values) <= low + 0.1 * (high - low)
    assert high - 0.1 * (high - low) <= max(values) <= high


def test_layers_fill_the_snowpack():
    layered = [tables["snow"] for tables in DRAWN if "layers" in tables["snow"]]
    assert 0.2 < len(layered) / len(DRAWN) < 0.4
    for snow in layered:
        total = sum(layer["thickness_m"] for layer in snow["layers"])
        assert total == pytest.approx(snow["thickness_m"], rel=1e-12)
    assert {len(snow["layers"]) for snow in layered} == {2, 3, 4}


def test_every_kind_of_scene_is_drawn():
    def kinds(table, key):
        return {tables[table].get(key) for tables in DRAWN}

    assert kinds("ground", "law") == {"free", "no-slip", "sliding"}
    assert len(kinds("snow", "creep_law")) == 3
    both = {"one-sided", "two-sided"}
    assert kinds("ground", "contact") == kinds("net", "contact") == both
    assert kinds("gravity", "mode") == {"full", "parallel"}
    excess = [
        tables["net"]["height_m"] - tables["snow"]["thickness_m"] for tables in DRAWN
    ]
    assert {-1.0, 0.0, 1.0} == {math.copysign(1, e) if e else 0.0 for e in excess}
    for key in ("slack", "friction_deg"):
        assert 0.0 in kinds("net", key)
