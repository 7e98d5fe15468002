"""Tables [support] and [panel] of a scene file: values, and one finding a fault."""

import math
import tomllib

import pytest

from netdesign.files.scene import (
    SceneFile,
    build_scene_of_file,
    read_scene,
    read_scene_file,
)
from netdesign.outcome import SceneFileError
from netdesign.panel.inputs import Rope

SCENE = """
[slope]
angle_deg = 37.5
[snow]
thickness_m = 2.9
upslope_length_m = 17
density_kg_m3 = 313
[net]
inclination_deg = 28
height_m = 3.1
{net}
friction_deg = 27
"""
CABLE = "stiffness_kN_per_m = 17000\nslack = 0.03"
SUPPORT = """
[support]
post_spacing_m = 3.7
"""
PANEL = """
[panel]
rope_stiffness_kN = 17300
rope_sag = 0.043
cut = "upper"
"""


def build(text):
    return build_scene_of_file(SceneFile.model_validate(tomllib.loads(text))).support


@pytest.fixture
def read(tmp_path):
    def write_and_read(text):
        path = tmp_path / "scene.toml"
        path.write_text(text, encoding="utf-8")
        return read_scene_file(path)

    return write_and_read


def test_a_scene_without_a_support_has_none(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(SCENE.format(net=CABLE), encoding="utf-8")
    given = read_scene_file(path)
    assert given.support is None
    assert read_scene(path) == (given.scene, given.settings)


def test_given_values_become_si():
    text = (
        SCENE.format(net=CABLE)
        + SUPPORT
        + "post_tilt_deg = 11\nuphill_anchor_distance_m = 0\n"
        "downhill_anchor_distance_m = 2.3\npost_base_distance_m = 0.4\n"
        + PANEL
        + "mid_span_anchors = true\nend_guy_deg = 33\n"
    )
    support = build(text)
    assert support.layout.post_tilt == pytest.approx(math.radians(11.0))
    assert support.layout.uphill_anchor_distance == 0.0
    assert support.layout.downhill_anchor_distance == 2.3
    assert support.layout.post_base_distance == 0.4
    panel = support.panel
    assert panel.lower == panel.upper == Rope(stiffness=17.3e6, sag=0.043)
    assert (panel.post_spacing, panel.cut, panel.has_mid_anchors) == (
        3.7,
        "upper",
        True,
    )
    assert support.end_guy_angle == pytest.approx(math.radians(33.0))


@pytest.mark.parametrize(
    ("line", "instead", "key"),
    [
        ("rope_sag = 0.043", "rope_sag = 0.31", "panel.rope_sag = 0.31"),
        ("rope_sag = 0.043", "rope_sag = -0.01", "panel.rope_sag = -0.01"),
        ('cut = "upper"', 'cut = "lower"', "panel.cut = 'lower'"),
        ('cut = "upper"', "", "panel.cut"),
        ("rope_stiffness_kN = 17300", "rope_stiffness_kN = 0", "rope_stiffness_kN = 0"),
        ("rope_sag = 0.043", "", "panel.rope_sag"),
        ("rope_sag = 0.043", "lower_rope_sag = 0.04", "panel.rope_sag"),
        ("rope_sag = 0.043", "rope_sag = 0.04\nlower_rope_sag = 0", "panel.rope_sag"),
        ("rope_stiffness_kN = 17300", "", "panel.rope_stiffness_kN"),
        ("post_spacing_m = 3.7", "", "support.post_spacing_m"),
        ("post_spacing_m = 3.7", "post_spacing_m = nan", "support.post_spacing_m"),
        ("[support]\npost_spacing_m = 3.7", "", "needs [support]"),
        (CABLE, f'{CABLE}\nkind = "rigid"', "net.kind"),
        ('cut = "upper"', 'cut = "upper"\nend_guy_deg = 81', "panel.end_guy_deg = 81"),
        ('cut = "upper"', 'cut = "upper"\nclips = 3', "panel.clips"),
    ],
)
def test_each_fault_is_one_finding(read, line, instead, key):
    text = SCENE.format(net=CABLE) + SUPPORT + PANEL
    assert line in text
    with pytest.raises(SceneFileError) as caught:
        read(text.replace(line, instead))
    told = [one for one in str(caught.value).splitlines() if "scene.toml" in one]
    assert len(told) == 1
    assert key in str(caught.value)
