"""Member forces of a case; a failed case is a result with its reason."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

from netdesign.cable.net import Net
from netdesign.checks.result import Band
from netdesign.coupling.scene import Scene
from netdesign.coupling.solution import FailedSolution
from netdesign.envelope.panel_forces import (
    PanelForces,
    cover,
    resolve_layouts,
    resolve_panels,
    resolve_pulls,
    spread_out,
)
from netdesign.envelope.ranges import Case
from netdesign.outcome import SENTENCE, Fault, ModelError, Outcome, catch_fault
from netdesign.panel.inputs import Panel
from netdesign.panel.solve import FailedPanel
from netdesign.solving.runner import Runner
from netdesign.solving.solve import CaseEnd, Settings, SolvedState, describe_case
from netdesign.solving.workers import Job
from netdesign.structure.anchors import AnchorForces, compute_anchor_forces
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import SupportLayout, SupportPoints, place_support
from netdesign.structure.members import NetPart
from netdesign.words.message import Message


@dataclass(frozen=True, slots=True, kw_only=True)
class CaseTask:
    """Everything that a worker needs for one case.

    ``job`` is None where the model refuses the case; ``refusal`` says why. Without
    a ``layout`` the net's own tensions are followed, per metre of width; with
    ``panels`` the largest forces of these, too; with ``other_layouts`` the largest on
    any of all layouts.
    """

    case: Case
    job: Job | None
    refusal: Message | None
    layout: SupportLayout | None
    panels: tuple[Panel, ...] = ()
    other_layouts: tuple[SupportLayout, ...] = ()


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
        N/m without a layout]; those by the panel between posts beside them. The largest
        of all layouts of the support.
    anchors : AnchorForces or None
        Force vectors on the ground, of the first layout.
    solution : SolvedState or None
        State of snow and net.
    fault : Fault or None
        What failed in the program, where it was the program.
    panel : PanelForces, FailedPanel or None
        The panel between posts, on the first layout, or why it has no forces in this
        case; None of a row without one.
    of_layouts : tuple of (SupportLayout, dict of str to Band)
        The members' forces on each of several layouts [N]; empty of a single one.
    """

    case: Case
    outcome: Outcome
    reason: Message | None = None
    member_forces: dict[str, Band]
    anchors: AnchorForces | None = None
    solution: SolvedState | None = None
    fault: Fault | None = None
    panel: PanelForces | FailedPanel | None = None
    of_layouts: tuple[tuple[SupportLayout, dict[str, Band]], ...] = ()

    @property
    def is_converged(self) -> bool:
        """Its numbers may be used."""
        return self.outcome is Outcome.CONVERGED

    @property
    def lack(self) -> Message | None:
        """Reason why it has no forces, or none by the panel between posts."""
        if self.is_converged and isinstance(self.panel, FailedPanel):
            return self.panel.reason
        return self.reason

    def at_layout(self, place: int) -> CaseResult:
        """The case with the members' forces on one of its layouts alone.

        What it brings to the ground stays that on the first layout; `stand` gives it.
        """
        if not self.of_layouts:
            return self
        _, forces = self.of_layouts[place]
        return replace(self, member_forces=forces, of_layouts=())

    def on_layout(self, layout: SupportLayout) -> CaseResult:
        """The same on another layout, between those that it has.

        Raises
        ------
        ValueError
            Where that cannot hold what they hold.
        """
        if not self.is_converged or self.solution is None:
            return self
        solution = self.solution
        on_layouts = resolve_layouts(
            [place_support(layout, solution.head_point)],
            layout.post_spacing,
            (solution.foot, solution.head),
            self.panel if isinstance(self.panel, PanelForces) else None,
        )
        if isinstance(on_layouts, FailedSupport):
            raise ValueError("a case that another layout holds")
        forces = {**self.member_forces, **on_layouts[0]}
        return replace(self, member_forces=forces, of_layouts=())

    def stand(self, layout: SupportLayout) -> CaseResult:
        """The case with what its section brings to the ground on a layout."""
        if self.solution is None:
            return self
        foot, head = self.solution.foot, self.solution.head
        anchors = compute_anchor_forces(
            place_support(layout, self.solution.head_point),
            foot_pull_per_m=(foot.x, foot.y),
            head_pull_per_m=(head.x, head.y),
            post_spacing=layout.post_spacing,
        )
        held = None if isinstance(anchors, FailedSupport) else anchors
        return replace(self, anchors=held)


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
    jobs = [task.job for task in tasks if task.job is not None]
    ends = iter((runner or Runner()).solve(jobs))
    return [resolve_case(task, next(ends) if task.job else None) for task in tasks]


def resolve_case(task: CaseTask, end: CaseEnd | None) -> CaseResult:
    """Forces of a case from the end of its solve; failures stay outcomes."""
    if end is None or task.job is None:
        return _failed(task, Outcome.OUT_OF_VALIDITY, task.refusal)
    if isinstance(end, FailedSolution):
        return replace(_failed(task, end.outcome, end.reason), fault=end.fault)
    if task.layout is None:
        return replace(_resolve_net(task, end), reason=end.reason)
    result = catch_fault(
        partial(_resolve_support, task, task.layout, end),
        describe_case(task.job.scene, task.job.settings),
    )
    if not isinstance(result, Fault):
        return replace(result, reason=result.reason or end.reason)
    return replace(_failed(task, Outcome.PROGRAM_FAULT, SENTENCE), fault=result)


def _resolve_net(task: CaseTask, state: SolvedState) -> CaseResult:
    """Tensions of the net per metre of width: nothing is known of its support."""
    foot, head = state.foot, state.head
    return CaseResult(
        case=task.case,
        outcome=Outcome.CONVERGED,
        member_forces={
            "foot": spread_out(foot.size, foot.error),
            "head": spread_out(head.size, head.error),
            "rope": _bound_tension(state),
        },
        solution=state,
    )


def _bound_tension(state: SolvedState) -> Band:
    """Largest tension of the net for each metre of width [N/m]."""
    foot, head = state.foot, state.head
    largest = max(state.tension_max, foot.size, head.size)
    return spread_out(largest, max(foot.error, head.error))


def _resolve_support(
    task: CaseTask, layout: SupportLayout, solution: SolvedState
) -> CaseResult:
    points = place_support(layout, solution.head_point)
    pulls = [(solution.foot, solution.head)]
    supports = resolve_pulls(points, layout.post_spacing, pulls)
    if isinstance(supports, FailedSupport):
        return _failed(task, supports.outcome, supports.reason)
    ((anchors, bands),) = supports
    panel = _resolve_panel(task, points, solution)
    forces = {
        **bands,
        NetPart.MESH: _bound_tension(solution),
        **(panel.worst if isinstance(panel, PanelForces) else {}),
    }
    result = CaseResult(
        case=task.case,
        outcome=Outcome.CONVERGED,
        member_forces=forces,
        anchors=anchors,
        solution=solution,
        panel=panel,
    )
    return _resolve_others(task, layout, result) if task.other_layouts else result


def _resolve_others(
    task: CaseTask, layout: SupportLayout, result: CaseResult
) -> CaseResult:
    """Case with its forces on the other layouts; what fails on one fails."""
    solution, panel = result.solution, result.panel
    if solution is None:
        raise ValueError("a case without a solution")
    on_layouts = resolve_layouts(
        [place_support(layout, solution.head_point) for layout in task.other_layouts],
        layout.post_spacing,
        (solution.foot, solution.head),
        panel if isinstance(panel, PanelForces) else None,
    )
    if isinstance(on_layouts, FailedSupport):
        return _failed(task, on_layouts.outcome, on_layouts.reason)
    first = result.member_forces
    forces = (first, *({**first, **own} for own in on_layouts))
    largest = {name: cover(by_member[name] for by_member in forces) for name in first}
    layouts = (layout, *task.other_layouts)
    return replace(
        result,
        member_forces=largest,
        of_layouts=tuple(zip(layouts, forces, strict=True)),
    )


def _resolve_panel(
    task: CaseTask, points: SupportPoints, solution: SolvedState
) -> PanelForces | FailedPanel | None:
    """Forces by the panel between posts, or why there are none."""
    net = task.job.scene.net if task.job else None
    if not task.panels or not isinstance(net, Net):
        return None
    return resolve_panels(task.panels, net, points, solution)


def build_task(
    case: Case,
    build_scene: Callable[[Case], Scene],
    layout: SupportLayout | None,
    settings: Settings,
    panels: tuple[Panel, ...] = (),
    other_layouts: tuple[SupportLayout, ...] = (),
) -> CaseTask:
    """Task of a case; a scene that the model refuses becomes a named refusal."""
    job: Job | None = None
    refusal: Message | None = None
    try:
        job = Job(scene=build_scene(case), settings=settings)
    except ModelError as error:
        refusal = error.message
    return CaseTask(
        case=case,
        job=job,
        refusal=refusal,
        layout=layout,
        panels=panels,
        other_layouts=other_layouts,
    )


def _failed(task: CaseTask, outcome: Outcome, reason: Message | None) -> CaseResult:
    return CaseResult(case=task.case, outcome=outcome, reason=reason, member_forces={})
