"""Numbers that can hardly be meant beside those of the other lines of their sheet."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from statistics import median

from netdesign.site.plausible.doubts import Doubt, is_typed
from netdesign.site.readings import Reading, Row
from netdesign.words.message import say

_LEAST_LINES = 5
_BEYOND = 4.0  # times the scatter of a column about its median
_NAME = re.compile(r"^(\D*)(\d+(?:[.,]\d+)?)(.*)$")
# Force over the square of the diameter that a type's name gives [kN/mm2].
_FITS = (0.25, 1.3)
_OTHERS = 2  # types, at least, whose names give a diameter
_DIAMETERS = (10.0, 80.0)  # [mm]
_BY_DIAMETER = {"Anchors": "tendon", "Ropes": "rope"}


def list_column_doubts(lines: Sequence[Row], sheet: str) -> Iterator[Doubt]:
    """Doubts about numbers of a sheet beside others of their column.

    Parameters
    ----------
    lines : sequence of mapping of str to Reading
        All lines of the sheet.
    sheet : str
        Its name in English.
    """
    keys = lines[0].keys() if lines else ()
    for key in keys:
        if not lines[0][key].field.scatters:
            yield from _list_outliers([one[key] for one in lines])
    if sheet in _BY_DIAMETER:
        yield from _list_misfits(lines, _BY_DIAMETER[sheet])


def _list_outliers(readings: Sequence[Reading]) -> Iterator[Doubt]:
    """Numbers far off the median of five or more, by ratio."""
    typed = [one for one in readings if is_typed(one) and one.number > 0.0]
    if len(typed) < _LEAST_LINES:
        return
    middle = median(one.number for one in typed)
    scatter = median(_find_ratio(one.number, middle) for one in typed)
    for one in typed:
        if _find_ratio(one.number, middle) > _BEYOND * scatter:
            yield (
                one,
                say(
                    "plausible.outlier",
                    times=one.number / middle,
                    middle=middle,
                    unit=one.field.unit,
                    count=len(typed),
                ),
            )


def _find_ratio(one: float, other: float) -> float:
    return max(one / other, other / one)


def _list_misfits(lines: Sequence[Row], key: str) -> Iterator[Doubt]:
    """Forces that do not follow the diameters in the names of their types.

    Numbers are diameters where they fit the forces of all types but one.
    """
    named = [one for line in lines if (one := _read_name(line, key))]
    off = [one for one in named if not _fits(one[1], one[2])]
    if len(named) - len(off) < _OTHERS or len(off) > 1:
        return
    for _, diameter, reading in off:
        yield reading, say("plausible.diameter", diameter=diameter)
    fitting = [one for one in named if one not in off]
    for kind, diameter, reading in fitting:
        for other_kind, other, beside in fitting:
            is_smaller = kind == other_kind and diameter < other
            if is_smaller and reading.number > beside.number:
                yield reading, say("plausible.more", place=beside.place)
                yield beside, say("plausible.less", place=reading.place)


def _read_name(line: Row, key: str) -> tuple[str, float, Reading] | None:
    """Text around the number of a name, the number, and the force of the type."""
    match, reading = _NAME.match(line["id"].word), line[key]
    if match is None or not is_typed(reading):
        return None
    diameter = float(match[2].replace(",", "."))
    if not _DIAMETERS[0] <= diameter <= _DIAMETERS[1]:
        return None
    return f"{match[1]}|{match[3]}", diameter, reading


def _fits(diameter: float, reading: Reading) -> bool:
    low, high = _FITS
    return low <= reading.number / diameter**2 <= high
