"""Proposal of net rows along contours, until they hold a whole starting zone.

Theory: terrain/THEORY.md, (T10) and (T11).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from netdesign.numerics.arrays import Floats, Ints, Mask
from netdesign.terrain.contour import go_along
from netdesign.terrain.coverage import divide_zones
from netdesign.terrain.fall_line import FallLines, follow_fall
from netdesign.terrain.grid import Grid
from netdesign.terrain.measure import BROKEN, LEAST_STEEP, find_flattest
from netdesign.terrain.surface import Surface, choose_window

LEAST_ROW, MOST_ROW = 12.0, 60.0  # length of a row [m]
GAP = 2.0  # between two rows beside each other; what lies above it counts as held [m]
_LEAST_SNOW = 10.0  # above a row, along the ground: anchors of nearer rows meet [m]
_CLEAR = 14.0  # below another row: anchors of nearer rows meet [m]
_STEEPEST = math.radians(60.0)  # ground on which a row may stand
_STEP = 1.0  # along a contour, between two lines of fall [m]
_FARTHEST = 100.0  # along a line of fall, that is looked at [m]
_WIDE = 300.0  # along a contour, to each side [m]
_SPARE = 0.98  # of the largest distance, for what lies between two lines of fall [-]
_FOOT = 0.92  # of it below the highest place: beside it the lines may be longer [-]
_BENT = 0.9  # of the bend that breaks a row: posts do not stand at its points [-]
_ELSEWHERE, _OPEN, _HELD = 0, 1, 2  # states of the ground


@dataclass(frozen=True, slots=True, kw_only=True)
class Construction:
    """A net that may be built.

    Attributes
    ----------
    id : str
        Its name.
    net_height, post_spacing : float
        D_K normal to the slope; largest distance of posts along the row [m].
    """

    id: str
    net_height: float
    post_spacing: float


@dataclass(frozen=True, slots=True, kw_only=True)
class ProposedRow:
    """A row of a plan.

    Attributes
    ----------
    points : ndarray, shape (n, 2)
        Feet of the posts, uphill on their left [m].
    construction : Construction
        What is built.
    spacing : float
        Of its posts, at most that of the construction [m].
    snow : float
        Largest vertical snow height along it [m].
    """

    points: Floats
    construction: Construction
    spacing: float
    snow: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Task:
    """Ground and nets that rows are proposed for.

    Attributes
    ----------
    surface : Surface
        Ground.
    zones : sequence of ndarray, shape (n, 2)
        Rings of the starting zones [m].
    constructions : sequence of Construction
        The lowest first.
    find_snow : callable
        Vertical snow height at places [m], shape (n, 2) -> (n,).
    find_reach : callable
        Largest distance that a row holds [m], of a slope angle [rad] and a net
        height [m].
    """

    surface: Surface
    zones: Sequence[Floats]
    constructions: Sequence[Construction]
    find_snow: Callable[[Floats], Floats]
    find_reach: Callable[[float, float], float]

    def choose(self, snow: float, slope: float) -> Construction:
        """Lowest net that is as high as the snow; else the highest."""
        needed = snow * math.cos(slope)
        enough = (one for one in self.constructions if one.net_height >= needed)
        return next(enough, self.constructions[-1])

    @property
    def farthest(self) -> float:
        """Largest distance that any row holds, on the flattest ground [m]."""
        reach = self.find_reach(LEAST_STEEP, self.constructions[-1].net_height)
        return min(reach, _FARTHEST)  # a profile may have no cap

    def find_spared_reach(self, place: Floats, slope: float) -> float:
        """Distance that a row at a place holds, of the net that its snow needs [m]."""
        snow = float(self.find_snow(place[None])[0])
        return _SPARE * self.find_reach(slope, self.choose(snow, slope).net_height)


class _Ground:
    """Squares of the zones, and which of them some row holds."""

    def __init__(self, task: Task) -> None:
        self._squares = divide_zones(task.surface, task.zones)
        is_steep: Mask = self._squares.is_steep
        self._states: Ints = np.where(is_steep, _OPEN, _ELSEWHERE)
        self._sought: Floats = np.full(
            is_steep.shape, -math.inf
        )  # heights, where looked at
        heights = task.surface.at(self._squares.locate(is_steep)).height
        self._sought[is_steep] = np.where(np.isfinite(heights), heights, -math.inf)

    def find_states(self, places: Floats) -> Ints:
        """State of the ground at places, shape (..., 2) -> (...)."""
        at = np.rint((places - self._squares.corner) / self._squares.side)
        ends = self._states.shape[::-1]
        is_on: Mask = np.asarray(((at >= 0) & (at < ends)).all(axis=-1))
        column, line = np.moveaxis(np.where(is_on[..., None], at, 0), -1, 0)
        found = self._states[line.astype(np.int64), column.astype(np.int64)]
        return np.where(is_on, found, _ELSEWHERE)

    def find_top(self) -> Floats | None:
        """Highest open place that has not been looked at; None without one."""
        line, column = divmod(int(self._sought.argmax()), self._sought.shape[1])
        if self._sought[line, column] == -math.inf:
            return None
        return self._squares.corner + self._squares.side * np.array((column, line))

    def hold(self, strip: Floats) -> None:
        """Mark the squares inside a ring as held."""
        part, inside = self._squares.find_inside(strip)
        states = self._states[part]  # a view: marked in place
        states[inside & (states == _OPEN)] = _HELD
        self._sought[part][inside] = -math.inf

    def pass_over(self, top: Floats) -> None:
        """Look no more at a place, and at those beside it where no row has room."""
        turns = np.linspace(0.0, 2.0 * math.pi, 33)
        round_it = np.column_stack((np.cos(turns), np.sin(turns)))
        part, inside = self._squares.find_inside(top + 0.5 * LEAST_ROW * round_it)
        self._sought[part][inside] = -math.inf


@dataclass(frozen=True, slots=True)
class _Contour:
    """Points of a contour with the open ground above them.

    Attributes
    ----------
    points : ndarray, shape (n, 2)
        Uphill on their left [m].
    paths : tuple of ndarray, shape (m, 2)
        Line of fall above each, up to where open ground ends [m].
    lengths, reaches : ndarray, shape (n,)
        Of these lines, and what a row holds there [m].
    is_below_row : ndarray, shape (n,)
        Held ground ends them.
    """

    points: Floats
    paths: tuple[Floats, ...]
    lengths: Floats
    reaches: Floats
    is_below_row: Mask

    def take(self, first: int, last: int) -> _Contour:
        """Part from one point to another one."""
        part = slice(first, last + 1)
        return _Contour(
            self.points[part],
            self.paths[part],
            self.lengths[part],
            self.reaches[part],
            self.is_below_row[part],
        )

    @property
    def room(self) -> float:
        """Length [m]."""
        return _STEP * (len(self.points) - 1)


def choose_surface(grid: Grid, zones: Sequence[Floats]) -> Surface:
    """Surface of a grid by the noise along the outlines of zones."""
    return choose_window(grid, np.concatenate(zones))


def propose_rows(task: Task) -> list[ProposedRow]:
    """Propose rows from the top of the zones down.

    Each round takes the highest ground that nothing holds. A row stands as far below it
    as the steepest slope in between allows, and follows the contour to both sides. What
    is narrower than the shortest row stays open.

    Verified by
    -----------
    tests/terrain/test_layout.py
    """
    ground = _Ground(task)
    found: list[ProposedRow] = []
    while (top := ground.find_top()) is not None:
        for part in _list_contours(task, ground, top):
            for row, paths in _divide(task, part):
                found.append(row)
                for one, other in pairwise(paths):
                    ground.hold(np.concatenate((one, other[::-1])))
        ground.pass_over(top)
    return found


def _list_contours(task: Task, ground: _Ground, top: Floats) -> Iterator[_Contour]:
    """Parts of a contour on which rows stand that hold a highest open place."""
    foot = _find_foot(task, ground, top)
    if foot is None:
        return
    points, start = _follow(task.surface, ground, foot)
    contour = _look_up(task, ground, points)
    part = contour.take(*_extend(contour, start))
    spacing = max(one.post_spacing for one in task.constructions)
    yield from _cut_at_bends(part, spacing)


def _find_foot(task: Task, ground: _Ground, top: Floats) -> Floats | None:
    """Place of a row on the line of fall below a place, where it holds that place.

    Where the open ground below needs n rows, they share its length; what is left at its
    lower end is shorter than the least snow of a row.
    """
    below = follow_fall(task.surface, top[None], most=2.0 * task.farthest, is_up=False)
    points, lengths = below.points[:, 0], below.lengths[:, 0]
    count = int(_count_open(ground, below)[0])
    steepest = np.fmax.accumulate(below.steepness[:, 0])
    most = 0
    while most + 1 < count and lengths[most + 1] <= task.find_spared_reach(
        points[most + 1], float(steepest[most + 1])
    ):
        most += 1
    if most == 0 or lengths[count - 1] < _LEAST_SNOW:
        return None
    whole = float(lengths[count - 1])
    longest = _FOOT * float(lengths[most])
    number = max(1, math.ceil((whole - _LEAST_SNOW) / longest - 1e-9))
    at = min(longest, whole / number)
    place = np.array([np.interp(at, lengths[:count], x[:count]) for x in points.T])
    steepness = task.surface.at(place[None]).steepness[0]
    return place if steepness <= _STEEPEST else None


def _count_open(ground: _Ground, lines: FallLines) -> Ints:
    """Steps of each line of fall before it leaves open ground, shape (n,)."""
    is_open = ground.find_states(lines.points) == _OPEN
    return np.where(is_open.all(axis=0), len(is_open), np.argmin(is_open, axis=0))


def _follow(surface: Surface, ground: _Ground, foot: Floats) -> tuple[Floats, int]:
    """Contour through a place on open ground, and that place in it.

    It ends just beyond the zone, so that no line of fall slips by between two rows.
    """
    sides: list[list[Floats]] = [[foot], [foot]]
    outside, most = [0.0, 0.0], 1.5 * _STEP
    steps = np.array(((-_STEP,), (_STEP,)))
    while min(outside) < most and len(sides[0]) + len(sides[1]) < 2.0 * _WIDE / _STEP:
        there = go_along(surface, np.array([side[-1] for side in sides]), steps)
        states = ground.find_states(there)
        steepness = surface.at(there).steepness
        for k, side in enumerate(sides):
            outside[k] += _STEP if states[k] == _ELSEWHERE else 0.0
            is_round = _is_near(there[k], [*side[:-4], *sides[1 - k][4:]])
            is_ground = steepness[k] <= _STEEPEST  # not of a hole in the grid
            if states[k] == _HELD or is_round or not is_ground:
                outside[k] = math.inf
            if outside[k] < most:
                side.append(there[k])
    back, forth = sides
    return np.stack((*back[:0:-1], *forth)), len(back) - 1


def _is_near(place: Floats, others: Sequence[Floats]) -> bool:
    """A contour that has come round to places where it was before."""
    return any(math.dist(place, one) < GAP for one in others)


def _look_up(task: Task, ground: _Ground, points: Floats) -> _Contour:
    above = follow_fall(task.surface, points, most=task.farthest, is_up=True)
    counts = _count_open(ground, above)
    states = ground.find_states(above.points)
    lengths, reaches, paths, is_below = [], [], [], []
    for i, count in enumerate(counts):
        last = min(int(count), len(states) - 1)
        known = np.isfinite(above.points[: last + 1, i]).all(axis=1)
        paths.append(above.points[: last + 1, i][known])
        lengths.append(float(above.lengths[max(0, last - 1), i]))
        steepest = float(np.fmax.reduce(above.steepness[: max(1, last), i]))
        reaches.append(task.find_spared_reach(points[i], steepest))
        is_below.append(bool(states[last, i] == _HELD))
    return _Contour(
        points, tuple(paths), np.array(lengths), np.array(reaches), np.array(is_below)
    )


def _extend(contour: _Contour, start: int) -> tuple[int, int]:
    """First and last point of a row's contour around one of its points.

    No line of fall of its snow is longer than what its steepest place allows. Close
    below another row there is none.
    """
    longest, reach = contour.lengths[start], contour.reaches[start]
    ends = [start, start]
    for k, way in enumerate((-1, 1)):
        while 0 <= (there := ends[k] + way) < len(contour.points):
            now = max(longest, contour.lengths[there])
            least = min(reach, contour.reaches[there])
            is_close = contour.lengths[there] < _CLEAR
            if now > least or (is_close and contour.is_below_row[there]):
                break
            ends[k], longest, reach = there, now, least
    return ends[0], ends[1]


def _cut_at_bends(contour: _Contour, spacing: float) -> Iterator[_Contour]:
    """Parts of a contour that bend less at a post than a row may."""
    steps = np.diff(contour.points, axis=0)
    turned = np.diff(np.unwrap(np.arctan2(steps[:, 1], steps[:, 0])))
    bends = np.abs(turned) * max(1.0, spacing / _STEP)
    broken = np.flatnonzero(bends > _BENT * BROKEN) + 1
    cuts = [0, *(int(one) for one in broken), len(contour.points) - 1]
    for first, last in pairwise(cuts):
        part = contour.take(first, last)
        if part.room >= LEAST_ROW:
            yield part


def _divide(
    task: Task, contour: _Contour
) -> Iterator[tuple[ProposedRow, Sequence[Floats]]]:
    """Rows that fill a contour, and the lines of fall that bound the snow of each.

    They are as long as they may be, with gaps between; half a gap belongs to each.
    Bays are as wide as the net allows, or a little less.
    """
    points = contour.points
    snow = float(task.find_snow(points).max())
    built = task.choose(snow, find_flattest(task.surface, points))
    count = math.ceil((contour.room + GAP) / (MOST_ROW + GAP))
    length = (contour.room - (count - 1) * GAP) / count
    bays = math.ceil(length / built.post_spacing - 1e-9)
    along = _STEP * np.arange(len(points))
    for start in (length + GAP) * np.arange(count):
        at = np.linspace(start, start + length, bays + 1)
        feet = np.column_stack([np.interp(at, along, part) for part in points.T])
        first = math.floor((start - 0.5 * GAP) / _STEP)
        last = math.ceil((start + length + 0.5 * GAP) / _STEP)
        yield (
            ProposedRow(
                points=feet, construction=built, spacing=length / bays, snow=snow
            ),
            contour.paths[max(0, first) : last + 1],
        )
