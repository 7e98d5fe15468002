"""Drawing of an envelope: maps by inclination, or lines with their bound."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

from netdesign.report.drawing.label_board import LINE_PT
from netdesign.report.drawing.plain_svg import (
    ACCENT,
    GREY,
    INK,
    PALE,
    SHADES,
    TEXT_PT,
    WIDTH,
    Chart,
    Frame,
    bounds_of,
    drop_straight,
    list_ticks,
    shade,
    wrap_words,
)
from netdesign.report.words import (
    ENGLISH,
    Words,
    name_heading,
)
from netdesign.study.case_records import (
    DrawnForce,
    LargestForce,
    LineRecord,
    MapRecord,
)
from netdesign.study.governing import find_shown_member
from netdesign.study.records import RowStudy


@dataclass(frozen=True, slots=True, kw_only=True)
class EnvelopeView:
    """Largest force of a member, and what a drawing shows of it over the ranges."""

    force: LargestForce
    drawn: DrawnForce


def view_envelope(row: RowStudy) -> list[EnvelopeView]:
    """Drawn forces of a row's search."""
    forces = {one.quantity: one for one in row.forces}
    drawn = row.envelope.drawn
    return [EnvelopeView(force=forces[one.quantity], drawn=one) for one in drawn]


_LEFT, _GAP, _RIGHT = 30.0, 30.0, 42.0  # beside and between panels [pt]
_HEAD, _PANEL, _FOOT = 25.0, 60.0, 19.0  # heights of a row of panels [pt]
_BESIDE = 0.56 * WIDTH  # of the drawing beside a worked check [pt]
_ACROSS = 2  # lines side by side; more go below
_SMALLEST = 1e-9  # of the largest force: below it a member counts as unloaded
_OVERLAP = 0.5  # of the cells of a map: no white lines between them [pt]


def draw_maps(view: EnvelopeView, words: Words = ENGLISH) -> str:
    """SVG of force over density and friction, a column for each inclination.

    Returns "" where density or friction does not range. The ring marks the governing
    case, in the map of the inclination nearest to it.
    """
    if not view.drawn.maps:
        return ""
    chart, at = Chart(language=words.language), view.force.case.values
    chart.text(2.0, TEXT_PT + 1.0, _name(view, words), bold=True)
    nearest = min(
        range(len(view.drawn.maps)),
        key=lambda k: abs(view.drawn.maps[k].inclination_deg - at["inclination_deg"]),
    )
    known = [row for one in view.drawn.maps for row in one.force_kN]
    low, high = bounds_of(known)
    frames = [
        _place_panel(column, len(view.drawn.maps), one)
        for column, one in enumerate(view.drawn.maps)
    ]
    pairs = list(zip(frames, view.drawn.maps, strict=True))
    chart.tiles(cell for pair in pairs for cell in _list_cells(*pair, low, high))
    for frame, one in pairs:
        _name_map(chart, frame, one, words)
    governing = at["density_kg_m3"], at["friction_deg"]
    chart.ring(frames[nearest].x(governing[0]), frames[nearest].y(governing[1]), ACCENT)
    _paint_legend(chart, low, high)
    title = _title("drawing.maps", view, known, words)
    return chart.write(_HEAD + _PANEL + _FOOT, title, _BESIDE)


def draw_lines(view: EnvelopeView, words: Words = ENGLISH) -> str:
    """SVG of force along each quantity through the governing case, with its bound."""
    if not view.drawn.lines:
        return ""
    chart, top = Chart(language=words.language), 0.0
    chart.text(2.0, TEXT_PT + 1.0, _name(view, words), bold=True)
    for start in range(0, len(view.drawn.lines), _ACROSS):
        some = view.drawn.lines[start : start + _ACROSS]
        top += _paint_lines(chart, some, view, top, words)
    forces = [one.force_kN for one in view.drawn.lines]
    return chart.write(top, _title("drawing.lines", view, forces, words), _BESIDE)


def _paint_lines(
    chart: Chart,
    lines: Sequence[LineRecord],
    view: EnvelopeView,
    top: float,
    words: Words,
) -> float:
    """Paint lines side by side, all to the scale of their member; their height [pt]."""
    low, high = bounds_of([*(one.force_kN for one in view.drawn.lines)])
    high = max(high, view.force.bound_kN)
    margin = 0.06 * (high - low) or 0.01 * high
    names = 1
    for column, one in enumerate(lines):
        frame = Frame(
            **_panel(column, min(len(view.drawn.lines), _ACROSS), top),
            x_low=one.values[0],
            x_high=one.values[-1],
            y_low=low - margin,
            y_high=high + margin,
        )
        names = max(names, _paint_line(chart, frame, one, view, words))
    return _HEAD + _PANEL + _FOOT + (names - 1) * LINE_PT


def _list_cells(
    frame: Frame, one: MapRecord, low: float, high: float
) -> list[tuple[float, float, float, float, str]]:
    """Cells around the points of the map, clipped to its frame: tiles of a chart."""
    ends = (frame.left, frame.left + frame.width)
    xs = _edges(one.density_kg_m3, frame.x, *ends)
    ys = _edges(one.friction_deg, frame.y, frame.top + frame.height, frame.top)
    cells = []
    for column, (left, right) in enumerate(pairwise(xs)):
        fills = [shade(forces[column], low, high) for forces in one.force_kN]
        start = 0
        for row in range(1, len(fills) + 1):  # cells of one shade are one tile
            if row < len(fills) and fills[row] == fills[start]:
                continue
            bottom, top = ys[start], ys[row]
            end = min(right + _OVERLAP, frame.left + frame.width)
            foot = min(bottom + _OVERLAP, frame.top + frame.height)
            cells.append((left, top, end - left, foot - top, fills[start]))
            start = row
    return cells


def _name_map(chart: Chart, frame: Frame, one: MapRecord, words: Words) -> None:
    """Axes of a map and their symbols, too short to meet."""
    chart.text(
        frame.left + frame.width,
        frame.top - 5.5,
        f"θ = {words.show_with_unit('inclination_deg', one.inclination_deg)}",
        anchor="end",
    )
    chart.text(frame.left + 6.0, frame.top - 5.5, "φ [°]", anchor="end")
    chart.axes(frame)
    _name_axis(chart, frame, "ρ [kg/m³]")


def _paint_legend(chart: Chart, low: float, high: float) -> None:
    """Bar of all shades, with a few round forces beside it."""
    right, top = _BESIDE, _HEAD
    left, wide, high_pt = right - _RIGHT + 8.0, 9.0, _PANEL - 14.0
    step = high_pt / SHADES
    chart.tiles(
        (left, top + k * step, wide, step + 0.1, shade(SHADES - 1 - k, 0, SHADES - 1))
        for k in range(SHADES)
    )
    places = []
    for value in list_ticks(low, high):
        y = top + high_pt * (
            1.0 - ((value - low) / (high - low) if high > low else 0.5)
        )
        places.append((left + wide, y))
        chart.text(left + wide + 4.0, y + TEXT_PT / 3, chart.write_tick(value))
    chart.ticks(places)


def _paint_line(
    chart: Chart, frame: Frame, one: LineRecord, view: EnvelopeView, words: Words
) -> int:
    """Force and bound along a quantity; how many lines its name takes."""

    def trace(forces: Sequence[float]) -> list[tuple[float, float]]:
        return drop_straight(
            [
                (frame.x(value), frame.y(min(force, frame.y_high)))
                for value, force in zip(one.values, forces, strict=True)
            ]
        )

    force, allowed = trace(one.force_kN), trace(one.bound_kN)
    chart.area([*force, *allowed[::-1]], PALE, GREY)
    chart.line(force, stroke=INK)
    across = frame.y(view.force.bound_kN)
    chart.line(
        [(frame.left, across), (frame.left + frame.width, across)],
        stroke=ACCENT,
        width=0.5,
    )
    chart.axes(frame)
    chart.ring(
        frame.x(view.force.case.values[one.key]), frame.y(view.force.value_kN), ACCENT
    )
    return _name_axis(chart, frame, name_heading(words, one.key))


def _place_panel(column: int, columns: int, one: MapRecord) -> Frame:
    return Frame(
        **_panel(column, columns, 0.0),
        x_low=one.density_kg_m3[0],
        x_high=one.density_kg_m3[-1],
        y_low=one.friction_deg[0],
        y_high=one.friction_deg[-1],
    )


def _panel(column: int, columns: int, top: float) -> dict[str, float]:
    """Sides of a panel below a top [pt]."""
    width = (_BESIDE - _LEFT - _RIGHT - (columns - 1) * _GAP) / columns
    return {
        "left": _LEFT + column * (width + _GAP),
        "top": top + _HEAD,
        "width": width,
        "height": _PANEL - 14.0,
    }


def _name_axis(chart: Chart, frame: Frame, label: str) -> int:
    """Write what an axis shows below it; the number of lines."""
    base = frame.top + frame.height + 2.3 * TEXT_PT + 4.5
    lines = wrap_words(label, TEXT_PT, frame.width + _GAP - 6.0)
    for place, line in enumerate(lines):
        at = base + place * LINE_PT
        chart.text(frame.left + frame.width / 2, at, line, anchor="middle")
    return len(lines)


def _edges(
    values: Sequence[float], place: Callable[[float], float], first: float, last: float
) -> list[float]:
    """Borders of the cells around some values; the outer ones are those of a frame."""
    return [first, *(place((a + b) / 2) for a, b in pairwise(values)), last]


def _list_loaded(views: Sequence[EnvelopeView]) -> list[EnvelopeView]:
    largest = max((view.force.value_kN for view in views), default=0.0)
    return [view for view in views if view.force.value_kN > _SMALLEST * largest]


def _name(view: EnvelopeView, words: Words) -> str:
    """Force of a member."""
    return name_heading(words, f"{view.force.quantity}_kN")


def _title(
    what: str, view: EnvelopeView, forces: Sequence[Sequence[float]], words: Words
) -> str:
    """Name and numbers of a drawing for those who cannot see it."""
    member = _name(view, words)
    named = words("drawing.of_member", member=member, what=words(what))
    low, high = bounds_of(forces)
    told = words(
        "drawing.forces_in_words",
        member=member,
        forces=words.show_band("max_kN", low, high),
        largest=words.show_number("max_kN", view.force.value_kN),
        case=", ".join(words.name_values(view.force.case.values.items())),
    )
    return words("drawing.with_values", what=named, values=(told,))


def draw_envelope(row: RowStudy, words: Words) -> str:
    """Envelope of the member that governs, as wide as there is room beside a check.

    Of another member where that has no force.
    """
    views = _list_loaded(view_envelope(row))
    members = [one for one in views if one.drawn.maps or one.drawn.lines]
    if not members:
        return ""
    first = find_shown_member(row.checks)
    shown = min(members, key=lambda one: one.force.quantity != first)
    return draw_maps(shown, words) or draw_lines(shown, words)
