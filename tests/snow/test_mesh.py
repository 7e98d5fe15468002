"""Reference mesh and its placing against a net's curve."""

import math

import numpy as np
import pytest

from netdesign.coupling.scene import MESH_LEVELS
from netdesign.snow.mesh import build_template, place_nodes
from tests.each import each

COARSE = MESH_LEVELS[1]
ASPECTS = [0.25, 0.3, 0.7, 1.0, 2.5, 5.0, 20.0]


def areas(nodes, triangles):
    (x0, y0), (x1, y1), (x2, y2) = (nodes[:, triangles[k]] for k in range(3))
    return ((x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)) / 2


@each("size", MESH_LEVELS)
@each("aspect", ASPECTS)
def test_triangles_fill_the_rectangle(aspect, size):
    template = build_template(aspect, size)
    sizes = np.abs(areas(template.nodes, template.triangles))
    assert sizes.min() > 0.0
    assert sizes.sum() == pytest.approx(aspect, rel=1e-12)
    n_vertices = template.nodes.shape[1] - template.edges.shape[1]
    # Euler's formula for a disc: vertices - edges + triangles = 1
    assert n_vertices - template.edges.shape[1] + template.triangles.shape[1] == 1


UNTIDY = [*range(12)]


def draw_shape(seed):
    """An aspect ratio that no rounding leaves as it is, and up to three interfaces."""
    rng = np.random.default_rng(900 + seed)
    aspect = float(np.exp(rng.uniform(math.log(0.3), math.log(60.0))))
    parts = rng.uniform(0.2, 1.0, seed % 4 + 1)
    return aspect, tuple((np.cumsum(parts) / parts.sum())[:-1].tolist())


@each("seed", UNTIDY)
@each("size", MESH_LEVELS[:3])
def test_sides_hold_every_node_that_lies_on_them(seed, size):
    aspect, interfaces = draw_shape(seed)
    template = build_template(aspect, size, interfaces)
    sides = (
        (template.ground, 1, 0.0),
        (template.upstream, 0, aspect),
        (template.surface, 1, 1.0),
        (template.net, 0, 0.0),
    )
    for chain, axis, place in sides:
        np.testing.assert_array_equal(template.nodes[axis, chain], place)
        assert (np.diff(template.nodes[1 - axis, chain]) > 0.0).all()
        beside = np.abs(template.nodes[axis] - place) < 1e-9
        assert set(chain) == set(np.flatnonzero(beside))
        assert (np.flatnonzero(chain < template.n_vertices) % 2 == 0).all()


def draw_interfaces(seed):
    """Sides of two to four layers, none thinner than a twentieth."""
    rng = np.random.default_rng(seed)
    shares = 0.05 + rng.dirichlet(np.ones(rng.integers(2, 5))) * 0.8
    return tuple((np.cumsum(shares) / shares.sum())[:-1].round(6).tolist())


def largest_angles(corners):
    """Of triangles whose corners are (2, 3, n) [degrees]."""
    angles = []
    for place in range(3):
        here, *others = np.roll(corners, -place, axis=1).swapaxes(0, 1)
        one, two = (other - here for other in others)
        cosine = (one * two).sum(axis=0) / np.hypot(*one) / np.hypot(*two)
        angles.append(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))))
    return np.max(angles, axis=0)


@each("seed", range(20))
@each("aspect", [3.0, 9.0, 60.0])
@each("size", MESH_LEVELS[:4])
def test_layers_have_sides_and_no_slivers(aspect, seed, size):
    """Long triangles are sound, angles close to 180 degrees are not.

    The nodes of a sliver on the net carried pressures of -14, +513, -34 instead of 7.
    """
    interfaces = draw_interfaces(seed)
    template = build_template(aspect, size, interfaces)
    corners = template.nodes[:, template.triangles[:3]]
    assert np.abs(areas(template.nodes, template.triangles)).sum() == pytest.approx(
        aspect, rel=1e-12
    )
    for height in interfaces:  # no triangle on both sides
        above = corners[1] - height
        assert not ((above.max(axis=0) > 1e-9) & (above.min(axis=0) < -1e-9)).any()
    on_net = (corners[0] == 0.0).sum(axis=0) == 2
    near = corners[0].min(axis=0) < 3.0
    assert largest_angles(corners[:, :, on_net]).max() < 136.0
    assert largest_angles(corners[:, :, near]).max() < 165.0


def test_placing_keeps_ground_surface_and_far_end():
    template = build_template(5.0, COARSE)
    fractions = template.net_fractions
    curve = np.array([0.6 * fractions + 0.2 * fractions * (1 - fractions), fractions])
    placed = place_nodes(template, curve)
    xi, eta = template.nodes
    np.testing.assert_array_equal(placed[:, template.net], curve)
    np.testing.assert_allclose(placed[1, eta == 0.0], 0.0, atol=1e-15)
    np.testing.assert_allclose(placed[1, eta == 1.0], 1.0, rtol=1e-15)
    far = np.flatnonzero(xi[: template.n_vertices] >= 3.0)
    np.testing.assert_allclose(placed[0, far], -xi[far], rtol=1e-14)
