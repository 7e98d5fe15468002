"""Reference mesh and its placing against a net's curve."""

import math

import numpy as np
import pytest

from netdesign.coupling.scene import MESH_LEVELS
from netdesign.snow.mesh import MeshSize, build_template, place_nodes
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


@pytest.mark.parametrize("size", MESH_LEVELS)
def test_net_and_ground_are_chains_from_the_foot(size):
    template = build_template(5.0, size)
    for chain, axis in ((template.net, 1), (template.ground, 0)):
        places = template.nodes[:, chain]
        assert places[axis, 0] == 0.0
        assert np.abs(places[1 - axis]).max() == 0.0
        assert (np.diff(places[axis]) > 0.0).all()
        # vertices and midpoints alternate
        middles = (places[axis, :-2:2] + places[axis, 2::2]) / 2
        np.testing.assert_allclose(places[axis, 1::2], middles, rtol=1e-14)
    assert template.net[0] == template.ground[0]
    assert template.net_fractions[-1] == 1.0
    assert template.nodes[0, template.ground[-1]] == 5.0


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


@pytest.mark.parametrize("size", MESH_LEVELS)
def test_smallest_edges_stand_at_both_ends_of_the_net(size):
    vertices = build_template(5.0, size).net_fractions[::2]
    assert vertices[1] == pytest.approx(size.corner, rel=1e-9)
    assert 1.0 - vertices[-2] == pytest.approx(np.sqrt(size.corner), rel=1e-9)
    assert np.diff(vertices).max() <= 2.0 * size.net_spacing


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


@pytest.mark.parametrize("size", MESH_LEVELS[:3])
def test_every_place_where_layers_meet_the_net_has_rings(size):
    """Pressures are singular there as at the net's ends."""
    fractions = build_template(9.0, size, (0.3, 0.7)).net_fractions[::2]
    for height in (0.3, 0.7):
        nearest = np.sort(np.abs(fractions - height))[1:3]
        corner = min(np.sqrt(size.corner), 0.4 * 0.3 / 2.0)
        np.testing.assert_allclose(nearest, corner, rtol=1e-9)


def test_layers_have_two_rows_of_triangles_wherever_they_are():
    template = build_template(20.0, COARSE, (0.3, 0.36))
    n_vertices = template.nodes.shape[1] - template.edges.shape[1]
    distance, height = template.nodes[:, :n_vertices].round(9)
    for column in np.unique(distance[distance > 1.0]):
        rows = height[distance == column]
        for below, above in ((0.0, 0.3), (0.3, 0.36), (0.36, 1.0)):
            assert ((rows >= below) & (rows <= above)).sum() >= 3


def test_a_long_snowpack_costs_little_more():
    """Columns widen with their distance: as many for each doubling of the length."""
    counts = [
        build_template(aspect, COARSE).triangles.shape[1]
        for aspect in (12.5, 25.0, 50.0, 100.0, 200.0)
    ]
    added = np.diff(counts)
    assert (added > 0).all()
    assert added.max() < 1.5 * added.min()


def test_straight_net_normal_to_the_slope_mirrors_the_reference():
    """Distance upslope becomes -X."""
    template = build_template(5.0, COARSE)
    curve = np.array([np.zeros_like(template.net_fractions), template.net_fractions])
    placed = place_nodes(template, curve)
    np.testing.assert_allclose(placed, [[-1.0], [1.0]] * template.nodes, atol=1e-15)


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


def test_only_edges_on_the_net_are_curved():
    template = build_template(5.0, COARSE)
    fractions = template.net_fractions
    curve = np.array([fractions * (1 - fractions), fractions])
    placed = place_nodes(template, curve)
    n_vertices = template.nodes.shape[1] - template.edges.shape[1]
    bow = np.abs(placed[:, n_vertices:] - placed[:, template.edges].mean(axis=1))
    curved = np.flatnonzero(bow.max(axis=0) > 1e-12) + n_vertices
    assert set(curved) <= set(template.net[1::2])
    assert curved.size > 0


@pytest.mark.parametrize(("interfaces", "at_head"), [((), 3), ((0.37,), 6)])
def test_ends_of_the_net_have_sectors_of_their_own(interfaces, at_head):
    """Uniform snow at its head; layered snow has as many there as at the foot."""
    sizes = {"net_spacing": 0.2, "corner": 1e-3, "upslope_spacing": 1.0}
    size = MeshSize(sectors=6, head_sectors=3, **sizes)
    template = build_template(5.0, size, interfaces)
    x, y = template.nodes[:, : template.n_vertices]
    for height, sectors in ((0.0, 6), (1.0, at_head)):
        distance = np.hypot(x, y - height)
        nearest = np.sort(distance)[1]
        assert (distance < nearest * (1.0 + 1e-6)).sum() == 1 + sectors + 1
