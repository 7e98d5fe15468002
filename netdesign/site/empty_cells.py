"""Empty cells of a net row: the range, or the value, that counts instead.

No empty cell stops a row: knowing less widens its forces, and never hides them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from netdesign.envelope.ranges import Interval, Ranges
from netdesign.guideline.load_model import (
    compute_altitude_factor,
    load_guideline,
    read_load_model,
)
from netdesign.site.assumed import Assumed, assume, assume_ends
from netdesign.site.columns.fields import from_si, to_si
from netdesign.site.ranges import SiteRanges
from netdesign.site.readings import Reading, Row
from netdesign.site.statements import list_open_ropes
from netdesign.snow.creep_law import DENSEST_SNOW, ICE_DENSITY
from netdesign.snow.ground import GroundLaw
from netdesign.snow.heights import find_model_code_density
from netdesign.snow.snowpack import Layer, compute_mean_density
from netdesign.words.message import say

Snow = tuple[float, tuple[Layer, ...], GroundLaw]  # thickness, layers, on what
_SEVERE = {
    "slack": 0.0,
    "net_stiffness": 1.0,
    "glide_factor": 1.0,
}  # share of the range that pulls hardest
_DISTANCES = ("uphill_anchor_distance", "downhill_anchor_distance")
_SAGS = ("ridge_sag", "lower_sag")


def fill_in_assumed(row: Row) -> tuple[Row, tuple[Assumed, ...]]:
    """Line with numbers in those empty cells that a calculation needs one of.

    Parameters
    ----------
    row : mapping of str to Reading
        Line of a net row.

    Returns
    -------
    Row, tuple of Assumed
        A number that is filled in is the severe end of its range, or the middle where
        none is severe; what is assumed of net and support.
    """
    found = tuple(_list_of_net(row))
    filled = {one.key: _place(row[one.key], one) for one in found if one.key in row}
    glide = (assume("glide_factor"),) if _lacks_glide(row) else ()
    for one in glide:
        how = say("assumed.any_class", low=one.low, high=one.high)
        glide_factor = _place(row[one.key], one)
        filled[one.key] = replace(glide_factor, derivation=how)
    return {**row, **filled}, (*found, *glide, *_list_of_support(row))


def _place(reading: Reading, assumed: Assumed) -> Reading:
    """Reading of an empty cell as the calculation begins with it."""
    share = _SEVERE.get(assumed.key, 0.5)
    value = (1.0 - share) * assumed.low + share * assumed.high
    number = from_si(value, reading.field.unit)
    return replace(reading, state="default", value=number)


def _list_of_net(row: Row) -> Iterator[Assumed]:
    """Numbers of net and support that a line leaves empty."""
    for key in ("slack", "net_stiffness"):
        if row[key].state == "blank":
            yield assume(key)
    if row["post_tilt"].state == "blank":
        yield assume("post_tilt")
    height = row["net_height"]
    for key in _DISTANCES:
        if row[key].state == "blank" and isinstance(height.value, float):
            yield assume(key, height.si)


def _lacks_glide(row: Row) -> bool:
    """Neither a glide factor nor free gliding is given."""
    return row["glide_factor"].state == "blank"


def _list_of_support(row: Row) -> Iterator[Assumed]:
    """What is assumed of guys, and of the ropes between two posts."""
    count = row["guy_count"]
    if count.state == "blank":
        yield assume("guy_count")
    if count.given_count != 1 and row["guy_splay"].state == "blank":
        yield assume("guy_splay")
    yield from (assume(key) for key in _SAGS if row[key].state == "blank")


def assume_stiffness(row: Row, ropes: Mapping[str, Row]) -> tuple[Assumed, ...]:
    """Stiffness of border ropes, where a type of the row does not give it."""
    return (assume("axial_stiffness"),) if list_open_ropes(row, ropes) else ()


def fill_in_snow(
    row: Row, snow: Snow, ranges: SiteRanges, lines: Sequence[Row]
) -> tuple[Row, tuple[Assumed, ...]]:
    """Line with a length of its snow, and what is assumed of its snow.

    Parameters
    ----------
    row : mapping of str to Reading
        Line of a net row, without a fault.
    snow : tuple of float, tuple of Layer, GroundLaw
        Thickness, layers, on what.
    ranges : SiteRanges
        Of the site, which lists what it does not give.
    lines : sequence of Row
        Of sheet Snow.
    """
    thickness, layers, ground = snow
    altitude = row["altitude"].given_si
    found: list[Assumed] = [] if altitude else [assume("altitude")]
    if not lines:
        found.append(assume("snow_layers"))
    for one in ranges.assumed:
        if one.key == "density":
            height = thickness / math.cos(row["slope_angle"].si)
            one = assume_density(height, altitude, layers)
        found.append(one)
    if row["upslope_length"].state != "blank":
        return row, tuple(found)
    length = assume_upslope(thickness, ground)
    filled = {**row, length.key: _place(row[length.key], length)}
    return filled, (*found, length)


# Snow farther upslope than (_FROM + _MORE r^(1/3)) d adds less than 0.1 % to the pulls,
# r = D* / d; snow/THEORY.md, (N16a).
_FROM, _MORE = 12.0, 16.5


def find_felt_length(thickness: float, slip_length: float) -> float:
    """Length of the snow that a net on ground that holds it feels [m].

    Parameters
    ----------
    thickness : float
        d, normal to the slope [m].
    slip_length : float
        D* of the ground [m].
    """
    return thickness * (_FROM + _MORE * math.cbrt(slip_length / thickness))


def assume_upslope(thickness: float, ground: GroundLaw) -> Assumed:
    """Upslope length of a line that gives none, on ground that holds the snow."""
    length = find_felt_length(thickness, ground.slip_length)
    return assume_ends("upslope_length", length, length)


def assume_density(
    height: float, altitude: float | None, layers: Sequence[Layer]
) -> Assumed:
    """Range of the mean density of a row for which nobody gives one.

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


# Columns that may hold a range, which counts as one that is assumed.
_OF_TYPE = (
    *("slack", "net_stiffness", "post_tilt", *_DISTANCES, "guy_splay"),
    "end_guy_angle",
)
# Those whose range is searched with the cases.
_OF_CASES = ("snow", "glide_factor", "upslope_length")


def list_typed(row: Row, *, has_end: bool) -> tuple[Assumed, ...]:
    """Ranges of net and support that cells of a row hold."""
    keys = _OF_TYPE if has_end else _OF_TYPE[:-1]
    return tuple(
        replace(
            assume(one.field.key),
            low=to_si(one.span[0], one.field.unit),
            high=to_si(one.span[1], one.field.unit),
            unit=one.field.unit,
            times="",
            source="typed",
            is_typed=True,
        )
        for one in (row[key] for key in keys)
        if one.span is not None
    )


def find_own_ranges(assumed: Sequence[Assumed], row: Row) -> Ranges:
    """Ranges that are searched of a row: assumed ones, and those its cells hold."""
    found = {
        one.key: Interval(low=one.low, high=one.high)
        for one in assumed
        if one.kind == "searched"
    }
    for reading in (row[key] for key in _OF_CASES):
        if reading.span is not None:
            low, high = (to_si(end, reading.field.unit) for end in reading.span)
            key = reading.field.key
            name = "thickness" if key == "snow_thickness" else key
            found[name] = Interval(low=low, high=high)
    return Ranges.of(**found)
