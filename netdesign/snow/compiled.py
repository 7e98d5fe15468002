"""Newton steps of the flow by the compiled core; the same as those of ``flow.py``.

Only the velocity element; the mixed one is taken in NumPy. Theory: core/THEORY.md.
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from netdesign.core.arguments import (
    LawArgument,
    MeshArgument,
    StepArgument,
    locate,
    to_floats,
)
from netdesign.core.library import SINGULAR, find_core, require_sound
from netdesign.core.plan import Words, build_plan
from netdesign.numerics.arrays import Floats, Mask
from netdesign.snow.law import FlowProblem, Material
from netdesign.snow.linear import SingularError
from netdesign.snow.mesh import MeshTemplate
from netdesign.snow.placed_mesh import PlacedMesh, edge_triples


class Support(NamedTuple):
    """Supports of the snow in a step.

    Attributes
    ----------
    free : ndarray of bool, shape (n_dofs,)
        Unknowns that nothing holds.
    shares : ndarray, shape (n_dofs,), or None
        Of friction, as ``friction_shares`` has them [-].
    bears : ndarray of bool, shape (n_edges,)
        Edges of the ground that have not lifted wholly.
    """

    free: Mask
    shares: Floats | None
    bears: Mask


class Advanced(NamedTuple):
    """Result of a step.

    Attributes
    ----------
    unknowns, reaction : ndarray, shape (n_dofs,)
        Velocities, and forces of net and ground on the snow, node axes.
    stress : ndarray, shape (n_triangles, n_points, 3)
        (xx, yy, xy) [rho g d].
    base_shear : ndarray, shape (n_edges, n_points), or None
        On a sliding ground [rho g d].
    """

    unknowns: Floats
    reaction: Floats
    stress: Floats
    base_shear: Floats | None


class _Numbers(NamedTuple):
    """Numbers of a template as the core takes them, and its plan."""

    triangles: Words
    net: Words
    edges: Words
    plan: Words


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CompiledFlow:
    """The core on one placed mesh, with the load on it.

    Attributes
    ----------
    library : PyDLL
        The core.
    mesh : PlacedMesh
        Of the flow.
    argument : MeshArgument
        The same as the core takes it.
    numbers : tuple of ndarray, each of any shape
        Numbers of nodes, and the plan.
    kept : tuple of ndarray, each of any shape
        Arrays whose addresses the argument has.
    """

    library: ctypes.PyDLL
    mesh: PlacedMesh
    argument: MeshArgument
    numbers: _Numbers
    kept: tuple[Floats, ...]

    def advance(
        self,
        problem: FlowProblem,
        material: Material,
        stress: Floats,
        base_shear: Floats | None,
        support: Support,
        *,
        keeps: bool = False,
    ) -> Advanced:
        """One step from stresses: Newton's (N10), or a correction (N17).

        Parameters
        ----------
        problem, material : FlowProblem, Material
            Laws of creep and ground.
        stress : ndarray, shape (n_triangles, n_points, 3)
            To start from [rho g d].
        base_shear : ndarray, shape (n_edges, n_points), or None
            To start from, where the ground slides [rho g d].
        support : Support
            What holds the snow.
        keeps : bool
            The stresses are kept and corrected; the unknowns are then the correction.

        Raises
        ------
        SingularError
            If nothing holds the snow.
        """
        count, mesh = self.mesh.n_dofs, self.mesh
        found = Advanced(
            unknowns=np.empty(count),
            reaction=np.empty(count),
            stress=np.empty((*mesh.weights.shape, 3)),
            base_shear=None
            if base_shear is None
            else np.empty(mesh.base.weights.shape),
        )
        self._call(problem, material, stress, base_shear, support, found, keeps=keeps)
        return found

    def respond(
        self,
        problem: FlowProblem,
        material: Material,
        stress: Floats,
        base_shear: Floats | None,
        support: Support,
        held: Mask,
    ) -> tuple[Floats, Floats]:
        """Forces at the net's nodes where its normal velocity is prescribed.

        Parameters
        ----------
        problem, material : FlowProblem, Material
            Laws of creep and ground.
        stress : ndarray, shape (n_triangles, n_points, 3)
            About which the flow is linearised [rho g d].
        base_shear : ndarray, shape (n_edges, n_points), or None
            Where the ground slides [rho g d].
        support : Support
            What holds the snow.
        held : ndarray of bool, shape (n_net - 1,)
            Nodes above the foot that the snow has not left.

        Returns
        -------
        ndarray, ndarray, shape (n_net, n_net - 1)
            Along the first and the second axis of each node, per velocity.

        Raises
        ------
        SingularError
            If nothing holds the snow.
        """
        root = self._call(
            problem, material, stress, base_shear, support, None, keeps=False
        )
        net = self.mesh.template.net
        places = np.column_stack([2 * net, 2 * net + 1]).ravel()
        moved = np.zeros((places.size, held.size))
        moved[2 + 2 * np.flatnonzero(held), np.flatnonzero(held)] = 1.0
        shares = None if support.shares is None else support.shares[places]
        moved += _solve_root(root, root @ moved, support.free[places], shares)
        forces = root @ moved
        return forces[::2], forces[1::2]

    def compare(
        self,
        problem: FlowProblem,
        material: Material,
        reactions: tuple[Floats, Floats],
        stresses: tuple[Floats, Floats],
    ) -> tuple[float, float]:
        """Relative changes in a step, as (N16) takes them.

        Parameters
        ----------
        problem, material : FlowProblem, Material
            Law of creep.
        reactions : tuple of ndarray, each of shape (n_dofs,)
            After the step and before it [rho g d^2].
        stresses : tuple of ndarray, each of shape (n_triangles, n_points, 3)
            After the step and before it [rho g d].

        Returns
        -------
        float, float
            Of the sums of the net's forces, and of the stress [-].
        """
        change = np.empty(2)
        law, kept = describe_law(problem, material)
        self.library.nd_compare(
            ctypes.byref(self.argument),
            ctypes.byref(law),
            *(ctypes.c_void_p(locate(one)) for one in (*reactions, *stresses)),
            ctypes.c_void_p(locate(change)),
        )
        del kept
        return float(change[0]), float(change[1])

    def _call(
        self,
        problem: FlowProblem,
        material: Material,
        stress: Floats,
        base_shear: Floats | None,
        support: Support,
        found: Advanced | None,
        *,
        keeps: bool,
    ) -> Floats:
        mesh = self.mesh
        stress = to_floats(stress, (*mesh.weights.shape, 3))
        if base_shear is not None:
            base_shear = to_floats(base_shear, mesh.base.weights.shape)
        root = np.empty((2 * mesh.template.net.size, 2 * mesh.template.net.size))
        given = (stress, base_shear, support.free, support.shares, support.bears)
        places = [locate(one) for one in (*given, *(found or (None,) * 4), root)]
        law, kept = describe_law(problem, material)
        code = self.library.nd_step(
            ctypes.byref(self.argument),
            ctypes.byref(law),
            ctypes.byref(StepArgument(*places)),
            ctypes.c_void_p(locate(self.numbers.plan)),
            int(keeps),
        )
        del kept
        if code == SINGULAR:
            raise SingularError("singular")
        require_sound(code)
        return root


def _solve_root(
    root: Floats, forces: Floats, free: Mask, shares: Floats | None
) -> Floats:
    """Unknowns of the net that balance forces (2 n_net, m); 0 where held."""
    load, matrix = -forces, root.copy()
    if shares is not None:
        load[1::2] += shares[1::2, None] * load[::2]
        matrix[1::2] += shares[1::2, None] * matrix[::2]
    solved = np.zeros_like(load)
    try:
        solved[free] = np.linalg.solve(matrix[np.ix_(free, free)], load[free])
    except np.linalg.LinAlgError as error:
        raise SingularError(str(error)) from None
    return solved


def describe_law(
    problem: FlowProblem, material: Material
) -> tuple[LawArgument, tuple[Floats, Floats]]:
    """Laws as the core takes them, and their arrays, shape (n_triangles, n_points)."""
    bulk = np.ascontiguousarray(material.bulk_ratio, dtype=np.float64)
    fluidity = np.ascontiguousarray(material.fluidity_ratio, dtype=np.float64)
    slip = problem.slip_exponent
    law = LawArgument(
        problem.exponent,
        problem.exponent if slip is None else slip,
        problem.slip_ratio * problem.layers[0].fluidity_ratio,
        problem.stress_floor,
        0 if bulk.size == 1 else 1,
        locate(bulk),
        locate(fluidity),
    )
    return law, (bulk, fluidity)


def can_compile(problem: FlowProblem) -> bool:
    """There is a core, and it has the problem's element."""
    return find_core() is not None and problem.element == "velocity"


def prepare_flow(mesh: PlacedMesh, load: Floats) -> CompiledFlow | None:
    """The core on a mesh; None where there is none.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    load : ndarray, shape (n_dofs,)
        Of gravity, node axes [rho g d^2].
    """
    library = find_core()
    if library is None:
        return None
    template, base = mesh.template, mesh.base
    numbers = _number(library, template)
    kept = tuple(
        np.ascontiguousarray(one, dtype=np.float64)
        for one in (
            *(mesh.gradients, mesh.weights, mesh.axes),
            *(base.weights, base.shape, load),
        )
    )
    argument = MeshArgument(
        *(mesh.nodes.shape[1], template.triangles.shape[1]),
        *(template.net.size, len(numbers.edges)),
        *(locate(one) for one in (numbers.triangles, numbers.net, numbers.edges)),
        *(locate(one) for one in kept),
    )
    return CompiledFlow(
        library=library, mesh=mesh, argument=argument, numbers=numbers, kept=kept
    )


@lru_cache(maxsize=256)
def _number(library: ctypes.PyDLL, template: MeshTemplate) -> _Numbers:
    triangles = np.ascontiguousarray(template.triangles.T, dtype=np.int32)
    net = np.ascontiguousarray(template.net, dtype=np.int32)
    return _Numbers(
        triangles=triangles,
        net=net,
        edges=_find_edges(template, triangles),
        plan=build_plan(library, triangles, np.ascontiguousarray(template.nodes), net),
    )


def _find_edges(template: MeshTemplate, triangles: Words) -> Words:
    """Triangle above each edge of the ground, and the edge's nodes in it, (n, 4)."""
    triples = np.column_stack(edge_triples(template.ground))
    owner = np.empty(template.nodes.shape[1], dtype=np.int64)
    owner[triangles.T] = np.arange(len(triangles))  # an edge's midpoint has one
    above = owner[triples[:, 1]]
    places = (triangles[above][:, None] == triples[..., None]).argmax(axis=2)
    return np.ascontiguousarray(np.column_stack([above, places]), dtype=np.int32)
