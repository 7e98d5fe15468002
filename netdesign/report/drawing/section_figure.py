"""Section of a net row to scale: slope, snow, net, support, forces, pressure."""

from __future__ import annotations

import math
from itertools import pairwise

from netdesign.numerics.curve import trace_curve
from netdesign.report.drawing.label_board import Box, Label, LabelBoard
from netdesign.report.drawing.plain_svg import (
    ACCENT,
    GREY,
    INK,
    PALE,
    SNOW,
    TEXT_PT,
    WIDTH,
    Chart,
    Frame,
    Point,
    drop_straight,
    measure_words,
)
from netdesign.report.drawing.section_measures import (
    LONGEST_ARROW,
    ROD,
    Paper,
    Section,
    describe_measures,
    draw_measures,
    fit_paper,
    move,
)
from netdesign.report.words import ENGLISH, Words, show_member
from netdesign.study.support_records import Arrow, Drawing

SLIP_DASH = "2.2 1.5"  # of the net where the snow slips on it
_LEGEND = (
    ("drawing.net_sticks", INK, 1.8, ""),
    ("drawing.net_slips", INK, 1.8, SLIP_DASH),
    ("drawing.force_on_ground", ACCENT, 1.5, ""),
)
_LEGEND_TOP, _LEGEND_LINE = 12.0, 13.0
LEGEND_BOTTOM = _LEGEND_TOP + len(_LEGEND) * _LEGEND_LINE
_KEY, _EDGE = 19.0, 8.0  # length of a line of the legend, room beside it [pt]


def draw_scale_bar(sketch: Chart, paper: Paper, board: LabelBoard) -> None:
    """Bar of a round length near one inch, at the lower left."""
    inch = 72.0 / paper.scale
    length = max(step for step in (0.5, 1, 2, 5, 10) if step <= max(0.5, 0.9 * inch))
    left, bottom = _EDGE, paper.height - 6.0
    right = left + length * paper.scale
    sketch.line([(left, bottom), (right, bottom)], width=1.6)
    middle = ((left + right) / 2, bottom - 4.5)
    sketch.text(*middle, f"{sketch.write_tick(length)} m", anchor="middle")
    board.reserve(Box(left, bottom - 2 * TEXT_PT, right, bottom))


def draw_legend(sketch: Chart, words: Words, board: LabelBoard) -> None:
    """Explain the lines; the words end at them, however wide their font is."""
    right = WIDTH - _EDGE
    for place, (key, stroke, width, dash) in enumerate(_LEGEND):
        y = _LEGEND_TOP + _LEGEND_LINE * place
        ends = [(right - _KEY, y), (right, y)]
        sketch.line(ends, stroke=stroke, width=width, dash=dash)
        end = right - _KEY - 6.0
        sketch.text(end, y + 2.6, words(key), anchor="end")
        left = end - measure_words(words(key), TEXT_PT)
        board.reserve(Box(left, y - TEXT_PT, WIDTH, y + 5.0))


CHART_WIDTH = 150.0  # of all that stands right of the section [pt]
_CHART_LEFT, _CHART_HEIGHT = WIDTH - 112.0, 52.0
_TITLES = 2.6 * TEXT_PT  # two lines above the chart
CHART_BOTTOM = LEGEND_BOTTOM + _TITLES + _CHART_HEIGHT + 4.0 * TEXT_PT


def list_pressures(drawing: Drawing) -> list[Point]:
    """Pressure [kPa] and height above the slope [m] where both are known."""
    pairs = zip(drawing.pressure_kPa, drawing.net_m, strict=False)
    return [(pressure, y) for pressure, (_, y) in pairs if pressure is not None]


def draw_pressure(
    sketch: Chart, drawing: Drawing, words: Words, board: LabelBoard
) -> None:
    """Pressure to the right, height upwards; nothing where no pressure is known."""
    known = list_pressures(drawing)
    if len(known) < 2:
        return
    top = LEGEND_BOTTOM + _TITLES + 10.0
    right = WIDTH - 8.0
    title = top - 2.1 * TEXT_PT
    sketch.text(right, title, words("drawing.pressure"), anchor="end", bold=True)
    line = (right, title + 1.2 * TEXT_PT)
    sketch.text(*line, words("drawing.over_height"), anchor="end")
    frame = Frame(
        left=_CHART_LEFT,
        top=top,
        width=right - _CHART_LEFT,
        height=_CHART_HEIGHT,
        x_low=min(0.0, *(pressure for pressure, _ in known)),
        x_high=1.05 * max(0.1, *(pressure for pressure, _ in known)),
        y_low=0.0,
        y_high=max(drawing.head_m[1], known[-1][1]),
    )
    sketch.axes(frame)
    points = frame.place(known)
    edge = [(frame.x(0.0), points[0][1]), *points, (frame.x(0.0), points[-1][1])]
    sketch.area(edge, "#f1dfda")
    sketch.line(points, stroke=ACCENT, width=1.2)
    board.reserve(Box(WIDTH - CHART_WIDTH, LEGEND_BOTTOM, WIDTH, CHART_BOTTOM))


def describe_pressure(drawing: Drawing, words: Words) -> list[str]:
    """Least and largest pressure in words; nothing where none is known."""
    known = [pressure for pressure, _ in list_pressures(drawing)]
    if len(known) < 2:
        return []
    label, text = words("drawing.pressure"), words.show_range(known)
    return [words("show.label", label=label, text=text)]


_SHORTEST_ARROW = 0.14  # heights of the head
_SLACK = 1e-3  # of the largest force; below it there is no arrow
_ASIDE = (-1.0, 0.4)  # where the label of a force stands best
_CHORDS = 6  # straight pieces that are drawn between two nodes of the net


Named = tuple[tuple[str, str], ...]  # lines of a label with their colours


def draw_section(drawing: Drawing, name: str, words: Words = ENGLISH) -> str:
    """SVG of the section in the case of ``drawing``; ``name`` keeps its ids apart."""
    frame = Section(slope=math.radians(drawing.slope_deg), drawing=drawing)
    has_pressure = len(list_pressures(drawing)) > 1
    paper = fit_paper(frame, CHART_BOTTOM if has_pressure else LEGEND_BOTTOM)
    board = LabelBoard(width=WIDTH, height=paper.height)
    sketch = Chart(language=words.language)
    _draw_snow(sketch, paper, f"{name}-snow")
    _draw_ground(sketch, paper)
    draw_legend(sketch, words, board)
    draw_pressure(sketch, drawing, words, board)
    draw_scale_bar(sketch, paper, board)
    measures = draw_measures(sketch, paper, words, board)
    _draw_support(sketch, paper)
    _draw_net(sketch, paper)
    forces = [_draw_arrow(sketch, paper, arrow, words) for arrow in drawing.arrows]
    sketch.dot(paper.at(drawing.head_m), 1.9, fill="#fff")
    _avoid_members(board, paper)
    for label in (*measures, *forces):
        board.draw(sketch, label)
    return sketch.write(paper.height, _describe(paper, words))


def _describe(paper: Paper, words: Words) -> str:
    """Words for what the drawing says, with its numbers."""
    drawing = paper.frame.drawing
    values = describe_measures(paper, words)
    for arrow in drawing.arrows:
        size = math.hypot(arrow.force_x_kN, arrow.force_y_kN)
        member = show_member(words, arrow.member)
        force = words.show_with_unit("max_kN", size)
        values.append(words("show.force_of", member=member, force=force))
    values += describe_pressure(drawing, words)
    what = words("drawing.section")
    return words("drawing.with_values", what=what, values=tuple(values))


def _avoid_members(board: LabelBoard, paper: Paper) -> None:
    """Keep labels off the lines that matter."""
    drawing, frame = paper.frame.drawing, paper.frame
    head = drawing.head_m
    for start in (
        drawing.uphill_anchor_m,
        drawing.downhill_anchor_m,
        drawing.post_base_m,
    ):
        board.avoid(paper.all_at([start, head]))
    board.avoid(paper.all_at(drawing.net_m))
    board.avoid(paper.all_at([(frame.top_end, 0.0), (frame.low_end, 0.0)]))
    for arrow in drawing.arrows:
        at = (arrow.x_m, arrow.y_m)
        size = math.hypot(arrow.force_x_kN, arrow.force_y_kN) or 1.0
        along = (arrow.force_x_kN / size, arrow.force_y_kN / size)
        reach = LONGEST_ARROW if along[1] < 0 else -ROD
        board.avoid(paper.all_at([at, move(at, along, reach * frame.unit)]))


def _draw_snow(sketch: Chart, paper: Paper, name: str) -> None:
    drawing, top_end = paper.frame.drawing, paper.frame.top_end
    thickness = drawing.snow_thickness_m
    net = [point for piece in trace_curve(drawing.net_m, _CHORDS) for point in piece]
    covered = [(x, y) for x, y in net if y <= thickness]
    surface = [(covered[-1][0], thickness), (top_end, thickness)]
    curve = drop_straight(paper.all_at(covered))
    outline = [paper.at((top_end, 0.0)), *curve, *paper.all_at(surface)]
    sketch.area(outline, SNOW)
    sketch.clip_area(name, outline)
    edges = (
        (paper.at((x1, y1)), paper.at((x2, y2)))
        for x1, y1, x2, y2 in drawing.mesh_edges_m
        if max(x1, x2) > top_end
    )
    sketch.segments(edges, stroke=PALE, width=0.3, clip=name)
    sketch.line(paper.all_at(surface), stroke=GREY, width=0.6)


def _draw_ground(sketch: Chart, paper: Paper) -> None:
    frame = paper.frame
    start, end = frame.top_end, frame.low_end
    step, depth = 0.11 * frame.unit, 0.05 * frame.unit
    ticks = (
        (paper.at((start + (i + 1) * step, 0.0)), paper.at((start + i * step, -depth)))
        for i in range(int((end - start) / step))
    )
    sketch.segments(ticks, stroke=PALE, width=0.5)
    sketch.line(paper.all_at([(start, 0.0), (end, 0.0)]), width=1.0)


def _draw_support(sketch: Chart, paper: Paper) -> None:
    drawing, reach = paper.frame.drawing, 0.09 * paper.frame.unit
    for anchor in (drawing.uphill_anchor_m, drawing.downhill_anchor_m):
        sketch.line(paper.all_at([anchor, drawing.head_m]), width=0.7)
    post = [drawing.post_base_m, drawing.head_m]
    sketch.line(paper.all_at(post), width=2.6)
    x, _ = drawing.post_base_m
    sketch.line(paper.all_at([(x - reach, 0.0), (x + reach, 0.0)]), width=2.6)


def _draw_net(sketch: Chart, paper: Paper) -> None:
    pieces = trace_curve(paper.frame.drawing.net_m, _CHORDS)
    sticks = [a and b for a, b in pairwise(paper.frame.drawing.sticks)]
    start = 0
    for i in range(1, len(sticks) + 1):
        if i == len(sticks) or sticks[i] != sticks[start]:
            run = [point for piece in pieces[start:i] for point in piece]
            dash = "" if sticks[start] else SLIP_DASH
            sketch.line(drop_straight(paper.all_at(run)), width=1.8, dash=dash)
            start = i


def _draw_arrow(sketch: Chart, paper: Paper, arrow: Arrow, words: Words) -> Label:
    """Draw force and anchor; a force into the ground ends there, others pull up."""
    frame = paper.frame
    size = math.hypot(arrow.force_x_kN, arrow.force_y_kN)
    largest = max(math.hypot(a.force_x_kN, a.force_y_kN) for a in frame.drawing.arrows)
    start = (arrow.x_m, arrow.y_m)
    member = (show_member(words, arrow.member), INK)
    if size <= _SLACK * largest:  # no arrow of 0.00 kN
        return _draw_anchor(sketch, paper, start, _aim(frame, start), (member,))
    named = (member, (words.show_with_unit("max_kN", size), ACCENT))
    along = (arrow.force_x_kN / size, arrow.force_y_kN / size)
    length = frame.unit * max(LONGEST_ARROW * size / largest, _SHORTEST_ARROW)
    tip = move(start, along, length)
    into_ground = along[1] < 0
    label = Label(lines=named, at=paper.at(tip), toward=_ASIDE)
    if not into_ground:
        label = _draw_anchor(sketch, paper, start, along, named)
    sketch.arrow(paper.at(start), paper.at(tip))
    return label


def _aim(frame: Section, start: Point) -> Point:
    """Direction from an anchor to the head."""
    target = frame.drawing.head_m
    length = math.dist(start, target)
    return (target[0] - start[0]) / length, (target[1] - start[1]) / length


def _draw_anchor(
    sketch: Chart, paper: Paper, start: Point, along: Point, named: Named
) -> Label:
    """Rod in the ground, against the pull; its label hangs at its end."""
    rod = move(start, along, -ROD * paper.frame.unit)
    sketch.line(paper.all_at([start, rod]), stroke=INK, width=1.8)
    sketch.dot(paper.at(start), 1.8)
    return Label(lines=named, at=paper.at(rod), toward=_ASIDE)
