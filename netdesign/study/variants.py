"""Variants of a net row: the corners of what is assumed of its statics.

Post, guys and end guy hold what the net pulls, and do not change it: a variant has the
row's solved cases, and forces of its own. Where the largest lies: structure/THEORY.md,
"Where nobody gives a number".
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import product

from netdesign.checks.check import AssumedPoint
from netdesign.site.model import NetRow
from netdesign.structure.layout import SupportLayout
from netdesign.structure.splay import Guys
from netdesign.units import given_degree_from_radian

_OF_LAYOUT = ("post_tilt", "uphill_anchor_distance", "downhill_anchor_distance")
_COUNT, _SPLAY, _END = "guy_count", "guy_splay", "end_guy_angle"
_UNITS = {"deg": "_deg"}
_OF_STATICS = (*_OF_LAYOUT, _COUNT, _SPLAY, _END)


def list_layouts(row: NetRow) -> tuple[SupportLayout, ...]:
    """Layouts of a row's support at all corners of what is assumed of them."""
    ends = {key: _list_ends(row, key) for key in _OF_LAYOUT}
    assumed = {key: found for key, found in ends.items() if found}
    return tuple(
        replace(row.layout, **dict(zip(assumed, corner, strict=True)))
        for corner in product(*assumed.values())
    )


def list_variants(row: NetRow) -> tuple[NetRow, ...]:
    """The row at each corner of what is assumed of its statics; itself without any.

    What is assumed of a variant has one value, at which it is. Those of one layout
    stand together, the layouts in the order of ``list_layouts``.
    """
    ends = {key: _list_ends(row, key) for key in _OF_STATICS}
    assumed = {key: found for key, found in ends.items() if found}
    found: dict[tuple[tuple[str, float], ...], NetRow] = {}
    for corner in product(*assumed.values()):
        values = dict(zip(assumed, corner, strict=True))
        if values.get(_COUNT, row.guys.count) < 2:
            values.pop(_SPLAY, None)  # a single guy has none
        key = tuple(values.items())
        if key not in found:
            found[key] = place_variant(row, values)
    return tuple(found.values())


def place_variant(row: NetRow, values: Mapping[str, float]) -> NetRow:
    """The row with values of what is assumed of its statics, by their keys."""
    layout = {key: values[key] for key in _OF_LAYOUT if key in values}
    guys, end = row.guys, row.row_end
    if _COUNT in values or _SPLAY in values:
        count = int(values.get(_COUNT, guys.count))
        splay = values.get(_SPLAY, guys.splay) if count > 1 else None
        guys = Guys(count=count, splay=splay, are_shared=guys.are_shared)
    if end is not None and _END in values:
        end = replace(end, guy_angle=values[_END])
    return replace(
        row,
        layout=replace(row.layout, **layout),
        guys=guys,
        row_end=end,
        assumed=tuple(
            replace(one, low=values[one.key], high=values[one.key])
            if one.key in values
            else one
            for one in row.assumed
            if one.key != _SPLAY or guys.count > 1
        ),
    )


def read_values(row: NetRow) -> dict[str, float]:
    """Values of what is assumed of a variant's statics, by their keys, in SI units."""
    return {
        one.key: one.low
        for one in row.assumed
        if one.key in _OF_STATICS and not one.is_range
    }


def describe_variant(row: NetRow) -> AssumedPoint | None:
    """What is assumed of a variant, at which it is; None of a row that is given."""
    shown = {
        f"{one.key}{_UNITS.get(one.unit, '_m')}" if one.key != _COUNT else _COUNT: (
            given_degree_from_radian(one.low) if one.unit == "deg" else one.low
        )
        for one in row.assumed
        if one.key in _OF_STATICS and not one.is_range
    }
    return AssumedPoint(**shown) if shown else None


def is_layout_assumed(row: NetRow) -> bool:
    """Whether nobody gives some distance or tilt of its support."""
    return any(row.find_assumed(key) is not None for key in _OF_LAYOUT)


def _list_ends(row: NetRow, key: str) -> tuple[float, ...]:
    """Ends of what is assumed of a column; none where it is given."""
    found = row.find_assumed(key)
    if found is None or (key == _END and row.row_end is None):
        return ()
    return tuple(dict.fromkeys((found.low, found.high)))
