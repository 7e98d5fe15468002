"""Drawings of the page: errors of the pack, settling of snow, bands of structures."""

from __future__ import annotations

import math
from collections.abc import Sequence

from netdesign.evidence.validation.reach import MARKS as REACH_MARKS
from netdesign.evidence.validation.reach import PLACES, Reach
from netdesign.evidence.validation.structure import MemberBand, Validation
from netdesign.evidence.verification.case import VerificationCase
from netdesign.evidence.verification.compaction import (
    DENSITIES,
    MODELS,
    STRESSES,
    Place,
)
from netdesign.evidence.verification.pack import name_kind
from netdesign.report.drawing.charts import SHADES
from netdesign.report.drawing.letters import measure_words
from netdesign.report.drawing.plain_svg import (
    ACCENT,
    GREY,
    INK,
    PALE,
    TEXT_PT,
    WIDTH,
    Chart,
    Frame,
)
from netdesign.report.words import ENGLISH, Words, show_member, show_own
from netdesign.snow.creep_law import CREEP_LAWS
from netdesign.words.catalogue import load_texts

_LEAST, _MOST = 1e-16, 10.0  # shares of a tolerance that are shown, ends included
_BAND = "#eceef0"  # between snow at freezing and cold snow
_LINE = 13.0  # of a list [pt]
_BELOW = 32.0  # a panel: its ticks, the name of its axis [pt]
_TALL, _ABOVE, _BESIDE = 110.0, 16.0, 40.0  # of a panel of the settling [pt]


def draw_errors(cases: Sequence[VerificationCase], words: Words = ENGLISH) -> str:
    """Error of each case over its tolerance: right of the line none passes."""
    kinds = list(dict.fromkeys(case.kind for case in cases))
    names = [name_kind(kind, words) for kind in kinds]
    chart, frame = _begin_list(names, len(kinds), (_LEAST / 3.0, 1.1 * _MOST), words)
    for place, (kind, name) in enumerate(zip(kinds, names, strict=True)):
        y = frame.y(place + 0.5)
        chart.text(frame.left - 6.0, y + TEXT_PT / 3, name, anchor="end")
        shares = [one.error / one.tolerance for one in cases if one.kind == kind]
        # a share that is no number passes no more than a large one
        known = [
            min(max(one, _LEAST), _MOST) if one == one else _MOST for one in shares
        ]
        marks = [frame.x(math.log10(one)) for one in known]
        chart.segments([((x, y - 4), (x, y + 4)) for x in marks], stroke=INK, width=0.7)
    ends = [(frame.x(0.0), y) for y in (frame.top, frame.top + frame.height)]
    chart.line(ends, stroke=ACCENT, width=1.0)
    title = words("validation.errors_title")
    return _end_list(chart, frame, words("validation.errors_axis"), title)


def _begin_list(
    names: Sequence[str], lines: float, ends: tuple[float, float], words: Words
) -> tuple[Chart, Frame]:
    """Frame of lines below each other, their names at its left."""
    left = max(measure_words(name, TEXT_PT) for name in names) + 10.0
    low, high = map(math.log10, ends)
    frame = Frame(
        left=left,
        top=2.0,
        width=WIDTH - left - 4.0,
        height=_LINE * lines,
        x_low=low,
        x_high=high,
        y_low=lines,
        y_high=0.0,
    )
    return Chart(language=words.language), frame


def _end_list(chart: Chart, frame: Frame, axis: str, title: str) -> str:
    chart.axes(frame, x_ticks=False, y_ticks=False)
    chart.decades(frame, across=True)
    bottom = frame.top + frame.height
    middle = frame.left + frame.width / 2.0
    chart.text(middle, bottom + _BELOW - 6.0, axis, anchor="middle")
    return chart.write(bottom + _BELOW, title)


def draw_compaction(places: Sequence[Place], words: Words = ENGLISH) -> str:
    """Apparent compaction viscosity over density, one panel a stress."""
    chart = Chart(language=words.language)
    values = [v for one in places for v in (*one.laws_Pa_s.values(), *_list_ends(one))]
    ends = math.log10(min(values)), math.log10(max(values))
    step = _ABOVE + _TALL + _BELOW
    for number, stress in enumerate(STRESSES):
        frame = Frame(
            left=_BESIDE + number % 2 * (WIDTH / 2.0),
            top=_ABOVE + number // 2 * step,
            width=WIDTH / 2.0 - _BESIDE - 8.0,
            height=_TALL,
            x_low=DENSITIES[0],
            x_high=DENSITIES[-1],
            y_low=ends[0],
            y_high=ends[1],
        )
        kilopascal = words.write(f"{stress / 1e3:g}")
        title = f"{kilopascal} kPa: {words('validation.viscosity_axis')}"
        chart.text(frame.left, frame.top - 5.0, title, bold=True)
        _draw_stress(chart, frame, [one for one in places if one.stress_Pa == stress])
        axis, middle = words("validation.density_axis"), frame.left + frame.width / 2.0
        below = frame.top + _TALL + _BELOW - 8.0
        chart.text(middle, below, axis, anchor="middle")
    top = -(-len(STRESSES) // 2) * step + _LINE
    _name_lines(chart, top)
    return chart.write(top + 2.0 * _LINE, words("validation.compaction_title"))


def _list_ends(place: Place) -> list[float]:
    return [value for ends in place.models_Pa_s.values() for value in ends]


def _draw_stress(chart: Chart, frame: Frame, places: Sequence[Place]) -> None:
    """Bands of the models between snow at freezing and cold snow, then all lines."""

    def trace(values: Sequence[float]) -> list[tuple[float, float]]:
        pairs = zip(places, values, strict=True)
        return [
            (frame.x(p.density_kg_m3), frame.y(math.log10(value))) for p, value in pairs
        ]

    ends = {
        model.name: [
            trace([place.models_Pa_s[model.name][end] for place in places])
            for end in (0, 1)
        ]
        for model in MODELS
    }
    for warm, cold in ends.values():
        chart.area([*warm, *cold[::-1]], _BAND)
    for (_, dash), (warm, _) in zip(SHADES, ends.values(), strict=False):
        chart.line(warm, stroke=GREY, dash=dash)
    for _, cold in ends.values():
        chart.line(cold, stroke=GREY, width=0.4)
    for number, law in enumerate(CREEP_LAWS):
        color, (_, dash) = INK if number else ACCENT, SHADES[number]
        values = [place.laws_Pa_s[law] for place in places]
        chart.line(trace(values), stroke=color, width=1.3, dash=dash)
    chart.axes(frame, y_ticks=False)
    chart.decades(frame, across=False)


def _name_lines(chart: Chart, top: float) -> None:
    """Names of the models on one line, of the laws on the next."""
    for row, names in enumerate(([one.name for one in MODELS], list(CREEP_LAWS))):
        for number, name in enumerate(names):
            x, y = _BESIDE + number * WIDTH / 4.4, top + row * _LINE
            color = (GREY if row == 0 else INK) if row == 0 or number else ACCENT
            ends = ((x, y - 2.5), (x + 18.0, y - 2.5))
            chart.line(ends, stroke=color, dash=SHADES[number][1])
            chart.text(x + 22.0, y, name)


def draw_bands(validations: Sequence[Validation], words: Words = ENGLISH) -> str:
    """Bands of the model and what was measured, one bar a member."""
    bars: list[tuple[str, MemberBand | None, float]] = []
    for one in validations:
        bars.append((show_own(words, one.structure.title), None, 0.0))
        bars += [
            (_name_bar(pair.measured.name, band, words), band, pair.measured.value)
            for pair in one.comparisons
            for band in pair.bands
        ]
    values = [value for _, band, x in bars if band for value in (band.high, x)]
    names = [name for name, band, _ in bars if band]
    ends = (_FEEBLE / 1.3, 1.3 * max(values))
    chart, frame = _begin_list(names, len(bars), ends, words)
    for place, (name, band, value) in enumerate(bars):
        y = frame.y(place + 0.5)
        if band is None:
            chart.text(2.0, y + TEXT_PT / 3, name, bold=True)
            continue
        chart.text(frame.left - 6.0, y + TEXT_PT / 3, name, anchor="end")
        _draw_bar(chart, frame, y, band, value)
    title = words("validation.bands_title")
    return _end_list(chart, frame, words("validation.bands_axis"), title)


def draw_reach(reaches: Sequence[Reach], words: Words = ENGLISH) -> str:
    """Glide over distance, beside an endless row and a net that stands alone."""
    chart = Chart(language=words.language)
    titles = (words("validation.of_row"), words("validation.of_net"))
    bottom = _ABOVE + _TALL
    for number, title in enumerate(titles):
        frame = Frame(
            left=_BESIDE + number * (WIDTH / 2.0),
            top=_ABOVE,
            width=WIDTH / 2.0 - _BESIDE - 8.0,
            height=_TALL,
            x_low=0.0,
            x_high=float(PLACES[-1]),
            y_low=0.0,
            y_high=1.0,
        )
        chart.text(frame.left, frame.top - 5.0, title, bold=True)
        for mark in REACH_MARKS:
            ends = [(frame.x(mark), y) for y in (frame.top, bottom)]
            chart.line(ends, stroke=GREY, width=0.5)
        for (_, dash), one in zip(SHADES, reaches, strict=False):
            shares = (one.of_row, one.of_net)[number]
            points = zip(one.distances, shares, strict=True)
            traced = [(frame.x(x), frame.y(min(y, 1.0))) for x, y in points]
            chart.line(traced, stroke=INK, dash=dash)
        chart.axes(frame)
        middle = frame.left + frame.width / 2.0
        axis = words("validation.reach_axis")
        chart.text(middle, bottom + _BELOW - 8.0, axis, anchor="middle")
    top = bottom + _BELOW + _LINE
    for number, one in enumerate(reaches):
        x = _BESIDE + number * WIDTH / 5.4
        chart.line(((x, top - 2.5), (x + 18.0, top - 2.5)), dash=SHADES[number][1])
        chart.text(x + 22.0, top, f"N = {words.show_given(one.glide_factor)}")
    return chart.write(top + _LINE, words("validation.reach_title"))


_FEEBLE = 1.0  # least force of the axis [kN]: a slack guy has none


def _name_bar(measured: str, band: MemberBand, words: Words) -> str:
    member = name_validated(band.member, words)
    return words("show.label", label=show_own(words, measured), text=member)


def _draw_bar(
    chart: Chart, frame: Frame, y: float, band: MemberBand, value: float
) -> None:
    """Band of a member, its middle, and what was measured."""
    for ends, color in (((band.low, band.high), PALE), (band.middle, GREY)):
        left, right = (frame.x(math.log10(max(end, _FEEBLE))) for end in ends)
        chart.rectangle(left, y - 3.5, max(right - left, 0.5), 7.0, color)
    x = frame.x(math.log10(max(value, _FEEBLE)))
    chart.line(((x, y - 5.5), (x, y + 5.5)), stroke=ACCENT, width=2.2)


def name_validated(member: str, words: Words) -> str:
    """Member of the model that a measured value may be."""
    key = f"validation_member.{member}"
    return words(key) if key in load_texts("en") else show_member(words, member)
