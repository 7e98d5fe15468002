"""Strips: taken from a solution, cut to ropes, hung again."""

import math
from dataclasses import replace

import numpy as np
import pytest

from netdesign.coupling.scene import MESH_LEVELS, Scene, SolverSettings
from netdesign.coupling.steady.solve import solve_steady
from netdesign.errors import ModelError, SolveError
from netdesign.outcome import Outcome
from netdesign.panel.inputs import Panel, Rope
from netdesign.panel.stations import build_stations
from netdesign.panel.strips import cut_lengths, draw_strips, pull_strips, take_strip
from netdesign.snow.snowpack import Layer, Snowpack

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
    length = scene.net.unstressed_length
    still = np.zeros((2, 2, 1))
    pulls = pull_strips(strip, np.array([length]), still, np.ones((2, 1)))
    (curve,) = draw_strips(strip, np.array([length]), still, pulls[0])
    scale = solution.foot.size
    foot = [solution.foot.x, solution.foot.y]
    head = [solution.head.x, solution.head.y]
    np.testing.assert_allclose(pulls[0, :, 0], foot, atol=1e-8 * scale)
    np.testing.assert_allclose(pulls[1, :, 0], head, atol=1e-8 * scale)
    np.testing.assert_allclose(curve, solution.net_curve, atol=1e-8)
    assert strip.shares.sum() == pytest.approx(1.0, abs=1e-14)
    np.testing.assert_allclose(strip.load, np.add(foot, head), atol=1e-8 * scale)


def test_pulls_keep_their_sum_between_moved_ropes(solved):
    strip = take_strip(solved(inclination_deg=30.0))
    moved = np.random.default_rng(7).uniform(-0.21, 0.17, (2, 2, 3))
    lengths = strip.chord * np.array([0.93, 1.02, 1.11])
    start = np.repeat(strip.foot_pull[:, None], 3, axis=1)
    pulls = pull_strips(strip, lengths, moved, start)
    for number in range(lengths.size):
        both = pulls[..., number].sum(axis=0)
        np.testing.assert_allclose(both, strip.load, rtol=1e-12)
        ends = moved[..., number]
        one = slice(number, number + 1)
        (curve,) = draw_strips(strip, lengths[one], moved[..., one], pulls[0][:, one])
        np.testing.assert_allclose(curve[:, 0], ends[0], atol=1e-14)
        np.testing.assert_allclose(curve[:, -1], strip.head + ends[1], atol=1e-10)
        turned = curve[0] * strip.forces[1] - curve[1] * strip.forces[0]
        places = (ends[0], strip.head + ends[1])
        held = sum(
            x * pull[1] - y * pull[0]
            for (x, y), pull in zip(places, pulls[..., number], strict=True)
        )
        assert turned.sum() == pytest.approx(held, abs=1e-9 * np.hypot(*strip.load))


def test_only_a_net_at_rest_has_strips(solved):
    history = replace(solved(inclination_deg=30.0), method="transient")
    with pytest.raises(ModelError, match="steady state of a net, not on a history"):
        take_strip(history)


@pytest.mark.parametrize("mid", [False, True])
@pytest.mark.parametrize("cut", ["uniform", "upper", "fitted"])
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
    lengths = cut_lengths(panel, strip, stations)
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
    with pytest.raises(SolveError, match="leaves next to no net") as caught:
        cut_lengths(panel, strip, build_stations(4, has_mid_anchors=False))
    assert caught.value.outcome is Outcome.OUT_OF_VALIDITY
    narrower = replace(panel, post_spacing=0.89 * strip.chord / 0.4)
    lengths = cut_lengths(narrower, strip, build_stations(4, has_mid_anchors=False))
    assert lengths.min() == pytest.approx(0.11 * strip.chord, rel=1e-9)


def test_strip_that_nothing_holds_is_named(solved):
    """A length at which no number comes out."""
    strip = take_strip(solved(inclination_deg=30.0))
    still = np.zeros((2, 2, 1))
    with pytest.raises(SolveError, match="Nothing holds a strip"):
        pull_strips(strip, np.array([math.nan]), still, np.ones((2, 1)))
