"""Note on a row's end: the profile's end factor, and the program's own beside it."""

from __future__ import annotations

from netdesign.envelope.ranges import Ranges
from netdesign.errors import ModelError
from netdesign.haefeli.slab import Slab
from netdesign.planview.end_effect import EndEffect, compute_end_effect
from netdesign.site.model import NetRow
from netdesign.snow.creep_law import CreepLaw
from netdesign.structure.row_position import LoadedWidth
from netdesign.study.effects import RowEffects, find_row_glide_factor
from netdesign.words.message import Message, say


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
    span = ranges["density"]
    density, glide = 0.5 * (span.low + span.high), find_row_glide_factor(row)
    try:
        own = compute_end_effect(
            Slab(
                thickness=row.snow_thickness,
                slope_angle=row.slope_angle,
                density=density,
                creep_law=law,
            ),
            gap=row.gap,
            glide_factor=glide,
            length=edge.end_length,
        )
    except ModelError:  # snow that the law does not take: its cases say so
        return []
    return [_tell(edge, own, glide, density)]


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
