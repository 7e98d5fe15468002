"""End effect of a row: the profile's, and the program's own beside it."""

from __future__ import annotations

import math
from itertools import product

from netdesign.checks import Standard
from netdesign.envelope.ranges import Ranges
from netdesign.guideline.load_model import read_end_effect
from netdesign.haefeli.slab import Slab
from netdesign.outcome import ModelError
from netdesign.planview.end_effect import EndEffect, compute_end_effect
from netdesign.site.model import NetRow
from netdesign.snow.creep_law import CreepLaw
from netdesign.structure.row_position import LoadedWidth, compute_edge_width
from netdesign.study.effects import RowEffects, find_row_glide_factor
from netdesign.study.support_records import EndEffectRecord
from netdesign.words.message import Message, say

# Of the table beside the note; the row's own gap [m] and glide factor join them.
_GAPS = (1.0, 2.0, math.inf)
_GLIDE_FACTORS = (1.2, 2.4, 3.2)


def list_end_notes(
    row: NetRow, ranges: Ranges, law: CreepLaw, effects: RowEffects
) -> list[Message]:
    """Own end effect beside the profile's; it decides nothing.

    Density in the middle of its range: over 150 to 550 kg/m3 the factors change by
    less than 8 %.

    Parameters
    ----------
    row : NetRow
        Net row.
    ranges : Ranges
        Of the envelope.
    law : CreepLaw
        Creep law of the study.
    effects : RowEffects
        With the profile's end effect.
    """
    edge = effects.find_support("edge")
    if not edge.end_factor * edge.end_length > 0.0:
        return []
    density, glide = _find_density(ranges), find_row_glide_factor(row)
    own = _compute_own(row, density, law, row.gap, glide, edge.end_length)
    return [] if own is None else [_tell(edge, own, glide, density)]


def record_end_effects(
    row: NetRow, ranges: Ranges, law: CreepLaw, standard: Standard
) -> list[EndEffectRecord]:
    """End effects over gaps and glide factors, the row's own among them.

    None of a row without an end, or under a profile without an end effect.
    """
    rule = read_end_effect(standard)
    if rule is None or not row.has_end:
        return []
    found, density = [], _find_density(ranges)
    own_glide = find_row_glide_factor(row)
    for gap, glide in product(
        sorted({*_GAPS, row.gap}), sorted({*_GLIDE_FACTORS, own_glide})
    ):
        edge = compute_edge_width(
            rule,
            post_spacing=row.layout.post_spacing,
            net_height=row.net_height,
            gap=gap,
            glide_factor=glide,
        )
        if not edge.end_length > 0.0:
            continue
        own = _compute_own(row, density, law, gap, glide, edge.end_length)
        if own is not None:
            is_own = (gap, glide) == (row.gap, own_glide)
            found.append(_record(edge, own, gap, glide, is_own=is_own))
    return found


def _record(
    edge: LoadedWidth, own: EndEffect, gap: float, glide: float, *, is_own: bool
) -> EndEffectRecord:
    return EndEffectRecord(
        gap_m=None if gap == math.inf else gap,
        glide_factor=glide,
        is_own=is_own,
        end_length_m=edge.end_length,
        profile_factor=edge.end_factor,
        profile_width_m=edge.end_factor * edge.end_length,
        free_factor=own.free.factor,
        free_width_m=own.free.width,
        pulled_factor=own.pulled.factor,
        pulled_width_m=own.pulled.width,
    )


def _find_density(ranges: Ranges) -> float:
    """Middle of the range of densities [kg/m3]."""
    span = ranges["density"]
    return 0.5 * (span.low + span.high)


def _compute_own(
    row: NetRow,
    density: float,
    law: CreepLaw,
    gap: float,
    glide_factor: float,
    length: float,
) -> EndEffect | None:
    """End effect by the plan view; None for snow that the law does not take."""
    try:
        return compute_end_effect(
            Slab(
                thickness=row.snow_thickness,
                slope_angle=row.slope_angle,
                density=density,
                creep_law=law,
            ),
            gap=gap,
            glide_factor=glide_factor,
            length=length,
        )
    except ModelError:  # the row's cases say so
        return None


def _tell(edge: LoadedWidth, own: EndEffect, glide: float, density: float) -> Message:
    width = edge.end_factor * edge.end_length
    is_larger = own.free.width > width
    return say(
        "row.own_end_effect_larger" if is_larger else "row.own_end_effect",
        factor=edge.end_factor,
        length=edge.end_length,
        width=width,
        free=own.free.factor,
        free_width=own.free.width,
        pulled=own.pulled.factor,
        pulled_width=own.pulled.width,
        glide=glide,
        density=density,
    )
