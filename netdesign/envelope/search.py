"""Searches of net rows: which cases each solves next, until its envelope is known.

A search solves no case: it is a generator of the jobs to solve, which is sent their
ends. First: which of these cases need no solve. More friction leaves a solution
(nearly) as it is where the snow slips nowhere on the net, or at its foot only. Such a
case takes the result of the case with less friction. The first of them are solved as a
test; a difference ends the skipping. Cases of the first design are solved on the
coarsest meshes, then again near a largest force. Theory: envelope/THEORY.md.
"""

from __future__ import annotations

from collections.abc import Collection, Generator, Mapping, Sequence
from dataclasses import replace
from itertools import islice, product
from typing import Any, TypeAlias, TypeVar

import numpy as np

from netdesign.coupling.solution import SolvedState
from netdesign.envelope.result_reader import bound_lifted, name_quantities
from netdesign.envelope.rows import (
    Confirmation,
    RowEnvelope,
    RowTask,
    build_point_task,
    roughen_settings,
)
from netdesign.envelope.run import CaseResult, resolve_case
from netdesign.search.maxima import Maxima, MaximaSearch
from netdesign.search.surrogate import Point
from netdesign.solving.runner import Runner
from netdesign.solving.solve import CaseEnd, Settings
from netdesign.solving.workers import Job

_End = TypeVar("_End")
# Jobs to be solved, their ends, and what follows once all are known.
Steps: TypeAlias = Generator[list[Job], list[CaseEnd], _End]
_AXIS = "friction_angle"
_TESTS = 2  # cases that are solved as tests before any is skipped
_AGREEMENT = 0.2  # of the stated error of both end pulls: more than iterations leave


class FrictionSkip:
    """Knowledge of one search about sticking snow."""

    def __init__(self, axes: Sequence[str]) -> None:
        """Take the names of the search's axes."""
        self._axis = axes.index(_AXIS) if _AXIS in axes else None
        # by the other coordinates: least friction known to stick, and its end
        self._sticking: dict[Point, tuple[float, SolvedState]] = {}
        self._agrees = True
        self._recalled: set[Point] = set()
        self.tested = 0

    @property
    def skipped(self) -> int:
        """Cases that are known without a solve."""
        return len(self._recalled)

    def choose(self, points: Sequence[Point]) -> list[Point]:
        """Points to be solved next: of each line the one with the least friction.

        Ask again with the points that are left. None are chosen once the rest need no
        solve.
        """
        if not self._agrees:
            return [*points]
        least: dict[Point, Point] = {}
        for point in sorted(points, key=lambda p: (self._line(p), self._friction(p))):
            if not self._is_chance(point):
                least.setdefault(self._line(point), point)
        if least:
            return [*least.values()]
        missing = _TESTS - self.tested
        step = max(1, len(points) // max(1, missing))  # tests lie apart
        return sorted(points)[::step][:missing]

    def learn(self, point: Point, end: CaseEnd) -> None:
        """Take the end of a case that was solved."""
        self._recalled.discard(point)
        if self._axis is None or not isinstance(end, SolvedState):
            return
        if self._is_chance(point):
            self.tested += 1
            sticking = self._sticking[self._line(point)][1]
            self._agrees = self._agrees and _agree(sticking, end)
        elif end.sticks:
            known_friction, _ = self._sticking.get(self._line(point), (2.0, end))
            if self._friction(point) < known_friction:
                self._sticking[self._line(point)] = (self._friction(point), end)

    def forget(self, points: Collection[Point]) -> None:
        """Drop what is known of the lines of points that are to be solved again."""
        for point in points:
            self._sticking.pop(self._line(point), None)

    def recall(self, point: Point) -> SolvedState:
        """End of a case that was not solved."""
        self._recalled.add(point)
        return self._sticking[self._line(point)][1]

    def _is_chance(self, point: Point) -> bool:
        if self._axis is None or self._line(point) not in self._sticking:
            return False
        return self._friction(point) > self._sticking[self._line(point)][0]

    def _friction(self, point: Point) -> float:
        return 0.0 if self._axis is None else point[self._axis]

    def _line(self, point: Point) -> Point:
        """All coordinates but friction."""
        return tuple(c for axis, c in enumerate(point) if axis != self._axis)


def _agree(first: SolvedState, second: SolvedState) -> bool:
    pairs = ((first.foot, second.foot), (first.head, second.head))
    return all(
        abs(a.x - b.x) + abs(a.y - b.y) <= _AGREEMENT * a.error for a, b in pairs
    )


def solve_points(
    task: RowTask,
    points: Sequence[Point],
    skip: FrictionSkip,
    settings: Settings | None = None,
) -> Steps[list[CaseResult]]:
    """Results of some points of a row, in their order; settings unless the row's own.

    Ends that friction cannot change are those of the case with less of it.
    """
    tasks = [build_point_task(task, point, settings) for point in points]
    asked = zip(points, tasks, strict=True)
    jobs = {point: case.job for point, case in asked if case.job is not None}
    ends: dict[Point, CaseEnd] = {}
    while chosen := skip.choose([point for point in jobs if point not in ends]):
        answers = yield [jobs[point] for point in chosen]
        for point, end in zip(chosen, answers, strict=True):
            ends[point] = end
            skip.learn(point, end)
    ends |= {point: skip.recall(point) for point in jobs if point not in ends}
    resolved: dict[int, CaseResult] = {}
    results = []
    for case, found in zip(tasks, map(ends.get, points), strict=True):
        # Several frictions share an end where the snow sticks.
        same = resolved.get(id(found)) if found else None
        result = replace(same, case=case.case) if same else resolve_case(case, found)
        resolved[id(found)] = result
        results.append(result)
    return results


def solve_first(
    task: RowTask,
    points: Sequence[Point],
    skip: FrictionSkip,
) -> Steps[tuple[list[CaseResult], set[int]]]:
    """Results of the first design, and the places of those that stay rough.

    All are solved on the two coarsest meshes. A case that failed there, has no panel,
    or may come near a largest force, is solved again as the row asks for, unless it is
    that accurate already.
    """
    settings = roughen_settings(task.settings)
    results = yield from solve_points(task, points, skip, settings)
    quantities, rough = name_quantities(task, results), set[int]()
    near = quantities.find_near(quantities.read(results))
    if settings != task.settings:
        accuracy = task.settings.accuracy
        rough = {k for k, x in enumerate(results) if _would_gain(x, accuracy)}
    again = {place: points[place] for place in sorted(rough & near)}
    skip.forget(again.values())
    solved = yield from solve_points(task, [*again.values()], skip)
    for place, result in zip(again, solved, strict=True):
        results[place] = result
    return results, rough - near


def _would_gain(result: CaseResult, accuracy: float) -> bool:
    """More meshes could change the result."""
    if result.solution is None:
        return result.fault is None
    pulls = (result.solution.foot, result.solution.head)
    return any(pull.error > accuracy * pull.size for pull in pulls)


def search_row(task: RowTask) -> Steps[RowEnvelope]:
    """Envelope of one row; the same for the same ends.

    Verified by
    -----------
    tests/envelope/test_search.py
    """
    search = MaximaSearch(len(task.ranges.axes), task.search)
    skip = FrictionSkip(task.ranges.axes)
    every, rough = yield from solve_first(task, search.ask(), skip)
    quantities = name_quantities(task, every)
    readings = [quantities.read(every)]
    doubts = np.zeros_like(readings[0].errors)
    doubts[sorted(rough)] = readings[0].errors[sorted(rough)]
    search.tell(readings[0].values, quantities.watch(readings), doubts)
    while search.result is None:
        results = yield from solve_points(task, search.ask(), skip)
        every += results
        readings.append(quantities.read(results))
        search.tell(readings[-1].values, quantities.watch(readings))
    maxima = quantities.bound_members(search.result)
    confirmed = yield from _confirm(task, quantities.members, maxima, every)
    return RowEnvelope(
        task=task,
        members=quantities.members,
        results=tuple(every),
        maxima=maxima,
        confirmations=confirmed,
        skipped=skip.skipped,
        lifted=bound_lifted(task.layouts, maxima.points, every, task.search),
    )


def _confirm(
    task: RowTask,
    members: Sequence[str],
    maxima: Maxima,
    results: Sequence[CaseResult],
) -> Steps[tuple[Confirmation, ...]]:
    """Governing case of each member that carries a force, solved once more."""
    if task.confirmed_by is None:
        return ()
    peaks = zip(maxima.maximum, maxima.governing, strict=True)  # none, unsolved
    governing = {
        member: place
        for member, (force, place) in zip(members, peaks, strict=False)
        if force > 0.0
    }
    places = sorted(set(governing.values()))
    points = [maxima.points[place] for place in places]
    apart = FrictionSkip(())  # each is solved
    confirmed = yield from solve_points(task, points, apart, task.confirmed_by)
    again = dict(zip(places, confirmed, strict=True))
    return tuple(
        Confirmation(member=member, screened=results[place], confirmed=again[place])
        for member, place in governing.items()
    )


def search_rows(tasks: Sequence[RowTask], runner: Runner) -> list[RowEnvelope]:
    """Envelopes of all rows, searched together: a wave has the next cases of every row.

    Parameters
    ----------
    tasks : sequence of RowTask
        One a row.
    runner : Runner
        Where cases are solved and kept; rows with the same net and snow share cases.

    Returns
    -------
    list of RowEnvelope
        In the order of the tasks; equal tasks share one.
    """
    steps = {task: search_row(task) for task in dict.fromkeys(tasks)}
    envelopes = _run_together(steps, runner)
    return [envelopes[task] for task in tasks]


def run_grid(
    task: RowTask, counts: Mapping[str, int], runner: Runner
) -> tuple[list[CaseResult], int]:
    """Cases of a grid with so many even samples an axis; how many took no solve."""
    task = replace(task, ranges=replace(task.ranges, is_even=True))
    sizes = [counts[name] for name in task.ranges.axes]
    points = list(product(*([k / (n - 1) for k in range(n)] for n in sizes)))
    skip = FrictionSkip(task.ranges.axes)
    steps = {task: solve_points(task, points, skip)}
    return _run_together(steps, runner)[task], skip.skipped


def _run_together(
    steps: Mapping[RowTask, Steps[_End]],
    runner: Runner,
) -> dict[RowTask, _End]:
    """End of each task; a wave has the jobs that all of them wait for."""
    ended: dict[RowTask, _End] = {}

    def go_on(answers: Mapping[RowTask, Any]) -> dict[RowTask, list[Job]]:
        asked = {}
        for task, ends in answers.items():
            try:
                asked[task] = steps[task].send(ends)
            except StopIteration as end:
                ended[task] = end.value
        return asked

    asked = go_on(dict.fromkeys(steps))
    while asked:
        ends = iter(runner.solve([job for its in asked.values() for job in its]))
        asked = go_on({x: list(islice(ends, len(its))) for x, its in asked.items()})
    return ended
