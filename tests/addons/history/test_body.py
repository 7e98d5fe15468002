"""The snowpack that moves: mesh put back, mass kept, snow that leans over falls."""

import math
from dataclasses import replace

import numpy as np
import pytest

from netdesign.addons.history.body import build_body, compute_areas, move_body
from netdesign.addons.history.settings import TRANSIENT_LEVELS
from netdesign.outcome import Outcome, SolveError
from netdesign.snow.law import FlowLayer
from netdesign.snow.mesh import MeshSize, build_template
from tests.each import each

ASPECT = 5.0
# Fine enough for a heap that is read off the surface's vertices.
FINE = MeshSize(net_spacing=0.06, corner=1e-2, sectors=4, upslope_spacing=0.25)
ROUNDING = 1e-13  # of the mass, after sums over some hundred triangles
HEAP_WIDTH = 0.3
STRAIGHT = [0.0, 0.6]  # x of the head, at height 1


def net_curve(template, head_x=0.0, sag=0.0, height=1.0):
    part = template.net_fractions
    bulge = 4.0 * sag * part * (1.0 - part)
    return np.array([head_x * part + bulge, height * part - bulge * head_x])


def a_body(law, *, head_x=0.0, sag=0.0, size=TRANSIENT_LEVELS[1], tops=()):
    template = build_template(ASPECT, size, tops)
    return build_body(law, template, net_curve(template, head_x, sag))


def on_net(body):
    return body.vertices[:, body.topology.net]


def creep(body, seed=5):
    """Vertices after some creep that leaves all sides straight and the net alone."""
    topology = body.topology
    distance, height = topology.template.nodes[:, : topology.template.n_vertices]
    away = np.minimum(1.0, distance)  # 0 at the net
    moved = body.vertices.copy()
    moved[0] += 0.1 * away * height * (1.0 - height)
    moved[0] += 0.02 * away * (ASPECT - distance)
    inside = (distance > 0.0) & (distance < ASPECT) & (height > 0.0) & (height < 1.0)
    push = np.random.default_rng(seed).normal(size=moved.shape)
    size = np.sqrt(np.abs(body.areas).min())
    moved[:, inside] += 0.2 * size * push[:, inside]
    upstream = (distance == ASPECT) & (height > 0.0) & (height < 1.0)
    moved[0, upstream] += 0.02
    return moved


def uneven(body, seed=6):
    """The same mesh with mass that differs from triangle to triangle."""
    draw = np.random.default_rng(seed)
    return replace(
        body,
        mass=body.areas * draw.uniform(0.5, 1.5, body.mass.size),
        warmth=draw.uniform(0.5, 2.0, body.mass.size),
    )


@pytest.mark.parametrize("seed", range(5))
def test_layers_lie_at_their_heights_however_the_net_bulges(a_flow_problem, seed):
    """Weight of each from the area between two level lines, up to the net."""
    rng = np.random.default_rng(seed)
    top, sag = rng.uniform(0.2, 0.8), rng.uniform(0.05, 0.2)
    densities = rng.uniform(0.5, 1.5, 2)
    warmths = rng.uniform(0.1, 9.0, 2)
    layers = tuple(
        FlowLayer(top=high, bulk_ratio=1.8, density=density, warmth=warmth)
        for high, density, warmth in zip((top, 1.0), densities, warmths, strict=True)
    )
    law = replace(a_flow_problem(), layers=layers)
    body = a_body(law, head_x=0.5, sag=sag, tops=(top,))
    x, y = on_net(body)
    heights = np.unique(np.append(y, top))
    across = ASPECT + np.interp(heights, y, x)
    lower = heights <= top
    areas = [
        np.trapezoid(across[part], heights[part])
        for part in (lower, ~lower | (heights == top))
    ]
    assert body.mass.sum() == pytest.approx(densities @ areas, rel=1e-12)
    heat = (body.mass * body.warmth).sum()
    assert heat == pytest.approx((densities * warmths) @ areas, rel=1e-12)


# --- rezoning ----------------------------------------------------------------


@pytest.mark.parametrize("head_x", STRAIGHT)
@pytest.mark.parametrize("level", [0, 1])
def test_snow_that_rests_keeps_its_mesh(a_flow_problem, head_x, level):
    body = uneven(a_body(a_flow_problem(), head_x=head_x, size=TRANSIENT_LEVELS[level]))
    head = on_net(body)[:, -1]
    moved, fallen = move_body(body, body.vertices, on_net(body), head)
    np.testing.assert_allclose(moved.vertices, body.vertices, atol=1e-14)
    np.testing.assert_allclose(moved.mass, body.mass, atol=ROUNDING)
    np.testing.assert_allclose(moved.warmth, body.warmth, rtol=1e-9)
    assert fallen == pytest.approx(0.0, abs=ROUNDING)


# --- mass --------------------------------------------------------------------


@pytest.mark.parametrize("head_x", STRAIGHT)
@pytest.mark.parametrize("level", [0, 1])
def test_mass_and_its_heat_are_kept_to_rounding(a_flow_problem, head_x, level):
    """The four sides are straight, so that mending them cuts nothing off."""
    body = uneven(a_body(a_flow_problem(), head_x=head_x, size=TRANSIENT_LEVELS[level]))
    displaced = creep(body)
    assert np.abs(displaced - body.vertices).max() > 0.02
    moved, fallen = move_body(body, displaced, on_net(body), on_net(body)[:, -1])
    assert np.abs(moved.vertices - displaced).max() > 1e-3
    assert fallen == pytest.approx(0.0, abs=ROUNDING)
    assert moved.mass.sum() == pytest.approx(body.mass.sum(), rel=ROUNDING)
    assert moved.mass.min() > 0.0
    heat = (body.mass * body.warmth).sum()
    assert (moved.mass * moved.warmth).sum() == pytest.approx(heat, rel=ROUNDING)
    # donor cells mix, so they stay between the extremes
    assert body.warmth.min() <= moved.warmth.min()
    assert moved.warmth.max() <= body.warmth.max()


@pytest.mark.parametrize("head_x", STRAIGHT)
@pytest.mark.parametrize("level", [0, 1])
def test_uniform_density_stays_uniform_on_any_new_mesh(a_flow_problem, head_x, level):
    """What edges sweep is what areas gain: no density arises from moving vertices."""
    body = a_body(a_flow_problem(), head_x=head_x, size=TRANSIENT_LEVELS[level])
    displaced = creep(body)
    even = replace(body, mass=compute_areas(body.topology, displaced))
    moved, fallen = move_body(even, displaced, on_net(body), on_net(body)[:, -1])
    np.testing.assert_allclose(moved.density, 1.0, rtol=1e-11)
    np.testing.assert_allclose(moved.warmth, 1.0, rtol=1e-12)
    lost = even.mass.sum() - moved.areas.sum()
    assert fallen == pytest.approx(lost, abs=ROUNDING)


# --- overhang ----------------------------------------------------------------


def heap(body, slope):
    """Snow that has risen beside the head; the corner itself is held there."""
    topology = body.topology
    distance = topology.template.nodes[0, : topology.template.n_vertices]
    eta = topology.template.nodes[1, : topology.template.n_vertices]
    moved = body.vertices.copy()
    moved[1] += slope * distance * np.exp(-((distance / HEAP_WIDTH) ** 2)) * eta
    return moved


@pytest.mark.parametrize("head_x", [0.0, 0.3])
def test_snow_that_leans_over_the_head_falls(a_flow_problem, head_x):
    """What lies beyond 135 degrees from the net goes, with the mass that it has."""
    body = a_body(a_flow_problem(), head_x=head_x, size=FINE)
    slope = 3.0
    displaced = heap(body, slope)
    even = replace(body, mass=compute_areas(body.topology, displaced))
    net = on_net(body)
    head = net[:, -1]
    moved, fallen = move_body(even, displaced, net, head)
    assert fallen == pytest.approx(even.mass.sum() - moved.areas.sum(), abs=1e-12)
    np.testing.assert_allclose(moved.density, 1.0, rtol=1e-9)

    steepest = math.radians(135.0) - math.atan2(1.0, head_x)
    assert steepness(displaced, body, head) > steepest
    assert steepness(moved.vertices, body, head) <= steepest + 1e-9
    # between the heap, slope r exp(-(r / w)^2), and the line, r the distance from the
    # net in the template; its triangles, some 0.1 wide there, cut corners
    stretch = 1.0 + head_x / 3.0
    line = math.tan(steepest) * stretch
    reach = HEAP_WIDTH * math.sqrt(math.log(slope / line))
    heap_area = slope * HEAP_WIDTH**2 / 2.0 * (1.0 - line / slope)
    expected = stretch * (heap_area - line * reach**2 / 2.0)
    assert expected > 5e-3
    assert fallen == pytest.approx(expected, abs=8e-3)
    assert fallen > 0.5 * expected


def steepness(vertices, body, head):
    """Largest angle of the surface above the ground's direction, from the head."""
    x, y = vertices[:, body.topology.surface[1:]] - head[:, None]
    return np.arctan2(y, -x).max()


# --- inversion ---------------------------------------------------------------


def turn_a_triangle(body, net):
    """A vertex moved across its triangle."""
    moved = body.vertices.copy()
    moved[0, body.topology.triangles[0, 0]] += 1.0
    assert compute_areas(body.topology, moved).min() < 0.0
    return moved, net


def flow_over_the_head(body, net):
    moved = body.vertices.copy()
    moved[1] *= 1.0 + 2.0 * body.topology.template.nodes[0, : moved.shape[1]]
    return moved, net


def leave_no_room(body, net):
    net[0, 1:-1] -= 4.0
    return body.vertices, net


@each(
    "spoil, said, level",
    [
        (turn_a_triangle, "the mesh of the snow folds over", 1),
        (flow_over_the_head, "flows over the net's head", 0),
        (leave_no_room, "cannot be repaired", 1),
    ],
)
def test_snow_that_cannot_be_moved_is_refused(a_flow_problem, spoil, said, level):
    body = a_body(a_flow_problem(), size=TRANSIENT_LEVELS[level])
    vertices, net = spoil(body, on_net(body))
    with pytest.raises(SolveError, match=said) as failure:
        move_body(body, vertices, net, net[:, -1])
    assert failure.value.outcome is Outcome.OUT_OF_VALIDITY
