"""Ranges that the rows of a site share: density, friction and inclination of nets."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from netdesign.envelope.ranges import Interval, Ranges
from netdesign.site.assumed import Assumed, assume
from netdesign.site.model import InputEcho
from netdesign.site.readings import Reading, Row
from netdesign.words.message import say

DOCUMENTS = ("snow_document", "glide_document", "ground_document")
QUANTITIES = ("density", "friction_angle", "inclination")


@dataclass(frozen=True, slots=True, kw_only=True)
class SiteRanges:
    """Ranges of a site, as far as they could be understood.

    Attributes
    ----------
    ranges : Ranges or None
        SI units; None where a line has a fault.
    inputs : tuple of InputEcho
        Both ends of each range, in the units of the edge.
    assumed : tuple of Assumed
        Those that have no line.
    lines : tuple of Row
        Both ends of each range, one a line.
    """

    ranges: Ranges | None = None
    inputs: tuple[InputEcho, ...] = ()
    assumed: tuple[Assumed, ...] = ()
    lines: tuple[Row, ...] = ()


def build_ranges(lines: Mapping[str, Reading]) -> SiteRanges:
    """Ranges of the three quantities; the assumed ones where a line is empty.

    The inputs end with the documents that snow, glide factors and ground come from.

    Parameters
    ----------
    lines : mapping of str to Reading
        Of sheet Project, by key.
    """
    readings = [lines[key] for key in QUANTITIES]
    if any(reading.state == "faulty" for reading in readings):
        return SiteRanges()
    ends = [_split(reading) for reading in readings if reading.state == "given"]
    documents = [lines[key] for key in DOCUMENTS if lines[key].state == "given"]
    assumed = tuple(
        assume(reading.field.key) for reading in readings if reading.state != "given"
    )
    return SiteRanges(
        ranges=Ranges.of(
            **{
                entry.key: Interval(low=entry.low, high=entry.high) for entry in assumed
            },
            **{low.field.key: Interval(low=low.si, high=high.si) for low, high in ends},
        ),
        inputs=tuple(
            reading.echo()
            for reading in (*(end for pair in ends for end in pair), *documents)
        ),
        assumed=assumed,
        lines=tuple({end.field.key: end} for pair in ends for end in pair),
    )


def _split(reading: Reading) -> tuple[Reading, Reading]:
    """Low and high end of what one cell holds; twice the same of a single value."""
    field = replace(reading.field, may_range=False)
    low, high = reading.span or (reading.number, reading.number)
    names = (say(f"column.{end}_end", name=field.name) for end in ("low", "high"))
    first, second = (
        replace(reading, field=replace(field, named=name), value=end, span=None)
        for name, end in zip(names, (low, high), strict=True)
    )
    return first, second
