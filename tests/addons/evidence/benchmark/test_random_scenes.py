"""Random scenes: the same whenever drawn, within the ranges, of every kind."""

from netdesign.addons.evidence.benchmark.scenes import (
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
