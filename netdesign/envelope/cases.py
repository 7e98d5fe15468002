"""Cases of a row, from their points in the ranges to their results.

More friction leaves a solution (nearly) as it is where the snow slips nowhere on the
net, or at its foot only. Such cases take the result of the case with less friction. The
first of them are solved as a test; a difference ends the skipping. Cases of the first
design are solved on the coarsest meshes, then again near a largest force. Theory:
envelope/THEORY.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from netdesign.envelope.rows import RowTask, build_point_task, roughen_settings
from netdesign.envelope.run import CaseResult, resolve_case
from netdesign.search.surrogate import Point
from netdesign.solving.solve import CaseEnd, Settings, SolvedState
from netdesign.solving.workers import Batch, Ends

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
