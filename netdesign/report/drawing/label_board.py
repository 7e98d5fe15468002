"""Places for the labels of a drawing: no two meet, few cross a line.

A label is tried around its point, near first, and in the direction that suits it best;
where it has to go further off, a thin line leads to it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from netdesign.report.drawing.plain_svg import (
    GREY,
    INK,
    TEXT_PT,
    Chart,
    Point,
    measure_words,
)

LINE_PT = 1.3 * TEXT_PT  # from one line of a label to the next
_AIR = 1.5  # between two labels [pt]
_STEP = 3.0  # between the points of a line that stand for it [pt]
_REACHES = (4.0, 9.0, 15.0, 22.0, 30.0, 40.0, 52.0, 66.0, 82.0)
_FURTHER = (105.0, 135.0, 170.0, 210.0, 260.0, 320.0)  # where a label may cross a line
_LED_FROM = 12.0  # reach from which a line leads to the label
_TURNS = (0, 1, -1, 2, -2, 3, -3, 4, -4, 5, -5, 6, -6, 7, -7, 8)  # of 22.5 degrees
_DESCENT = 0.25  # of a letter below its line


@dataclass(frozen=True, slots=True)
class Box:
    """A rectangle on paper [pt]; y downwards."""

    left: float
    top: float
    right: float
    bottom: float

    def meets(self, other: Box, air: float = 0.0) -> bool:
        """They overlap, or come closer than ``air``."""
        return (
            self.left < other.right + air
            and other.left < self.right + air
            and self.top < other.bottom + air
            and other.top < self.bottom + air
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Label:
    """Lines of text, each with its colour, that belong to a point of the drawing."""

    lines: tuple[tuple[str, str], ...]
    at: Point
    toward: Point  # direction in which it would stand best

    @property
    def size(self) -> tuple[float, float]:
        """Width and height [pt]."""
        wide = max(measure_words(text, TEXT_PT) for text, _ in self.lines)
        return wide, LINE_PT * len(self.lines)


@dataclass(slots=True, kw_only=True)
class LabelBoard:
    """Paper of a drawing, and what its labels have to leave free."""

    width: float
    height: float
    taken: list[Box] = field(default_factory=list)
    lines: list[Point] = field(default_factory=list)

    def reserve(self, box: Box) -> None:
        """Keep labels out of an area."""
        self.taken.append(box)

    def avoid(self, points: Sequence[Point]) -> None:
        """Keep labels off a line where there is room elsewhere."""
        for (x0, y0), (x1, y1) in pairwise(points):
            count = max(1, round(math.dist((x0, y0), (x1, y1)) / _STEP))
            shares = [k / count for k in range(count + 1)]
            self.lines += [(x0 + s * (x1 - x0), y0 + s * (y1 - y0)) for s in shares]

    def draw(self, sketch: Chart, label: Label) -> None:
        """Write a label where it is free."""
        box, foot, reach = self._find(label)
        self.taken.append(box)
        is_right = foot[0] > box.left + (box.right - box.left) / 2
        if reach >= _LED_FROM:
            sketch.line([label.at, foot], stroke=GREY, width=0.4)
            self.avoid([label.at, foot])
        anchor, x = ("end", box.right) if is_right else ("start", box.left)
        for place, (text, colour) in enumerate(label.lines):
            base = box.top + (place + 1) * LINE_PT - _DESCENT * TEXT_PT
            sketch.text(x, base, text, anchor=anchor, fill=colour)

    def _find(self, label: Label) -> tuple[Box, Point, float]:
        """Box of the label, the point of it that is nearest to its own, the reach."""
        passes = ((True, _REACHES), (False, (*_REACHES, *_FURTHER)))
        for avoids_lines, reaches in passes:
            for box, foot, reach in _list_places(label, reaches):
                if self._is_free(box, avoids_lines=avoids_lines):
                    return box, foot, reach
        wide, tall = label.size
        box = Box(0.0, self.height, wide, self.height + tall)
        return box, (box.right, box.top + tall / 2), math.inf

    def _is_free(self, box: Box, *, avoids_lines: bool) -> bool:
        if box.left < 0 or box.top < 0:
            return False
        if box.right > self.width or box.bottom > self.height:
            return False
        if any(box.meets(other, _AIR) for other in self.taken):
            return False
        return not (avoids_lines and self._crosses_line(box))

    def _crosses_line(self, box: Box) -> bool:
        left, right = box.left - 1, box.right + 1
        top, bottom = box.top - 1, box.bottom + 1
        return any(left < x < right and top < y < bottom for x, y in self.lines)


def _list_places(
    label: Label, reaches: Sequence[float]
) -> Iterator[tuple[Box, Point, float]]:
    """Boxes around the point of a label, near first, each with its foot and reach."""
    best, size = math.atan2(label.toward[1], label.toward[0]), label.size
    for reach in reaches:
        for turn in _TURNS:
            angle = best + math.pi / 8 * turn
            foot = (
                label.at[0] + reach * math.cos(angle),
                label.at[1] + reach * math.sin(angle),
            )
            yield _hang(size, foot, angle), foot, reach


def write_label(text: str, at: Point, toward: Point, colour: str = INK) -> Label:
    """Label of one line."""
    return Label(lines=((text, colour),), at=at, toward=toward)


def _hang(size: tuple[float, float], foot: Point, angle: float) -> Box:
    """Box of a size that begins at ``foot`` and lies in the direction ``angle``."""
    wide, tall = size
    left = foot[0] - wide * _share(math.cos(angle))
    top = foot[1] - tall * _share(math.sin(angle))
    return Box(left, top, left + wide, top + tall)


def _share(part: float) -> float:
    """Part of a box that lies before its foot: all, half or nothing of it."""
    if part > 0.35:
        return 0.0
    return 1.0 if part < -0.35 else 0.5
