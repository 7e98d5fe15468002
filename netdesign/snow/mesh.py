"""Mesh of the snowpack: a reference triangulation, placed against a net's curve.

The reference region is the rectangle of a straight net normal to the slope, in
units of the snow thickness: xi is the distance upslope of the net, eta the height
above the ground. Rings of triangles surround the net's two ends, where the pressure is
singular; their radii are fourth powers of equal steps. Every case of one aspect ratio
shares the reference; only the node positions differ. Theory: snow/THEORY.md, section 3.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np

from netdesign.numerics.arrays import Floats, Ints, Mask, freeze
from netdesign.outcome import require_positive, require_within
from netdesign.snow.triangulation import (
    Triangulation,
    connect_points,
    measure_twice_areas,
    number_nodes,
)

# Radii of rings are powers of equal steps: the forces that a triangle near a singular
# point adds fall with its size. Then depth over width of the outermost triangles.
_RING_POWER, _RING_DEPTH = 4.0, 1.8
# Largest radius, and the share of the distance between layers' sides that it may take.
_RING_RADIUS, _RING_GAP = 0.45, 0.4
# Both are divided by the sectors: the size of triangles over their distance from an
# end, and the share by which a column is wider than its neighbour.
_RING_SHARE, _GROWTH = 1.8, 1.6
_CLEARANCE = 1.3  # other points keep this many ring radii away
BESIDE = _CLEARANCE * _RING_RADIUS  # behind it columns begin
_LEAST_ROWS = 2  # of triangles in each layer
_LEAST_OFF = 0.8  # distance of other points from a layer's side, over half its pieces
# Upslope of this many thicknesses the flow changes over lengths like the distance: the
# columns widen with it. Along layers triangles may be long from nearer on.
_FAR, _FAR_ALONG_LAYERS = 8.0, 2.0
# Ground that holds a short snowpack makes its upslope end felt at the net. Columns take
# at most this share of the length, over the sectors.
_END_SHARE = 0.5
NET_FOLLOWED = 3.0  # upslope of this many thicknesses the mesh does not follow the net


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshSize:
    """Resolution of a mesh, lengths in units of the snow thickness.

    Attributes
    ----------
    net_spacing : float
        Size of triangles along the middle of the net [thickness].
    corner : float
        Size of the smallest triangles, at the net's foot [thickness]; its square root
        at the head and where layers meet the net: the flow is less singular there.
    sectors : int
        Number of sectors of each ring around the net's foot; so many times slower,
        too, triangles grow away from the ends. 0 for an even mesh without rings.
    upslope_spacing : float
        Largest size, far upslope [thickness].
    subdivisions : int
        How many times every triangle is cut in four.
    head_sectors : int, optional
        Sectors of each ring around the head of uniform snow; else as many as around
        the foot.
    """

    net_spacing: float
    corner: float
    sectors: int
    upslope_spacing: float
    subdivisions: int = 0
    head_sectors: int | None = None

    @property
    def growth(self) -> float:
        """Difference of neighbouring columns near the net, over the narrower."""
        return _GROWTH / max(1, self.sectors)

    def __post_init__(self) -> None:
        """Refuse sizes that give no mesh."""
        require_within("net spacing", self.net_spacing, 1e-3, 0.34)
        require_positive("corner size", self.corner)
        require_within("corner size", self.corner, 1e-9, self.net_spacing)
        require_within("sectors", self.sectors, 0, 64)
        if self.head_sectors is not None:
            require_within("sectors around the head", self.head_sectors, 1, 64)
        require_within("upslope spacing", self.upslope_spacing, 1e-2, 10.0)
        require_within("subdivisions", self.subdivisions, 0, 4)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MeshTemplate:
    """Reference mesh of six-node triangles; shared by all cases of one shape.

    Attributes
    ----------
    nodes : ndarray, shape (2, n_nodes)
        Reference coordinates (xi, eta); vertices first, then edge midpoints.
    triangles : ndarray, shape (6, n_triangles)
        Nodes of each triangle in the order of scikit-fem's ``ElementTriP2``.
    edges : ndarray, shape (2, n_edges)
        Vertices of the edges, in the order of the midpoints.
    net, ground, surface, upstream : ndarray, shape (2 n + 1,)
        Nodes on the four sides, vertices and midpoints in turn: net from foot to
        head, ground and surface going upslope, upstream end from the ground up.
    orientation : ndarray, shape (n_triangles,)
        Sign of the area that the order of its nodes gives a placed triangle.
    aspect : float
        Upslope length over thickness.
    interfaces : tuple of float
        Heights between layers over the thickness, ascending.
    source : MeshTemplate or None
        Of another aspect, whose columns were moved: numbers and heights are its own.
    """

    nodes: Floats
    triangles: Ints
    orientation: Floats
    edges: Ints
    net: Ints
    ground: Ints
    surface: Ints
    upstream: Ints
    aspect: float
    interfaces: tuple[float, ...] = ()
    source: MeshTemplate | None = None

    @property
    def origin(self) -> MeshTemplate:
        """Template that was triangulated: itself, or its source."""
        return self.source or self

    @property
    def n_vertices(self) -> int:
        """Number of corner nodes; they come first."""
        return int(self.nodes.shape[1] - self.edges.shape[1])

    @property
    def net_fractions(self) -> Floats:
        """Height of the net nodes over the thickness, shape (n_net,); 0 to 1."""
        return np.asarray(self.nodes[1, self.net])


@lru_cache(maxsize=256)
def build_template(
    aspect: float, size: MeshSize, interfaces: tuple[float, ...] = ()
) -> MeshTemplate:
    """Reference mesh of a snowpack.

    Parameters
    ----------
    aspect : float
        Upslope length over thickness [-].
    size : MeshSize
        Resolution.
    interfaces : tuple of float
        Heights between layers over the thickness, ascending [-]; no triangle
        crosses them.

    Raises
    ------
    ModelError
        If the aspect is out of its range.
    """
    require_aspect(aspect)
    columns = _column_places(aspect, size)
    points = _column_points(columns, size, interfaces)
    if size.sectors:
        points = _add_rings(points, columns, size, interfaces)
    far = _FAR_ALONG_LAYERS if interfaces else _FAR
    points = _sort_out(points.round(12))
    mesh = _build_mesh(
        points, connect_points(_squeeze(points, far)), aspect, interfaces
    )
    for _ in range(size.subdivisions):
        mesh = _subdivide(mesh)
    return mesh


def require_aspect(aspect: float) -> None:
    """Refuse what no mesh is made for.

    Parameters
    ----------
    aspect : float
        Upslope length over thickness [-].

    Raises
    ------
    ModelError
        If it is out of its range.
    """
    require_within("upslope length over thickness", aspect, 0.25, 200.0)


def triangulate(points: Floats, aspect: float) -> MeshTemplate:
    """Reference mesh of given points.

    Parameters
    ----------
    points : ndarray, shape (n, 2)
        They fill the rectangle to its sides [thickness].
    aspect : float
        Upslope length over thickness [-].
    """
    return _build_mesh(points, connect_points(points), aspect)


def _subdivide(mesh: MeshTemplate) -> MeshTemplate:
    """Every triangle cut in four at the middles of its sides."""
    a, b, c, ab, bc, ca = mesh.triangles
    quarters = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    triangles = np.concatenate([np.column_stack(q) for q in quarters])
    return _build_mesh(mesh.nodes.T, triangles, mesh.aspect, mesh.interfaces)


def _build_mesh(
    points: Floats, triangles: Ints, aspect: float, interfaces: tuple[float, ...] = ()
) -> MeshTemplate:
    mesh = number_nodes(points, triangles)
    nodes = mesh.nodes
    # placing maps xi to -X and so turns every triangle over
    orientation = -np.sign(measure_twice_areas(points[mesh.triangles[:3].T]))
    ground, upstream, surface, net = _find_sides(points, mesh, aspect)
    # points were rounded; a side lies where it is said to lie
    nodes[1, ground], nodes[0, upstream] = 0.0, aspect
    nodes[1, surface], nodes[0, net] = 1.0, 0.0
    return MeshTemplate(
        nodes=freeze(nodes),
        triangles=freeze(mesh.triangles),
        orientation=freeze(orientation),
        edges=freeze(mesh.edges),
        net=freeze(net[::-1].copy()),
        ground=freeze(ground),
        surface=freeze(surface[::-1].copy()),
        upstream=freeze(upstream),
        aspect=aspect,
        interfaces=interfaces,
    )


def _find_sides(points: Floats, mesh: Triangulation, aspect: float) -> list[Ints]:
    """Nodes of the four sides, anticlockwise from the foot, corners in both sides.

    A walk around the boundary, so that no coordinate has to equal another.
    """
    ends = mesh.edges[:, mesh.boundary].T
    around: dict[int, list[tuple[int, int]]] = defaultdict(list)
    for edge, (start, end) in zip(mesh.boundary.tolist(), ends.tolist(), strict=True):
        around[start].append((edge, end))
        around[end].append((edge, start))
    corners = [
        int(np.hypot(points[:, 0] - x, points[:, 1] - y).argmin())
        for x, y in ((0.0, 0.0), (aspect, 0.0), (aspect, 1.0), (0.0, 1.0))
    ]
    loop = _walk_boundary(around, corners[0], points)
    places = [loop.index(corner) for corner in corners[1:]]
    return [
        np.array(loop[start : end + 1], dtype=np.int64)
        for start, end in pairwise([0, *places, len(loop) - 1])
    ]


def _walk_boundary(
    around: dict[int, list[tuple[int, int]]], corner: int, points: Floats
) -> list[int]:
    """Nodes on the boundary from a corner along the ground and back to it."""
    loop = [corner]
    # of the foot's two neighbours the one on the ground
    edge, vertex = max(around[corner], key=lambda pair: float(points[pair[1], 0]))
    while True:
        loop += [len(points) + edge, vertex]
        if vertex == corner:
            return loop
        first, second = around[vertex]
        edge, vertex = second if first[0] == edge else first


def place_nodes(template: MeshTemplate, net_curve: Floats) -> Floats:
    """Node positions of the snowpack whose downslope face is the net's curve.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.
    net_curve : ndarray, shape (2, n_net)
        Positions of the net nodes, foot to head, in units of the thickness.

    Returns
    -------
    ndarray, shape (2, n_nodes)
        Positions in the slope's axes, in units of the thickness. Edges on the net
        are parabolas through their three nodes, all others are straight.
    """
    distance, height = template.nodes
    follow = follow_net(template)
    fractions = template.net_fractions
    x_net = np.interp(height, fractions, net_curve[0])
    y_net = np.interp(height, fractions, net_curve[1])
    placed = np.array([follow * x_net - distance, height + follow * (y_net - height)])
    start, end = template.edges
    placed[:, template.n_vertices :] = (placed[:, start] + placed[:, end]) / 2.0
    placed[:, template.net] = net_curve
    return placed


@lru_cache(maxsize=256)
def follow_net(template: MeshTemplate) -> Floats:
    """Share of the net's displacement that each node takes, shape (n_nodes,)."""
    reach = min(NET_FOLLOWED, template.aspect)
    return freeze(np.maximum(0.0, 1.0 - template.nodes[0] / reach))


def edge_triples(chain: Ints) -> tuple[Ints, Ints, Ints]:
    """Start, middle and end node of each edge of an alternating chain.

    Parameters
    ----------
    chain : ndarray of int, shape (2 n + 1,)
        Vertices and midpoints in turn.

    Returns
    -------
    ndarray of int, three, shape (n,)
        Start, middle, end.
    """
    return chain[:-2:2], chain[1::2], chain[2::2]


def _end_points(size: MeshSize, interfaces: tuple[float, ...]) -> Floats:
    """Rings around the net's foot and head.

    A stiff layer may hang on the net's head: layered snow has all sectors there.
    """
    at_head = None if interfaces else size.head_sectors
    foot = _quarter_rings(size.sectors, size.corner)
    head = _quarter_rings(at_head or size.sectors, np.sqrt(size.corner))
    return np.vstack([foot, np.array([0.0, 1.0]) + head * np.array([1.0, -1.0])])


def _quarter_rings(sectors: int, corner: float) -> Floats:
    angles = np.linspace(0.0, np.pi / 2, sectors + 1)
    return _ring_points(sectors, corner, _RING_RADIUS, angles)


def _junction_points(size: MeshSize, height: float, radius: float) -> Floats:
    """Rings around the place on the net where two layers meet."""
    angles = np.linspace(-np.pi / 2, np.pi / 2, 2 * (size.sectors // 2 or 1) + 1)
    rings = _ring_points(size.sectors, np.sqrt(size.corner), radius, angles)
    return np.asarray(rings + np.array([0.0, height]))


def _ring_points(sectors: int, corner: float, radius: float, angles: Floats) -> Floats:
    """Rings of points (n, 2) around the origin, and the origin."""
    outer = radius ** (1.0 / _RING_POWER)
    inner = min(corner, radius / 2.0) ** (1.0 / _RING_POWER)
    width = np.pi / 2 / sectors
    count = _RING_POWER * (1.0 - inner / outer) / (_RING_DEPTH * width)
    radii = np.linspace(outer, inner, max(1, round(count)) + 1) ** _RING_POWER
    # exactly on the net and on the level line
    across = np.where(np.abs(angles) == np.pi / 2, 0.0, np.cos(angles))
    up = np.where(angles == 0.0, 0.0, np.sin(angles))
    x, y = np.outer(radii, across), np.outer(radii, up)
    return np.vstack([[(0.0, 0.0)], np.column_stack([x.ravel(), y.ravel()])])


def _column_places(aspect: float, size: MeshSize) -> Floats:
    """Distances of the columns upslope of the net, shape (n,), the last ``aspect``."""
    columns = [0.0]
    step = size.net_spacing
    while columns[-1] < aspect:
        columns.append(columns[-1] + step)
        step = min(step * (1.0 + size.growth), _widest(columns[-1], aspect, size))
    places = np.array(columns) * (aspect / columns[-1])
    places[-1] = aspect
    return places


def _column_points(
    places: Floats, size: MeshSize, interfaces: tuple[float, ...]
) -> Floats:
    """Points of the columns, on every side of a layer."""
    spacing = np.append(np.diff(places), places[-1] - places[-2])
    bounds = (0.0, *interfaces, 1.0)
    points = []
    for place, step in zip(places, spacing, strict=True):
        across = min(max(step, size.net_spacing), size.upslope_spacing)
        heights = [np.array([0.0])]
        for below, above in pairwise(bounds):
            rows = max(_LEAST_ROWS, round((above - below) / across))
            heights.append(_divide(below, above, rows))
        column = np.concatenate(heights)
        points.append(np.column_stack([np.full_like(column, place), column]))
    return np.vstack(points)


@lru_cache(maxsize=256)
def _divide(below: float, above: float, rows: int) -> Floats:
    """Heights of the upper bounds of ``rows`` equal rows."""
    return freeze(np.linspace(below, above, rows + 1)[1:])


def _sort_out(points: Floats) -> Floats:
    """Distinct points (n, 2), by distance, then by height."""
    points = points[np.lexsort(points.T[::-1])]
    is_new = np.append(True, (np.diff(points, axis=0) != 0.0).any(axis=1))
    return np.asarray(points[is_new])


def _add_rings(
    points: Floats, columns: Floats, size: MeshSize, interfaces: tuple[float, ...]
) -> Floats:
    """The columns' points, beside the net rings in their place."""
    aspect = float(columns[-1])
    first = float(columns[np.searchsorted(columns, min(BESIDE, aspect))])
    to_foot = np.hypot(points[:, 0], points[:, 1])
    to_head = np.hypot(points[:, 0], 1.0 - points[:, 1])
    apart = np.minimum(to_foot, to_head) > BESIDE
    points = np.vstack([_end_points(size, interfaces), points[apart]])
    # a short snowpack: the rings must not reach beyond its upslope end
    points = points[points[:, 0] <= aspect]
    points = np.vstack([points, [(aspect, 0.0), (aspect, 1.0)]])
    for below, height, above in _neighbours(interfaces):
        radius = min(_RING_RADIUS, _RING_GAP * min(height - below, above - height))
        line = _interface_points(size, height, radius, first)
        apart = np.hypot(points[:, 0], points[:, 1] - height) > _CLEARANCE * radius
        is_clear = (_is_clear(points, line) & apart) | (points[:, 0] >= first)
        rings = _junction_points(size, height, radius)
        points = np.vstack([points[is_clear], line, rings])
    return points


def _neighbours(interfaces: tuple[float, ...]) -> list[tuple[float, float, float]]:
    """Each height between layers with that below and above it."""
    bounds = (0.0, *interfaces, 1.0)
    return list(zip(bounds, interfaces, bounds[2:], strict=False))


def _interface_points(
    size: MeshSize, height: float, radius: float, first: float
) -> Floats:
    """Points along an interface from its rings to the first whole column."""
    gap = radius / _RING_GAP
    places = [min(radius, first / 2.0)]
    while places[-1] < first:
        to_end = np.hypot(places[-1], min(height, 1.0 - height))
        near = min(places[-1], _RING_SHARE / size.sectors * to_end)
        column = size.net_spacing + size.growth * places[-1]
        places.append(places[-1] + min(gap, column, near))
    # the first stays, the last lies on the column
    stretch = (first - places[0]) / (places[-1] - places[0])
    along = places[0] + (np.array(places) - places[0]) * stretch
    along[-1] = first
    return np.column_stack([along, np.full(len(places), height)])


def _widest(distance: float, aspect: float, size: MeshSize) -> float:
    """Largest column at a distance upslope of the net."""
    short = _END_SHARE * aspect / max(1, size.sectors)
    return min(size.upslope_spacing, short) * max(1.0, distance / _FAR)


def _squeeze(points: Floats, far: float) -> Floats:
    """Points (n, 2) in coordinates in which triangles that are long far off are not."""
    distance, height = points.T
    log = np.log(np.maximum(distance, far) / far)
    return np.column_stack([np.minimum(distance, far) + far * log, height])


def _is_clear(points: Floats, line: Floats) -> Mask:
    """Points outside the circles over a level line's pieces, and not close to them.

    A piece whose circle is empty is an edge of the Delaunay triangulation. A point
    close to it, on the net above all, would be the corner of a sliver.
    """
    centres, radii = (line[1:] + line[:-1]) / 2, np.diff(line[:, 0]) / 2
    nearest = np.searchsorted(line[:, 0], points[:, 0], side="right") - 1
    nearest = np.clip(nearest, 0, len(centres) - 1)
    distance = np.hypot(*(points - centres[nearest]).T)
    off = np.abs(points[:, 1] - line[0, 1])
    radius = radii[nearest]
    return np.asarray((distance > radius * (1.0 + 1e-9)) & (off > _LEAST_OFF * radius))
