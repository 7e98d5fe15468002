"""Empty cells of a net row: the range, or the value, that counts instead.

No empty cell stops a row: knowing less widens its forces, and never hides them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

from netdesign.envelope.ranges import Interval, Ranges
from netdesign.guideline.load_model import (
    compute_altitude_factor,
    load_guideline,
    read_load_model,
)
from netdesign.site.assumed import Assumed, assume, assume_ends, load_assumed
from netdesign.site.columns.fields import from_si, to_si
from netdesign.site.lines import Lines, Types
from netdesign.site.office.project import SHARED
from netdesign.site.readings import Reading, Row
from netdesign.site.type_resistances import ANCHORS, read_axes
from netdesign.snow.creep_law import DENSEST_SNOW, ICE_DENSITY
from netdesign.snow.ground import GroundLaw
from netdesign.snow.snowpack import Layer, compute_mean_density, find_model_code_density

Snow = tuple[float, tuple[Layer, ...], GroundLaw]  # thickness [m], layers, ground
_SEVERE = {
    "slack": 0.0,
    "net_stiffness": 1.0,
    "glide_factor": 1.0,
}  # share of the range that pulls hardest
_DISTANCES = ("uphill_anchor_distance", "downhill_anchor_distance")

# No column holds these: a panel takes the worst that is built.
_ALWAYS = ("panel_system", "net_cut")


def fill_in(
    row: Row, end: Row, snow: Snow, lines: Lines
) -> tuple[Row, tuple[Assumed, ...]]:
    """Line of a net row with numbers in its empty cells, and what is assumed of these.

    Parameters
    ----------
    row, end : Row
        Line of a net row without a fault, and the cells that name other types at its
        end.
    snow : tuple of float, tuple of Layer, GroundLaw
        Thickness [m], layers, ground of its snow.
    lines : Lines
        Of all sheets.

    Returns
    -------
    Row, tuple of Assumed
        A number that is filled in is the severe end of its range, or the middle where
        none is severe; what is assumed, and the ranges that cells hold.
    """
    is_open = _find_open(row, end, lines)
    assumed = tuple(
        _assume(key, row, snow)
        for key in load_assumed()
        if is_open.get(key, key in row and row[key].state == "blank")
    )
    filled = {
        entry.key: _fill_cell(row[entry.key], entry)
        for entry in assumed
        if entry.key in row
    }
    return {**row, **filled}, (*assumed, *_list_typed(row))


def _find_open(row: Row, end: Row, lines: Lines) -> dict[str, bool]:
    """Whether each key is open, where an empty cell alone does not decide."""
    gap, count = row["gap"].given_si, row["guy_count"].given_count
    site = {assumed.key for assumed in lines.ranges.assumed}
    ropes = [
        lines.types["ropes"].get(row[key].word) for key in ("ridge_rope", "lower_rope")
    ]
    of_types = set(_list_of_types([*row.values(), *end.values()], lines.types))
    return {
        **dict.fromkeys(_ALWAYS, True),
        **{key: key in site for key in SHARED},
        **{key: key in of_types for key in _OF_TYPES},
        "altitude": not row["altitude"].given_si,
        "snow_layers": row["id"].word not in lines.snow,
        "axial_stiffness": any(
            rope is None or rope["axial_stiffness"].state != "given" for rope in ropes
        ),
        **{key: gap != 0.0 and row[key].state == "blank" for key in _OF_END},
        "guy_splay": count != 1 and row["guy_splay"].state == "blank",
        "guy_anchors": count != 1 and row["guy_anchors"].state == "blank",
        "row_end": gap is None,
        "anchor_axes": len(read_axes(row, ANCHORS, lines.types)) < len(ANCHORS),
    }


_OF_END = ("post_count", "ropes_at_supports", "end_guy_angle")
_OF_TYPES = ("anchor_kind", "lever_arm", "base_friction", "buckling_length")


def _list_of_types(readings: Sequence[Reading], types: Types) -> Iterator[str]:
    """What is assumed of anchors and posts that cells name, by key."""
    anchors, posts = (
        [
            types[table][reading.word]
            for reading in readings
            if reading.field.refers_to == table and reading.word
        ]
        for table in ("anchor_types", "posts")
    )
    for line in anchors:
        kind = line["kind"].word
        if not kind:
            yield "anchor_kind"
        if kind != "rope anchor" and line["lever_arm"].state == "blank":
            yield "lever_arm"
    if not posts or any(post["base_friction"].state == "blank" for post in posts):
        yield "base_friction"


def _assume(key: str, row: Row, snow: Snow) -> Assumed:
    """Range or value of an empty column, as far as it hangs on the row."""
    thickness, layers, ground = snow
    if key in _DISTANCES:
        return assume(key, row["net_height"].si)
    if key == "upslope_length":
        felt = _FROM + _MORE * math.cbrt(ground.slip_length / thickness)
        return assume_ends(key, thickness * felt, thickness * felt)
    if key == "density":
        height = thickness / math.cos(row["slope_angle"].si)
        return assume_density(height, row["altitude"].given_si, layers)
    return assume(key)


def _fill_cell(reading: Reading, assumed: Assumed) -> Reading:
    """Reading of an empty cell as the calculation begins with it."""
    share = _SEVERE.get(assumed.key, 0.5)
    value = (1.0 - share) * assumed.low + share * assumed.high
    number = from_si(value, reading.field.unit)
    return replace(reading, state="default", value=None if assumed.word else number)


# Snow farther upslope than (_FROM + _MORE r^(1/3)) d adds less than 0.1 % to the pulls,
# r = D* / d; snow/THEORY.md, (N16a).
_FROM, _MORE = 12.0, 16.5


def assume_density(
    height: float, altitude: float | None, layers: Sequence[Layer]
) -> Assumed:
    """Range of the mean density of a row where it is not given.

    Parameters
    ----------
    height : float
        Largest of the snow, vertical [m].
    altitude : float or None
        [m]; None is not known.
    layers : sequence of Layer
        Whose mean it holds, too.
    """
    usual, factor = assume("density"), 1.0  # of an altitude not known: the least
    if altitude is not None:
        model = read_load_model(load_guideline())
        factor = compute_altitude_factor(model, altitude)
    low = min(factor * usual.low, usual.high)
    high = max(usual.high, find_model_code_density(height))
    if layers:  # which follow the range: none gets denser than ice
        mean = compute_mean_density(tuple(layers))
        densest = max(layer.density for layer in layers) / mean
        most = min(high, DENSEST_SNOW * ICE_DENSITY / densest)
        low, high = min(low, mean), max(mean, most)
    return assume_ends("density", low, high)


# Columns of snow and ground whose range is searched with the cases.
_OF_CASES = ("snow", "glide_factor", "upslope_length")


def _list_typed(row: Row) -> tuple[Assumed, ...]:
    """Ranges of net and support that cells of a row hold."""
    keys = [key for key in load_assumed() if key in row and key not in _OF_CASES]
    if row["gap"].given_si == 0.0:
        keys.remove("end_guy_angle")
    return tuple(
        replace(
            assume(reading.field.key),
            low=to_si(reading.span[0], reading.field.unit),
            high=to_si(reading.span[1], reading.field.unit),
            unit=reading.field.unit,
            source="typed",
            is_typed=True,
        )
        for reading in (row[key] for key in keys)
        if reading.span is not None
    )


def find_own_ranges(assumed: Sequence[Assumed], row: Row) -> Ranges:
    """Ranges that are searched of a row: assumed ones, and those its cells hold."""
    intervals = {
        entry.key: Interval(low=entry.low, high=entry.high)
        for entry in assumed
        if entry.kind == "searched"
    }
    for reading in (row[key] for key in _OF_CASES):
        if reading.span is not None:
            low, high = (to_si(end, reading.field.unit) for end in reading.span)
            key = reading.field.key
            name = "thickness" if key == "snow_thickness" else key
            intervals[name] = Interval(low=low, high=high)
    return Ranges.of(**intervals)
