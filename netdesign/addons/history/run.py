"""A whole history on one mesh, and the solution in SI units that histories make."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from netdesign.addons.history.instant import Instant
from netdesign.addons.history.moments import (
    NO_PLATEAU,
    History,
    HistoryPoint,
    Plateau,
    select_counted,
)
from netdesign.addons.history.net_pulls import compute_node_forces
from netdesign.addons.history.settings import Start
from netdesign.addons.history.state import TransientProblem, TransientState
from netdesign.coupling.balance import check_balance, negative_share
from netdesign.coupling.interface import Estimate
from netdesign.coupling.scene import Scene
from netdesign.coupling.solution import Balance, Cost, EndPull, Method, Solution
from netdesign.numerics.arrays import Floats, Mask
from netdesign.snow.creep_law import DENSEST_SNOW
from netdesign.words.message import Message


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Run:
    """A history on one mesh, dimensionless: whole, or as far as it has come.

    Attributes
    ----------
    problem : TransientProblem
        Scene.
    start : str
        ``steady``, ``sagged`` or ``straight``.
    state : TransientState
        At the end.
    instant : Instant or None
        At the end; None before the first step.
    moments : tuple of HistoryPoint
        After every step.
    ways : ndarray, shape (n,), or float
        Ways of the net's vertices [thickness]; 0 before the first step.
    fallen_mass : float
        Of the snow that fell over the head [mean density times d^2].
    plateau : Plateau
        Whether it came to rest.
    ended : Message or None
        Why the run ended before its horizon; None if it did not.
    linear_solves, rejected : int
        Solves taken; steps that were repeated.
    """

    problem: TransientProblem
    start: Start
    state: TransientState
    instant: Instant | None = None
    moments: tuple[HistoryPoint, ...] = ()
    ways: Floats | float = 0.0
    fallen_mass: float = 0.0
    plateau: Plateau = NO_PLATEAU
    ended: Message | None = None
    linear_solves: int = 0
    rejected: int = 0

    @property
    def counted(self) -> Sequence[HistoryPoint]:
        """Moments whose pulls are those of the scene's snow on its net."""
        is_guessed = self.start != "steady"
        return select_counted(self.moments, self.plateau, is_guessed=is_guessed)

    @property
    def fallen(self) -> float:
        """Share of the snow's mass that fell over the head."""
        return self.fallen_mass / (float(self.state.body.mass.sum()) + self.fallen_mass)

    @property
    def end(self) -> Instant:
        """Equilibrium at the end of the last step."""
        assert self.instant is not None
        return self.instant

    def follow(
        self, instant: Instant, state: TransientState, fallen: float, step: float
    ) -> Run:
        """Run with one step more.

        Parameters
        ----------
        instant : Instant
            Equilibrium at the step's end.
        state : TransientState
            After the step.
        fallen : float
            Mass that fell over the head in it [mean density times d^2].
        step : float
            Duration [time scale].
        """
        net = state.body.topology.net
        axes = _net_normals(state.body.vertices[:, net])
        across = np.abs((instant.velocity[:, net] * axes).sum(axis=0))
        ways = self.ways + across * step
        tensions = instant.response.tensions
        ends = np.hypot(*np.array([instant.foot_pull, instant.head_pull]).T)
        strain = self.moments[-1].strain if self.moments else 0.0
        density = self.problem.settling.mean_density * float(state.body.density.max())
        moment = HistoryPoint(
            time=state.time,
            foot=instant.foot_pull,
            head=instant.head_pull,
            tension_min=float(min(tensions.min(), *ends)),
            tension_max=float(max(tensions.max(), *ends)),
            on_net=instant.on_net,
            max_relative_density=min(density, DENSEST_SNOW),
            way=float(ways.max()),
            speed=float(across.max()),
            strain=strain + instant.creep_rate * step,
            residual=instant.residual,
        )
        return replace(
            self,
            state=state,
            instant=instant,
            moments=(*self.moments, moment),
            ways=ways,
            fallen_mass=self.fallen_mass + fallen,
            linear_solves=self.linear_solves + instant.linear_solves,
        )


def measure_run(run: Run) -> list[Floats]:
    """Largest pulls that count.

    Parameters
    ----------
    run : Run
        On one mesh.

    Returns
    -------
    list of ndarray, shape (2,)
        On foot and head [rho g d^2].
    """
    pulls = zip(*((moment.foot, moment.head) for moment in run.counted), strict=True)
    return [max(of_end, key=lambda pull: float(np.hypot(*pull))) for of_end in pulls]


def _net_normals(points: Floats) -> Floats:
    """Unit normals of a polygon at its points (2, n)."""
    along = np.gradient(points, axis=1)
    return np.asarray(np.array([along[1], -along[0]]) / np.hypot(*along))


def scale_history(run: Run, scene: Scene) -> History:
    """History of a run in SI units.

    Parameters
    ----------
    run : Run
        Dimensionless.
    scene : Scene
        Its scales.
    """
    return History(
        moments=tuple(_scale_moment(moment, scene) for moment in run.moments),
        plateau=run.plateau,
        start=run.start,
        densifies=run.problem.settling.densifies,
        fallen_share=run.fallen,
        ended=run.ended,
    )


def build_solution(
    scene: Scene,
    runs: Sequence[Run],
    pulls: Sequence[Estimate],
    method: Method,
    balance_tolerance: float,
    friction_tolerance: float | None = None,
) -> Solution:
    """Solution whose shapes are those at the end of the finest run.

    Parameters
    ----------
    scene : Scene
        What was solved.
    runs : sequence of Run
        Of all meshes; the finest is the last.
    pulls : sequence of Estimate
        Largest on foot and head, with their errors [rho g d^2].
    method : str
        ``transient`` or ``staggered``.
    balance_tolerance : float
        Largest force missing over the weight [-].
    friction_tolerance : float, optional
        Shear beyond the friction limit over the weight [-]; default is the former.

    Raises
    ------
    SolveError
        If a balance is not met.
    """
    run = runs[-1]
    foot, head = (EndPull.of_estimate(pull, scene.force_scale) for pull in pulls)
    thickness, body = scene.snowpack.thickness, run.state.body
    template = body.topology.template
    vertices = body.vertices
    nodes = np.concatenate([vertices, vertices[:, template.edges].mean(axis=1)], axis=1)
    points = run.end.points
    along = run.problem.head / np.hypot(*run.problem.head)
    balance = _measure_balance(run, scene)
    check_balance(balance, balance_tolerance, friction_tolerance=friction_tolerance)
    return Solution(
        scene=scene,
        method=method,
        foot=foot,
        head=head,
        tension_min=min(moment.tension_min for moment in run.counted)
        * scene.force_scale,
        tension_max=max(moment.tension_max for moment in run.counted)
        * scene.force_scale,
        sag=float((along[1] * points[0] - along[0] * points[1]).max()) * thickness,
        net_curve=points * thickness,
        net_forces=_list_forces(run) * scene.force_scale,
        net_slides=_find_slides(run),
        mesh_nodes=nodes * thickness,
        mesh_triangles=body.topology.triangles.T,
        mesh_density=body.density * scene.snowpack.density,
        mesh_velocity=run.end.velocity * scene.velocity_scale,
        balance=balance,
        cost=Cost(
            linear_solves=sum(part.linear_solves for part in runs),
            rounds=sum(len(part.moments) + part.rejected for part in runs),
            elements=template.triangles.shape[1],
            degrees_of_freedom=2 * template.nodes.shape[1],
        ),
        history=scale_history(run, scene),
    )


def _list_forces(run: Run) -> Floats:
    """Forces of the snow on the net's nodes, shape (2, n), foot to head."""
    on_net = run.end.on_net
    corner = -on_net.sum(axis=1)
    corner += run.end.foot_pull + run.end.head_pull
    return np.column_stack([corner, on_net])


def _find_slides(run: Run) -> Mask:
    """Net nodes at which the snow slips, foot to head."""
    signs = run.end.response.slide_signs
    slides = np.append(False, signs != 0)
    if run.end.on_net.shape[1] > signs.size:
        slides = np.append(slides, True)  # a corner held at the head slips freely
    return slides


def _scale_moment(moment: HistoryPoint, scene: Scene) -> HistoryPoint:
    force, thickness = scene.force_scale, scene.snowpack.thickness
    return replace(
        moment,
        time=moment.time * scene.time_scale,
        foot=moment.foot * force,
        head=moment.head * force,
        tension_min=moment.tension_min * force,
        tension_max=moment.tension_max * force,
        on_net=moment.on_net * force,
        way=moment.way * thickness,
        speed=moment.speed * scene.velocity_scale,
    )


def _measure_balance(run: Run, scene: Scene) -> Balance:
    weight = float(run.state.body.mass.sum())
    tensions = run.end.response.tensions
    normal, tangential = compute_node_forces(run.end.points, tensions)
    friction = run.problem.snow.friction
    excess = np.abs(tangential) - friction * np.maximum(normal, 0.0)
    size = weight * float(np.hypot(*run.problem.snow.gravity))
    return Balance(
        weight_along_slope=weight * run.problem.snow.gravity[0] * scene.force_scale,
        relative_residual=max(moment.residual for moment in run.moments),
        friction_excess=max(0.0, float(excess.max())) / size,
        smallest_tension=float(tensions.min()) * scene.force_scale,
        suction_share=negative_share(normal),
        ground_tension_share=negative_share(run.end.ground_normal),
    )
