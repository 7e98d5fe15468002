"""Every value of a study by its place, so that two studies can be compared whole."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, is_dataclass
from enum import Enum
from typing import Any

from netdesign.edge.json_text import list_fields
from netdesign.words.message import Message, say

SAME = 1e-6  # relative; other machines differ in the last digits only
ROUNDING = 1e-12  # relative; of the same number, summed in another order
# Absolute, of residuals, shares and small differences, which are rounding themselves.
_NOISE = 1e-6
_PERCENT = "_percent"  # end of the name of a difference or an error
_PLAIN = frozenset({float, int, str, bool, type(None)})  # have no values within


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """One value that two studies do not share; None where one has none."""

    place: str  # "rows.R1.checks.foot_anchor.tendon.demand_kN"
    stored: Any
    again: Any

    @property
    def message(self) -> Message:
        """``rows.R1.verdict: stored 'pass', again 'fail'``."""
        stored, again = show_value(self.stored), show_value(self.again)
        return say("value.differs", place=self.place, stored=stored, again=again)


def show_value(value: object) -> Message | str:
    """A value as Python writes it, a number with the reader's decimal mark; or none."""
    if value is None:
        return say("value.none")
    return say("value.number", number=value) if type(value) is float else repr(value)


def list_values(part: object) -> dict[str, Any]:
    """Values of a study, or of a part of one, by their places.

    Members of a list stand under their ids, if each has its own; the order of these
    is a value too.
    """
    values: dict[str, Any] = {}
    _collect(part, "", values)
    return values


def compare_values(
    stored: object, again: object, *, is_exact: bool = False
) -> list[Difference]:
    """Places at which two parts differ, in the order of the first.

    Parameters
    ----------
    stored, again : object
        Studies, or the same part of each.
    is_exact : bool
        Numbers count as different by more than their rounding; otherwise by more than
        a millionth, which other machines and libraries do not reach.
    """
    return compare_listed(list_values(stored), list_values(again), is_exact=is_exact)


def compare_listed(
    old: Mapping[str, Any], new: Mapping[str, Any], *, is_exact: bool = False
) -> list[Difference]:
    """Places at which two parts differ, in the order of the first.

    Parameters
    ----------
    old, new : mapping
        What ``list_values`` gives of the two parts.
    is_exact : bool
        As in ``compare_values``.
    """
    places = dict.fromkeys((*old, *new))
    return [
        Difference(place=place, stored=old.get(place), again=new.get(place))
        for place in places
        if place not in old
        or place not in new
        or not _is_same(old[place], new[place], 0.0 if is_exact else _find_noise(place))
    ]


def _collect(value: Any, place: str, values: dict[str, Any]) -> None:
    """Add the values of a part to those known, in the order of the part."""
    if type(value) in _PLAIN:
        values[place] = value
        return
    if is_dataclass(value):
        value = list_fields(value)
    if not isinstance(value, Mapping | list | tuple):
        values[place] = str(value) if isinstance(value, Enum) else value
        return
    ids: list[str] = []
    names: Iterable[object] = value
    parts: Iterable[object] = value
    if isinstance(value, Mapping):
        parts = value.values()
    else:
        ids = _list_ids(value)
        names = ids or range(len(value))
    if not value:
        values[place] = {} if isinstance(value, Mapping) else type(value)()
    before = f"{place}." if place else ""
    if ids:
        values[f"{before}order"] = ", ".join(ids)
    for name, part in zip(names, parts, strict=True):
        _collect(part, f"{before}{name}", values)


def _list_ids(members: Sequence[Any]) -> list[str]:
    """Ids or symbols of the members of a list; none if one lacks it or two share it."""
    ids = [str(getattr(one, "id", getattr(one, "symbol", ""))) for one in members]
    return ids if all(ids) and len(set(ids)) == len(ids) else []


def _find_noise(place: str) -> float:
    """Absolute difference that counts as none; two forces make a difference in %."""
    return 100.0 * _NOISE if place.endswith(_PERCENT) else _NOISE


def _is_same(old: Any, new: Any, noise: float) -> bool:
    if all(isinstance(one, float) or type(one) is int for one in (old, new)):
        tolerance = SAME if noise else ROUNDING
        return math.isclose(old, new, rel_tol=tolerance, abs_tol=noise)
    return type(old) is type(new) and bool(old == new)
