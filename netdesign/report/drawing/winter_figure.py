"""A winter on a net: forces against date, below them the layers that gave them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from datetime import date, timedelta
from typing import Any

from netdesign.report.drawing.label_board import LINE_PT
from netdesign.report.drawing.letters import measure_words
from netdesign.report.drawing.plain_svg import WIDTH, Chart, Frame, shade
from netdesign.report.drawing.style import ACCENT, GREY, INK, TEXT_PT
from netdesign.report.words import Words, show_member
from netdesign.words.catalogue import set_marks

_LEFT, _RIGHT = 36.0, 158.0  # beside the panels [pt]
# Above the first panel, whose days are named on two lines over its title; between two.
_HEAD, _GAP = 16.0 + 2 * LINE_PT, 24.0  # [pt]
_FORCES, _MEMBERS, _SNOW, _AIR = 118.0, 96.0, 104.0, 52.0  # heights of the panels [pt]
_LOOSE, _DENSE = 80.0, 600.0  # ends of the greys [kg/m3]
_LABEL_GAP = TEXT_PT + 1.0
_STYLES = (
    (ACCENT, "", 1.4),
    (INK, "", 1.0),
    ("#555b63", "5 2", 1.0),
    (GREY, "1 2", 1.2),
)
_AIR_STYLES = ((INK, "", 0.7),)
_MEMBERS_SHOWN = ("foot_anchor", "uphill_guy", "post")

Day = Mapping[str, Any]
Run = list[tuple[int, float]]  # days since the first, and values; no gap between


def draw_winter(
    winter: Mapping[str, Any], air: Mapping[str, float], words: Words
) -> str:
    """SVG of one winter of a row; "" without a curve.

    Parameters
    ----------
    winter : mapping
        Entry of ``winters`` of the winter document.
    air : mapping of str to float
        Air temperature by date [C]; may be empty.
    words : Words
        Language.
    """
    days: Sequence[Day] = winter["curve"]
    if not days:
        return ""
    first, last = span = _find_span(days)
    chart, top = Chart(language=words.language), _HEAD
    pulls = [
        (words("winter_column.foot"), _pick(days, span, _read("foot_kN_per_m"))),
        (words("winter_column.head"), _pick(days, span, _read("head_kN_per_m"))),
    ]
    panel = _Panel(chart, first, last)
    title = words("winter_page.pulls_title")
    frame = panel.draw_lines(top, _FORCES, title, pulls)
    _mark_governing(chart, frame, winter, first, words)
    top += _FORCES + _GAP
    members = _list_members(days, span, words)
    if members:
        title = words("winter_page.members_title")
        panel.draw_lines(top, _MEMBERS, title, members)
        top += _MEMBERS + _GAP
    panel.draw_snow(top, _SNOW, words("winter_page.layers_title"), days)
    top += _SNOW + _GAP
    inside = {
        (date.fromisoformat(day) - first).days: degrees for day, degrees in air.items()
    }
    warm = [(k, v) for k, v in sorted(inside.items()) if 0 <= k <= (last - first).days]
    if warm:
        title = words("winter_page.air_title")
        panel.draw_lines(
            top, _AIR, title, [("", [warm])], from_zero=False, styles=_AIR_STYLES
        )
        top += _AIR + _GAP
    panel.label_months(top - _GAP)
    return chart.write(top, _describe(winter["name"], [*pulls, *members], words))


def _describe(winter: str, lines: Sequence[tuple[str, list[Run]]], words: Words) -> str:
    """Words for the drawing, with the largest value of each line."""
    values = [
        words(
            "show.force_of",
            member=name,
            force=words.show_number("max_kN", max(v for run in runs for _, v in run)),
        )
        for name, runs in lines
        if runs
    ]
    what = words("winter_page.figure", winter=winter)
    return words("drawing.with_values", what=what, values=tuple(values))


class _Panel:
    """Panels of one winter, one below the other, over the same days."""

    def __init__(self, chart: Chart, first: date, last: date) -> None:
        self._chart, self._first = chart, first
        self._count = (last - first).days
        self._width = WIDTH - _LEFT - _RIGHT

    def draw_lines(
        self,
        top: float,
        height: float,
        title: str,
        lines: Sequence[tuple[str, list[Run]]],
        *,
        from_zero: bool = True,
        styles: Sequence[tuple[str, str, float]] = _STYLES,
    ) -> Frame:
        """Lines with their names at the right, and the frame that holds them."""
        values = [v for _, runs in lines for run in runs for _, v in run] or [0.0]
        low = 0.0 if from_zero else min(values)
        high = max(max(values), low + 1e-9)
        frame = self._place(top, height, low, high + 0.06 * (high - low))
        self._chart.text(_LEFT, top - 5.0, title, bold=True)
        self._chart.axes(frame, x_ticks=False)
        labels = []
        for (name, runs), (stroke, dash, width) in zip(lines, styles, strict=False):
            for run in runs:
                places = [(frame.x(day), frame.y(value)) for day, value in _widen(run)]
                self._chart.line(places, stroke=stroke, width=width, dash=dash)
            if runs:
                points = [point for run in runs for point in run]
                labels.append((max(points, key=lambda one: one[1]), name, stroke))
        self._name_lines(frame, labels)
        return frame

    def draw_snow(
        self, top: float, height: float, title: str, days: Sequence[Day]
    ) -> None:
        """Layers of each day as tiles: the darker, the denser."""
        deepest = max(day["thickness_m"] for day in days)
        frame = self._place(top, height, 0.0, max(deepest, 0.1))
        self._chart.text(_LEFT, top - 5.0, title, bold=True)
        tiles = []
        places = [(date.fromisoformat(day["date"]) - self._first).days for day in days]
        ends = [*places[1:], places[-1] + 1]
        for day, start, end in zip(days, places, ends, strict=True):
            left, right = frame.x(start), frame.x(min(end, self._count))
            base = 0.0
            for layer in day["layers"] or [_uniform(day)]:
                upper = base + layer["thickness_m"]
                fill = shade(layer["density_kg_m3"], _LOOSE, _DENSE)
                size = frame.y(base) - frame.y(upper)
                tiles.append((left, frame.y(upper), right - left, size, fill))
                base = upper
        self._chart.tiles(tile for tile in tiles if tile[3] > 0.0)
        self._chart.axes(frame, x_ticks=False)
        self._draw_scale(frame)

    def label_months(self, bottom: float) -> None:
        """First day of each month, below the last panel; names that stand apart."""
        frame = self._place(0.0, bottom, 0.0, 1.0)
        free = -math.inf
        for count in range(self._count + 1):
            day = self._first + timedelta(days=count)
            if day.day != 1:
                continue
            x, text = frame.x(count), f"{day:%m/%Y}"
            self._chart.line(((x, bottom), (x, bottom + 3.0)), stroke=GREY)
            if x > free:
                self._chart.text(x + 2.0, bottom + TEXT_PT + 4.0, text)
                free = x + 4.0 + measure_words(text, TEXT_PT)

    def _place(self, top: float, height: float, low: float, high: float) -> Frame:
        return Frame(
            left=_LEFT,
            top=top,
            width=self._width,
            height=height,
            x_low=0.0,
            x_high=float(max(self._count, 1)),
            y_low=low,
            y_high=high,
        )

    def _name_lines(
        self, frame: Frame, labels: Sequence[tuple[tuple[int, float], str, str]]
    ) -> None:
        """Name and largest value of each line at the right, none on another."""
        ranked = sorted(labels, key=lambda one: -one[0][1])
        low = frame.top - _LABEL_GAP
        for (_, value), name, stroke in ranked if any(n for _, n, _ in labels) else ():
            y = max(frame.y(value), low + _LABEL_GAP)
            low = y
            x = frame.left + frame.width + 4.0
            shown = set_marks(f"{value:.1f}", self._chart.language)
            self._chart.line(
                ((x, y - 2.5), (x + 9.0, y - 2.5)), stroke=stroke, width=1.4
            )
            self._chart.text(x + 12.0, y, f"{shown} {name}")

    def _draw_scale(self, frame: Frame) -> None:
        """Greys of some densities at the right."""
        x = frame.left + frame.width + 6.0
        for place, density in enumerate((100, 200, 300, 400, 500)):
            y = frame.top + frame.height - (place + 1) * 12.0
            fill = shade(float(density), _LOOSE, _DENSE)
            self._chart.rectangle(x, y, 12.0, 12.0, fill)
            self._chart.text(x + 16.0, y + 9.0, f"{density} kg/m³")


def _mark_governing(
    chart: Chart, frame: Frame, winter: Mapping[str, Any], first: date, words: Words
) -> None:
    """Thin lines at the governing day and at the day of the largest height."""
    marks = (
        (winter["height_max_date"], words("winter_page.mark_highest"), GREY),
        (winter["governing_date"], words("winter_page.mark_governing"), ACCENT),
    )
    places = sorted((day, label, stroke) for day, label, stroke in marks if day)
    for place, (day, label, stroke) in enumerate(places):
        x = frame.x((date.fromisoformat(day) - first).days)
        bottom = frame.top + frame.height
        chart.line(((x, frame.top), (x, bottom)), stroke=stroke, width=0.6, dash="2 2")
        high = frame.top - 5.0 - (2 - place) * LINE_PT  # each on a line of its own
        is_left = x + measure_words(label, TEXT_PT) > WIDTH
        anchor, shift = ("end", 2.0) if is_left else ("start", -2.0)
        chart.text(x + shift, high, label, anchor=anchor)


def _find_span(days: Sequence[Day]) -> tuple[date, date]:
    """First and last day with snow, a little room beside them."""
    snowy = [date.fromisoformat(day["date"]) for day in days if day["thickness_m"] > 0]
    every = snowy or [date.fromisoformat(day["date"]) for day in days]
    return min(every) - timedelta(days=3), max(every) + timedelta(days=5)


def _read(key: str) -> Callable[[Day], float | None]:
    return lambda day: day[key]


def _read_member(member: str) -> Callable[[Day], float | None]:
    return lambda day: day["members_kN"].get(member)


def _pick(
    days: Sequence[Day], span: tuple[date, date], read: Callable[[Day], float | None]
) -> list[Run]:
    """Runs of the days in the frame that have a value; one without it parts two."""
    runs: list[Run] = [[]]
    for day in days:
        at, value = date.fromisoformat(day["date"]), read(day)
        if not span[0] <= at <= span[1]:
            continue
        if value is None:
            runs.append([])
        else:
            runs[-1].append(((at - span[0]).days, float(value)))
    return [run for run in runs if run]


def _widen(run: Run) -> list[tuple[float, float]]:
    """Points of a run; a lone day is drawn as wide as it is, or nobody would see it."""
    if len(run) > 1:
        return [(float(day), value) for day, value in run]
    ((day, value),) = run
    return [(day - 0.5, value), (day + 0.5, value)]


def _list_members(
    days: Sequence[Day], span: tuple[date, date], words: Words
) -> list[tuple[str, list[Run]]]:
    found = []
    for member in _MEMBERS_SHOWN:
        runs = _pick(days, span, _read_member(member))
        if runs:
            found.append((show_member(words, member), runs))
    return found


def _uniform(day: Day) -> dict[str, float]:
    return {
        "thickness_m": day["thickness_m"],
        "density_kg_m3": day["density_kg_m3"] or _LOOSE,
    }
