"""The snowpack as a body that deforms: a mesh that follows it, and mass that it keeps.

Vertices move with the snow in a step and are then put back into a good mesh between
the same boundaries; the mass that the edges sweep over changes triangle, so none is
lost. Lengths in snow thicknesses, densities over the initial mean. Theory:
snow/THEORY.md, section 4. The creep law follows the density that has changed.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from netdesign.numerics.arrays import Floats, Ints
from netdesign.outcome import Outcome, SolveError
from netdesign.snow.creep_law import (
    CreepLaw,
    compute_factors,
    compute_shear_factor,
)
from netdesign.snow.law import FlowProblem, Material, sample_material
from netdesign.snow.mesh import NET_FOLLOWED, MeshTemplate, place_nodes
from netdesign.words.message import say

_UPSTREAM_FOLLOWED = 1.0  # the mesh follows the upstream end over this many thicknesses
_LARGEST_SWEEP = 0.5  # share of a triangle that one part of a remap may take
_MOST_PARTS = 64
_LEAST_HEIGHT = 1e-15  # of a triangle's corner over another: no division by 0
# What to change where the snow cannot be followed.
# Snow that leans over the head falls off: the angle between its surface and the net
# may not exceed this, nor may its edge lean further upslope than the second angle.
_OVERHANG = np.radians(135.0)
_STEEPEST_EDGE = np.radians(150.0)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Topology:
    """Vertices of a template, without the midpoints.

    Attributes
    ----------
    template : MeshTemplate
        Where they come from.
    triangles : ndarray of int, shape (n_triangles, 3)
        Anticlockwise once placed.
    edges : ndarray of int, shape (2, n_edges)
        Ends of each edge.
    left, right : ndarray of int, shape (n_edges,)
        Triangles on both sides of each edge; right is -1 on the boundary.
    net, ground, surface, upstream : ndarray of int, shape (n,)
        Vertices along the boundary: net from foot to head, ground and surface going
        upslope, upstream end from the ground up.
    bottom : ndarray of int, shape (n_ground - 1,)
        Triangle above each edge of the ground.
    """

    template: MeshTemplate
    triangles: Ints
    edges: Ints
    left: Ints
    right: Ints
    net: Ints
    ground: Ints
    surface: Ints
    upstream: Ints
    bottom: Ints


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SnowBody:
    """The snowpack at one time.

    Attributes
    ----------
    topology : Topology
        Of its mesh.
    vertices : ndarray, shape (2, n_vertices)
        Positions [thickness].
    mass : ndarray, shape (n_triangles,)
        Of each triangle [initial mean density times thickness^2].
    warmth : ndarray, shape (n_triangles,)
        Fluidity over the scene's, from layer temperatures [-].
    """

    topology: Topology
    vertices: Floats
    mass: Floats
    warmth: Floats

    @property
    def areas(self) -> Floats:
        """Areas (n_triangles,) [thickness^2]; at most 0 for a triangle turned over."""
        return compute_areas(self.topology, self.vertices)

    @property
    def density(self) -> Floats:
        """Densities (n_triangles,) over the initial mean [-]."""
        return np.asarray(self.mass / self.areas)


@lru_cache(maxsize=16)
def build_topology(template: MeshTemplate) -> Topology:
    """Triangles, edges and boundary chains of the vertices of a template."""
    triangles = template.triangles[:3].T.copy()
    turned = template.orientation < 0
    triangles[turned] = triangles[turned][:, ::-1]
    edges, left, right = _pair_edges(triangles)
    owner = np.empty(template.nodes.shape[1], dtype=np.int64)
    owner[template.triangles] = np.arange(template.triangles.shape[1])
    return Topology(
        template=template,
        triangles=triangles,
        edges=edges,
        left=left,
        right=right,
        net=template.net[::2],
        ground=template.ground[::2],
        surface=template.surface[::2],
        upstream=template.upstream[::2],
        bottom=owner[template.ground[1::2]],  # an edge's midpoint has one owner
    )


def build_body(
    problem: FlowProblem, template: MeshTemplate, net_curve: Floats
) -> SnowBody:
    """Undeformed snow against a net's curve.

    Parameters
    ----------
    problem : FlowProblem
        Layers of the snow.
    template : MeshTemplate
        Reference mesh.
    net_curve : ndarray, shape (2, n_net)
        Nodes of the net, foot to head [thickness].

    Raises
    ------
    SolveError
        If a triangle of the mesh is turned over.
    """
    topology = build_topology(template)
    vertices = place_nodes(template, net_curve)[:, : template.n_vertices]
    areas = compute_areas(topology, vertices)
    if not areas.min() > 0.0:
        raise SolveError(Outcome.OUT_OF_VALIDITY, say("snow.start_folds"))
    shares = _share_layers(problem, vertices[1, topology.triangles])
    density = shares @ np.array([layer.density for layer in problem.layers])
    heat = shares @ np.array([layer.density * layer.warmth for layer in problem.layers])
    return SnowBody(
        topology=topology,
        vertices=vertices,
        mass=density * areas,
        warmth=heat / density,
    )


def _share_layers(problem: FlowProblem, corners: Floats) -> Floats:
    """Shares of the layers in the areas of triangles, shape (n, n_layers).

    Layers lie at their heights, wherever the net's curve has carried the triangles
    whose corners have the heights ``corners``, shape (n, 3).
    """
    low, middle, high = np.sort(corners, axis=1).T
    below = [np.zeros(low.size)]
    for layer in problem.layers[:-1]:
        corner = np.maximum(layer.top - low, 0.0) ** 2
        corner /= np.maximum(middle - low, _LEAST_HEIGHT) * (high - low)
        rest = np.maximum(high - layer.top, 0.0) ** 2
        rest /= np.maximum(high - middle, _LEAST_HEIGHT) * (high - low)
        share = np.where(layer.top < middle, corner, 1.0 - rest)
        below.append(np.clip(share, 0.0, 1.0))
    return np.diff(np.column_stack([*below, np.ones(low.size)]), axis=1)


def compute_areas(topology: Topology, vertices: Floats) -> Floats:
    """Signed areas of the triangles.

    Parameters
    ----------
    topology : Topology
        Its triangles.
    vertices : ndarray, shape (2, n_vertices)
        Positions [thickness].

    Returns
    -------
    ndarray, shape (n_triangles,)
        [thickness^2]; at most 0 for a triangle that has turned over.
    """
    (ax, bx, cx), (ay, by, cy) = vertices[:, topology.triangles].transpose(0, 2, 1)
    return np.asarray(((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / 2.0)


def move_body(
    body: SnowBody, displaced: Floats, net: Floats, head: Floats
) -> tuple[SnowBody, float]:
    """Body after a step, its mesh made good again.

    Parameters
    ----------
    body : SnowBody
        Before the step.
    displaced : ndarray, shape (2, n_vertices)
        Where the snow has carried the vertices.
    net : ndarray, shape (2, n_net_vertices)
        Where the vertices on the net are to be, on the curve they were carried to.
    head : ndarray, shape (2,)
        Of the net; snow that leans too far over it falls off.

    Returns
    -------
    SnowBody, float
        And the mass that fell over the head.

    Raises
    ------
    SolveError
        If the snow turned a triangle over: the step was too long, or the mesh cannot
        follow the snow any more.
    """
    topology = body.topology
    if not compute_areas(topology, displaced).min() > 0.0:
        raise SolveError(Outcome.OUT_OF_VALIDITY, say("snow.mesh_folds"))
    vertices = _place_vertices(topology, displaced, net, head)
    if not compute_areas(topology, vertices).min() > 0.0:
        raise SolveError(Outcome.OUT_OF_VALIDITY, say("snow.mesh_not_mended"))
    carried = np.array([body.mass, body.mass * body.warmth])
    remapped = _remap(topology, displaced, vertices, carried)
    mass, heat = remapped
    moved = replace(body, vertices=vertices, mass=mass, warmth=heat / mass)
    return moved, float(body.mass.sum() - mass.sum())


def _pair_edges(triangles: Ints) -> tuple[Ints, Ints, Ints]:
    """Edges (2, n) with the triangles on their left and right (-1: none)."""
    count = len(triangles)
    ends = np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)])
    owner = np.tile(np.arange(count), 3)
    keys = np.sort(ends, axis=1)
    _, first, number = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    number = number.ravel()
    right = np.full(first.size, -1)
    second = np.ones(ends.shape[0], dtype=bool)
    second[first] = False
    right[number[second]] = owner[second]
    return ends[first].T.copy(), owner[first], right


def _place_vertices(
    topology: Topology, displaced: Floats, net: Floats, head: Floats
) -> Floats:
    """Vertices between the displaced boundaries: a blend of the four sides."""
    template = topology.template
    distance, height = template.nodes[:, : template.n_vertices]
    foot, top = net[:, 0], net[:, -1]
    follow = np.maximum(0.0, 1.0 - distance / min(NET_FOLLOWED, template.aspect))
    # along the ground and the surface, spaced as in the template
    end = displaced[0, topology.ground[-1]]
    base_x = foot[0] + (end - foot[0]) * distance / template.aspect
    surface = _trim_surface(displaced[:, topology.surface], net, head)
    along = distance + (1.0 - follow) * top[0]
    crest = _walk_along(surface, along / (template.aspect + top[0]))
    placed = height * crest
    placed[0] += (1.0 - height) * base_x
    # what the net's and the upstream end's curves add to straight sides
    side = _interpolate(height, template.net_fractions[::2], net)
    placed += follow * (side - (1.0 - height) * foot[:, None] - height * top[:, None])
    back = displaced[:, topology.upstream]
    side = _interpolate(height, template.nodes[1, topology.upstream], back)
    length = min(_UPSTREAM_FOLLOWED, template.aspect / 2.0)
    fade = np.maximum(0.0, 1.0 - (template.aspect - distance) / length)
    placed += fade * (side - (1.0 - height) * back[:, :1] - height * back[:, -1:])
    placed[:, topology.net] = net
    placed[1, topology.ground] = 0.0
    return np.asarray(placed)


def _trim_surface(surface: Floats, net: Floats, head: Floats) -> Floats:
    """Surface (2, n) from the net's top vertex on, without what leans over the head."""
    top = net[:, -1]
    last = head - net[:, -2]
    angle = np.arctan2(last[1], last[0]) + np.pi - _OVERHANG
    angle = min(angle, _STEEPEST_EDGE)
    edge = np.array([np.cos(angle), np.sin(angle)])
    beyond = edge[1] * (surface[0] - top[0]) - edge[0] * (surface[1] - top[1])
    beyond[0] = 0.0
    gone = np.flatnonzero(beyond > 0.0)
    if gone.size == 0:
        return np.column_stack([top, surface[:, 1:]])
    last_gone = int(gone[-1])
    if last_gone + 1 >= surface.shape[1]:
        raise SolveError(Outcome.OUT_OF_VALIDITY, say("snow.over_the_head"))
    part = beyond[last_gone] / (beyond[last_gone] - beyond[last_gone + 1])
    step = surface[:, last_gone + 1] - surface[:, last_gone]
    crossing = surface[:, last_gone] + part * step
    rest = surface[:, last_gone + 1 :]
    if (crossing - top) @ edge <= 1e-9:
        return np.column_stack([top, rest])
    return np.column_stack([top, crossing, rest])


def _walk_along(line: Floats, fractions: Floats) -> Floats:
    """Points (2, n) at fractions of the length of a polygon."""
    lengths = np.append(0.0, np.cumsum(np.hypot(*np.diff(line))))
    return _interpolate(fractions, lengths / lengths[-1], line)


def _interpolate(wanted: Floats, places: Floats, points: Floats) -> Floats:
    return np.array([np.interp(wanted, places, axis) for axis in points])


def _remap(topology: Topology, old: Floats, new: Floats, carried: Floats) -> Floats:
    """Contents of each triangle after its vertices moved through resting snow.

    Donor cells: an edge takes what it sweeps over from the triangle that it enters.
    ``carried`` has shape (n_fields, n_triangles); a long way is taken in parts.
    """
    swept = np.abs(_sweep(topology, old, new))
    taken = np.bincount(topology.left, swept, minlength=carried.shape[1])
    inside = topology.right >= 0
    taken += np.bincount(
        topology.right[inside], swept[inside], minlength=carried.shape[1]
    )
    smallest = np.minimum(compute_areas(topology, old), compute_areas(topology, new))
    parts = max(1, int(np.ceil(float((taken / smallest).max()) / _LARGEST_SWEEP)))
    if parts > _MOST_PARTS:
        raise SolveError(Outcome.OUT_OF_VALIDITY, say("snow.mesh_moves"))
    fields, start = carried.copy(), old
    for part in range(1, parts + 1):
        end = old + (new - old) * (part / parts)
        swept = _sweep(topology, start, end)
        outer = np.where(inside, topology.right, topology.left)
        donor = np.where(swept > 0.0, topology.left, outer)
        moved = swept * (fields / compute_areas(topology, start))[:, donor]
        for field, flow in zip(fields, moved, strict=True):
            np.subtract.at(field, topology.left, flow)
            np.add.at(field, topology.right[inside], flow[inside])
        start = end
    return fields


def _sweep(topology: Topology, old: Floats, new: Floats) -> Floats:
    """Areas A of (N21) that edges sweep on their left, negative on their right."""
    first, second = topology.edges
    (ux, uy), (wx, wy) = new[:, second] - old[:, first], new[:, first] - old[:, second]
    return np.asarray((ux * wy - uy * wx) / 2.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Settling:
    """Creep law that follows the density, or not.

    Attributes
    ----------
    creep_law : CreepLaw
        Set of a(D), b(D).
    mean_density : float
        Relative density D that counts as 1 in the body [-].
    densifies : bool
        False keeps a and b as they were at the start; mass is kept in any case.
    least_density : float
        Of the loosest layer at the start, over the mean. Snow that is stretched counts
        as no looser (assumed): the law is a fit of snow that settles, and snow that
        softened as it is stretched would part in a single triangle, whatever its size.
    """

    creep_law: CreepLaw
    mean_density: float
    densifies: bool = True
    least_density: float = 1.0


def build_material(
    settling: Settling, problem: FlowProblem, body: SnowBody
) -> Material:
    """Material at the quadrature points of a body.

    Parameters
    ----------
    settling : Settling
        Whether and how the law follows the density.
    problem : FlowProblem
        Exponent and layers.
    body : SnowBody
        As it is now.

    Returns
    -------
    Material
        Numbers, or arrays of shape (n_triangles, 1): a triangle has one density.
    """
    if not settling.densifies:
        return sample_material(problem, body.topology.template)
    density = np.maximum(body.density, settling.least_density)
    shear, bulk = compute_factors(settling.creep_law, settling.mean_density * density)
    reference = compute_shear_factor(settling.creep_law, settling.mean_density)
    power = (problem.exponent + 1.0) / 2.0
    return Material(
        bulk_ratio=(shear / bulk)[:, None],
        fluidity_ratio=(body.warmth * (shear / reference) ** power)[:, None],
        density=body.density[:, None],
    )
