"""A scene on a mesh as the compiled core takes it for its rounds.

What hangs on the mesh alone is found once for all scenes on it. Theory: core/THEORY.md.
"""

from __future__ import annotations

import ctypes
from collections.abc import Mapping
from functools import lru_cache
from itertools import accumulate
from typing import Any, NamedTuple

import numpy as np

from netdesign.cable.funicular import CLOSED
from netdesign.core.arguments import (
    LawArgument,
    MeshArgument,
    SceneArgument,
    locate,
    locate_all,
)
from netdesign.coupling.steady.hanging import SteadyProblem, cut_net
from netdesign.numerics.arrays import Floats
from netdesign.snow.compiled import describe_law, describe_rules, describe_template
from netdesign.snow.compiled_mesh import describe_placement
from netdesign.snow.contact import may_lift
from netdesign.snow.flow import make_linear
from netdesign.snow.kernel import share_end_load
from netdesign.snow.law import FlowProblem, sample_material
from netdesign.snow.mesh import MeshTemplate, follow_net
from netdesign.snow.placed_mesh import EDGE_SHAPE, EDGE_TANGENT, EDGE_WEIGHTS
from netdesign.snow.shared_mesh import find_once

# Fields of ``SceneArgument``: which of the net's nodes are beside a node; its parts.
_FRAME = ("below", "rise", "heights", "ends")
_NET = ("shares", "part", "firsts", "rises")

_Arrays = tuple[np.ndarray[Any, Any], ...]


class DescribedScene(NamedTuple):
    """A scene on a mesh as the core takes it.

    Attributes
    ----------
    argument : SceneArgument
        All of it but where a round starts.
    places : mapping of slice
        Of each result of a round in the array of all.
    kept : tuple of ndarray, each of any shape
        Arrays whose addresses the argument has.
    """

    argument: SceneArgument
    places: Mapping[str, slice]
    kept: _Arrays


def describe_scene(
    library: ctypes.PyDLL, problem: SteadyProblem
) -> DescribedScene | None:
    """A scene on a mesh as the core takes it; None where the mesh is too large.

    Parameters
    ----------
    library : PyDLL
        The core.
    problem : SteadyProblem
        Scene on a mesh, dimensionless.
    """
    template, snow = problem.template, problem.snow
    top = float(problem.head[1])
    form = _describe_form(template, library, top, snow.ground == "sliding")
    if form is None:
        return None
    laws = _describe_laws(snow, template if snow.layers[1:] else None)
    head = np.array(problem.head, dtype=np.float64)
    argument = SceneArgument.from_buffer_copy(form.argument)
    argument.law, argument.first = laws.law, laws.first
    places = _describe_places(template)
    argument.reference, argument.follow = places.addresses
    argument.rules = describe_rules(snow, places.lifts)
    argument.gravity[:] = snow.gravity
    argument.is_uniform = int(laws.density.size == 1)
    argument.density, argument.head = locate_all(laws.density, head)
    argument.end_load = snow.end_load
    argument.length, argument.stiffness = problem.length, problem.stiffness
    return DescribedScene(
        argument=argument,
        places=form.places,
        kept=(*form.kept, *places.kept, *laws.kept, laws.density, head),
    )


class _Laws(NamedTuple):
    """Laws of creep and sliding as the core takes them, and the snow's density."""

    law: LawArgument
    first: LawArgument  # of linear creep
    density: Floats
    kept: _Arrays


@lru_cache(maxsize=8)  # every mesh of a scene asks
def _describe_laws(snow: FlowProblem, template: MeshTemplate | None) -> _Laws:
    """``template`` is that of layered snow; uniform snow is the same on all."""
    described = []
    for problem in (snow, make_linear(snow)):
        material = sample_material(problem, template)
        shape = (template.triangles.shape[1], 3) if template else ()
        described.append(describe_law(problem, material, shape))
    (law, kept), (first, more) = described
    density = np.array(sample_material(snow, template).density, dtype=np.float64)
    return _Laws(law, first, density, (*kept, *more))


class _Form(NamedTuple):
    """A template and a net of some height as the core takes them."""

    argument: SceneArgument
    places: Mapping[str, slice]
    kept: _Arrays


@find_once
def _describe_form(
    template: MeshTemplate, library: ctypes.PyDLL, top: float, slides: bool
) -> _Form | None:
    described = describe_template(template, library)
    if described is None:
        return None
    frame, net = _describe_frame(template), _describe_net(template, top)
    end = share_end_load(template)
    mesh = MeshArgument(*described.counts, *described.numbers)
    mesh.edge_shape = locate(EDGE_SHAPE)
    argument = SceneArgument(place=describe_placement(template, EDGE_TANGENT))
    # numbers have caches of their own: the form keeps the arrays of one alone
    argument.place.triangles, argument.place.net = mesh.triangles, mesh.net
    argument.mesh, argument.plan = mesh, described.plan
    argument.n_vertices = template.n_vertices
    for name, place in zip(_FRAME, locate_all(*frame), strict=True):
        setattr(argument, name, place)
    for name, place in zip(_NET, locate_all(*net), strict=True):
        setattr(argument, name, place)
    argument.end_share, argument.edge_weights = locate_all(end, EDGE_WEIGHTS)
    argument.n_elements, argument.n_parts = net[0].size, net[-1].size
    argument.tolerance = CLOSED
    return _Form(
        argument=argument,
        places=_lay_out(template, net[0].size, net[-1].size, slides=slides),
        kept=(*described.kept, *frame, *net, end, template.orientation),
    )


def _describe_net(template: MeshTemplate, top: float) -> _Arrays:
    """The net's parts, as ``Scene`` of round.c has them."""
    parts = cut_net(template, top)
    return (
        np.ascontiguousarray(parts.shares, dtype=np.float64),
        np.ascontiguousarray(parts.part, dtype=np.int64),
        np.ascontiguousarray(parts.firsts, dtype=np.int64),
        np.ascontiguousarray(parts.rises, dtype=np.float64),
    )


class _Places(NamedTuple):
    """Nodes of a template, how they follow the net, and which may lift."""

    kept: _Arrays
    addresses: tuple[int, int]  # of the first two
    lifts: int


@lru_cache(maxsize=256)
def _describe_places(template: MeshTemplate) -> _Places:
    nodes = np.ascontiguousarray(template.nodes, dtype=np.float64)
    follow = np.ascontiguousarray(follow_net(template), dtype=np.float64)
    lifts = may_lift(template)
    return _Places(
        kept=(nodes, follow, lifts),
        addresses=(locate(nodes), locate(follow)),
        lifts=locate(lifts),
    )


def _describe_frame(template: MeshTemplate) -> _Arrays:
    """Places of nodes between those of the net, as ``Scene`` of round.c has them."""
    heights, of_net = template.nodes[1], template.net_fractions
    below = np.searchsorted(of_net, heights, side="right") - 1
    below = np.clip(below, 0, of_net.size - 1)
    rise = np.where(below < of_net.size - 1, heights - of_net[below], 0.0)
    return (
        np.ascontiguousarray(below, dtype=np.int32),
        np.maximum(rise, 0.0),
        np.ascontiguousarray(of_net, dtype=np.float64),
        np.ascontiguousarray(template.edges, dtype=np.int32),
    )


def _lay_out(
    template: MeshTemplate, n_elements: int, n_parts: int, *, slides: bool
) -> dict[str, slice]:
    """Places of a round's results; round.c has the same list."""
    nodes, net = template.nodes.shape[1], template.net.size
    points, ground = 3 * template.triangles.shape[1], template.ground.size - 1
    edges = ground // 2 * EDGE_WEIGHTS.size
    on_net = 2 * (2 * n_elements + 1)
    hung = {
        **{"forces": on_net, "lengths": n_elements, "parts": n_parts},
        **{"curve": on_net, "pull": 2, "tension": 2 * n_elements, "ends": 4},
    }
    sizes = {
        **{"nodes": 2 * nodes, "weights": points, "gradients": 12 * points},
        **{"unit_load": nodes, "normal": 2 * net, "axes": 2 * nodes},
        **{"edge_weights": edges, "load": 2 * nodes},
        **{"unknowns": 2 * nodes, "reaction": 2 * nodes, "stress": 3 * points},
        "shear": edges if slides else 0,
        "sign": net - 1,
        **hung,
        **{f"settled_{name}": size for name, size in hung.items()},
        **{"residual": 2 * nodes, "on_ground": 2, "ground_normal": ground},
        **{"unbalanced": 1, "way": 1, "marks": (2 * (net - 1) + ground) // 8 + 1},
    }
    ends = accumulate(sizes.values())
    return {
        name: slice(end - size, end)
        for (name, size), end in zip(sizes.items(), ends, strict=True)
    }
