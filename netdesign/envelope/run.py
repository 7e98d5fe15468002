"""Runs cases, in one process or several; no failed case is ever lost."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import get_context

from netdesign.checks.result import Band
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import FailedSolution, Solution
from netdesign.coupling.steady import solve_steady
from netdesign.coupling.transient import TransientSettings, solve_transient
from netdesign.envelope.grid import Case
from netdesign.errors import ModelError
from netdesign.outcome import Outcome
from netdesign.structure.anchors import AnchorForces, compute_anchor_forces
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import SupportLayout, place_support

_THREAD_VARIABLES = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


@dataclass(frozen=True, slots=True, kw_only=True)
class CaseTask:
    """Everything that a worker needs for one case.

    ``scene`` is None where the model refuses the case; ``refusal`` says why. The kind
    of settings chooses steady state or history.
    """

    case: Case
    scene: Scene | None
    refusal: str
    layout: SupportLayout
    settings: SolverSettings | TransientSettings


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
        Characteristic force of each member with its numerical band [N per anchor].
    anchors : AnchorForces or None
        Force vectors on the ground.
    solution : Solution or None
        State of snow and net.
    """

    case: Case
    outcome: Outcome
    reason: str = ""
    member_forces: dict[str, Band]
    anchors: AnchorForces | None = None
    solution: Solution | None = None

    @property
    def is_converged(self) -> bool:
        """Its numbers may be used."""
        return self.outcome is Outcome.CONVERGED


def run_cases(
    tasks: Sequence[CaseTask],
    *,
    jobs: int = 1,
    on_done: Callable[[CaseResult], None] | None = None,
) -> list[CaseResult]:
    """Solve all tasks; results in the order of the tasks, whatever the workers did.

    Parameters
    ----------
    tasks : sequence of CaseTask
        Cases to solve.
    jobs : int
        Processes; 1 stays in this one.
    on_done : callable, optional
        Called with each result as it arrives.

    Returns
    -------
    list of CaseResult
        One for each task. A worker that died leaves ``worker_failed`` results.
    """
    notify = on_done or (lambda _: None)
    if jobs == 1 or len(tasks) < 2:
        results = []
        for task in tasks:
            results.append(solve_case(task))
            notify(results[-1])
        return results
    with (
        single_threaded_workers(),
        ProcessPoolExecutor(
            min(jobs, len(tasks)), mp_context=get_context("spawn")
        ) as pool,
    ):
        try:
            return _gather(pool, tasks, notify)
        except BaseException:
            pool.shutdown(wait=True, cancel_futures=True)
            raise


def _gather(
    pool: ProcessPoolExecutor,
    tasks: Sequence[CaseTask],
    notify: Callable[[CaseResult], None],
) -> list[CaseResult]:
    results: dict[int, CaseResult] = {}
    places: dict[Future[CaseResult], int] = {}
    for place, task in enumerate(tasks):
        try:
            places[pool.submit(solve_case, task)] = place
        except BrokenProcessPool:
            results[place] = _lose(task)
            notify(results[place])
    for future in as_completed(places):
        place = places[future]
        results[place] = _collect(future, tasks[place])
        notify(results[place])
    return [results[place] for place in range(len(tasks))]


def solve_case(task: CaseTask) -> CaseResult:
    """Solve one case and resolve its support; failures come back as outcomes."""
    if task.scene is None:
        return _failed(task, Outcome.OUT_OF_VALIDITY, task.refusal)
    try:
        solution = _solve(task.scene, task.settings)
        if isinstance(solution, FailedSolution):
            return _failed(task, solution.outcome, solution.reason)
        if solution.history is not None and not solution.history.plateau.reached:
            reason = solution.history.ended or Outcome.PLATEAU_NOT_REACHED.sentence
            return _failed(task, Outcome.PLATEAU_NOT_REACHED, reason)
        return _resolve_support(task, solution)
    except Exception as error:  # a bug in one case must not hide the others
        return _failed(task, Outcome.WORKER_FAILED, f"{type(error).__name__}: {error}")


def _solve(
    scene: Scene, settings: SolverSettings | TransientSettings
) -> Solution | FailedSolution:
    if isinstance(settings, TransientSettings):
        return solve_transient(scene, settings)
    return solve_steady(scene, settings)


def _resolve_support(task: CaseTask, solution: Solution) -> CaseResult:
    anchors = _anchor_forces(task, solution)
    if isinstance(anchors, FailedSupport):
        return _failed(task, anchors.outcome, anchors.reason)
    bands = _force_bands(task, solution, anchors)
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
    task: CaseTask, solution: Solution, shift: Sequence[float] = (0.0, 0.0, 0.0, 0.0)
) -> AnchorForces | FailedSupport:
    """Anchor forces with the end pulls moved by ``shift`` times their error.

    The four shares are for x and y of the foot's pull, x and y of the head's.
    """
    foot, head = solution.foot, solution.head
    return compute_anchor_forces(
        place_support(task.layout, solution.head_point),
        foot_pull_per_m=(
            foot.x + shift[0] * foot.error,
            foot.y + shift[1] * foot.error,
        ),
        head_pull_per_m=(
            head.x + shift[2] * head.error,
            head.y + shift[3] * head.error,
        ),
        post_spacing=task.layout.post_spacing,
    )


def _force_bands(
    task: CaseTask, solution: Solution, anchors: AnchorForces
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
            moved = _anchor_forces(task, solution, shift)
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
    layout: SupportLayout,
    settings: SolverSettings,
) -> CaseTask:
    """Task of a case; a scene that the model refuses becomes a named refusal."""
    scene, refusal = None, ""
    try:
        scene = build_scene(case)
    except ModelError as error:
        refusal = str(error)
    return CaseTask(
        case=case, scene=scene, refusal=refusal, layout=layout, settings=settings
    )


def _collect(future: Future[CaseResult], task: CaseTask) -> CaseResult:
    try:
        return future.result()
    except BrokenProcessPool:
        return _lose(task)


def _lose(task: CaseTask) -> CaseResult:
    return _failed(task, Outcome.WORKER_FAILED, "a worker process ended abruptly")


def _failed(task: CaseTask, outcome: Outcome, reason: str) -> CaseResult:
    return CaseResult(case=task.case, outcome=outcome, reason=reason, member_forces={})


@contextmanager
def single_threaded_workers() -> Iterator[None]:
    """Worker processes inherit one BLAS thread each: there is one worker a core."""
    before = {name: os.environ.get(name) for name in _THREAD_VARIABLES}
    os.environ.update(dict.fromkeys(_THREAD_VARIABLES, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value
