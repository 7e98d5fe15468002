"""Page of `netdesign terrain`: maps, a table, and a profile of each row."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

import numpy as np
import shapely
from contourpy import contour_generator

from netdesign.addons.charts import draw_tiles
from netdesign.addons.terrain.coverage import Coverage
from netdesign.addons.terrain.measure import (
    MeasuredRow,
    describe_end,
    describe_kinks,
    describe_steep_above,
)
from netdesign.addons.terrain.plan import Plan
from netdesign.addons.terrain.surface import Surface, measure_along
from netdesign.numerics.arrays import Floats
from netdesign.report.blocks import (
    Column,
    Figure,
    Paragraph,
    Part,
    Table,
    fixed_cell,
    masthead,
    notes,
    section,
    text_cell,
)
from netdesign.report.drawing.label_board import LabelBoard, write_label
from netdesign.report.drawing.plain_svg import (
    GREY,
    INK,
    TEXT_PT,
    WIDTH,
    Chart,
    Frame,
    show_place,
)
from netdesign.report.page import render_page
from netdesign.report.words import Words, show_text

SLOPE_CLASSES = (25, 30, 35, 40, 45, 50)  # lower ends of the classes [deg]
_TILES = 130  # on the longer side of a map
_MARGIN = 15.0  # of ground around rows and zones [m]
_SUN = (math.radians(315.0), math.radians(45.0))  # azimuth, height: as on most maps
_CONTOURS = (1, 2, 5, 10, 20, 50, 100)  # distances of contours [m]
_MOST_CONTOURS = 25
_HEIGHT = 420.0  # of a map, at most [pt]
_ALONG = 12.0  # of a profile beyond net and snow [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class Extract:
    """Ground of a map on squares, from south to north and west to east.

    Attributes
    ----------
    frame : Frame
        Of the map; its axes are east and north [m].
    side : float
        Of a square [m].
    heights, gradient : ndarray, shape (m, n) and (m, n, 2)
        At their middles [m, -].
    """

    frame: Frame
    side: float
    heights: Floats
    gradient: Floats


def extract_ground(surface: Surface, plan: Plan) -> Extract:
    """Ground around the rows and zones of a plan."""
    lines = [line.points for line in plan.lines]
    points = np.concatenate([*lines, shapely.get_coordinates(plan.zones)])
    low, high = points.min(axis=0) - _MARGIN, points.max(axis=0) + _MARGIN
    width, height = high - low
    side = max(surface.grid.cell, float(max(width, height)) / _TILES)
    east = np.arange(low[0] + side / 2.0, high[0], side)
    north = np.arange(low[1] + side / 2.0, high[1], side)
    mesh = np.meshgrid(east, north)
    ground = surface.at(np.column_stack([axis.ravel() for axis in mesh]))
    room = min(WIDTH - 40.0, _HEIGHT * width / height)
    frame = Frame(
        left=(WIDTH - room) / 2.0,
        top=6.0,
        width=room,
        height=room * height / width,
        x_low=float(low[0]),
        x_high=float(high[0]),
        y_low=float(low[1]),
        y_high=float(high[1]),
    )
    shape = (len(north), len(east))
    return Extract(
        frame=frame,
        side=side,
        heights=ground.height.reshape(shape),
        gradient=ground.gradient.reshape(*shape, 2),
    )


def draw_map(
    extract: Extract,
    plan: Plan,
    rows: Sequence[MeasuredRow],
    coverage: Coverage,
) -> str:
    """Relief with contours, rows, lines of fall, zones, and what no row holds."""
    chart = Chart(language="en")
    _paint(chart, extract, _shade_relief(extract))
    _hatch(chart, extract.frame, coverage)
    step = _draw_contours(chart, extract)
    for zone in plan.zones:
        ring = shapely.get_coordinates(zone)
        chart.line(extract.frame.place(ring), width=1.2, dash="6 3")
    for row in rows:
        for post, end in enumerate(row.ends):
            lengths = row.above.lengths[:, post]
            path = row.above.points[lengths <= end.length.value, post]
            chart.line(extract.frame.place(path), stroke=GREY, width=0.4)
    _draw_rows(chart, extract.frame, rows)
    below = _draw_scale(chart, extract.frame)
    chart.text(extract.frame.left, below, f"contours every {step:g} m")
    return chart.write(below + 8.0, "Map")


def draw_slopes(extract: Extract, rows: Sequence[MeasuredRow]) -> str:
    """Slope classes in greys, with the rows."""
    chart = Chart(language="en")
    angles = np.degrees(np.arctan(np.hypot(*np.moveaxis(extract.gradient, -1, 0))))
    classes = np.searchsorted(SLOPE_CLASSES, angles, side="right").astype(float)
    classes[~np.isfinite(angles)] = math.nan
    _paint(chart, extract, 1.0 - 0.7 * classes / len(SLOPE_CLASSES))
    _draw_rows(chart, extract.frame, rows)
    below = _draw_scale(chart, extract.frame) + 6.0
    width = extract.frame.width / (len(SLOPE_CLASSES) + 1)
    for place in range(len(SLOPE_CLASSES) + 1):
        left = extract.frame.left + place * width
        fill = _grey(1.0 - 0.7 * place / len(SLOPE_CLASSES))
        draw_tiles(chart, [(left, below, width + 0.2, 9.0, fill)])
        first = f"{SLOPE_CLASSES[place - 1]}°" if place else "0°"
        chart.text(left + 1.0, below + 10.0 + TEXT_PT, first)
    return chart.write(below + 16.0 + TEXT_PT, "Slope classes")


def draw_profile(row: MeasuredRow) -> str:
    """Profile of the ground along the line of fall of the steepest post."""
    post = int(np.argmax(row.slopes))
    above = row.above
    is_known = np.isfinite(above.lengths[:, post])
    end = row.ends[post].length.value
    keep = is_known & (above.lengths[:, post] <= end + _ALONG)
    points, heights = above.points[keep, post], above.heights[keep, post]
    out = measure_along(points)
    slope, high = float(row.slopes[post]), row.line.net_height
    head = (high * math.sin(slope), heights[0] + high * math.cos(slope))
    span, rise = float(out[-1]) + 4.0, float(np.ptp(heights)) + high + 2.0
    room = min(WIDTH - 80.0, 230.0 * span / rise)
    frame = Frame(
        left=50.0,
        top=6.0,
        width=room,
        height=room * rise / span,
        x_low=-4.0,
        x_high=float(out[-1]),
        y_low=float(heights.min()) - 0.5,
        y_high=float(heights.min()) - 0.5 + rise,
    )
    chart = Chart(language="en")
    chart.axes(frame)
    chart.line(frame.place(zip(out, heights, strict=True)))
    net = [(0.0, float(heights[0])), (-head[0], head[1])]
    chart.line(frame.place(net), width=2.0)
    at = float(np.interp(end, above.lengths[keep, post], out))
    top = frame.y(float(np.interp(at, out, heights)))
    chart.line([(frame.x(at), top - 12.0), (frame.x(at), top)], dash="2 2")
    label = f"post {post + 1}, mean slope {math.degrees(slope):.1f}°"
    chart.text(frame.left + 6.0, frame.top + TEXT_PT, label)
    return chart.write(frame.top + frame.height + 24.0, name_profile(row))


def name_profile(row: MeasuredRow) -> str:
    """Caption of a row's profile."""
    caption = "ground along the line of fall, net and end of its snow; axes in metres"
    return f"Row {row.line.id}: {caption}"


def _shade_relief(extract: Extract) -> Floats:
    """Light on the ground from the north-west, 0.25 to 1 [-]."""
    east, north = np.moveaxis(extract.gradient, -1, 0)
    azimuth, height = _SUN
    sun = (math.sin(azimuth), math.cos(azimuth))
    towards = -(east * sun[0] + north * sun[1]) * math.cos(height) + math.sin(height)
    light = towards / np.sqrt(1.0 + east**2 + north**2)
    return np.asarray(0.45 + 0.55 * np.clip(light, 0.0, 1.0))


def _paint(chart: Chart, extract: Extract, light: Floats) -> None:
    """Squares of a grey each, those alike in a column as one."""
    frame, side = extract.frame, extract.side
    width, height = (side * frame.width / (frame.x_high - frame.x_low),) * 2
    levels = np.round(np.where(np.isfinite(light), light, 2.0) * 24.0) / 24.0
    tiles = (
        (
            frame.left + column * width,
            frame.top + frame.height - (first + count) * height,
            width + 0.2,
            count * height + 0.2,
            _grey(level) if level <= 1.0 else "#fff",
        )
        for column in range(levels.shape[1])
        for first, count, level in _list_runs(levels[:, column])
    )
    draw_tiles(chart, tiles)


def _list_runs(values: Floats) -> Iterator[tuple[int, int, float]]:
    """First place, number and value of alike values in turn."""
    place = 0
    for value, group in groupby(values.tolist()):
        count = len(list(group))
        yield place, count, value
        place += count


def _grey(level: float) -> str:
    return "#" + f"{round(255 * min(1.0, max(0.0, level))):02x}" * 3


def _hatch(chart: Chart, frame: Frame, coverage: Coverage) -> None:
    """Crosses on the ground that no row holds."""
    scale = frame.width / (frame.x_high - frame.x_low)  # [pt/m]
    every = max(1, round(9.0 / (coverage.side * scale)))
    places = np.rint(coverage.places / coverage.side).astype(int)
    shown = coverage.places[(places % every == 0).all(axis=1)]
    path = "".join(
        f"M{show_place(frame.x(x) - 2)} {show_place(frame.y(y) - 2)}l4 4m0 -4l-4 4"
        for x, y in shown
    )
    if path:
        chart.shapes.append(f'<path d="{path}" stroke="{INK}" stroke-width="0.6"/>')


def _draw_contours(chart: Chart, extract: Extract) -> float:
    """Draw contours at a round distance, 25 at most; the distance [m]."""
    heights = extract.heights[np.isfinite(extract.heights)]
    low, high = float(heights.min()), float(heights.max())
    few = (high - low) / _MOST_CONTOURS
    step = next((step for step in _CONTOURS if step >= few), _CONTOURS[-1])
    frame = extract.frame
    lines, columns = extract.heights.shape
    east = frame.x_low + extract.side * (np.arange(columns) + 0.5)
    north = frame.y_low + extract.side * (np.arange(lines) + 0.5)
    drawn = contour_generator(east, north, np.ma.masked_invalid(extract.heights))
    path = "".join(
        "M" + "L".join(f"{show_place(x)} {show_place(y)}" for x, y in frame.place(line))
        for level in np.arange(math.ceil(low / step) * step, high, step)
        for line in map(np.asarray, drawn.lines(float(level)))
    )
    look = f'stroke="{GREY}" stroke-width="0.4" fill="none"'
    chart.shapes.append(f'<path d="{path}" {look}/>')
    return float(step)


def _draw_rows(chart: Chart, frame: Frame, rows: Sequence[MeasuredRow]) -> None:
    """Rows, each with its name above its middle where that is free."""
    board = LabelBoard(width=WIDTH, height=frame.top + frame.height)
    paths = [frame.place(row.posts) for row in rows]
    for path in paths:
        chart.line(path, width=2.4)
        board.avoid(path)
    for row, path in zip(rows, paths, strict=True):
        up = (-math.sin(row.aspect), math.cos(row.aspect))
        board.draw(chart, write_label(row.line.id, path[len(path) // 2], up))


def _draw_scale(chart: Chart, frame: Frame) -> float:
    """North arrow and scale below a map; where the next line of text stands [pt]."""
    below = frame.top + frame.height + 12.0
    span = frame.x_high - frame.x_low
    length = next(
        metres for metres in (200, 100, 50, 20, 10, 5) if metres <= span / 4.0
    )
    end = frame.left + frame.width
    start = end - length / span * frame.width
    chart.line([(start, below), (end, below)], width=2.0)
    chart.text(start - 4.0, below + TEXT_PT / 3, f"{length} m", anchor="end")
    left = frame.left
    chart.line([(left + 3.0, below + 6.0), (left + 3.0, below - 8.0)], width=1.2)
    tip = [(left, below - 4.0), (left + 3.0, below - 9.0), (left + 6.0, below - 4.0)]
    chart.line(tip, width=1.2)
    chart.text(left + 9.0, below + TEXT_PT / 3, "N")
    return below + 20.0


_TITLE = "Net rows on the terrain"
_MAP = (
    "Relief with contours; rows thick, lines of fall up to the end of their snow thin, "
    "starting zones dashed. Crosses: steeper than 25° and held by no row."
)
_SLOPES = (
    "Slope angle in classes, the darker the steeper; a class begins at the number on "
    "its left."
)
_NUMBERS = (
    *("Slope of the steepest post [°]", "Its band [°]", "Mean of the posts [°]"),
    *("Aspect [°]", "Altitude [m]", "Length [m]", "Posts", "Upslope length [m]"),
)
_TEXTS = ("It ends", "Row below, distance [m]", "Kinks at posts")
# Names on the maps are read on paper and on a telephone.
_STYLE = """
p { overflow-wrap: anywhere; }
@media screen and (max-width: 620px) { .plate svg { width: 640px; } }
@media print { .plate svg { width: 100%; } }
"""


def render_terrain(
    surface: Surface,
    plan: Plan,
    rows: Sequence[MeasuredRow],
    coverage: Coverage,
    grid: tuple[str, str],
) -> bytes:
    """Page of rows on terrain.

    Parameters
    ----------
    surface, plan, rows, coverage
        What was measured.
    grid : tuple of str
        Name of the grid's file, and its SHA-256.
    """
    words = Words("en")
    extract = extract_ground(surface, plan)
    sentences = (
        find(row) for row in rows for find in (describe_kinks, describe_steep_above)
    )
    kinks = [sentence for sentence in sentences if sentence]
    maps = (
        (draw_map(extract, plan, rows, coverage), _MAP),
        (draw_slopes(extract, rows), _SLOPES),
    )
    profiles = ((draw_profile(row), name_profile(row)) for row in rows)
    first = _describe_grid(surface, coverage, grid)
    blocks = (
        masthead("netdesign terrain", _TITLE),
        Part(id="grid", blocks=(*(Paragraph(text=sentence) for sentence in first),)),
        section("map", "Map", *_show(maps)),
        section(
            "rows",
            "Rows",
            _tabulate(rows, words).shown("study"),
            *([notes(*kinks, look="notes open")] if kinks else []),
        ),
        section("profiles", "Profiles", *_show(profiles)),
    )
    return render_page(blocks, _TITLE, "en", style=_STYLE).encode()


def _show(drawings: Iterable[tuple[str, str]]) -> Iterator[Figure]:
    for svg, caption in drawings:
        yield Figure(svg=svg, caption=caption, look="plate")


def _describe_grid(
    surface: Surface, coverage: Coverage, grid: tuple[str, str]
) -> list[str]:
    """Sentences on the grid, its fit, and the coverage of the starting zones."""
    name, sha256 = grid
    cells = f"{surface.window} x {surface.window} cells of {surface.grid.cell:g} m"
    first = [
        f"Grid {show_text(name)}, SHA-256 {sha256}.",
        f"A quadratic is fitted to {cells} around each point. The heights leave it by "
        f"{surface.noise:.2g} m (standard deviation).",
    ]
    return [*first, coverage.sentence] if coverage.area else first


def _tabulate(rows: Sequence[MeasuredRow], words: Words) -> Table:
    lines = []
    for row in rows:
        slope, below = row.slope, row.below_length
        ends = (f"{math.degrees(end):.1f}" for end in (slope.low, slope.high))
        near = "-" if below is None else f"{row.below_row}, {below:.1f}"
        lines.append(
            (
                text_cell(row.line.id),
                fixed_cell(words, math.degrees(slope.value), 1),
                text_cell("–".join(ends)),
                fixed_cell(words, math.degrees(float(row.slopes.mean())), 1),
                fixed_cell(words, math.degrees(row.aspect), 0),
                fixed_cell(words, float(row.posts[:, 2].max()), 0),
                fixed_cell(words, row.length, 1),
                fixed_cell(words, len(row.posts), 0),
                fixed_cell(words, row.upslope.length.value, 1),
                text_cell(describe_end(row.upslope)),
                text_cell(near),
                text_cell(", ".join(map(str, row.kinks)) or "-"),
            )
        )
    columns = (
        Column(heading="Row"),
        *(Column(heading=heading, is_number=True) for heading in _NUMBERS),
        *(Column(heading=heading) for heading in _TEXTS),
    )
    caption = "What the grid says of each row"
    return Table(caption=caption, columns=columns, rows=tuple(lines))
