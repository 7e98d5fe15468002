"""Section of a net row to scale, with the largest design force at each anchor."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from netdesign.numerics.curve import trace_curve
from netdesign.report.drawing.label_board import Box, Label, LabelBoard
from netdesign.report.drawing.plain_svg import (
    BLUE,
    GREY,
    INK,
    SNOW,
    SOFT,
    TEXT_PT,
    Chart,
    Point,
    drop_straight,
)
from netdesign.report.drawing.section_measures import (
    BORE,
    LONGEST_ARROW,
    PAPER,
    Paper,
    Section,
    draw_measures,
    fit_paper,
    list_distances,
    move,
    show_heights,
)
from netdesign.report.words import ENGLISH, Words, show_member
from netdesign.study.case_records import Drawing, PullRecord

# Design force [kN] and utilisation in words, by member.
Forces = Mapping[str, tuple[float, str]]
_SHORTEST_ARROW = 6.0  # [pt]
_CHORDS = 6  # straight pieces that are drawn between two nodes of the net
_DOT = 2.0  # radius of a point on the ground [pt]
_FROM_DOT = 2.4  # between a point on the ground and the start of its arrow [pt]
_LENGTHS = (0.5, 1.0, 2.0, 5.0, 10.0)  # of the scale bar [m]
_ROUND = (1.0, 2.0, 5.0)  # first digits of the force that its arrow measures


@dataclass(frozen=True, slots=True)
class _Plate:
    """Paper with what is drawn on it, and the forces that it shows."""

    sketch: Chart
    paper: Paper
    board: LabelBoard
    forces: Forces
    words: Words

    @property
    def most(self) -> float:
        """Largest force [kN]."""
        return max((force for force, _ in self.forces.values()), default=0.0)


def draw_section(
    drawing: Drawing,
    pulls: Sequence[PullRecord],
    forces: Forces,
    words: Words = ENGLISH,
) -> str:
    """SVG of the section.

    Parameters
    ----------
    drawing : Drawing
        Net under load in the governing case, and the points of the support.
    pulls : sequence of PullRecord
        Directions of pulls and bores of the anchors.
    forces : mapping
        Largest design force of each member [kN], over all cases and supports, with its
        utilisation as text.
    words : Words
        Of the language.
    """
    frame = Section(slope=math.radians(drawing.slope_deg), drawing=drawing)
    paper = fit_paper(frame)
    board = LabelBoard(width=PAPER, height=paper.height)
    plate = _Plate(Chart(language=words.language), paper, board, forces, words)
    _draw_ground(plate)
    measures = draw_measures(plate.sketch, paper, words, board)
    _draw_support(plate)
    labels = list(_draw_forces(plate, pulls))
    _draw_scales(plate)
    for label in (*labels, *measures):
        board.draw(plate.sketch, label)
    return plate.sketch.write(paper.height, _describe(plate), PAPER)


def _describe(plate: _Plate) -> str:
    """Words for what the drawing says, with its numbers."""
    paper, words = plate.paper, plate.words
    lengths = [
        words.show_with_unit("snow_thickness_m", right - left)
        for left, right in list_distances(paper)
    ]
    values = [
        words.show_with_unit("slope_deg", paper.frame.drawing.slope_deg),
        *show_heights(paper, words),
        words("drawing.distances", lengths=tuple(lengths)),
        *(
            words("show.label", label=show_member(words, member), text=text)
            for member, (_, text) in plate.forces.items()
        ),
    ]
    what = words("drawing.section")
    return words("drawing.with_values", what=what, values=tuple(values))


def _draw_ground(plate: _Plate) -> None:
    """Snow behind the net, and the line of the ground."""
    sketch, paper = plate.sketch, plate.paper
    frame, drawing = paper.frame, paper.frame.drawing
    thickness, top = drawing.snow_thickness_m, frame.top_end
    net = [point for piece in trace_curve(drawing.net_m, _CHORDS) for point in piece]
    covered = [(x, y) for x, y in net if y <= thickness]
    surface = [(covered[-1][0], thickness), (top, thickness)]
    curve = drop_straight(paper.all_at(covered))
    sketch.area(
        [paper.at((frame.snow_foot, 0.0)), *curve, *paper.all_at(surface)], SNOW
    )
    sketch.line(paper.all_at(surface), stroke=GREY, width=0.6, dash="3 2")
    start, end = top, frame.low_end
    step, depth = 0.16 * frame.unit, 0.05 * frame.unit
    ticks = (
        (paper.at((start + (i + 1) * step, 0.0)), paper.at((start + i * step, -depth)))
        for i in range(int((end - start) / step))
    )
    sketch.segments(ticks, stroke=GREY, width=0.4)
    sketch.line(paper.all_at([(start, 0.0), (end, 0.0)]), width=1.1)
    sketch.line(drop_straight(paper.all_at(net)), width=1.3)


def _draw_support(plate: _Plate) -> None:
    """Guys and post; labels keep off the lines that matter."""
    paper, board = plate.paper, plate.board
    drawing, frame = paper.frame.drawing, paper.frame
    post = paper.all_at([drawing.post_base_m, drawing.head_m])
    for anchor in (drawing.uphill_anchor_m, drawing.downhill_anchor_m):
        guy = paper.all_at([anchor, drawing.head_m])
        plate.sketch.line(guy, width=0.7)
        board.avoid(guy)
    plate.sketch.line(post, width=3.2)
    plate.sketch.line(post, width=1.8, stroke="#ffffff")
    board.avoid(post)
    board.avoid(paper.all_at(drawing.net_m))
    board.avoid(paper.all_at([(frame.top_end, 0.0), (frame.low_end, 0.0)]))


def _draw_forces(plate: _Plate, pulls: Sequence[PullRecord]) -> Iterator[Label]:
    """Arrows and bores at the points of the ground; their labels."""
    drawing = plate.paper.frame.drawing
    places = {
        "foot_anchor": (drawing.net_m[0], 1.0),
        "uphill_anchor": (drawing.uphill_anchor_m, 1.0),
        "downhill_anchor": (drawing.downhill_anchor_m, -1.0),
    }
    for pull in pulls:
        if pull.anchor not in places:
            continue
        start, side = places.pop(pull.anchor)
        axis = (-side * math.cos(pull.axis), -math.sin(pull.axis))
        _draw_bore(plate, start, axis)
        angle = math.radians((pull.least_deg + pull.largest_deg) / 2.0)
        along = (side * math.cos(angle), math.sin(angle))
        yield from _draw_force(plate, start, along, pull.anchor)
    base, head = drawing.post_base_m, drawing.head_m
    length = math.dist(base, head) or 1.0
    along = ((base[0] - head[0]) / length, (base[1] - head[1]) / length)
    yield from _draw_force(plate, base, along, "post_base")
    for start, _ in places.values():
        plate.sketch.dot(plate.paper.at(start), _DOT, fill="#ffffff")


def _draw_bore(plate: _Plate, start: Point, axis: Point) -> None:
    """Rod in the ground along its axis, cut short."""
    reach, paper = BORE * plate.paper.frame.unit, plate.paper
    ends = paper.all_at([move(start, axis, share * reach) for share in (0.0, 0.75, 1)])
    plate.sketch.line(ends[:2], width=1.8)
    plate.sketch.line(ends[1:], width=1.8, dash="2 2")
    plate.board.avoid([ends[0], ends[2]])


def _draw_force(
    plate: _Plate, start: Point, along: Point, member: str
) -> Iterator[Label]:
    """Arrow of a design force; its label hangs at the point on the ground."""
    paper = plate.paper
    force, text = plate.forces.get(member, (0.0, ""))
    if force > 0.0:
        longest = LONGEST_ARROW * paper.frame.unit
        length = max(longest * force / plate.most, _SHORTEST_ARROW / paper.scale)
        gap = _FROM_DOT / paper.scale
        ends = [paper.at(move(start, along, x)) for x in (gap, gap + length)]
        plate.sketch.arrow(ends[0], ends[1], stroke=BLUE, width=1.7)
        plate.board.avoid(ends)
    plate.sketch.dot(paper.at(start), _DOT, fill="#ffffff")
    if text:
        lines = ((show_member(plate.words, member), INK), (text, BLUE))
        toward = (0.6, -1.0) if member == "uphill_anchor" else (-1.0, 0.25)
        yield Label(lines=lines, at=paper.at(start), toward=toward)


def _draw_scales(plate: _Plate) -> None:
    """Bars of a round length and of a round force, at the lower left."""
    sketch, paper = plate.sketch, plate.paper
    bottom = paper.height - 5.0
    inch = 72.0 / paper.scale
    length = max(step for step in _LENGTHS if step <= max(0.5, 0.8 * inch))
    end = 4.0 + length * paper.scale
    sketch.line([(4.0, bottom), (end, bottom)], width=1.6)
    sketch.text(end + 4.0, bottom + 2.8, f"{sketch.write_tick(length)} m", fill=SOFT)
    if plate.most > 0.0:
        power = 10.0 ** math.floor(math.log10(plate.most))
        force = max(x * power for x in _ROUND if x * power <= plate.most)
        start = end + 34.0
        share = LONGEST_ARROW * force / plate.most
        end = start + share * paper.frame.unit * paper.scale
        sketch.arrow((start, bottom), (end, bottom), stroke=BLUE, width=1.7)
        shown = f"{sketch.write_tick(force)} kN"
        sketch.text(end + 4.0, bottom + 2.8, shown, fill=SOFT)
    plate.board.reserve(Box(0.0, bottom - TEXT_PT, end + 40.0, paper.height))
