"""Numbers typed with what belongs to them in one cell: a unit, both ends of a range."""

from __future__ import annotations

import re

from netdesign.site.cells.cells import Cell

_NUMBER = r"[+-]?(?:[\d.,'’\s\u00a0\u202f\u2009]*\d)"
_WITH_UNIT = re.compile(rf"({_NUMBER})\s*([^\d\s.,'’+-].*)")
# Of the ends no sign is read, so that no minus is taken for a dash nor a dash for one.
_END = r"\d(?:[\d.,'’\u00a0\u202f\u2009]*\d)?"
_UNIT = r"[^\d\s.,'’+–—÷-][^\d\s]*\d?|"
_RANGE = re.compile(
    rf"(?:(?:de|von|from|da)\s+)?({_END})\s*({_UNIT})\s*"
    rf"(?:-|–|—|÷|\.\.\.?|…|à|a|bis|to)\s*({_END})\s*({_UNIT})",
    re.IGNORECASE,
)


def split_unit(text: str) -> tuple[str, str]:
    """Number and what is typed behind it, both as typed; no unit where there is none.

    >>> split_unit("3,0 m"), split_unit("12 500"), split_unit("about 3 m")
    (('3,0', 'm'), ('12 500', ''), ('about 3 m', ''))
    """
    found = _WITH_UNIT.fullmatch(text.strip())
    return (found[1].strip(), found[2].strip()) if found else (text, "")


def find_typed_unit(cell: Cell) -> str:
    """Unit that a cell shows itself: typed behind its number or set by its format."""
    if isinstance(cell.value, str):
        return split_unit(cell.value)[1]
    return "%" if cell.is_percent else cell.shown_unit


def split_range(text: str) -> tuple[str, str, str] | None:
    """Low end, high end and unit of a range in one cell; None where it is none.

    >>> split_range("250-450"), split_range("20° à 35°"), split_range("-5-10")
    (('250', '450', ''), ('20', '35', '°'), None)
    """
    found = _RANGE.fullmatch(text.strip())
    if found is None:
        return None
    low, low_unit, high, high_unit = (one.strip() for one in found.groups())
    if low_unit and low_unit != high_unit:
        return None
    return low, high, high_unit
