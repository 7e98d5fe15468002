"""Newton steps of the flow by the compiled core; the same as those of ``flow_step.py``.

Only the velocity element; the mixed one is taken in NumPy. Theory: core/THEORY.md.
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from netdesign.core.arguments import (
    EffortArgument,
    LawArgument,
    MeshArgument,
    RulesArgument,
    StateArgument,
    StepArgument,
    locate,
    locate_all,
    to_array,
    to_floats,
)
from netdesign.core.library import SINGULAR, require_sound
from netdesign.numerics.arrays import Floats, Ints, Mask
from netdesign.snow.compiled_mesh import number_template, plan_template
from netdesign.snow.contact import Contact, FlowState, may_lift
from netdesign.snow.law import FlowProblem, Material, sample_material
from netdesign.snow.linear import SingularError
from netdesign.snow.mesh import MeshTemplate
from netdesign.snow.placed_mesh import PlacedMesh
from netdesign.snow.shared_mesh import find_once


class Solved(NamedTuple):
    """End of a flow, as ``FlowResult``.

    Attributes
    ----------
    ending : int
        0 converged, 1 not in so many steps, 2 no numbers.
    state : FlowState
        After the last step.
    linear_solves : int
        Taken.
    change : float
        Relative error that the last step left, (N16) [-].
    """

    ending: int
    state: FlowState
    linear_solves: int
    change: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CompiledFlow:
    """The core on one placed mesh, under one load and one law.

    Attributes
    ----------
    library : PyDLL
        The core.
    mesh : PlacedMesh
        Of the flow.
    given : tuple of structures
        Mesh, laws and rules as the core takes them.
    plan : int
        Address of the order of the template's nodes.
    kept : tuple of ndarray, each of any shape
        Arrays whose addresses the structures have.
    """

    library: ctypes.PyDLL
    mesh: PlacedMesh
    given: tuple[MeshArgument, LawArgument, RulesArgument]
    plan: int
    kept: tuple[np.ndarray[Any, Any], ...]

    def solve(
        self,
        start: FlowState,
        first: FlowProblem | None,
        effort: EffortArgument,
    ) -> Solved:
        """Newton's steps from a state, as ``solve_flow`` takes them.

        Parameters
        ----------
        start : FlowState
            Where they start.
        first : FlowProblem or None
            Laws of one step before them.
        effort : EffortArgument
            What is asked; it tells then what was needed.

        Raises
        ------
        SingularError
            If nothing holds the snow in the first step by other laws.
        """
        template = self.mesh.template
        state, places = self._copy(start)
        law, kept = None, None
        if first is not None:
            material = sample_material(first, template)
            law, kept = describe_law(first, material, self.mesh.weights.shape)
        argument = StateArgument(*places, start.base_shear is not None)
        mesh, own, rules = map(ctypes.byref, self.given)
        code = self.library.nd_flow(
            *(mesh, own, law and ctypes.byref(law), rules),
            ctypes.c_void_p(self.plan),
            *(ctypes.byref(argument), ctypes.byref(effort)),
        )
        del kept  # C had its addresses
        return Solved(_require_held(code), state, effort.steps, effort.change)

    def correct(self, state: FlowState) -> FlowState:
        """A state whose stresses balance better, (N17).

        Parameters
        ----------
        state : FlowState
            A converged state.

        Raises
        ------
        SingularError
            If nothing holds the snow.
        """
        mended, _ = self._copy(state)
        arrays = (mended.unknowns, mended.reaction, mended.stress, mended.base_shear)
        self._step(state, (*locate_all(*arrays), 0), keeps=True)
        mended.unknowns[:] += state.unknowns
        return mended

    def respond(
        self,
        state: FlowState,
        free: Mask,
        shares: Floats | None,
    ) -> tuple[Floats, Floats]:
        """Forces at the net's nodes where its normal velocity is prescribed.

        Parameters
        ----------
        state : FlowState
            About which the flow is linearised; its contact does not change.
        free : ndarray of bool, shape (n_dofs,)
            Unknowns that nothing holds.
        shares : ndarray, shape (n_dofs,), or None
            Of friction, as ``friction_shares`` has them [-].

        Returns
        -------
        ndarray, ndarray, shape (n_net, n_net - 1)
            Along the first and the second axis of each node, per velocity.

        Raises
        ------
        SingularError
            If nothing holds the snow.
        """
        net = self.mesh.template.net
        root = np.empty((2 * net.size, 2 * net.size))
        self._step(state, (0, 0, 0, 0, locate(root)), keeps=False)
        places = np.column_stack([2 * net, 2 * net + 1]).ravel()
        held = np.flatnonzero(~state.contact.is_open)
        moved = np.zeros((places.size, net.size - 1))
        moved[2 + 2 * held, held] = 1.0
        shares = None if shares is None else shares[places]
        moved += _solve_root(root, root @ moved, free[places], shares)
        forces = root @ moved
        return forces[::2], forces[1::2]

    def balance(self, stress: Floats, base_shear: Floats | None) -> Floats:
        """Internal less external nodal forces.

        Parameters
        ----------
        stress : ndarray, shape (n_triangles, n_points, 3)
            Of the snow [rho g d].
        base_shear : ndarray, shape (n_edges, n_points), or None
            Where the ground slides [rho g d].

        Returns
        -------
        ndarray, shape (n_dofs,)
            In node axes [rho g d^2].

        Raises
        ------
        ValueError
            If an array is not of its shape.
        """
        mesh, shear = self.mesh, None
        stress = to_floats(stress, (*mesh.weights.shape, 3))
        if base_shear is not None:
            shear = to_floats(base_shear, mesh.base.weights.shape)
        forces = np.empty(mesh.n_dofs)
        places = (ctypes.c_void_p(one) for one in locate_all(stress, shear, forces))
        require_sound(self.library.nd_residual(ctypes.byref(self.given[0]), *places))
        return forces

    def _copy(self, state: FlowState) -> tuple[FlowState, tuple[int, ...]]:
        """A state of this mesh for C to change, and where it is.

        Its numbers are one array, its marks another: each address costs.
        """
        mesh = self.mesh
        n_dofs, shape = mesh.n_dofs, (*mesh.weights.shape, 3)
        shear_at = 2 * n_dofs + 3 * mesh.weights.size
        slides = state.base_shear is not None
        numbers = np.empty(shear_at + (mesh.base.weights.size if slides else 0))
        copied = FlowState(
            unknowns=numbers[:n_dofs],
            reaction=numbers[n_dofs : 2 * n_dofs],
            stress=numbers[2 * n_dofs : shear_at].reshape(shape),
            base_shear=(
                numbers[shear_at:].reshape(mesh.base.weights.shape) if slides else None
            ),
            contact=_copy_contact(state.contact, mesh.template),
        )
        for name in ("unknowns", "reaction", "stress", "base_shear"):
            if (own := getattr(copied, name)) is not None:
                own[...] = getattr(state, name)
        contact = copied.contact
        marks, count = locate(contact.is_pressed), contact.sign.size
        held = (locate(contact.sign), marks, marks + count, marks + 2 * count)
        return copied, (locate(numbers), *held)

    def _step(self, state: FlowState, results: tuple[int, ...], *, keeps: bool) -> None:
        mesh, shear = self.mesh, None
        stress = to_floats(state.stress, (*mesh.weights.shape, 3))
        if state.base_shear is not None:
            shear = to_floats(state.base_shear, mesh.base.weights.shape)
        template = mesh.template
        held = _to_arrays(
            state.contact, template.net.size - 1, template.ground.size - 1
        )
        step = StepArgument(*locate_all(stress, shear, *held), *results)
        code = self.library.nd_step(
            *map(ctypes.byref, (*self.given, step)),
            ctypes.c_void_p(self.plan),
            int(keeps),
        )
        _require_held(code)


def _copy_contact(contact: Contact, template: MeshTemplate) -> Contact:
    """The same in two arrays: of signs, and of marks side by side."""
    n_net, n_ground = template.net.size - 1, template.ground.size - 1
    sign = np.empty(n_net, dtype=np.int64)
    marks = np.empty(2 * n_net + n_ground, dtype=np.bool_)
    sign[:] = contact.sign
    marks[:n_net] = contact.is_pressed
    marks[n_net : 2 * n_net] = contact.is_open
    marks[2 * n_net :] = contact.is_lifted
    return Contact(
        sign=sign,
        is_pressed=marks[:n_net],
        is_open=marks[n_net : 2 * n_net],
        is_lifted=marks[2 * n_net :],
    )


def _require_held(code: int) -> int:
    """The code of a function that could hold the snow."""
    if code == SINGULAR:
        raise SingularError("singular")
    return require_sound(code)


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


def _to_arrays(contact: Contact, n_net: int, n_ground: int) -> tuple[Ints | Mask, ...]:
    """Contact as the core takes it, shapes (n_net,) and (n_ground,)."""
    return (
        to_array(contact.sign, np.int64, (n_net,)),
        to_array(contact.is_pressed, np.bool_, (n_net,)),
        to_array(contact.is_open, np.bool_, (n_net,)),
        to_array(contact.is_lifted, np.bool_, (n_ground,)),
    )


def describe_law(
    problem: FlowProblem, material: Material, shape: tuple[int, ...]
) -> tuple[LawArgument, tuple[Floats, Floats]]:
    """Laws as the core takes them, and their arrays: one number, or of the shape.

    Parameters
    ----------
    problem, material : FlowProblem, Material
        Creep and ground.
    shape : tuple of int
        Of the quadrature points.
    """
    bulk = np.asarray(material.bulk_ratio, dtype=np.float64)
    fluidity = np.asarray(material.fluidity_ratio, dtype=np.float64)
    if bulk.size > 1 or fluidity.size > 1:
        bulk, fluidity = np.broadcast_to(bulk, shape), np.broadcast_to(fluidity, shape)
    bulk, fluidity = np.ascontiguousarray(bulk), np.ascontiguousarray(fluidity)
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


def describe_rules(problem: FlowProblem, lifts: int) -> RulesArgument:
    """Rules of contact as the core takes them.

    Parameters
    ----------
    problem : FlowProblem
        Contacts and friction.
    lifts : int
        Address of the marks (n_ground - 1,) of ground nodes that may lift [-].
    """
    return RulesArgument(
        problem.friction,
        problem.net_contact == "one-sided",
        problem.ground_contact == "one-sided",
        problem.ground == "no-slip",
        lifts,
    )


class Described(NamedTuple):
    """A template as the core takes it.

    Attributes
    ----------
    kept : tuple of ndarray, each of any shape
        Arrays whose addresses the others are.
    counts : tuple of int
        Of nodes, triangles, the net's nodes, edges on the ground.
    numbers : tuple of int
        Addresses of the nodes of triangles, net, ground, edges.
    plan : int
        Address of the order of the nodes.
    """

    kept: tuple[np.ndarray[Any, Any], ...]
    counts: tuple[int, int, int, int]
    numbers: tuple[int, ...]
    plan: int


def prepare_flow(
    library: ctypes.PyDLL,
    problem: FlowProblem,
    material: Material,
    mesh: PlacedMesh,
    load: Floats,
) -> CompiledFlow | None:
    """The core on a mesh; None where the mesh is too large for it.

    Parameters
    ----------
    library : PyDLL
        The core.
    problem, material : FlowProblem, Material
        Creep, ground and friction.
    mesh : PlacedMesh
        Mesh against the net's curve.
    load : ndarray, shape (n_dofs,)
        Of gravity, node axes [rho g d^2].
    """
    described = describe_template(mesh.template, library)
    if described is None:
        return None
    base = mesh.base
    arrays = (mesh.gradients, mesh.weights, mesh.axes, base.weights, base.shape, load)
    kept = tuple(np.ascontiguousarray(one, dtype=np.float64) for one in arrays)
    argument = MeshArgument(*described.counts, *described.numbers, *locate_all(*kept))
    law, more = describe_law(problem, material, mesh.weights.shape)
    lifts = may_lift(mesh.template)
    return CompiledFlow(
        library=library,
        mesh=mesh,
        given=(argument, law, describe_rules(problem, locate(lifts))),
        plan=described.plan,
        kept=(*described.kept, *kept, *more, lifts),
    )


@find_once
def describe_template(
    template: MeshTemplate, library: ctypes.PyDLL
) -> Described | None:
    """A template as the core takes it; None where it is too large."""
    plan = plan_template(library, template)
    if plan is None:
        return None
    numbers = number_template(template)
    counts = (template.nodes.shape[1], len(numbers.triangles))
    return Described(
        kept=(*numbers, plan),
        counts=(*counts, numbers.net.size, len(numbers.edges)),
        numbers=tuple(locate_all(*numbers)),
        plan=locate(plan),
    )
