"""Terrain of one net row: slope, aspect, altitude, bends, upslope length, posts.

Theory: addons/terrain/THEORY.md, (T4) to (T8).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import shapely

from netdesign.addons.terrain.grid import Grid
from netdesign.addons.terrain.plan import NetLine, Plan
from netdesign.addons.terrain.surface import (
    LONGEST_BENCH,
    FallLines,
    Rows,
    Surface,
    choose_window,
    find_exit,
    find_first_crossings,
    find_mean,
    find_relief,
    follow_fall,
    measure_along,
)
from netdesign.numerics.arrays import Floats
from netdesign.outcome import TerrainError

LEAST_STEEP = math.radians(25.0)  # below it the snow holds itself
KINK, BROKEN = math.radians(5.0), math.radians(15.0)  # bends of a row at a post
CARED_ANGLE, CARED_LENGTH = math.radians(0.5), 0.1  # a check cares about [rad, m]
LEAST_LENGTH = 1.0  # of snow above a row; less is none [m]
_BEYOND = 5.0  # steep ground above a zone that is told [m]
_ERRORS = 2.0  # standard errors of a band


@dataclass(frozen=True, slots=True, kw_only=True)
class Band:
    """A length or an angle with its ends [m or rad]."""

    low: float
    value: float
    high: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Upslope:
    """Snow above a row, along the line of fall of one post.

    Attributes
    ----------
    length : Band
        Along the ground [m].
    end : str
        "row", "zone", "flat", "cap", "top", or "edge" (of the grid, or of a hole in
        it: the cap, since the ground beyond is not known).
    row : str
        The row that ends it, or "".
    steep : float
        Length of steep ground, whatever zone or row ends the snow before [m].
    """

    length: Band
    end: str
    row: str = ""
    steep: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuredRow:
    """One net row on the terrain.

    Attributes
    ----------
    line : NetLine
        As drawn.
    posts : ndarray, shape (n, 3)
        East, north, height [m].
    length : float
        From the first post to the last, along the ground [m].
    slopes : ndarray, shape (n,)
        Mean slope angle on the line of fall of each post, over its snow [rad].
    slope : Band
        Of the steepest post [rad].
    flattest : float
        Least slope angle of the ground at a post, less its error [rad].
    aspect : float
        Direction in which the ground falls, clockwise from north [rad].
    upslope : Upslope
        The longest.
    bends : ndarray, shape (n - 2,)
        At the posts inside the row [rad].
    above : FallLines
        Lines of fall, up to their ends.
    below_row, below_length : str, float or None
        Row below, and how far along the line of fall [m]; "" and None without one.
    """

    line: NetLine
    posts: Floats
    length: float
    slopes: Floats
    slope: Band
    flattest: float
    aspect: float
    upslope: Upslope
    bends: Floats
    above: FallLines
    ends: tuple[Upslope, ...]
    below_row: str = ""
    below_length: float | None = None

    @property
    def kinks(self) -> tuple[int, ...]:
        """Posts at which the row bends by more than a kink, from 1 on."""
        return tuple(int(place) + 2 for place in np.flatnonzero(self.bends > KINK))


@dataclass(frozen=True, slots=True)
class _DrawnRow:
    """A row with its posts and the lines of fall through them."""

    line: NetLine
    posts: Floats
    bends: Floats
    above: FallLines
    below: FallLines


def measure_plan(
    grid: Grid,
    plan: Plan,
    *,
    most: float,
    on_row: Callable[[object], None] | None = None,
) -> tuple[Surface, list[MeasuredRow]]:
    """Measure all rows of a plan on a grid; and the surface that served.

    Parameters
    ----------
    grid : Grid
        Heights.
    plan : Plan
        Rows, and the starting zones.
    most : float
        Cap on the upslope length [m].
    on_row : callable, optional
        Called after each row.

    Raises
    ------
    TerrainError
        With the faults of all rows at once: one leaves the grid or meets a hole, is
        shorter than a post spacing, or bends too much to be one row.

    Verified by
    -----------
    tests/addons/terrain/test_measure.py
    """
    surface = choose_window(grid, np.concatenate([line.points for line in plan.lines]))
    rows = []
    for drawn in _draw_rows(surface, plan, most):
        rows.append(_measure_row(surface, plan, drawn, most))
        if on_row is not None:
            on_row(drawn.line)
    return surface, rows


def _draw_rows(surface: Surface, plan: Plan, most: float) -> list[_DrawnRow]:
    """Posts of all rows; their lines of fall are followed at once."""
    drawn: list[tuple[NetLine, Floats, Floats]] = []
    faults: list[str] = []
    for line in plan.lines:
        try:
            posts = place_posts(surface, line)
        except TerrainError as error:
            faults.append(str(error))
            continue
        bends = find_bends(posts[:, :2])
        if bends.size and bends.max() > BROKEN:
            faults.append(_refuse_bend(line, bends))
        drawn.append((line, posts, bends))
    if faults:
        raise TerrainError("\n".join(faults))
    places = np.concatenate([posts[:, :2] for _, posts, _ in drawn])
    above = follow_fall(surface, places, most=most, is_up=True)
    below = follow_fall(surface, places, most=most, is_up=False)
    firsts = np.cumsum([0, *(len(posts) for _, posts, _ in drawn)]).tolist()
    parts = [slice(first, other) for first, other in pairwise(firsts)]
    return [
        _DrawnRow(line, posts, bends, above.take(part), below.take(part))
        for (line, posts, bends), part in zip(drawn, parts, strict=True)
    ]


def _measure_row(
    surface: Surface, plan: Plan, drawn: _DrawnRow, most: float
) -> MeasuredRow:
    line, posts, above, below = drawn.line, drawn.posts, drawn.above, drawn.below
    places = posts[:, :2]
    least, others = surface.grid.cell, _list_others(plan, line)
    crossed = _list_crossings(others, above, least)
    bench = min(line.net_height, LONGEST_BENCH)
    zone_ends = _list_zone_ends(plan, above)
    ends = tuple(
        _end_above(surface, above, post, most, bench, zone_ends[post], crossed[post])
        for post in range(len(posts))
    )
    slopes, reliefs = (
        np.array(
            [
                find_mean(*pair, post, end.length.value, line.net_height)
                for post, end in enumerate(ends)
            ]
        )
        for pair in (
            (above, below),
            (find_relief(surface, above), find_relief(surface, below)),
        )
    )
    gradient = surface.at(places).gradient.mean(axis=0)
    crossed_below = _list_crossings(others, below, least)
    nearest = [(at, name) for rows in crossed_below for name, at in rows.items()]
    length, row = min(nearest, default=(None, ""))
    return MeasuredRow(
        line=line,
        posts=posts,
        length=float(measure_along(posts)[-1]),
        slopes=slopes,
        slope=_band_slope(surface, slopes, reliefs, ends),
        flattest=_find_flattest(surface, places),
        aspect=math.atan2(-gradient[0], -gradient[1]) % (2.0 * math.pi),
        upslope=max(ends, key=lambda end: end.length.high),
        bends=drawn.bends,
        above=above,
        ends=ends,
        below_row=row,
        below_length=length,
    )


def _list_others(plan: Plan, line: NetLine) -> Rows:
    """Other rows and closed gaps, with their names."""
    others = [(row.id, row.points) for row in plan.lines if row.id != line.id]
    gaps = [gap for gap in plan.closed_gaps if line.id not in gap.rows]
    others += [(gap.rows[0], gap.points) for gap in gaps]
    names = [name for name, _ in others]
    return names, [shapely.LineString(points) for _, points in others]


def _list_crossings(
    others: Rows, lines: FallLines, least: float
) -> list[dict[str, float]]:
    """Lengths at which each line of fall crosses other rows and closed gaps [m]."""
    posts = range(lines.points.shape[1])
    return [find_first_crossings(lines, post, others, least=least) for post in posts]


def _find_flattest(surface: Surface, places: Floats) -> float:
    """Least slope angle at some places, less its error [rad]: there snow is deepest.

    Parameters
    ----------
    surface : Surface
        Ground.
    places : ndarray, shape (n, 2)
        [m].
    """
    error = _ERRORS * surface.slope_error
    return max(0.0, float(surface.at(places).steepness.min()) - error)


def _refuse_bend(line: NetLine, bends: Floats) -> str:
    angle, limit = map(math.degrees, (float(bends.max()), BROKEN))
    refusal = f"row {line.id} bends by {angle:.1f}° at post {int(bends.argmax()) + 2}"
    return f"{refusal}: above {limit:g}° draw two rows"


def place_posts(surface: Surface, line: NetLine) -> Floats:
    """Posts along a line by its spacing along the ground, shape (n, 3) [m].

    What is left of the line stands out half at each end: its direction says nothing.
    """
    drawn = shapely.LineString(line.points)
    fine = shapely.get_coordinates(shapely.segmentize(drawn, 0.5 * surface.grid.cell))
    heights = surface.at(fine).height
    if np.isnan(heights).any():
        at = fine[int(np.flatnonzero(np.isnan(heights))[0])]
        refusal = f"row {line.id} leaves the grid, or meets a hole in it, at"
        raise TerrainError(f"{refusal} {at[0]:.1f}, {at[1]:.1f}")
    ground = np.column_stack((fine, heights))
    along = measure_along(ground)
    count = math.floor(along[-1] / line.post_spacing + 1e-6) + 1
    if count < 2:
        refusal = (
            f"row {line.id} is {along[-1]:.1f} m long, shorter than its post spacing"
        )
        raise TerrainError(f"{refusal} of {line.post_spacing:g} m")
    left = max(0.0, float(along[-1]) - line.post_spacing * (count - 1))
    wanted = 0.5 * left + line.post_spacing * np.arange(count)
    return np.column_stack([np.interp(wanted, along, part) for part in ground.T])


def find_bends(places: Floats) -> Floats:
    """Angles by which a line turns at its inner points, shape (n - 2,) [rad]."""
    steps = np.diff(places, axis=0)
    headings = np.arctan2(steps[:, 1], steps[:, 0])
    turned = np.diff(headings)
    return np.abs((turned + math.pi) % (2.0 * math.pi) - math.pi)


def _end_above(
    surface: Surface,
    above: FallLines,
    post: int,
    most: float,
    bench: float,
    of_zone: float | None,
    rows: Mapping[str, float],
) -> Upslope:
    """First end of the snow above a post: a row, the zone's edge, flat ground."""
    spread = _ERRORS * surface.slope_error
    flat = [
        _find_flat(above, post, LEAST_STEEP + error, bench, most)
        for error in (spread, 0.0, -spread)
    ]
    followed, is_lost = above.find_length(post), bool(above.is_lost[post])
    # the ground beyond the grid is not known to end the snow
    ends = [("edge" if is_lost else "cap", "", most)]
    if followed < most and not is_lost:
        ends.append(("top", "", followed))
    ends += [("row", name, at) for name, at in rows.items()]
    if of_zone is not None:
        ends.append(("zone", "", of_zone))
    end, row, length = min(ends, key=lambda candidate: candidate[2])
    low, value, high = (min(at, length) for at in flat)
    if value < length:
        end, row = "flat", ""
    band = Band(low=low, value=value, high=high)
    steep = min(most if is_lost else followed, most, flat[1])
    return Upslope(length=band, end=end, row=row, steep=steep)


def _list_zone_ends(plan: Plan, above: FallLines) -> list[float | None]:
    """Lengths above the posts at which the zone ends [m]; None without a zone.

    Above a post beside the zone lies none of its snow: 0, if other posts have some.
    """
    zones = shapely.union_all(plan.zones)
    posts = range(above.points.shape[1])
    ends = [find_exit(above, post, zones) for post in posts]
    has_zone = any(end is not None for end in ends)
    return [0.0 if end is None and has_zone else end for end in ends]


def _find_flat(
    above: FallLines, post: int, least: float, bench: float, most: float
) -> float:
    """Length at which a line of fall becomes flatter than an angle [m].

    Flat ground shorter than a bench [m] does not count, but on a top: snow reaches
    across it.
    """
    angles, lengths = above.steepness[:, post], above.lengths[:, post]
    is_flat = np.concatenate(([False], angles < least, [False]))
    firsts = np.flatnonzero(is_flat[1:] & ~is_flat[:-1])
    afters = np.flatnonzero(is_flat[:-1] & ~is_flat[1:])
    last = int(np.isfinite(lengths).sum()) - 1
    for first, after in zip(firsts.tolist(), afters.tolist(), strict=True):
        is_top = after > last and lengths[last] < most and not above.is_lost[post]
        if lengths[min(after, last)] - lengths[first] < bench and not is_top:
            continue
        if first == 0:
            return 0.0
        share = (angles[first - 1] - least) / (angles[first - 1] - angles[first])
        return float(lengths[first - 1] + share * (lengths[first] - lengths[first - 1]))
    return math.inf


def _band_slope(
    surface: Surface, slopes: Floats, reliefs: Floats, ends: Sequence[Upslope]
) -> Band:
    """Slope of the steepest post with its errors by noise and relief, (T6)."""
    stretches = np.array([end.length.value for end in ends])
    windows = np.maximum(1.0, stretches / (surface.window * surface.grid.cell))
    spreads = _ERRORS * surface.slope_error / np.sqrt(windows) + reliefs
    steepest = int(np.argmax(slopes))
    value = float(slopes[steepest])
    high = float((slopes + spreads).max())
    return Band(low=value - float(spreads[steepest]), value=value, high=high)


def describe_kinks(row: MeasuredRow) -> str:
    """Sentence on the posts at which a row bends; empty for a straight one."""
    if not row.kinks:
        return ""
    posts = ", ".join(map(str, row.kinks))
    bend, limit = math.degrees(float(row.bends.max())), math.degrees(KINK)
    sentence = f"row {row.line.id} bends by up to {bend:.1f}° at post {posts}: beyond"
    return f"{sentence} {limit:g}° check such a post as the end of a row on both sides"


def describe_steep_above(row: MeasuredRow) -> str:
    """Sentence on steep ground beyond the zone's edge, whose snow does not count."""
    beyond = [end.steep - end.length.value for end in row.ends if end.end == "zone"]
    most = max(beyond, default=0.0)
    if most < _BEYOND:
        return ""
    sentence = f"Above row {row.line.id} the ground stays steep for {most:.0f} m beyond"
    return f"{sentence} the edge of the starting zone: its snow does not count"


def describe_end(upslope: Upslope) -> str:
    """Words on what ends the snow above a row."""
    return {
        "row": f"up to row {upslope.row}",
        "zone": "up to the edge of the starting zone",
        "flat": "up to where the ground is flatter than 25°",
        "cap": "the largest length that was looked for",
        "top": "up to a top",
        "edge": "the largest length, since it meets the edge of the grid or a hole "
        "in it and the ground beyond is not known",
    }[upslope.end]
