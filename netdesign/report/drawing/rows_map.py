"""Map of net rows by their verdicts: no relief, no coordinates, legible in grey."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from netdesign.files.rows_map import MeasuredPlace, RowsMap
from netdesign.outcome import Verdict
from netdesign.report.drawing.label_board import LINE_PT, Label, LabelBoard
from netdesign.report.drawing.plain_svg import (
    ACCENT,
    GREY,
    INK,
    TEXT_PT,
    WIDTH,
    Chart,
    Frame,
    Point,
    measure_words,
)
from netdesign.report.words import VERDICTS, Words

_MARGIN = 8.0  # of ground around rows and zones [m]
_HEIGHT = 400.0  # of a map, at most [pt]
_SIDE = 34.0  # beside a map, for the names of its outer rows [pt]
_TICK = 5.0  # of a post, down the slope [pt]
_SAMPLE = 26.0  # line of the legend [pt]
_SCALES = (500, 200, 100, 50, 20, 10, 5, 2)  # [m]
_DASHES = {Verdict.NOT_PROVEN: "7 3", Verdict.DECLARED: "9 2.5 1.8 2.5", None: "1.5 3"}
_ORDER = (Verdict.PASS, Verdict.FAIL, Verdict.NOT_PROVEN, Verdict.DECLARED, None)


@dataclass(frozen=True, slots=True, kw_only=True)
class MappedRow:
    """Verdict of a net row as the map shows it.

    Attributes
    ----------
    verdict : Verdict or None
        None of a row that was not checked.
    used : str
        Utilisation that governs, or "".
    anchor : str
        Part of the page that its name leads to, or "".
    """

    verdict: Verdict | None = None
    used: str = ""
    anchor: str = ""


def draw_rows_map(
    places: RowsMap, rows: Mapping[str, MappedRow], title: str, words: Words
) -> str:
    """Map of rows and posts, with what each verdict's line looks like below it.

    Parameters
    ----------
    places : RowsMap
        Rows in plan.
    rows : mapping of str to MappedRow
        What is said of each; those that are left out were not checked.
    title : str
        Words that stand for the map.
    words : Words
        Of the language.
    """
    places = _localise(places)
    chart, frame = Chart(language=words.language), _frame(places)
    below = frame.top + frame.height
    board = LabelBoard(width=WIDTH, height=below)
    for zone in places.zones:
        chart.line(frame.place(zone), stroke=GREY, width=0.8, dash="2 2")
    shown = {name: rows.get(name, MappedRow()) for name in places.rows}
    for name, place in places.rows.items():
        _draw_row(chart, board, frame, place, shown[name].verdict)
    for name, place in places.rows.items():
        board.draw(chart, _label(frame, name, place, shown[name]))
    _draw_scale(chart, frame, below + 12.0)
    verdicts = {one.verdict for one in shown.values()}
    known = [one for one in _ORDER if one in verdicts]
    end = _draw_legend(chart, known, below + 32.0, words)
    return chart.write(end, title)


def _localise(places: RowsMap) -> RowsMap:
    """Map in metres from its own corner, to a millimetre: the same wherever it lies."""
    west, south = (min(part) for part in zip(*_list_points(places), strict=True))

    def move(x: float, y: float) -> tuple[float, float]:
        return round(x - west, 3), round(y - south, 3)

    rows = {
        name: replace(row, posts=[(*move(x, y), 0.0) for x, y, _ in row.posts])
        for name, row in places.rows.items()
    }
    zones = tuple(tuple(move(x, y) for x, y in zone) for zone in places.zones)
    return replace(places, rows=rows, zones=zones)


def _list_points(places: RowsMap) -> list[tuple[float, float]]:
    points = [(x, y) for row in places.rows.values() for x, y, _ in row.posts]
    return [*points, *(point for zone in places.zones for point in zone)]


def _frame(places: RowsMap) -> Frame:
    """Frame of a map whose metres are as long upwards as sideways."""
    (west, east), (south, north) = (
        (min(part) - _MARGIN, max(part) + _MARGIN)
        for part in zip(*_list_points(places), strict=True)
    )
    scale = min((WIDTH - 2.0 * _SIDE) / (east - west), _HEIGHT / (north - south))
    width = scale * (east - west)
    return Frame(
        left=(WIDTH - width) / 2.0,
        top=4.0,
        width=width,
        height=scale * (north - south),
        x_low=west,
        x_high=east,
        y_low=south,
        y_high=north,
    )


def _draw_row(
    chart: Chart,
    board: LabelBoard,
    frame: Frame,
    place: MeasuredPlace,
    verdict: Verdict | None,
) -> None:
    """Line of a row, with a tick down the slope at each post."""
    path = frame.place(place.posts)
    down = (math.sin(place.aspect), -math.cos(place.aspect))
    tips = [(x + _TICK * down[0], y + _TICK * down[1]) for x, y in path]
    chart.segments(zip(path, tips, strict=True), stroke=GREY, width=0.7)
    _draw_line(chart, path, verdict)
    board.avoid(path)
    board.avoid(tips)


def _draw_line(chart: Chart, path: Sequence[Point], verdict: Verdict | None) -> None:
    """Line of a verdict: its kind says the same as its colour."""
    if verdict is Verdict.FAIL:
        chart.line(path, stroke=ACCENT, width=5.0)
        chart.line(path, stroke="#fff", width=1.4)
        return
    stroke = GREY if verdict is None else INK
    chart.line(path, stroke=stroke, width=2.4, dash=_DASHES.get(verdict, ""))


def _label(frame: Frame, name: str, place: MeasuredPlace, row: MappedRow) -> Label:
    """Name of a row above its middle, with the sign of its verdict."""
    path = frame.place(place.posts)
    sign = "" if row.verdict is None else VERDICTS[row.verdict].symbol
    text = " ".join(one for one in (name, sign, row.used) if one)
    colour = ACCENT if row.verdict is Verdict.FAIL else INK
    up = (-math.sin(place.aspect), math.cos(place.aspect))
    return Label(
        lines=((text, colour),),
        at=path[len(path) // 2],
        toward=(up[0], up[1]),
        link=row.anchor,
    )


def _draw_scale(chart: Chart, frame: Frame, at: float) -> None:
    """North arrow and scale."""
    left, end = frame.left, frame.left + frame.width
    chart.arrow((left + 4.0, at + 7.0), (left + 4.0, at - 7.0), stroke=INK, width=1.1)
    chart.text(left + 10.0, at + TEXT_PT / 3, "N")
    span = frame.x_high - frame.x_low
    length = next((one for one in _SCALES if one <= span / 3.0), 1)
    start = end - length / span * frame.width
    chart.line([(start, at), (end, at)], width=1.6)
    chart.text(start - 4.0, at + TEXT_PT / 3, f"{length} m", anchor="end")


def _draw_legend(
    chart: Chart, verdicts: Sequence[Verdict | None], at: float, words: Words
) -> float:
    """A line of each verdict with its word; where the drawing ends [pt]."""
    left = 4.0
    for verdict in verdicts:
        if verdict is None:
            text = words("rows_map.not_checked")
        else:
            text = f"{VERDICTS[verdict].symbol} {words(f'verdict.{verdict}')}"
        wide = _SAMPLE + 5.0 + measure_words(text, TEXT_PT) + 16.0
        if left > 4.0 and left + wide > WIDTH:
            left, at = 4.0, at + 1.5 * LINE_PT
        _draw_line(chart, [(left, at), (left + _SAMPLE, at)], verdict)
        chart.text(left + _SAMPLE + 5.0, at + TEXT_PT / 3, text)
        left += wide
    return at + LINE_PT
