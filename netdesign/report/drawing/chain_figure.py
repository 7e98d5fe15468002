"""Chains of a net row: each line of parts from the net into the ground, with its use.

A chain is as strong as its weakest link: that of each chain is bold, that of the whole
row has a thick border. A link that is not proven counts as the weakest. Beside them the
loads along the height of a net: of the coupled calculation, and of the guideline.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from netdesign.checks.check import Check
from netdesign.outcome import Verdict
from netdesign.report.drawing.plain_svg import (
    ACCENT,
    GREY,
    INK,
    TEXT_PT,
    WIDTH,
    Chart,
    Frame,
    measure_words,
)
from netdesign.report.words import Words, show_member, show_verdict
from netdesign.study.case_records import GuidelineRecord
from netdesign.study.records import RowStudy
from netdesign.words.names import name_mode

# Members from the net into the ground.
_CHAINS = (
    ("mesh", "ridge_rope", "lower_rope"),
    ("foot_anchor",),
    ("uphill_guy", "uphill_anchor"),
    ("downhill_guy", "downhill_anchor"),
    ("post", "post_base", "post_foot"),
    ("end_guy", "end_guy_anchor"),
    ("lateral_anchor",),
)
_LINE = 14.5  # from chain to chain [pt]
_BOX = 11.5  # height of a link [pt]
_PAD, _ARROW = 3.5, 13.0  # inside a box, and between two [pt]
_OPEN, _FAILED = 1e9, 1e12  # of a link that is not proven, and of one that fails
_SMALLEST = 0.6  # of the text, where a chain is long


@dataclass(frozen=True, slots=True)
class _Link:
    """One mode of a member: its largest utilisation inside the row and at its end.

    Above all others where it fails, then where nothing is proven.
    """

    text: str
    used: float


def draw_chains(row: RowStudy, words: Words) -> str:
    """SVG of the chains of a net row; "" where no check has a force.

    Parameters
    ----------
    row : RowStudy
        Its checks of forces are the links.
    words : Words
        Language.
    """
    chains = [chain for names in _CHAINS if (chain := list(_list(row, names, words)))]
    if not chains:
        return ""
    most = _find_weakest([one for chain in chains for one in chain])
    sketch = Chart(language=words.language)
    start = words("chain.net")
    for place, chain in enumerate(chains):
        _draw_chain(sketch, start, chain, place * _LINE + 1.0, most)
    values = tuple(one.text for chain in chains for one in chain)
    title = words("drawing.with_values", what=words("chain.title"), values=values)
    return sketch.write(len(chains) * _LINE + 2.0, title)


def _list(row: RowStudy, names: Sequence[str], words: Words) -> Iterator[_Link]:
    """Links of a chain: of a member one for each mode."""
    for name in names:
        by_mode: dict[str, list[Check]] = {}
        for check in row.checks:
            if check.member == name and check.is_of_force:
                by_mode.setdefault(check.mode, []).append(check)
        for place, (mode, checks) in enumerate(by_mode.items()):
            worst = max(checks, key=_use)
            named = [words.show(name_mode(mode))]
            if place == 0:
                named.insert(0, show_member(words, name))
            used = _show_use(worst, words)
            text = words("show.label", label=words.join(named), text=used)
            yield _Link(text=text, used=_use(worst))


def _use(check: Check) -> float:
    """Utilisation of a check, to rank it: a failure before what proves nothing."""
    if check.verdict is Verdict.FAIL:
        return _FAILED + (
            1.0 if check.is_unbounded else min(check.utilisation or 0.0, 1e6)
        )
    is_open = check.utilisation is None or check.verdict is Verdict.NOT_PROVEN
    return _OPEN if is_open else check.utilisation or 0.0


def _show_use(check: Check, words: Words) -> str:
    """Utilisation; behind the sign of its verdict, where that is no answer."""
    symbol = show_verdict(check.verdict, words).symbol
    used = math.inf if check.is_unbounded else check.utilisation
    if used is None:
        return symbol
    shown = words.show_number("utilisation", used)
    has_sign = check.verdict in (Verdict.NOT_PROVEN, Verdict.FAIL)
    return f"{symbol} {shown}" if has_sign else shown


def _find_weakest(links: Sequence[_Link]) -> float:
    """Utilisation of the weakest links; NaN, so that none is it, where all are open."""
    most = max(one.used for one in links)
    return math.nan if all(one.used == _OPEN for one in links) else most


def _draw_chain(
    sketch: Chart, start: str, chain: Sequence[_Link], top: float, most: float
) -> None:
    """One chain from left to right, smaller where it would not fit."""
    texts = [start, *(one.text for one in chain)]
    widths = [measure_words(text, TEXT_PT) + 2.0 * _PAD for text in texts]
    room = WIDTH - 2.0 - _ARROW * len(chain)
    size = max(_SMALLEST, min(1.0, room / sum(widths)))
    weakest = _find_weakest(chain)
    left, middle = 1.0, top + 0.5 * _BOX
    for place, (text, width) in enumerate(zip(texts, widths, strict=True)):
        wide = size * width
        used = chain[place - 1].used if place else None
        is_most = used is not None and used == most
        edge, thick = (ACCENT, 1.8) if is_most else (GREY, 0.6)
        corners = [(left, top), (left + wide, top), (left + wide, top + _BOX)]
        corners += [(left, top + _BOX), (left, top)]
        if place:
            sketch.line(corners, stroke=edge, width=thick)
        base = (left + size * _PAD, middle + 0.35 * size * TEXT_PT)
        is_weakest = used is not None and used == weakest
        sketch.text(*base, text, size=size * TEXT_PT, bold=is_weakest)
        left += wide
        if place < len(chain):
            sketch.arrow(
                (left + 1.0, middle), (left + _ARROW - 1.0, middle), stroke=INK
            )
            left += _ARROW


_LOADS_WIDTH = 310.0  # they stand beside a table
_LEFT, _TOP, _HEIGHT = 34.0, 16.0, 118.0
_BELOW = 26.0  # ticks and the name of the axis
_SAMPLE = 18.0  # of a line in the legend
_BETWEEN = 9.0


@dataclass(frozen=True, slots=True)
class _Line:
    """One load: its name, its looks, pressure [kPa] and height [m]."""

    label: str
    stroke: str
    dashes: str
    points: list[tuple[float, float]]


def draw_loads(record: GuidelineRecord, height: float, words: Words) -> str:
    """SVG of both loads over the height of the net; "" without a solved pressure.

    Parameters
    ----------
    record : GuidelineRecord
        Of one net row.
    height : float
        Of the net, normal to the slope [m].
    words : Words
        Of the language.
    """
    lines = list(_list_lines(record, height, words))
    if len(lines) < 2:
        return ""
    legend = (
        max(measure_words(one.label, TEXT_PT) for one in lines) + _SAMPLE + _BETWEEN
    )
    most = max(pressure for one in lines for pressure, _ in one.points)
    frame = Frame(
        left=_LEFT,
        top=_TOP,
        width=_LOADS_WIDTH - _LEFT - legend - 2.0 * _BETWEEN,
        height=_HEIGHT,
        x_low=0.0,
        x_high=1.05 * most,
        y_low=0.0,
        y_high=height,
    )
    sketch = Chart(language=words.language)
    sketch.axes(frame)
    sketch.text(0.0, TEXT_PT, words("loads.height"), bold=True)
    bottom = _TOP + _HEIGHT + _BELOW
    end = frame.left + frame.width
    sketch.text(end, bottom, words("loads.pressure"), anchor="end", bold=True)
    for place, one in enumerate(lines):
        points = [(frame.x(max(0.0, p)), frame.y(y)) for p, y in one.points]
        sketch.line(points, stroke=one.stroke, width=1.3, dash=one.dashes)
        y = _TOP + TEXT_PT + place * 1.7 * TEXT_PT
        start = end + 2.0 * _BETWEEN
        sample = [(start, y - 2.6), (start + _SAMPLE, y - 2.6)]
        sketch.line(sample, stroke=one.stroke, width=1.3, dash=one.dashes)
        sketch.text(start + _SAMPLE + 4.0, y, one.label)
    values = tuple(one.label for one in lines)
    title = words("drawing.with_values", what=words("loads.title"), values=values)
    return sketch.write(bottom + 4.0, title, _LOADS_WIDTH)


def _list_lines(
    record: GuidelineRecord, height: float, words: Words
) -> Iterator[_Line]:
    load = words.show_number("load_kN_per_m", record.solved_load_kN_per_m)
    if record.along_net:
        points = [(pressure, y) for y, pressure in record.along_net]
        yield _Line(words("loads.coupled", load=load), ACCENT, "", points)
    looks = {
        "same_snow": (INK, "5 2"),
        "load_case_1": (GREY, "1.5 1.5"),
        "load_case_2": (GREY, "6 1.5 1.5 1.5"),
    }
    for case in record.cases:
        if case.load_kN_per_m is None:
            continue
        top = case.loaded_share * height
        pressure = case.load_kN_per_m / top
        shown = words.show_number("load_kN_per_m", case.load_kN_per_m)
        label = words(f"loads.{case.name}", load=shown)
        stroke, dashes = looks[case.name]
        edge = [(0.0, 0.0), (pressure, 0.0), (pressure, top), (0.0, top)]
        yield _Line(label, stroke, dashes, edge)
