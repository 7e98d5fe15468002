"""Strips: taken from a solution, cut to ropes, hung again."""

import math
from dataclasses import replace

import numpy as np
import pytest

from netdesign.coupling.scene import MESH_LEVELS, Scene, SolverSettings
from netdesign.coupling.steady.solve import solve_steady
from netdesign.outcome import ModelError, Outcome
from netdesign.panel.equations import build_problem
from netdesign.panel.inputs import Panel, Rope
from netdesign.panel.solve import solve_strips
from netdesign.panel.strips import build_stations, cut_strips, draw_strips, take_strip
from netdesign.snow.snowpack import Layer, Snowpack
from tests.each import each

QUICK = SolverSettings(accuracy=0.1, levels=MESH_LEVELS[:2])


def solve_layered(scene: Scene):
    layers = (
        Layer(thickness=1.6, density=412.0),
        Layer(thickness=1.1, density=317.0),
        Layer(thickness=1.3, density=233.0),
    )
    density = sum(one.thickness * one.density for one in layers) / 4.0
    pack = Snowpack(
        slope_angle=scene.snowpack.slope_angle,
        thickness=4.0,
        upslope_length=20.0,
        density=density,
        layers=layers,
    )
    return solve_steady(replace(scene, snowpack=pack), QUICK, on_failure="raise")


@pytest.mark.parametrize("kind", ["plain", "freeboard", "layered"])
def test_strip_hangs_as_the_section_does(a_scene, kind):
    """Also where the snow ends below the head, and where nodes lie on layers."""
    scene = a_scene(
        inclination_deg=27.0,
        slack=0.031,
        ground="no-slip",
        height_m=4.43 if kind == "freeboard" else None,
    )
    solution = (
        solve_layered(scene)
        if kind == "layered"
        else solve_steady(scene, QUICK, on_failure="raise")
    )
    strip = take_strip(solution)
    length = np.array([scene.net.unstressed_length])
    pull = strip.foot_pull[:, None]
    (curve,) = draw_strips(strip, length, np.zeros((2, 2, 1)), pull)
    scale = solution.foot.size
    foot = [solution.foot.x, solution.foot.y]
    head = [solution.head.x, solution.head.y]
    np.testing.assert_array_equal(strip.foot_pull, foot)
    np.testing.assert_allclose(curve, solution.net_curve, atol=1e-8)
    assert strip.shares.sum() == pytest.approx(1.0, abs=1e-14)
    np.testing.assert_allclose(strip.load, np.add(foot, head), atol=1e-8 * scale)


@each("mid", [False, True])
@each("cut", ["uniform", "upper", "fitted"])
def test_cut_follows_the_ropes(solved, cut, mid):
    strip = take_strip(solved(inclination_deg=30.0, slack=0.04, ground="no-slip"))
    panel = Panel(
        post_spacing=3.7,
        lower=Rope(stiffness=2e7, sag=0.043),
        upper=Rope(stiffness=1e7, sag=0.091),
        cut=cut,
        has_mid_anchors=mid,
    )
    stations = build_stations(4, has_mid_anchors=mid)
    lengths = build_problem(strip, [panel], 4).lengths[0]
    chord = 4.0 / math.cos(math.radians(30))
    upper = 3.7 * 0.091  # in mid-panel
    lower = 0.0 if mid else 3.7 * 0.043
    less = {"uniform": 0.0, "upper": upper, "fitted": upper + lower}[cut]
    assert lengths[-1] == pytest.approx(1.04 * (chord - less), rel=1e-12)
    assert (np.diff(lengths[np.argsort(stations.xi)]) >= 0.0).all() or cut == "fitted"


def test_cut_that_leaves_no_net_is_named(solved):
    strip = take_strip(solved(inclination_deg=30.0))
    spacing = 0.91 * strip.chord / 0.4
    slack = Rope(stiffness=2e7, sag=0.2)
    panel = Panel(post_spacing=spacing, lower=slack, upper=slack, cut="fitted")
    failed = solve_strips(strip, [panel], stations=4).failures[0]
    assert "leaves next to no net" in str(failed.reason)
    assert failed.outcome is Outcome.OUT_OF_VALIDITY
    narrower = replace(panel, post_spacing=0.89 * strip.chord / 0.4)
    lengths = build_problem(strip, [narrower], 4).lengths
    assert lengths.min() == pytest.approx(0.11 * strip.chord, rel=1e-9)


def test_only_a_net_at_rest_has_strips(solved):
    history = replace(solved(inclination_deg=30.0), method="transient")
    with pytest.raises(ModelError, match="steady state of a net, not on a history"):
        take_strip(history)


@each("mid", [False, True])
def test_a_fitted_net_is_cut_to_the_parabolas_of_its_ropes(mid):
    """A rope that is held in mid-panel too has the sag of half the span, (P4)."""
    panel = Panel(
        post_spacing=3.7,
        upper=Rope(stiffness=2e7, sag=0.083),
        lower=Rope(stiffness=3e7, sag=0.061),
        cut="fitted",
        has_mid_anchors=mid,
    )
    stations = build_stations(5, has_mid_anchors=mid)
    place = np.append(stations.xi, 0.0) * 1.85  # from mid-panel [m]
    ridge = 0.083 * 3.7 * (1.0 - (place / 1.85) ** 2)
    lower = 0.061 * 3.7 * (1.0 - (place / 1.85) ** 2)
    if mid:
        lower = 0.061 * 1.85 * (1.0 - ((place - 0.925) / 0.925) ** 2)
    np.testing.assert_allclose(cut_strips(panel, stations), ridge + lower, rtol=1e-12)
