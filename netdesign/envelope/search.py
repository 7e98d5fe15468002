"""Searches of net rows: which cases each solves next, until its envelope is known.

A ``RowSearch`` solves no case. `ask` gives the batches to solve, `tell` takes their
ends. First: which of these cases need no solve. More friction leaves a solution
(nearly) as it is where the snow slips nowhere on the net, or at its foot only. Such a
case takes the result of the case with less friction. The first of them are solved as a
test; a difference ends the skipping. Cases of the first design are solved on the
coarsest meshes, then again near a largest force. Theory: envelope/THEORY.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import islice, product

from netdesign.edge.progress import Wave
from netdesign.envelope.result_reader import ResultReader, bound_lifted
from netdesign.envelope.rows import (
    Confirmation,
    RowEnvelope,
    RowTask,
    build_point_task,
    roughen_settings,
)
from netdesign.envelope.run import CaseResult, resolve_case
from netdesign.outcome import ModelError
from netdesign.search.maxima import Maxima, MaximaSearch
from netdesign.search.surrogate import Point
from netdesign.solving.runner import Runner
from netdesign.solving.solve import CaseEnd, Settings, SolvedState
from netdesign.solving.workers import Batch, Ends
from netdesign.words.message import say

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

    def list_lines(self, points: Sequence[Point]) -> list[list[Point]]:
        """Lines of ascending friction to be solved next, out of some points.

        A line is solved up to the first point whose snow sticks; ask again with the
        points that are left. None are returned once the rest need no solve.
        """
        if not self._agrees:
            return [[point] for point in points]
        unknown = [point for point in points if not self._is_chance(point)]
        if unknown:
            return self._group(unknown)
        missing = _TESTS - self.tested
        step = max(1, len(points) // max(1, missing))  # tests lie apart
        return [[point] for point in sorted(points)[::step][:missing]]

    def _group(self, points: Sequence[Point]) -> list[list[Point]]:
        lines: dict[Point, list[Point]] = {}
        for point in sorted(points, key=lambda p: (self._line(p), self._friction(p))):
            lines.setdefault(self._line(point), []).append(point)
        return list(lines.values())

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

    def forget(self, points: Sequence[Point]) -> None:
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


class Cases:
    """Some points of a row, until all their results are known.

    Attributes
    ----------
    rough : frozenset of int
        Places of results that are known roughly only.
    """

    rough: frozenset[int] = frozenset()

    def __init__(
        self,
        task: RowTask,
        points: Sequence[Point],
        skip: FrictionSkip,
        settings: Settings | None = None,
    ) -> None:
        """Take the points, and the settings of their solves if not the row's own."""
        self._points, self._skip = points, skip
        self._tasks = [build_point_task(task, point, settings) for point in points]
        asked = zip(points, self._tasks, strict=True)
        self._jobs = {point: case.job for point, case in asked if case.job is not None}
        self._ends: dict[Point, CaseEnd] = {}
        self._lines = self._list_lines()

    def _list_lines(self) -> list[list[Point]]:
        open_points = [point for point in self._jobs if point not in self._ends]
        return self._skip.list_lines(open_points)

    def ask(self) -> list[Batch]:
        """Batches to be solved next; none once the rest need no solve."""
        return [tuple(self._jobs[point] for point in line) for line in self._lines]

    def tell(self, answers: Sequence[Ends]) -> None:
        """Take the ends of the batches asked for, in their order."""
        for line, answer in zip(self._lines, answers, strict=True):
            for point, end in zip(line, answer, strict=False):  # until it sticks
                self._ends[point] = end
                self._skip.learn(point, end)
        self._lines = self._list_lines()

    def finish(self) -> list[CaseResult]:
        """Results in the order of the points; ends that friction cannot change."""
        for point in self._jobs:
            if point not in self._ends:
                self._ends[point] = self._skip.recall(point)
        resolved: dict[int, CaseResult] = {}
        results = []
        for point, task in zip(self._points, self._tasks, strict=True):
            end = self._ends.get(point)
            # Several frictions share an end where the snow sticks.
            same = resolved.get(id(end)) if end else None
            result = replace(same, case=task.case) if same else resolve_case(task, end)
            resolved[id(end)] = result
            results.append(result)
        return results


class FirstCases:
    """Cases of the first design: on the two coarsest meshes, then as they deserve.

    A case that failed there, has no panel, or may come near a largest force, is solved
    again as the row asks for, unless it is that accurate already. The others stay
    rough.

    Attributes
    ----------
    rough : frozenset of int
        Places of results that are known roughly only.
    """

    def __init__(
        self,
        task: RowTask,
        points: Sequence[Point],
        skip: FrictionSkip,
        find_near: Callable[[Sequence[CaseResult]], set[int]],
    ) -> None:
        """Take the points, and what finds the places of those that matter."""
        self._task, self._points, self._skip = task, points, skip
        self._find_near = find_near
        self._settings = roughen_settings(task.settings)
        self._cases = Cases(task, points, skip, self._settings)
        self._first: list[CaseResult] | None = None
        self._again: list[int] = []
        self.rough: frozenset[int] = frozenset()
        self._go_on()

    def ask(self) -> list[Batch]:
        """Batches to be solved next; none once the rest need no solve."""
        return self._cases.ask()

    def tell(self, answers: Sequence[Ends]) -> None:
        """Take the ends of the batches asked for, in their order."""
        self._cases.tell(answers)
        self._go_on()

    def finish(self) -> list[CaseResult]:
        """Results in the order of the points."""
        results = list(self._first or ())
        for place, result in zip(self._again, self._cases.finish(), strict=True):
            results[place] = result
        return results

    def _go_on(self) -> None:
        """Ask for the cases that matter once more, after the last of all is known."""
        if self._first is not None or self._cases.ask():
            return
        self._first = self._cases.finish()
        rough = {k for k, result in enumerate(self._first) if self._would_gain(result)}
        near = self._find_near(self._first)
        self._again, self.rough = sorted(rough & near), frozenset(rough - near)
        points = [self._points[place] for place in self._again]
        self._skip.forget(points)
        self._cases = Cases(self._task, points, self._skip)

    def _would_gain(self, result: CaseResult) -> bool:
        """More meshes could change the result."""
        if self._settings == self._task.settings or result.fault is not None:
            return False
        if result.solution is None:
            return True
        pulls = (result.solution.foot, result.solution.head)
        accuracy = self._task.settings.accuracy
        return any(pull.error > accuracy * pull.size for pull in pulls)


class RowSearch:
    """Search of one row's envelope: asks for the ends of batches, and is told.

    Attributes
    ----------
    task : RowTask
        What is searched.

    Verified by
    -----------
    tests/envelope/test_search.py
    """

    def __init__(self, task: RowTask) -> None:
        """Begin a search with nothing known of the row's cases."""
        self.task = task
        self._result: RowEnvelope | None = None
        self._search = MaximaSearch(len(task.ranges.axes), task.search)
        self._reader = ResultReader(
            layouts=task.layouts, has_panel=bool(task.panels), has_end=task.has_end
        )
        self._skip = FrictionSkip(task.ranges.axes)
        self._results: list[CaseResult] = []
        self._maxima: Maxima | None = None  # known once only confirmations are open
        self._cases: Cases | FirstCases = FirstCases(
            task, self._search.ask(), self._skip, self._reader.find_near
        )
        self._advance()

    @property
    def result(self) -> RowEnvelope:
        """Envelope of the row; the same for the same ends.

        Raises
        ------
        ModelError
            While something is still asked for.
        """
        if self._result is None:
            raise ModelError(say("envelope.not_ended"))
        return self._result

    @property
    def gap(self) -> float:
        """Largest gap left after the last round, over its quantity [-]."""
        return self._search.gap

    def ask(self) -> list[Batch]:
        """Batches to be solved next; none once the envelope is known."""
        return self._cases.ask()

    def tell(self, answers: Sequence[Ends]) -> None:
        """Take the ends of the batches asked for, in their order."""
        self._cases.tell(answers)
        self._advance()

    def _advance(self) -> None:
        """Go on until something has to be solved, or the envelope is known."""
        while self._result is None and not self._cases.ask():
            answered = self._cases.finish()
            if self._maxima is None:
                self._go_on(answered)
            else:
                self._finish(self._maxima, answered)

    def _go_on(self, answered: list[CaseResult]) -> None:
        """Tell the search what was found, and ask what it wants next."""
        self._results += answered
        search, reader = self._search, self._reader
        values = reader.read(answered)
        doubts = reader.read_doubts(answered, self._cases.rough)
        search.tell(values, reader.watch(), doubts)
        if points := search.ask():
            self._cases = Cases(self.task, points, self._skip)
        elif search.result is not None:
            self._confirm(search.result)

    def _confirm(self, maxima: Maxima) -> None:
        """Ask for the governing cases once more."""
        self._maxima = self._reader.bound_members(maxima)
        points = [maxima.points[place] for place in self._list_confirmed(maxima)]
        apart = FrictionSkip(())  # each is solved
        self._cases = Cases(self.task, points, apart, self.task.confirmed_by)

    def _list_confirmed(self, maxima: Maxima) -> list[int]:
        """Places of the cases that govern a member, each once."""
        if self.task.confirmed_by is None:
            return []
        return sorted(set(self._find_governing(maxima).values()))

    def _find_governing(self, maxima: Maxima) -> dict[str, int]:
        """Place of the governing case of each member that carries a force."""
        peaks = zip(maxima.maximum, maxima.governing, strict=True)  # none, unsolved
        return {
            member: place
            for member, (force, place) in zip(self._reader.members, peaks, strict=False)
            if force > 0.0
        }

    def _finish(self, maxima: Maxima, confirmed: Sequence[CaseResult]) -> None:
        again = dict(zip(self._list_confirmed(maxima), confirmed, strict=True))
        self._result = RowEnvelope(
            task=self.task,
            members=self._reader.members,
            quantities=self._reader.quantities,
            results=tuple(self._results),
            maxima=maxima,
            confirmations=tuple(
                Confirmation(
                    member=member,
                    screened=self._results[place],
                    confirmed=again[place],
                )
                for member, place in self._find_governing(maxima).items()
                if place in again
            ),
            skipped=self._skip.skipped,
            skips_tested=self._skip.tested,
            lifted=bound_lifted(
                self.task.layouts, maxima.points, self._results, self.task.search
            ),
        )


def search_rows(
    tasks: Sequence[RowTask],
    runner: Runner,
    on_wave: Callable[[Wave], None] = lambda _: None,
) -> list[RowEnvelope]:
    """Envelopes of all rows, searched together: a wave has the next cases of every row.

    Parameters
    ----------
    tasks : sequence of RowTask
        One a row.
    runner : Runner
        Where cases are solved and kept; rows with the same net and snow share cases.
    on_wave : callable, optional
        Called after each wave.

    Returns
    -------
    list of RowEnvelope
        In the order of the tasks; equal tasks share one.
    """
    searches = {task: RowSearch(task) for task in dict.fromkeys(tasks)}
    while asked := _ask_rows(searches.values()):
        ends = iter(runner.solve_batches([batch for _, its in asked for batch in its]))
        for search, batches in asked:
            search.tell(list(islice(ends, len(batches))))
        on_wave(_describe_wave(_ask_rows(searches.values())))
    return [searches[task].result for task in tasks]


_Asked = list[tuple[RowSearch, list[Batch]]]


def _ask_rows(searches: Iterable[RowSearch]) -> _Asked:
    """Searches that go on, with the batches that each waits for."""
    return [(search, batches) for search in searches if (batches := search.ask())]


def _describe_wave(asked: _Asked) -> Wave:
    return Wave(
        rows_open=len(asked),
        cases_waiting=sum(len(batch) for _, batches in asked for batch in batches),
        gap=max((search.gap for search, _ in asked), default=0.0),
    )


def run_grid(
    task: RowTask, counts: Mapping[str, int], runner: Runner
) -> tuple[list[CaseResult], int]:
    """Cases of a grid with so many samples of each axis, and how many took no solve."""
    sizes = [counts[name] for name in task.ranges.axes]
    points = list(product(*([k / (n - 1) for k in range(n)] for n in sizes)))
    skip = FrictionSkip(task.ranges.axes)
    cases = Cases(task, points, skip)
    while batches := cases.ask():
        cases.tell(runner.solve_batches(batches))
    return cases.finish(), skip.skipped
