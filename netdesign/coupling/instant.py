"""One step of snow that pushes the net along: equilibrium at the step's end.

The net's forces are taken where the step ends, so the step may be as long as
accuracy allows. Theory: coupling/THEORY.md, section 6. Dimensionless as in
``steady``; times in d over the velocity scale.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from netdesign.cable.response import NetResponse, hold_net, respond
from netdesign.cable.yielding import NetGuess, YieldingNodes, settle_net
from netdesign.errors import SolveError
from netdesign.outcome import Outcome
from netdesign.snow.body import SnowBody
from netdesign.snow.kernel import (
    PlacedMesh,
    assemble_base_force,
    assemble_stress,
    build_base_stiffness,
    build_stiffness,
    compute_base_velocity,
    compute_strain,
    gather,
    reference_element,
)
from netdesign.snow.law import (
    FlowLaw,
    Material,
    Tangent,
    advance_stress,
    hold_stress,
    linearise_creep,
    linearise_sliding,
    squared_size,
    total_stress,
)
from netdesign.snow.linear import (
    Blocks,
    SingularError,
    build_ordering,
    solve_blocks,
)
from netdesign.snow.settling import Settling, build_material
from netdesign.snow.straight_mesh import (
    build_straight_mesh,
    fold_load,
    unfold_velocity,
)

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Mask = NDArray[np.bool_]
Signs = NDArray[np.int8]

# The snow's upper corner: held at the net's head, slipping over it, or a node of the
# net below it.
Top = Literal["held", "slipping", "on-net"]

_SLOW = 0.9  # an iteration that changes this much of the last change is damped
_FAST = 0.2  # less than this ends the damping
_LEAST_PART = 0.1
_ROUNDING_SHARE = 5.0  # residual with rounding over what is asked of the net's forces
_FREE_ITERATIONS = 4


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TransientProblem:
    """What stays the same while the snow moves, dimensionless."""

    law: FlowLaw
    settling: Settling
    head: Floats
    length: float  # unstressed, of the whole net
    stiffness: float
    base_drag: float = 0.0  # shear stress on the ground over its velocity


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TransientState:
    """Snow and net at one time.

    Attributes
    ----------
    time : float
        Creep time since the start.
    body : SnowBody
        The snow.
    lengths : ndarray, shape (n_segments,)
        Unstressed lengths of the net between its nodes.
    top : str
        What the snow's upper corner does.
    velocity : ndarray, shape (2, n_nodes)
        Of the last step.
    moved : ndarray, shape (2, n_vertices)
        Displacement in the last step.
    step : float
        Its duration; 0 before the first.
    stress, base_shear : ndarray or None
        Of the last step; None before the first.
    """

    time: float
    body: SnowBody
    lengths: Floats
    top: Top
    velocity: Floats
    moved: Floats
    step: float = 0.0
    stress: Floats | None = None
    base_shear: Floats | None = None
    glide: Signs | None = None

    def hold_net(self, problem):
        nodes = self.body.vertices[:, self.carried]
        points = np.column_stack([np.zeros(2), nodes, problem.head])
        return hold_net(points, self.lengths, problem.stiffness)

    @property
    def carried(self) -> Ints:
        """Vertices that are nodes of the net, foot and a held top left out."""
        net = self.body.topology.net
        return net[1:] if self.top == "on-net" else net[1:-1]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Instant:
    """Equilibrium at the end of a step.

    Attributes
    ----------
    displaced : ndarray, shape (2, n_vertices)
        Where the vertices end.
    velocity, stress, base_shear
        As in ``TransientState``.
    points : ndarray, shape (2, n + 2)
        Foot, net nodes and head.
    response : NetResponse
        Forces and unstressed lengths of the net there.
    foot_pull, head_pull : ndarray, shape (2,)
        What net and snow pull with on the net's ends.
    on_net : ndarray, shape (2, n_net_vertices - 1)
        Forces of the snow on the net's vertices above the foot.
    ground_normal : ndarray, shape (n_ground - 1,)
        Downward nodal forces on the ground, without the node at the foot.
    creep_rate : float
        Mean size of the strain rate, S^n of eq. (F3), over the body.
    residual : float
        Force missing from the balance of any free node and of all, over the weight.
    linear_solves : int
        Taken by this step.
    """

    displaced: Floats
    velocity: Floats
    stress: Floats
    base_shear: Floats | None
    points: Floats
    response: NetResponse
    foot_pull: Floats
    head_pull: Floats
    on_net: Floats
    ground_normal: Floats
    creep_rate: float
    residual: float
    linear_solves: int
    top_slips: bool = False


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Motion:
    """Displacement of a step as a function of its end velocity: offset + rate v."""

    offset: Floats  # (2, n_vertices)
    rate: float
    guess: Floats  # (2, n_vertices), where equilibrium is assembled

    @classmethod
    def of_step(cls, state: TransientState, step: float) -> _Motion:
        """Second order from two steps (BDF2), first order for the first one."""
        if state.step == 0.0:
            still = np.zeros_like(state.moved)
            return cls(offset=still, rate=step, guess=still)
        growth = step / state.step
        return cls(
            offset=growth**2 / (1.0 + 2.0 * growth) * state.moved,
            rate=(1.0 + growth) / (1.0 + 2.0 * growth) * step,
            guess=growth * state.moved,
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Assembly:
    """The step's equations, but for stress and net."""

    problem: TransientProblem
    mesh: PlacedMesh
    material: Material
    weight: Floats  # nodal forces (n_dofs,)
    free: Mask
    net_dofs: Ints
    top_slips: bool
    motion: _Motion
    points: Floats  # foot, net nodes moved by the offset, head
    lengths: Floats

    def with_top(self, slips):
        free = self.free.copy()
        free[2 * int(self.mesh.template.net[-1]) + 1] = slips
        return replace(self, free=free, top_slips=slips)

    def net_at(self, unknowns: Floats, bulge: Floats | None = None) -> NetResponse:
        """The net where the unknowns carry it."""
        return respond(
            self.points_at(unknowns, bulge),
            self.lengths,
            friction=self.problem.law.friction,
            stiffness=self.problem.stiffness,
        )

    def points_at(self, unknowns: Floats, bulge: Floats | None = None) -> Floats:
        points = self.points.copy()
        points[:, 1:-1] += self.motion.rate * unknowns[self.net_dofs].reshape(-1, 2).T
        if bulge is not None:
            points[:, 1:-1] += bulge
        return points


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Target:
    """Result of a Newton iteration."""

    unknowns: Floats
    stress: Floats
    base_shear: Floats | None
    response: NetResponse
    guess: NetGuess


class _Linear(NamedTuple):
    law: FlowLaw
    tangent: Tangent
    strain: Floats
    base: Tangent | None
    base_shear: Floats | None
    blocks: list
    force: Floats


DEBUG = False
MOST_TOP = 3


def advance(
    problem: TransientProblem,
    state: TransientState,
    step: float,
    *,
    tolerance: float,
    balance_tolerance: float,
    max_iterations: int,
    bulge: Floats | None = None,
) -> Instant:
    """Solve one step.

    Parameters
    ----------
    problem, state : TransientProblem, TransientState
        Scene and start of the step.
    step : float
        Duration [time scale].
    tolerance : float
        Largest relative change of the stress in the last iteration [-].
    balance_tolerance : float
        Largest missing force over the weight [-].
    max_iterations : int
        Newton iterations allowed.
    bulge : ndarray, shape (2, n), optional
        Added to the net's nodes in the first iteration only: gives a straight net
        the stiffness across itself that it has once it is loaded.

    Returns
    -------
    Instant

    Raises
    ------
    SolveError
        If the step does not converge; a shorter one may.
    """
    assembly = _assemble(problem, state, step)
    stress, base_shear = state.stress, state.base_shear
    unknowns = np.where(assembly.free, assembly.mesh.to_node_axes(state.velocity), 0.0)
    net = state.hold_net(problem)
    forces = net.forces
    glide = _match_glide(state)
    guess = NetGuess(place=assembly.points_at(unknowns, bulge)[:, 1:-1], slides=np.zeros(glide.size), glide=glide)
    changes = 0
    for iteration in range(1, max_iterations + 1):
        target = _iterate(assembly, unknowns, stress, base_shear, forces, guess, 1e-9)
        change = _relative_change(assembly, stress, target.stress)
        if not np.isfinite(change):
            raise SolveError(Outcome.NONFINITE, "the snow's stress is not finite")
        unknowns, stress = target.unknowns, target.stress
        base_shear, response = target.base_shear, target.response
        forces, guess, glide = response.forces, target.guess, target.guess.glide
        top_slips = _top_slips(assembly, target)
        if top_slips != assembly.top_slips and changes < MOST_TOP:
            changes += 1
            assembly = assembly.with_top(top_slips)
            unknowns = np.where(assembly.free, unknowns, 0.0)
            continue
        if DEBUG: print("      ", iteration, f"{change:.2e}", "".join(".+-"[k] for k in glide))
        if 10.0 * change**2 < tolerance:
            instant = _finish(
                assembly, state, unknowns, stress, base_shear, response, iteration
            )
            if instant.residual < _ROUNDING_SHARE * balance_tolerance:
                return instant
    raise SolveError(Outcome.MAX_ITERATIONS, "a step of snow and net")


def _top_slips(assembly, target):
    """Whether the snow slips up over the net's head."""
    top = 2 * int(assembly.mesh.template.net[-1])
    if assembly.free[top]:
        return False
    if assembly.top_slips:
        return bool(target.unknowns[top + 1] > 0.0)
    law = assembly.problem.law
    support = assembly.weight - assemble_stress(assembly.mesh, total_stress(law, target.stress))
    return bool(support[top + 1] > law.friction * max(support[top], 0.0))


def _match_glide(state):
    count = state.carried.size
    glide = np.zeros(count, dtype=np.int8)
    if state.glide is not None:
        n = min(count, state.glide.size)
        glide[:n] = state.glide[:n]
    return glide


def advance_under(
    problem: TransientProblem,
    state: TransientState,
    step: float,
    response: NetResponse,
    *,
    tolerance: float,
    max_iterations: int,
) -> Instant:
    """Solve one step of snow under net forces that do not change in it.

    ``response`` is the net at the step's start, its stiffness zero; the rest is as in
    ``advance``. Only a base drag keeps such a step from being singular on a ground
    where the snow glides freely.
    """
    assembly = _assemble(problem, replace(state, step=0.0), step)
    unknowns = np.where(assembly.free, assembly.mesh.to_node_axes(state.velocity), 0.0)
    stress, base_shear = state.stress, state.base_shear
    for iteration in range(1, max_iterations + 1):
        linear = _linearise(assembly, unknowns, stress, base_shear)
        linear.force[assembly.net_dofs] -= response.forces.T.ravel()
        change_ = _solve(assembly, linear.blocks, linear.force)
        target = _follow_snow(assembly, linear, unknowns, change_, response, None)
        change = _relative_change(assembly, stress, target.stress)
        unknowns, stress = target.unknowns, target.stress
        base_shear = target.base_shear
        if not np.isfinite(change):
            raise SolveError(Outcome.NONFINITE, "the snow's stress is not finite")
        if change < tolerance:
            return _finish(
                assembly, state, unknowns, stress, base_shear, response, iteration
            )
    raise SolveError(Outcome.MAX_ITERATIONS, "a step of snow under the net's forces")


def _assemble(
    problem: TransientProblem, state: TransientState, step: float
) -> _Assembly:
    body, law = state.body, problem.law
    motion = _Motion.of_step(state, step)
    vertices = body.vertices + motion.guess
    template = body.topology.template
    top_axis = None
    if state.top != "on-net":
        last = problem.head - vertices[:, body.topology.net[-2]]
        top_axis = np.array([last[1], -last[0]]) / np.hypot(*last)
    mesh = build_straight_mesh(template, vertices, law.element, top_axis)
    if not mesh.is_valid:
        raise SolveError(Outcome.OUT_OF_VALIDITY, "the snow's mesh folds over")
    moved = replace(body, vertices=vertices)
    points = np.zeros((2, state.carried.size + 2))
    points[:, 1:-1] = (body.vertices + motion.offset)[:, state.carried]
    points[:, -1] = problem.head
    return _Assembly(
        problem=problem,
        mesh=mesh,
        material=build_material(problem.settling, law, moved),
        weight=_nodal_weight(problem, mesh, body),
        free=_free_places(problem, mesh, state),
        net_dofs=np.stack([2 * state.carried, 2 * state.carried + 1], axis=1).ravel(),
        top_slips=state.top == "slipping",
        motion=motion,
        points=points,
        lengths=state.lengths,
    )


def _nodal_weight(
    problem: TransientProblem, mesh: PlacedMesh, body: SnowBody
) -> Floats:
    """Weight of the mass that each triangle has kept."""
    shape, _, point_weights = reference_element()
    shares = 2.0 * point_weights @ shape
    template = mesh.template
    nodal = gather(
        template.triangles.T, np.outer(body.mass, shares), mesh.nodes.shape[1]
    )
    loads = np.outer(problem.law.gravity, fold_load(template, nodal))
    return mesh.to_node_axes(loads)


def _free_places(
    problem: TransientProblem, mesh: PlacedMesh, state: TransientState
) -> Mask:
    template = mesh.template
    free = np.ones(mesh.n_dofs, dtype=bool)
    midpoints, ground = template.net[1::2], template.ground
    free[2 * midpoints] = free[2 * midpoints + 1] = False
    free[2 * ground + 1] = False
    free[2 * ground[0]] = False
    if problem.law.ground == "no-slip":
        free[2 * ground] = False
    if state.top != "on-net":
        free[2 * template.net[-1]] = False
        free[2 * template.net[-1] + 1] = state.top == "slipping"
    return free


def _iterate(
    assembly: _Assembly,
    unknowns: Floats,
    stress: Floats | None,
    base_shear: Floats | None,
    forces: Floats,
    guess: NetGuess,
    balance_tolerance: float,
) -> _Target:
    """Newton iteration of the snow; the net is solved exactly on its linear answer."""
    linear = _linearise(assembly, unknowns, stress, base_shear)
    dofs, rate = assembly.net_dofs, assembly.motion.rate
    right = np.zeros((assembly.mesh.n_dofs, 1 + dofs.size))
    right[:, 0] = linear.force
    right[dofs, 0] -= forces.T.ravel()
    right[dofs, 1 + np.arange(dofs.size)] = -1.0
    answers = _solve(assembly, linear.blocks, right)
    nodes = YieldingNodes(
        positions=assembly.points[:, 1:-1]
        + rate * (unknowns[dofs] + answers[dofs, 0]).reshape(-1, 2).T,
        forces=forces,
        compliance=rate * answers[dofs, 1:],
    )
    problem = assembly.problem
    response, guess = settle_net(
        nodes,
        guess,
        problem.head,
        assembly.lengths,
        friction=problem.law.friction,
        stiffness=problem.stiffness,
        tolerance=balance_tolerance,
    )
    more = (response.forces - forces).T.ravel()
    change = answers[:, 0] + answers[:, 1:] @ more
    return _follow_snow(assembly, linear, unknowns, change, response, guess)


def _follow_snow(assembly, linear, unknowns, change, response, guess):
    mesh = assembly.mesh
    base_shear = None
    if linear.base is not None:
        base_shear = linear.base_shear + linear.base.modulus * compute_base_velocity(mesh, change)
    return _Target(
        unknowns=unknowns + change,
        stress=advance_stress(linear.law, linear.tangent, linear.strain, compute_strain(mesh, change)),
        base_shear=base_shear,
        response=response,
        guess=guess,
    )


def _linearise(assembly, unknowns, stress, base_shear):
    mesh, law = assembly.mesh, assembly.problem.law
    if stress is None:  # the first iterate is linear creep
        law = replace(law, exponent=1.0)
        stress = np.zeros((*mesh.weights.shape, mesh.operator.shape[2]))
    tangent = linearise_creep(law, assembly.material, stress)
    strain = compute_strain(mesh, unknowns)
    blocks = [build_stiffness(mesh, tangent.modulus)]
    force = assemble_stress(mesh, hold_stress(tangent, strain)) - assembly.weight
    base, shear = None, None
    if law.ground == "sliding":
        shear = np.zeros_like(mesh.base.weights) if base_shear is None else base_shear
        base = linearise_sliding(law, shear)
    elif assembly.problem.base_drag > 0.0:
        drag = np.full_like(mesh.base.weights, assembly.problem.base_drag)
        base = Tangent(modulus=drag, kept=np.zeros_like(drag))
    if base is not None:
        shear = base.kept + base.modulus * compute_base_velocity(mesh, unknowns)
        blocks.append(build_base_stiffness(mesh, base.modulus))
        force += assemble_base_force(mesh, shear)
    return _Linear(law, tangent, strain, base, shear, blocks, force)


def _solve(assembly: _Assembly, blocks: Sequence[Blocks], force: Floats) -> Floats:
    mesh, law = assembly.mesh, assembly.problem.law
    friction = None
    if assembly.top_slips and law.friction > 0.0:
        # over the head the snow slips up, with friction against it (F6)
        friction = np.zeros(mesh.n_dofs)
        friction[2 * int(mesh.template.net[-1]) + 1] = -law.friction
    is_mixed = law.element == "mixed"
    ordering = build_ordering(mesh.template, has_pressures=is_mixed, couples_net=False)
    try:
        return solve_blocks(
            ordering, blocks, force, assembly.free, friction, is_definite=not is_mixed
        )
    except SingularError:
        raise SolveError(
            Outcome.NONFINITE, "nothing holds the snow: a singular step"
        ) from None


def _relative_change(assembly: _Assembly, old: Floats | None, new: Floats) -> float:
    if old is None:
        return 1.0
    law, material, weights = (
        assembly.problem.law,
        assembly.material,
        assembly.mesh.weights,
    )
    change = (weights * squared_size(law, material, new - old)).sum()
    return float(np.sqrt(change / (weights * squared_size(law, material, new)).sum()))


def _weight_of(assembly: _Assembly) -> float:
    return float(np.hypot(*assembly.mesh.to_slope_axes(assembly.weight).sum(axis=1)))


def _finish(
    assembly: _Assembly,
    state: TransientState,
    unknowns: Floats,
    stress: Floats,
    base_shear: Floats | None,
    response: NetResponse,
    iterations: int,
) -> Instant:
    mesh, topology = assembly.mesh, state.body.topology
    residual = assemble_stress(mesh, total_stress(assembly.problem.law, stress))
    residual -= assembly.weight
    if base_shear is not None:
        residual += assemble_base_force(mesh, base_shear)
    residual[assembly.net_dofs] -= response.forces.T.ravel()
    supports = -mesh.to_slope_axes(residual)
    corner = _share_corner(assembly, supports[:, topology.ground[0]], response)
    head_pull = response.head_pull.copy()
    on_net = -response.forces
    if state.top != "on-net":
        held = supports[:, topology.net[-1]]
        head_pull += held
        on_net = np.column_stack([on_net, held])
    foot_pull = response.foot_pull + corner
    velocity = unfold_velocity(mesh.template, mesh.to_slope_axes(unknowns))
    moved = (
        assembly.motion.offset
        + assembly.motion.rate * (velocity[:, : mesh.template.n_vertices])
    )
    free = assembly.free.copy()
    free[mesh.n_velocities :] = False
    if assembly.top_slips:
        free[2 * int(mesh.template.net[-1]) + 1] = False
    weight = _weight_of(assembly)
    return Instant(
        displaced=state.body.vertices + moved,
        velocity=velocity,
        stress=stress,
        base_shear=base_shear,
        points=assembly.points_at(unknowns),
        response=response,
        foot_pull=foot_pull,
        head_pull=head_pull,
        on_net=on_net,
        ground_normal=-supports[1, mesh.template.ground[1:]],
        creep_rate=_mean_creep_rate(assembly, stress),
        residual=float(np.linalg.norm(residual[free])) / weight,
        linear_solves=iterations,
        top_slips=assembly.top_slips,
    )


def _mean_creep_rate(assembly: _Assembly, stress: Floats) -> float:
    law, material = assembly.problem.law, assembly.material
    weights = assembly.mesh.weights
    rate = material.fluidity * squared_size(law, material, stress) ** (
        law.exponent / 2.0
    )
    return float((weights * rate).sum() / weights.sum())


def _share_corner(assembly: _Assembly, corner: Floats, response: NetResponse) -> Floats:
    """The net's part of the force on the corner that net and ground hold together.

    As in ``interface``: along a ground without reactions at nodes all of its X-force
    is the net's; the rest follows from the node above, as under a uniform traction.
    """
    points = assembly.points
    first, second = np.hypot(*np.diff(points[:, :3]))
    share = -response.forces[:, 0] * first / (first + second)
    if assembly.problem.law.ground != "no-slip":
        share[0] = corner[0]
    return np.asarray(share)
