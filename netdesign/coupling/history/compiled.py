"""Snow of a step in the compiled core; the same as ``PlainSnow`` of ``snow.py``."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from netdesign.core.arguments import (
    BodyArgument,
    IterateArgument,
    LawArgument,
    MeshArgument,
    locate,
    point_to,
)
from netdesign.core.library import SINGULAR, find_core, require_sound
from netdesign.coupling.history.snow import (
    BodyLoad,
    Condensed,
    SnowIterate,
    take_linear,
)
from netdesign.numerics.arrays import Floats
from netdesign.snow.compiled import (
    describe_law,
    describe_placement,
    describe_template,
)
from netdesign.snow.linear import SingularError
from netdesign.snow.mesh import MeshTemplate
from netdesign.snow.placed_mesh import EDGE_SHAPE, EDGE_WEIGHTS


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CompiledSnow:
    """Snow of a step.

    Attributes
    ----------
    library : PyDLL
        The core.
    argument : BodyArgument
        Mesh, law and load as the core takes them.
    first : LawArgument
        Law of the first iterate.
    weights : ndarray, shape (n_triangles, 3)
        Of the quadrature [thickness^2].
    is_valid : bool
        No triangle is turned over.
    drags : bool
        The ground has a shear.
    kept : tuple of ndarray, each of any shape
        Arrays whose addresses the argument has.
    """

    library: ctypes.PyDLL
    argument: BodyArgument
    first: LawArgument
    weights: Floats
    is_valid: bool
    drags: bool
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
        following, count = self._copy(iterate), 2 * self.argument.mesh.n_net
        body, to = self._choose_law(is_first=iterate.stress is None), _point(following)
        memory = np.empty(require_sound(self.library.nd_room(body)))
        room = ctypes.c_int64(memory.size), ctypes.c_void_p(locate(memory))
        root, missing = np.empty((count, count)), np.empty(count)
        places = (ctypes.c_void_p(locate(one)) for one in (root, missing))
        code = self.library.nd_condense(body, ctypes.byref(to), *room, *places)
        if code == SINGULAR:
            raise SingularError("singular")
        require_sound(code)
        return Condensed(
            root, missing, partial(self._answer, iterate, following, memory)
        )

    def _answer(
        self, iterate: SnowIterate, following: SnowIterate, memory: Floats, net: Floats
    ) -> SnowIterate:
        is_first, to = iterate.stress is None, _point(following)
        room = ctypes.c_int64(memory.size), ctypes.c_void_p(locate(memory))
        moved = np.ascontiguousarray(net)
        body, place = (
            self._choose_law(is_first=is_first),
            ctypes.c_void_p(locate(moved)),
        )
        code = self.library.nd_answer(body, ctypes.byref(to), *room, place)
        require_sound(code)
        return following._replace(change=1.0 if is_first else to.change)

    def _choose_law(self, *, is_first: bool) -> object:
        body = BodyArgument.from_buffer_copy(self.argument)
        if is_first:
            body.law = self.first
        return ctypes.byref(body)

    def _copy(self, iterate: SnowIterate) -> SnowIterate:
        """Arrays of the next iterate, which begin as those of the last."""
        stress, shear = iterate.stress, iterate.base_shear
        mesh = self.argument.mesh
        if stress is None:
            stress = np.zeros((*self.weights.shape, 3))
        if self.drags and shear is None:
            shear = np.zeros((mesh.n_edges, EDGE_WEIGHTS.size))
        return SnowIterate(
            unknowns=iterate.unknowns.copy(),
            stress=stress.copy(),
            base_shear=shear.copy() if self.drags and shear is not None else None,
            imbalance=np.empty(2 * mesh.n_nodes),
        )


def _point(iterate: SnowIterate) -> IterateArgument:
    arrays = (iterate.unknowns, iterate.stress, iterate.base_shear, iterate.imbalance)
    return IterateArgument(*map(locate, arrays))


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
    library, problem = find_core(), load.problem
    if library is None or problem.snow.element != "velocity":
        return None
    described = describe_template(template, library)
    if described is None:
        return None
    n_triangles, n_net = template.triangles.shape[1], template.net.size
    n_edges = template.ground.size // 2
    slip = problem.snow.slip_ratio * np.ascontiguousarray(load.bottom)
    snow = problem.snow
    if snow.ground != "sliding" and problem.base_drag > 0.0:
        snow = replace(snow, slip_exponent=1.0)
        slip = np.array([1.0 / problem.base_drag])
    laws = [
        describe_law(one, load.material, (n_triangles, 3), slip)
        for one in (snow, take_linear(snow))
    ]
    places = {
        "nodes": np.ascontiguousarray(nodes),
        "gradients": np.empty((2, n_triangles, 3, 6)),
        "weights": np.empty((n_triangles, 3)),
        "load": np.empty(nodes.shape[1]),
        "axes": np.empty_like(nodes),
        "normal": np.empty((2, n_net)),
    }
    placement = describe_placement(described, template.orientation)
    point_to(placement, **places)
    mesh = MeshArgument(*described.counts, *described.numbers)
    edge_weights = np.empty((n_edges, EDGE_WEIGHTS.size))
    point_to(
        mesh,
        **{name: places[name] for name in ("gradients", "weights", "axes")},
        edge_weights=edge_weights,
        edge_shape=EDGE_SHAPE,
        load=load.weight,
    )
    argument = BodyArgument(
        place=placement, mesh=mesh, law=laws[0][0], plan=described.plan
    )
    point_to(
        argument, is_free=load.inner, edge_rule=EDGE_WEIGHTS, edge_weights=edge_weights
    )
    kept = (*described.kept, *places.values(), edge_weights, load.weight, load.inner)
    return CompiledSnow(
        library=library,
        argument=argument,
        first=laws[1][0],
        weights=places["weights"],
        is_valid=bool(library.nd_place(ctypes.byref(argument))),
        drags=load.drags,
        kept=(*kept, template.orientation, *laws[0][1], *laws[1][1]),
    )
