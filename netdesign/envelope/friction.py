"""Cases that friction cannot change: known without a solve, after a test.

Where the snow slips nowhere on the net, the friction limit is not reached and more
friction leaves the solution as it is. Where the snow slips by the very foot only, that
is very nearly so. It is used only after it was seen to hold: the first such cases are
solved all the same, and one that disagrees ends the skipping.
"""

from __future__ import annotations

from collections.abc import Sequence

from netdesign.search.surrogate import Point
from netdesign.solving.state import CaseEnd, SolvedState

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
            known = self._sticking[self._line(point)][1]
            self._agrees = self._agrees and _agree(known, end)
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


def _agree(one: SolvedState, other: SolvedState) -> bool:
    pairs = ((one.foot, other.foot), (one.head, other.head))
    return all(
        abs(a.x - b.x) + abs(a.y - b.y) <= _AGREEMENT * a.error for a, b in pairs
    )
