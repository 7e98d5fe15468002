"""Snow of a step in the compiled core; the same as ``PlainSnow`` of ``snow.py``."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from netdesign.addons.history.snow import (
    BodyLoad,
    Condensed,
    SnowIterate,
    take_linear,
)
from netdesign.core.arguments import (
    BodyArgument,
    IterateArgument,
    LawArgument,
    MeshArgument,
    locate_all,
    point_to,
    to_floats,
)
from netdesign.core.library import SINGULAR, find_core, require_sound
from netdesign.numerics.arrays import Floats
from netdesign.snow.compiled import (
    describe_law,
    describe_placement,
    describe_template,
)
from netdesign.snow.kernel import SingularError
from netdesign.snow.mesh import MeshTemplate
from netdesign.snow.placed_mesh import EDGE_SHAPE, EDGE_WEIGHTS


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CompiledSnow:
    """Snow of a step.

    Attributes
    ----------
    library : PyDLL
        The core.
    body : BodyArgument
        Mesh, laws and load as the core takes them.
    weights : ndarray, shape (n_triangles, 3)
        Of the quadrature [thickness^2].
    is_valid : bool
        No triangle is turned over.
    kept : tuple of ndarray, each of any shape
        Arrays whose addresses the body has.
    """

    library: ctypes.PyDLL
    body: BodyArgument
    weights: Floats
    is_valid: bool
    kept: tuple[np.ndarray[Any, Any], ...]

    def condense(self, iterate: SnowIterate) -> Condensed:
        """Newton step of the snow for any velocities of the net's nodes.

        Parameters
        ----------
        iterate : SnowIterate
            The last one.

        Raises
        ------
        SingularError
            If nothing holds the snow.
        """
        body, count = ctypes.byref(self.body), 2 * self.body.mesh.n_net
        memory = np.empty(require_sound(self.library.nd_room(body)))
        root, missing = np.empty((count, count)), np.empty(count)
        code = self.library.nd_condense(
            *(body, ctypes.byref(_point(iterate))), *_pass(memory, root, missing)
        )
        if code == SINGULAR:
            raise SingularError("singular")
        require_sound(code)
        return Condensed(root, missing, partial(self._answer, iterate, memory))

    def _answer(self, iterate: SnowIterate, memory: Floats, net: Floats) -> SnowIterate:
        mesh = self.body.mesh
        following = SnowIterate(
            unknowns=np.empty(2 * mesh.n_nodes),
            stress=np.empty((mesh.n_triangles, 3, 3)),
            base_shear=np.empty((mesh.n_edges, 4)) if self.body.slides else None,
            imbalance=np.empty(2 * mesh.n_nodes),
        )
        moved, to = to_floats(net, (2 * mesh.n_net,)), _point(following)
        iterates = (ctypes.byref(one) for one in (_point(iterate), to))
        body = ctypes.byref(self.body)
        require_sound(self.library.nd_answer(body, *iterates, *_pass(memory, moved)))
        return following._replace(change=to.change)


def _point(iterate: SnowIterate) -> IterateArgument:
    arrays = (iterate.unknowns, iterate.stress, iterate.base_shear, iterate.imbalance)
    return IterateArgument(*locate_all(*arrays))


def _pass(memory: Floats, *arrays: Floats) -> list[object]:
    """Size and place of the memory, and places of arrays."""
    places = [ctypes.c_void_p(one) for one in locate_all(memory, *arrays)]
    return [ctypes.c_int64(memory.size), *places]


def prepare_snow(
    load: BodyLoad, template: MeshTemplate, nodes: Floats
) -> CompiledSnow | None:
    """The core for the snow of a step; None where NumPy has to do.

    Parameters
    ----------
    load : BodyLoad
        Laws and load.
    template : MeshTemplate
        Reference mesh.
    nodes : ndarray, shape (2, n_nodes)
        Where equilibrium is taken [thickness].
    """
    library = find_core()
    if library is None or load.snow.element != "velocity":
        return None
    described = describe_template(template, library)
    if described is None:
        return None
    shape = (template.triangles.shape[1], 3)
    laws, kept = _describe_laws(load, shape)
    mesh = MeshArgument(*described.counts, *described.numbers)
    placement = describe_placement(described, template.orientation)
    placed = {
        "gradients": np.empty((2, *shape, 6)),
        "weights": np.empty(shape),
        "axes": np.empty_like(nodes),
    }
    edge_weights = np.empty((mesh.n_edges, EDGE_WEIGHTS.size))
    beside = np.empty(nodes.shape[1]), np.empty((2, mesh.n_net))
    point_to(placement, **placed, nodes=nodes, load=beside[0], normal=beside[1])
    point_to(mesh, **placed, edge_weights=edge_weights, edge_shape=EDGE_SHAPE)
    point_to(mesh, load=load.weight)
    body = BodyArgument(placement, mesh, *laws, described.plan)
    point_to(body, is_free=load.inner, edge_rule=EDGE_WEIGHTS)
    point_to(body, edge_weights=edge_weights)
    body.slides = load.slides
    arrays = (*described.kept, *kept, *placed.values(), *beside, edge_weights)
    return CompiledSnow(
        library=library,
        body=body,
        weights=placed["weights"],
        is_valid=bool(library.nd_place(ctypes.byref(body))),
        kept=(*arrays, nodes, load.weight, load.inner, template.orientation),
    )


def _describe_laws(
    load: BodyLoad, shape: tuple[int, ...]
) -> tuple[tuple[LawArgument, LawArgument], tuple[Floats, ...]]:
    """Law of the snow and that of the first iterate, and arrays to keep."""
    slip = load.snow.slip_ratio * np.ascontiguousarray(load.bottom)
    law, kept = describe_law(load.snow, load.material, shape, slip)
    first, more = describe_law(take_linear(load.snow), load.material, shape, slip)
    return (law, first), (*kept, *more)
