"""Newton step of the snow, condensed to the net's nodes, in NumPy and in the C core.

Theory: coupling/THEORY.md, section 6.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np

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
from netdesign.numerics.arrays import Floats, Mask
from netdesign.snow.compiled import (
    describe_law,
    describe_placement,
    describe_template,
)
from netdesign.snow.kernel import (
    Matrix,
    SingularError,
    assemble_base_force,
    assemble_base_stiffness,
    assemble_stiffness,
    assemble_stress,
    compute_base_velocity,
    compute_strain,
    solve_matrix,
)
from netdesign.snow.law import (
    FlowProblem,
    Material,
    Tangent,
    advance_stress,
    hold_stress,
    linearise_creep,
    linearise_sliding,
    squared_invariant,
    total_stress,
)
from netdesign.snow.mesh import MeshTemplate
from netdesign.snow.placed_mesh import EDGE_SHAPE, EDGE_WEIGHTS, PlacedMesh


class SnowIterate(NamedTuple):
    """Velocities, and the stresses that belong to them once converged.

    Attributes
    ----------
    unknowns : ndarray, shape (n_dofs,)
        Velocities, and pressures of the mixed element, in the slope's axes.
    stress : ndarray, shape (n_triangles, n_points, R), or None
        None before the first iteration [rho g d].
    base_shear : ndarray, shape (n_edges, n_points), or None
        Of a ground with a shear [rho g d].
    imbalance : ndarray, shape (2 n_nodes,), or None
        Forces that supports and net have to give [rho g d^2]; (K7).
    change : float
        Relative change of the stress in the last iteration [-]; 1 in the first.
    """

    unknowns: Floats
    stress: Floats | None
    base_shear: Floats | None
    imbalance: Floats | None = None
    change: float = 1.0


class Condensed(NamedTuple):
    """Snow about an iterate, all but the net's nodes eliminated.

    Attributes
    ----------
    root : ndarray, shape (2 n_net, 2 n_net)
        Forces that velocities of the net's nodes give, X and Y of each in turn [-].
    missing : ndarray, shape (2 n_net,)
        Forces that balance lacks there if these nodes keep their velocities
        [rho g d^2].
    answer : callable
        Gives the iterate after changes (2 n_net,) of these velocities.
    """

    root: Floats
    missing: Floats
    answer: Callable[[Floats], SnowIterate]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BodyLoad:
    """Laws and load of the snow where equilibrium is taken.

    Attributes
    ----------
    snow : FlowProblem
        Creep and ground; one that drags slides by a linear law.
    material : Material
        Of the snow as it is now.
    bottom : ndarray, shape (n_ground_edges,)
        Fluidity of the snow on the ground over the reference, or of what drags it [-].
    weight : ndarray, shape (2 n_nodes,)
        Nodal forces [rho g d^2].
    inner : ndarray of bool, shape (2 n_nodes,)
        Unknowns that nothing holds, off the net.
    """

    snow: FlowProblem
    material: Material
    bottom: Floats
    weight: Floats
    inner: Mask

    @property
    def slides(self) -> bool:
        """The ground has a shear."""
        return self.snow.ground == "sliding"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PlainSnow:
    """Snow of a step in NumPy.

    Attributes
    ----------
    load : BodyLoad
        Laws and load.
    mesh : PlacedMesh
        In the slope's axes everywhere.
    """

    load: BodyLoad
    mesh: PlacedMesh

    @property
    def weights(self) -> Floats:
        """Weights of the quadrature, shape (n_triangles, n_points) [thickness^2]."""
        return self.mesh.weights

    @property
    def is_valid(self) -> bool:
        """No triangle is turned over."""
        return self.mesh.is_valid

    def condense(self, iterate: SnowIterate) -> Condensed:
        """Newton step of the snow for any velocities of the net's nodes.

        Written for changes of the velocities: what rounding leaves of equilibrium in
        one iteration is mended in the next.

        Parameters
        ----------
        iterate : SnowIterate
            The last one.

        Raises
        ------
        SingularError
            If nothing holds the snow.
        """
        linear = self._linearise(iterate)
        net = np.repeat(2 * self.mesh.template.net, 2)
        net[1::2] += 1
        free = np.ones(self.mesh.n_dofs, dtype=bool)
        free[: self.load.inner.size] = self.load.inner
        forces = np.column_stack([linear.force, linear.matrix[:, net].toarray()])
        moved = solve_matrix(self.mesh.template, linear.matrix, forces, free)
        reactions = (forces + linear.matrix @ moved)[net]
        moved[net, 1 + np.arange(net.size)] = 1.0
        return Condensed(
            root=reactions[:, 1:],
            missing=-reactions[:, 0],
            answer=partial(self._answer, iterate, linear, moved),
        )

    def _answer(
        self, iterate: SnowIterate, linear: _Linear, moved: Floats, net: Floats
    ) -> SnowIterate:
        mesh, snow = self.mesh, self.load.snow
        change = moved[:, 0] + moved[:, 1:] @ net
        base_shear = linear.base_shear
        if linear.base is not None and base_shear is not None:
            base_velocity = compute_base_velocity(mesh, change)
            base_shear = base_shear + linear.base.modulus * base_velocity
        stress = advance_stress(
            snow, linear.tangent, linear.strain, compute_strain(mesh, change)
        )
        imbalance = assemble_stress(mesh, total_stress(snow, stress))
        if base_shear is not None:
            imbalance += assemble_base_force(mesh, base_shear)
        return SnowIterate(
            unknowns=iterate.unknowns + change,
            stress=stress,
            base_shear=base_shear,
            imbalance=imbalance[: self.load.weight.size] - self.load.weight,
            change=self._measure_change(iterate.stress, stress),
        )

    def _measure_change(self, old: Floats | None, new: Floats) -> float:
        """Relative change of the stress, by its invariant over the body."""
        if old is None:
            return 1.0
        snow, material = self.load.snow, self.load.material
        weights = self.mesh.weights
        change = (weights * squared_invariant(snow, material, new - old)).sum()
        size = (weights * squared_invariant(snow, material, new)).sum()
        return float(np.sqrt(change / size))

    def _linearise(self, iterate: SnowIterate) -> _Linear:
        mesh, stress, base_shear = self.mesh, iterate.stress, iterate.base_shear
        snow = self.load.snow
        if stress is None:
            snow = take_linear(snow)
            stress = np.zeros((*mesh.weights.shape, mesh.operator.shape[2]))
        tangent = linearise_creep(snow, self.load.material, stress)
        strain = compute_strain(mesh, iterate.unknowns)
        matrix = assemble_stiffness(mesh, tangent.modulus)
        force = assemble_stress(mesh, hold_stress(tangent, strain))
        force[: self.load.weight.size] -= self.load.weight
        if not self.load.slides:
            return _Linear(matrix, force, tangent, strain, None, None)
        shear = np.zeros_like(mesh.base_weights) if base_shear is None else base_shear
        base = linearise_sliding(snow, shear, self.load.bottom[:, None])
        base_velocity = compute_base_velocity(mesh, iterate.unknowns)
        shear = base.intercept + base.modulus * base_velocity
        matrix = matrix + assemble_base_stiffness(mesh, base.modulus)
        force += assemble_base_force(mesh, shear)
        return _Linear(matrix, force, tangent, strain, base, shear)


class _Linear(NamedTuple):
    """Linearised equations about an iterate."""

    matrix: Matrix
    force: Floats  # out of balance
    tangent: Tangent
    strain: Floats
    base: Tangent | None
    base_shear: Floats | None


def take_linear(snow: FlowProblem) -> FlowProblem:
    """Linear creep and sliding, of which the first iterate is.

    Parameters
    ----------
    snow : FlowProblem
        Creep and ground.
    """
    return replace(snow, exponent=1.0, slip_exponent=None)


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
        iterates = (ctypes.byref(place) for place in (_point(iterate), to))
        body = ctypes.byref(self.body)
        require_sound(self.library.nd_answer(body, *iterates, *_pass(memory, moved)))
        return following._replace(change=to.change)


def _point(iterate: SnowIterate) -> IterateArgument:
    arrays = (iterate.unknowns, iterate.stress, iterate.base_shear, iterate.imbalance)
    return IterateArgument(*locate_all(*arrays))


def _pass(memory: Floats, *arrays: Floats) -> list[object]:
    """Size and place of the memory, and places of arrays."""
    places = [ctypes.c_void_p(place) for place in locate_all(memory, *arrays)]
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
