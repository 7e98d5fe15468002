"""Member forces of a case; a failed case is a result with its reason."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from netdesign.checks.inputs import Band
from netdesign.coupling.scene import Scene
from netdesign.coupling.solution import FailedSolution, SolvedState
from netdesign.envelope.panel_forces import (
    HeldPulls,
    PanelForces,
    Pulls,
    hold_pulls,
    resolve_panels,
    spread_out,
    stand_on,
)
from netdesign.envelope.ranges import Case
from netdesign.numerics.arrays import Floats
from netdesign.outcome import SENTENCE, Fault, ModelError, Outcome, catch_fault
from netdesign.panel.inputs import Panel
from netdesign.panel.solve import FailedPanel
from netdesign.solving.runner import Runner
from netdesign.solving.solve import CaseEnd, Settings, describe_case
from netdesign.solving.workers import Job
from netdesign.structure.anchors import AnchorForces
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import SupportLayout
from netdesign.structure.members import NetPart
from netdesign.words.message import Message


@dataclass(frozen=True, slots=True, kw_only=True)
class CaseTask:
    """Everything that a worker needs for one case.

    ``job`` is None where the model refuses the case; ``refusal`` says why. Of several
    ``layouts`` the largest forces on any count; without one the net's own tensions are
    followed, per metre of width. Of ``panels`` the largest forces count, too.
    """

    case: Case
    job: Job | None
    refusal: Message | None
    layouts: tuple[SupportLayout, ...]
    panels: tuple[Panel, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LayoutForces:
    """Forces of a case on each layout that its support may have.

    Attributes
    ----------
    layouts : tuple of SupportLayout
        In the order of the bands.
    names : tuple of str
        Members, and quantities of the panel between posts.
    bands : ndarray, shape (layouts, names, 3)
        Least, own and largest force [N].
    """

    layouts: tuple[SupportLayout, ...]
    names: tuple[str, ...]
    bands: Floats

    @property
    def largest(self) -> dict[str, Band]:
        """Forces on the layout that is worst for each."""
        return self._name(self.bands.max(axis=0))

    def find(self, layout: SupportLayout) -> dict[str, Band] | None:
        """Forces on one of the layouts; None on any other."""
        if layout not in self.layouts:
            return None
        return self._name(self.bands[self.layouts.index(layout)])

    def _name(self, bands: Floats) -> dict[str, Band]:
        return {
            name: Band(low=low, value=value, high=high)
            for name, (low, value, high) in zip(self.names, bands.tolist(), strict=True)
        }


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
    of_layouts : LayoutForces or None
        The members' forces on each of several layouts; None of a single one.
    """

    case: Case
    outcome: Outcome
    reason: Message | None = None
    member_forces: dict[str, Band]
    anchors: AnchorForces | None = None
    solution: SolvedState | None = None
    fault: Fault | None = None
    panel: PanelForces | FailedPanel | None = None
    of_layouts: LayoutForces | None = None

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

    def on_layout(self, layout: SupportLayout) -> CaseResult:
        """The case with the members' forces on one layout: of its own, or between them.

        What it brings to the ground stays that on the first layout; `stand` gives it.

        Raises
        ------
        ValueError
            Where a layout cannot hold what its own hold.
        """
        if self.of_layouts is None or self.solution is None:
            return self
        forces = self.of_layouts.find(layout)
        if forces is None:
            panel = self.panel if isinstance(self.panel, PanelForces) else None
            held = _hold([layout], self.solution, panel)
            if not held.is_held.all():
                raise ValueError("a case that another layout holds")
            forces = _list_forces((layout,), held, self.solution, panel).largest
        return replace(self, member_forces=forces, of_layouts=None)

    def stand(self, layout: SupportLayout) -> CaseResult:
        """The case with what its section brings to the ground on a layout."""
        if self.solution is None:
            return self
        ends = _read_ends(self.solution)
        anchors = stand_on(layout, self.solution.head_point, ends)
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
    if not task.layouts:
        return replace(_resolve_net(task, end), reason=end.reason)
    result = catch_fault(
        partial(_resolve_support, task, end),
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


def _resolve_support(task: CaseTask, state: SolvedState) -> CaseResult:
    """Forces on all layouts; what fails on one fails, but for the panel."""
    layouts, head = task.layouts, state.head_point
    found = _resolve_panel(task, state)
    panel = found if isinstance(found, PanelForces) else None
    held = _hold(layouts, state, panel)
    if not held.is_held[:1, :, :1].all():
        return _fail_support(task, held.explain(layouts, head, slice(1)))
    if panel and not held.is_held[0].all():
        failed = held.explain(layouts, head)
        found = FailedPanel(outcome=failed.outcome, reason=failed.reason)
        panel, held = None, _hold(layouts, state, None)
    if not held.is_held.all():
        return _fail_support(task, held.explain(layouts, head))
    anchors = stand_on(layouts[0], head, _read_ends(state))
    if isinstance(anchors, FailedSupport):
        return _fail_support(task, anchors)
    forces = _list_forces(layouts, held, state, panel)
    return CaseResult(
        case=task.case,
        outcome=Outcome.CONVERGED,
        member_forces=forces.largest,
        anchors=anchors,
        solution=state,
        panel=found,
        of_layouts=forces if len(task.layouts) > 1 else None,
    )


def _hold(
    layouts: Sequence[SupportLayout], state: SolvedState, panel: PanelForces | None
) -> HeldPulls:
    """Supports under the pulls of the section, then under those of each panel."""
    own = (state.foot.error, state.foot.error, state.head.error, state.head.error)
    pulls = Pulls(_read_ends(state)[None], np.array([own]))
    if panel:
        pairs = zip(pulls, panel.pulls, strict=True)
        pulls = Pulls(*(np.concatenate(pair) for pair in pairs))
    return hold_pulls(layouts, state.head_point, pulls)


def _list_forces(
    layouts: tuple[SupportLayout, ...],
    held: HeldPulls,
    state: SolvedState,
    panel: PanelForces | None,
) -> LayoutForces:
    """Forces by the section, and by the worst of its panels."""
    mesh = _bound_tension(state)
    bands = {str(member): band[..., 0] for member, band in held.bands.items()}
    bands[NetPart.MESH] = np.array([mesh.low, mesh.value, mesh.high])
    if panel:
        of_panels = panel.read_members(held) | panel.ropes
        bands |= {name: band.max(axis=-1) for name, band in of_panels.items()}
    stacked = np.empty((len(held.is_held), len(bands), 3))
    for place, band in enumerate(bands.values()):
        stacked[:, place] = band
    return LayoutForces(layouts=layouts, names=tuple(bands), bands=stacked)


def _fail_support(task: CaseTask, failed: FailedSupport) -> CaseResult:
    return _failed(task, failed.outcome, failed.reason)


def _resolve_panel(
    task: CaseTask, state: SolvedState
) -> PanelForces | FailedPanel | None:
    """Panels between posts and their pulls, or why there are none."""
    if not task.panels or task.job is None:
        return None
    return resolve_panels(task.panels, task.job.scene.net, state)


def _read_ends(state: SolvedState) -> Floats:
    """Pulls of the section on foot and head (4,) [N/m]."""
    return np.array([state.foot.x, state.foot.y, state.head.x, state.head.y])


def build_task(
    case: Case,
    build_scene: Callable[[Case], Scene],
    layouts: Sequence[SupportLayout],
    settings: Settings,
    panels: tuple[Panel, ...] = (),
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
        layouts=tuple(layouts),
        panels=panels,
    )


def _failed(task: CaseTask, outcome: Outcome, reason: Message | None) -> CaseResult:
    return CaseResult(case=task.case, outcome=outcome, reason=reason, member_forces={})
