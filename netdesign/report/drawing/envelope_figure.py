"""Envelope of a net row: member forces over the ranges, small multiples."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from netdesign.outcome import Outcome
from netdesign.report.drawing.letters import measure_words
from netdesign.report.drawing.plain_svg import WIDTH, Frame, list_ticks
from netdesign.report.drawing.sketch import Point, Sketch
from netdesign.report.drawing.style import ACCENT, GREY, INK, PALE, TEXT_PT
from netdesign.report.governing import list_loaded
from netdesign.report.words import (
    ENGLISH,
    Words,
    name_heading,
    show_member,
)
from netdesign.study.case_records import CaseRecord, ExtremeRecord
from netdesign.study.records import RowStudy

_MOST_PANELS, _MOST_LINES = 4, 5  # across; more are thinned out
_LEFT, _RIGHT, _GAP = 34.0, 10.0, 14.0  # beside and between panels [pt]
_LEGEND, _HEAD, _PANEL, _FOOT = 20.0, 15.0, 72.0, 26.0  # heights [pt]
# Told apart without colour: shade, dashes and marker all differ.
_LINES = (
    (INK, "", "dot"),
    ("#555b63", "4 2", "square"),
    (GREY, "6 2 1 2", "triangle"),
    ("#555b63", "1 2", "diamond"),
    (INK, "6 2 1 2 1 2", "tip"),
)


def draw_envelope(row: RowStudy, words: Words = ENGLISH) -> str:
    """SVG of all forces of a row; "" if no case of it gives a force."""
    members = list_loaded(row)
    if not members:
        return ""
    governing = [extreme.case for extreme in row.extremes]
    panels = _thin(
        (case.case.inclination_deg for case in row.cases),
        [case.inclination_deg for case in governing],
        _MOST_PANELS,
    )
    frictions = _thin(
        (case.case.friction_deg for case in row.cases),
        [case.friction_deg for case in governing],
        _MOST_LINES,
    )
    sketch = Sketch(language=words.language)
    _draw_legend(sketch, frictions, words, has_failed=_has_failed(row.cases))
    for place, member in enumerate(members):
        top = _LEGEND + place * (_HEAD + _PANEL) + _HEAD
        for column, inclination in enumerate(panels):
            frame = _place_panel(row, member, (column, len(panels)), top)
            panel = _Panel(sketch, frame, row, member, words)
            panel.draw(inclination, frictions, is_first=column == 0)
            if place == 0:
                text = f"θ = {words.show_with_unit('inclination_deg', inclination)}"
                sketch.words((frame.left + frame.width, top - 5), text, anchor="end")
            if place == len(members) - 1:
                panel.label_densities()
    height = _LEGEND + len(members) * (_HEAD + _PANEL) + _FOOT
    values = [
        words(
            "show.force_of",
            member=show_member(words, extreme.quantity),
            force=words.show_with_unit("max_kN", extreme.max_kN),
        )
        for extreme in row.extremes
    ]
    what = words("drawing.envelope")
    title = words("drawing.with_values", what=what, values=tuple(values))
    return sketch.write(height, title)


def _thin(values: Iterable[float], keep: Sequence[float], most: int) -> list[float]:
    """At most ``most`` of the values, evenly chosen; those to keep come first."""
    known = sorted(set(values))
    if len(known) <= most:
        return known
    chosen = dict.fromkeys(value for value in keep if value in known)
    last = len(known) - 1
    for step in range(most):
        chosen.setdefault(known[round(step * last / (most - 1))])
    return sorted(list(chosen)[:most])


def _force(case: CaseRecord, member: str) -> float | None:
    force: float | None = getattr(case, f"{member}_kN")
    return force


def _has_failed(cases: Iterable[CaseRecord]) -> bool:
    return any(case.outcome is not Outcome.CONVERGED for case in cases)


def _place_panel(
    row: RowStudy, member: str, place: tuple[int, int], top: float
) -> Frame:
    """Panel of one member; all panels of a line share their scale."""
    column, columns = place
    width = (WIDTH - _LEFT - _RIGHT - (columns - 1) * _GAP) / columns
    densities = [case.case.density_kg_m3 for case in row.cases]
    forces = [_force(case, member) for case in row.cases]
    known = [force for force in forces if force is not None]
    reach = 0.16 * (max(known) - min(known)) or 0.1 * abs(max(known)) or 1.0
    margin = 0.06 * (max(densities) - min(densities)) or 1.0
    return Frame(
        left=_LEFT + column * (width + _GAP),
        top=top,
        width=width,
        height=_PANEL - 14.0,
        x_low=min(densities) - margin,
        x_high=max(densities) + margin,
        y_low=min(known) - reach,
        y_high=max(known) + 1.6 * reach,
    )


class _Panel:
    """One member at one inclination."""

    def __init__(
        self, sketch: Sketch, frame: Frame, row: RowStudy, member: str, words: Words
    ) -> None:
        self._sketch, self._frame, self._row = sketch, frame, row
        self._member, self._words = member, words

    def draw(
        self, inclination: float, frictions: Sequence[float], *, is_first: bool
    ) -> None:
        """Lines by friction angle, failed cases, what governs."""
        self._draw_scale(is_first=is_first)
        here = [c for c in self._row.cases if c.case.inclination_deg == inclination]
        for friction, style in zip(frictions, _LINES, strict=False):
            mine = [case for case in here if case.case.friction_deg == friction]
            self._draw_line(mine, style)
        bottom = self._frame.top + self._frame.height - 4.0
        for case in here:
            if _has_failed([case]):
                self._draw_cross((self._frame.x(case.case.density_kg_m3), bottom))
        for extreme in self._row.extremes:
            is_here = extreme.case.inclination_deg == inclination
            if extreme.quantity == self._member and is_here:
                self._mark(extreme)

    def _draw_scale(self, *, is_first: bool) -> None:
        frame, right = self._frame, self._frame.left + self._frame.width
        for value in list_ticks(frame.y_low, frame.y_high, 4):
            y = frame.y(value)
            self._sketch.line([(frame.left, y), (right, y)], stroke=PALE, width=0.4)
            if is_first:
                at = (frame.left - 3.0, y + TEXT_PT / 3)
                self._sketch.words(at, self._sketch.write_tick(value), anchor="end")
        bottom = frame.top + frame.height
        self._sketch.line(
            [(frame.left, bottom), (right, bottom)], stroke=GREY, width=0.5
        )
        if is_first:
            text = name_heading(self._words, f"{self._member}_kN")
            self._sketch.words((2.0, frame.top - 5.0), text, bold=True)

    def label_densities(self) -> None:
        """Ticks and the quantity's name below the lowest panels."""
        frame, base = self._frame, self._frame.top + self._frame.height
        for value in list_ticks(frame.x_low, frame.x_high, 5):
            at = (frame.x(value), base + 2.0 + TEXT_PT)
            self._sketch.words(at, self._sketch.write_tick(value), anchor="middle")
        text = name_heading(self._words, "density_kg_m3")
        middle = (frame.left + frame.width / 2, base + 5.0 + 2.2 * TEXT_PT)
        self._sketch.words(middle, text, anchor="middle")

    def _draw_line(
        self, cases: Sequence[CaseRecord], style: tuple[str, str, str]
    ) -> None:
        """Line through the known points, broken at cases without a result."""
        shade, dash, marker = style
        runs: list[list[Point]] = [[]]
        for case in sorted(cases, key=lambda case: case.case.density_kg_m3):
            force = _force(case, self._member)
            if force is None:
                runs.append([])
            else:
                x = self._frame.x(case.case.density_kg_m3)
                runs[-1].append((x, self._frame.y(force)))
        for run in runs:
            if len(run) > 1:
                self._sketch.line(run, stroke=shade, width=0.9, dash=dash)
            for at in run:
                draw_marker(self._sketch, at, marker, shade)

    def _draw_cross(self, at: Point) -> None:
        x, y = at
        arms = [
            ((x - 2.5, y - 2.5), (x + 2.5, y + 2.5)),
            ((x - 2.5, y + 2.5), (x + 2.5, y - 2.5)),
        ]
        self._sketch.segments(arms, stroke=ACCENT, width=1.0)

    def _mark(self, extreme: ExtremeRecord) -> None:
        """Ring around the governing case, with its value."""
        frame = self._frame
        x, y = frame.x(extreme.case.density_kg_m3), frame.y(extreme.max_kN)
        self._sketch.ring(x, y, ACCENT)
        is_left = x < frame.left + frame.width / 2
        at = (x + 6.0 if is_left else x - 6.0, y - 3.5)
        anchor = "start" if is_left else "end"
        text = self._words.show_number("max_kN", extreme.max_kN)
        self._sketch.words(at, text, anchor=anchor, fill=ACCENT)


def draw_marker(sketch: Sketch, at: Point, marker: str, stroke: str) -> None:
    """White mark with a dark rim; its shape tells lines apart without colour."""
    x, y = at
    outlines: dict[str, Sequence[Point]] = {
        "square": [(-1.6, -1.6), (1.6, -1.6), (1.6, 1.6), (-1.6, 1.6)],
        "triangle": [(0.0, -2.0), (1.9, 1.5), (-1.9, 1.5)],
        "diamond": [(0.0, -2.2), (2.2, 0.0), (0.0, 2.2), (-2.2, 0.0)],
        "tip": [(0.0, 2.0), (1.9, -1.5), (-1.9, -1.5)],
    }
    if marker == "dot":
        sketch.dot(at, 1.6, fill="#fff", stroke=stroke)
        return
    points = [(x + dx, y + dy) for dx, dy in outlines[marker]]
    sketch.area(points, "#fff")
    sketch.line([*points, points[0]], stroke=stroke, width=0.7)


def _draw_legend(
    sketch: Sketch, frictions: Sequence[float], words: Words, *, has_failed: bool
) -> None:
    left, y = 6.0, 7.0
    for friction, (shade, dash, marker) in zip(frictions, _LINES, strict=False):
        sketch.line([(left, y), (left + 20.0, y)], stroke=shade, dash=dash)
        draw_marker(sketch, (left + 10.0, y), marker, shade)
        text = f"φ = {words.show_with_unit('friction_deg', friction)}"
        left = _write_key(sketch, left + 24.0, y, text)
    sketch.ring(left + 4.0, y, ACCENT)
    left = _write_key(sketch, left + 12.0, y, words("drawing.governing_case"))
    if has_failed:
        sketch.words((left, y + 2.6), "×", fill=ACCENT, bold=True)
        _write_key(sketch, left + 9.0, y, words("drawing.no_result"))


def _write_key(sketch: Sketch, left: float, y: float, text: str) -> float:
    """Words of the legend; where the next may begin."""
    sketch.words((left, y + 2.6), text)
    return left + measure_words(text, TEXT_PT) + 7.0
