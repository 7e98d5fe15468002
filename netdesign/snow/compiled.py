"""Newton steps of the flow by the compiled core; the same as those of ``flow_step.py``.

Only the velocity element; the mixed one is taken in NumPy. Theory: core/THEORY.md.
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from netdesign.core.arguments import (
    LawArgument,
    MeshArgument,
    RulesArgument,
    StepArgument,
    locate,
    locate_all,
    to_array,
    to_floats,
)
from netdesign.core.library import SINGULAR, find_core, require_sound
from netdesign.core.plan import Words
from netdesign.numerics.arrays import Floats, Ints, Mask
from netdesign.snow.compiled_mesh import number_template, plan_template
from netdesign.snow.contact import Contact, may_lift
from netdesign.snow.law import FlowProblem, Material
from netdesign.snow.linear import SingularError
from netdesign.snow.mesh import MeshTemplate
from netdesign.snow.placed_mesh import PlacedMesh


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
    changes : tuple of float
        Relative, of the net's forces and of the stress, as (N16) takes them [-]; no
        numbers where the step before has no reactions.
    wanted : Contact
        That follows.
    """

    unknowns: Floats
    reaction: Floats
    stress: Floats
    base_shear: Floats | None
    changes: tuple[float, float]
    wanted: Contact


class _Room(NamedTuple):
    """Memory for the results of a step, each of its shape, and its places."""

    advanced: Advanced
    change: Floats
    places: tuple[int, ...]

    def read(self, contact: Contact, *, is_compared: bool) -> Advanced:
        """Results; without a comparison the contact is as it was."""
        if not is_compared:
            return self.advanced._replace(wanted=contact)
        changes = (float(self.change[0]), float(self.change[1]))
        return self.advanced._replace(changes=changes)


def _make_room(
    n_dofs: int, stress: Floats, base_shear: Floats | None, contact: Contact
) -> _Room:
    """Room for all numbers in one piece: each address costs."""
    n_shear = 0 if base_shear is None else base_shear.size
    shear_at = 2 * n_dofs + stress.size
    out = np.empty(shear_at + n_shear + 2)
    n_net, n_ground = contact.sign.size, contact.is_lifted.size
    sign = np.empty(n_net, dtype=np.int64)
    marks = np.empty(2 * n_net + n_ground, dtype=bool)
    first, mark = locate(out), locate(marks)
    starts = (0, n_dofs, 2 * n_dofs, shear_at, shear_at + n_shear)
    places = [first + 8 * start for start in starts]
    if base_shear is None:
        places[3] = 0
    advanced = Advanced(
        unknowns=out[:n_dofs],
        reaction=out[n_dofs : 2 * n_dofs],
        stress=out[2 * n_dofs : shear_at].reshape(stress.shape),
        base_shear=None,
        changes=(np.nan, np.nan),
        wanted=Contact(
            sign=sign,
            is_pressed=marks[:n_net],
            is_open=marks[n_net : 2 * n_net],
            is_lifted=marks[2 * n_net :],
        ),
    )
    if base_shear is not None:
        shear = out[shear_at : shear_at + n_shear].reshape(base_shear.shape)
        advanced = advanced._replace(base_shear=shear)
    wanted = (locate(sign), mark, mark + n_net, mark + 2 * n_net)
    return _Room(advanced, out[-2:], (*places, *wanted, 0))


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
    plan : ndarray of int32, shape (n_words,)
        Order of the template's nodes.
    kept : tuple of ndarray, each of any shape
        Arrays whose addresses the structures have.
    """

    library: ctypes.PyDLL
    mesh: PlacedMesh
    given: tuple[MeshArgument, LawArgument, RulesArgument]
    plan: Words
    kept: tuple[np.ndarray[Any, Any], ...]

    def with_law(self, problem: FlowProblem, material: Material) -> CompiledFlow:
        """The same mesh and load under other laws.

        Parameters
        ----------
        problem, material : FlowProblem, Material
            Laws of creep and ground.
        """
        law, kept = _describe_law(problem, material, self.mesh.weights.shape)
        mesh, _, rules = self.given
        return replace(self, given=(mesh, law, rules), kept=(*self.kept, *kept))

    def advance(
        self,
        stress: Floats,
        base_shear: Floats | None,
        contact: Contact,
        before: Floats | None = None,
        *,
        keeps: bool = False,
    ) -> Advanced:
        """One step from stresses: Newton's (N10), or a correction (N17).

        Parameters
        ----------
        stress : ndarray, shape (n_triangles, n_points, 3)
            To start from [rho g d].
        base_shear : ndarray, shape (n_edges, n_points), or None
            To start from, where the ground slides [rho g d].
        contact : Contact
            Under which the step is taken.
        before : ndarray, shape (n_dofs,), optional
            Reactions before it [rho g d^2]; without them nothing is compared.
        keeps : bool
            The stresses are kept and corrected; the unknowns are then the correction.

        Raises
        ------
        SingularError
            If nothing holds the snow.
        """
        room = _make_room(self.mesh.n_dofs, stress, base_shear, contact)
        self._call(stress, base_shear, contact, before, room.places, keeps)
        return room.read(contact, is_compared=before is not None)

    def respond(
        self,
        stress: Floats,
        base_shear: Floats | None,
        contact: Contact,
        free: Mask,
        shares: Floats | None,
    ) -> tuple[Floats, Floats]:
        """Forces at the net's nodes where its normal velocity is prescribed.

        Parameters
        ----------
        stress : ndarray, shape (n_triangles, n_points, 3)
            About which the flow is linearised [rho g d].
        base_shear : ndarray, shape (n_edges, n_points), or None
            Where the ground slides [rho g d].
        contact : Contact
            It does not change.
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
        self._call(stress, base_shear, contact, None, (*(0,) * 9, locate(root)), False)
        places = np.column_stack([2 * net, 2 * net + 1]).ravel()
        held = np.flatnonzero(~contact.is_open)
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

    def _call(
        self,
        stress: Floats,
        base_shear: Floats | None,
        contact: Contact,
        before: Floats | None,
        results: tuple[int, ...],
        keeps: bool,
    ) -> None:
        mesh = self.mesh
        stress = to_floats(stress, (*mesh.weights.shape, 3))
        shear = None
        if base_shear is not None:
            shear = to_floats(base_shear, mesh.base.weights.shape)
        if before is not None:
            before = to_floats(before, (mesh.n_dofs,))
        template = mesh.template
        held = _to_arrays(contact, template.net.size - 1, template.ground.size - 1)
        given = (stress, shear, before, *held)
        step = StepArgument(*locate_all(*given), *results)
        code = self.library.nd_step(
            *map(ctypes.byref, (*self.given, step)),
            ctypes.c_void_p(locate(self.plan)),
            int(keeps),
        )
        if code == SINGULAR:
            raise SingularError("singular")
        require_sound(code)


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


def _describe_law(
    problem: FlowProblem, material: Material, shape: tuple[int, ...]
) -> tuple[LawArgument, tuple[Floats, Floats]]:
    """Laws as the core takes them, and their arrays: one number, or of the shape."""
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


def _describe_rules(problem: FlowProblem, lifts: Mask) -> RulesArgument:
    return RulesArgument(
        problem.friction,
        problem.net_contact == "one-sided",
        problem.ground_contact == "one-sided",
        problem.ground == "no-slip",
        locate(lifts),
    )


def can_compile(problem: FlowProblem) -> bool:
    """There is a core, and it has the problem's element."""
    return find_core() is not None and problem.element == "velocity"


def prepare_flow(
    problem: FlowProblem, material: Material, mesh: PlacedMesh, load: Floats
) -> CompiledFlow | None:
    """The core on a mesh; None where there is none.

    Parameters
    ----------
    problem, material : FlowProblem, Material
        Creep, ground and friction.
    mesh : PlacedMesh
        Mesh against the net's curve.
    load : ndarray, shape (n_dofs,)
        Of gravity, node axes [rho g d^2].
    """
    library = find_core()
    if library is None:
        return None
    template, base = mesh.template, mesh.base
    numbers, lifts = number_template(template), _may_lift(template)
    arrays = (mesh.gradients, mesh.weights, mesh.axes, base.weights, base.shape, load)
    kept = tuple(np.ascontiguousarray(one, dtype=np.float64) for one in arrays)
    argument = MeshArgument(
        *(mesh.nodes.shape[1], template.triangles.shape[1]),
        *(template.net.size, len(numbers.edges)),
        *locate_all(*numbers, *kept),
    )
    law, more = _describe_law(problem, material, mesh.weights.shape)
    return CompiledFlow(
        library=library,
        mesh=mesh,
        given=(argument, law, _describe_rules(problem, lifts)),
        plan=plan_template(library, template),
        kept=(*numbers, lifts, *kept, *more),  # C has their addresses
    )


@lru_cache(maxsize=256)
def _may_lift(template: MeshTemplate) -> Mask:
    return np.ascontiguousarray(may_lift(template))
