"""From cases to member forces; no failed case is ever lost."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

from netdesign.checks.result import Band
from netdesign.coupling.scene import Scene
from netdesign.envelope.grid import Case
from netdesign.envelope.runner import Runner
from netdesign.envelope.state import CaseEnd, SolvedState
from netdesign.envelope.workers import Job
from netdesign.errors import ModelError
from netdesign.fault import SENTENCE, Fault, catch_fault
from netdesign.outcome import Outcome
from netdesign.solving.describe import describe_case
from netdesign.solving.solve import Settings
from netdesign.structure.anchors import AnchorForces, compute_anchor_forces
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import SupportLayout, SupportPoints, place_support
from netdesign.words.message import Message


@dataclass(frozen=True, slots=True, kw_only=True)
class CaseTask:
    """Everything that a worker needs for one case.

    ``scene`` is None where the model refuses the case; ``refusal`` says why. Without
    a ``layout`` the net's own tensions are followed, per metre of width. The kind of
    settings chooses steady state or history.
    """

    case: Case
    scene: Scene | None
    refusal: Message | None
    layout: SupportLayout | None
    settings: Settings


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CaseResult:
    """End of one case; forces exist only if the outcome is converged.

    Attributes
    ----------
    case : Case
        Point of the ranges.
    outcome : Outcome
        How it ended.
    reason : str
        Why it failed; "" if converged.
    member_forces : dict of str to Band
        Characteristic force of each member with its numerical band [N per anchor, or
        N/m without a layout].
    anchors : AnchorForces or None
        Force vectors on the ground.
    solution : SolvedState or None
        State of snow and net.
    fault : Fault or None
        What failed in the program, where it was the program.
    compared : Compared or None
        The steady state and the history of a case that was followed in time.
    """

    case: Case
    outcome: Outcome
    reason: Message | None = None
    member_forces: dict[str, Band]
    anchors: AnchorForces | None = None
    solution: SolvedState | None = None
    fault: Fault | None = None
    compared: Compared | None = None

    @property
    def is_converged(self) -> bool:
        """Its numbers may be used."""
        return self.outcome is Outcome.CONVERGED


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Compared:
    """A case at rest and followed in time, both converged."""

    steady: CaseResult
    history: CaseResult

    def exceeds(self, member: str) -> bool:
        """The history's force is larger by more than both state as their errors."""
        history = self.history.member_forces[member]
        return history.low > self.steady.member_forces[member].high


def run_cases(
    tasks: Sequence[CaseTask], runner: Runner | None = None
) -> list[CaseResult]:
    """Solve all tasks; results in the order of the tasks, whatever the workers did.

    Parameters
    ----------
    tasks : sequence of CaseTask
        Cases to solve.
    runner : Runner, optional
        Where they are solved and kept; this process unless told otherwise.

    Returns
    -------
    list of CaseResult
        One for each task. A worker that died leaves a ``worker_failed`` result, a
        fault of the program a ``program_fault``.
    """
    jobs = [build_job(task) for task in tasks]
    ends = iter((runner or Runner()).solve([job for job in jobs if job is not None]))
    return [
        resolve_case(task, None if job is None else next(ends))
        for task, job in zip(tasks, jobs, strict=True)
    ]


def solve_case(task: CaseTask) -> CaseResult:
    """Solve one case here and resolve its support."""
    return run_cases([task])[0]


def build_job(task: CaseTask) -> Job | None:
    """What workers solve of a task; None where the model refused its scene."""
    if task.scene is None:
        return None
    return Job(scene=task.scene, settings=task.settings)


def resolve_case(task: CaseTask, end: CaseEnd | None) -> CaseResult:
    """Forces of a case from the end of its solve; failures stay outcomes."""
    if end is None or task.scene is None:
        return _failed(task, Outcome.OUT_OF_VALIDITY, task.refusal)
    if end.state is None:
        return replace(_failed(task, end.outcome, end.reason), fault=end.fault)
    if task.layout is None:
        return replace(_resolve_net(task, end.state), reason=end.reason)
    found = catch_fault(
        partial(_resolve_support, task, task.layout, end.state),
        describe_case(task.scene, task.settings),
    )
    if not isinstance(found, Fault):
        return replace(found, reason=found.reason or end.reason)
    return replace(_failed(task, Outcome.PROGRAM_FAULT, SENTENCE), fault=found)


def _resolve_net(task: CaseTask, state: SolvedState) -> CaseResult:
    """Tensions of the net per metre of width: nothing is known of its support."""
    foot, head = state.foot, state.head
    error = max(foot.error, head.error)
    sizes = (
        ("foot", foot.size, foot.error),
        ("head", head.size, head.error),
        ("rope", state.tension_max, error),
    )
    return CaseResult(
        case=task.case,
        outcome=Outcome.CONVERGED,
        member_forces={
            name: Band(low=max(0.0, size - error), value=size, high=size + error)
            for name, size, error in sizes
        },
        solution=state,
    )


def _resolve_support(
    task: CaseTask, layout: SupportLayout, solution: SolvedState
) -> CaseResult:
    points = place_support(layout, solution.head_point)
    width = layout.post_spacing
    anchors = _anchor_forces(points, width, solution)
    if isinstance(anchors, FailedSupport):
        return _failed(task, anchors.outcome, anchors.reason)
    bands = _force_bands(points, width, solution, anchors)
    if isinstance(bands, FailedSupport):
        return _failed(task, bands.outcome, bands.reason)
    return CaseResult(
        case=task.case,
        outcome=Outcome.CONVERGED,
        member_forces=bands,
        anchors=anchors,
        solution=solution,
    )


def _anchor_forces(
    points: SupportPoints,
    width: float,
    solution: SolvedState,
    shift: Sequence[float] = (0.0, 0.0, 0.0, 0.0),
) -> AnchorForces | FailedSupport:
    """Anchor forces with the end pulls moved by ``shift`` times their error.

    The four shares are for x and y of the foot's pull, x and y of the head's.
    """
    foot, head = solution.foot, solution.head
    return compute_anchor_forces(
        points,
        foot_pull_per_m=(
            foot.x + shift[0] * foot.error,
            foot.y + shift[1] * foot.error,
        ),
        head_pull_per_m=(
            head.x + shift[2] * head.error,
            head.y + shift[3] * head.error,
        ),
        post_spacing=width,
    )


def _force_bands(
    points: SupportPoints, width: float, solution: SolvedState, anchors: AnchorForces
) -> dict[str, Band] | FailedSupport:
    """Member forces with the band that the error of the end pulls can cause.

    Within one set of working members the forces are linear in the pulls, so moving
    each component by its error, and adding the changes, bounds them.
    """
    values = anchors.member_forces
    spread = dict.fromkeys(values, 0.0)
    for component in range(4):
        change = dict.fromkeys(values, 0.0)
        for share in (-1.0, 1.0):
            shift = [share if place == component else 0.0 for place in range(4)]
            moved = _anchor_forces(points, width, solution, shift)
            if isinstance(moved, FailedSupport):
                return moved
            for member, force in moved.member_forces.items():
                change[member] = max(change[member], abs(force - values[member]))
        for member in spread:
            spread[member] += change[member]
    return {
        member: Band(
            low=max(0.0, value - spread[member]),
            value=value,
            high=value + spread[member],
        )
        for member, value in values.items()
    }


def build_task(
    case: Case,
    build_scene: Callable[[Case], Scene],
    layout: SupportLayout | None,
    settings: Settings,
) -> CaseTask:
    """Task of a case; a scene that the model refuses becomes a named refusal."""
    scene: Scene | None = None
    refusal: Message | None = None
    try:
        scene = build_scene(case)
    except ModelError as error:
        refusal = error.message
    return CaseTask(
        case=case, scene=scene, refusal=refusal, layout=layout, settings=settings
    )


def _failed(task: CaseTask, outcome: Outcome, reason: Message | None) -> CaseResult:
    return CaseResult(case=task.case, outcome=outcome, reason=reason, member_forces={})
