"""Notes on the net under its snow: snow on its guys, its height between two posts.

For information: they decide nothing.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from netdesign.checks import Standard
from netdesign.checks.check import find_action_factor
from netdesign.envelope.ranges import Ranges
from netdesign.outcome import ModelError
from netdesign.site.model import NetRow
from netdesign.structure.members import Member
from netdesign.study.dependent import find_snow_pressure
from netdesign.study.records import CheckRecord
from netdesign.study.sideways import GUYS, place_row
from netdesign.study.support_records import PanelRecord
from netdesign.words.message import Message, say
from netdesign.words.names import name_member


def list_guy_notes(
    row: NetRow, ranges: Ranges, checks: Sequence[CheckRecord], standard: Standard
) -> Iterator[Message]:
    """Note on the width of snow that working guys bear beside their design forces.

    Theory: structure/THEORY.md, (S23). Of several supports the least.
    """
    on_action = find_action_factor(standard).value
    try:
        pressure = find_snow_pressure(row, ranges).value / 1e3
    except ModelError:  # outside the guideline's closed forms
        return
    across = min(row.net_height, row.held_thickness)
    widths = []
    for guy in GUYS:
        spare = [
            bear_snow(force, check.resistance_kN, _find_cosine(row, ranges, guy))
            for check in checks
            if (check.member, check.mode) == (guy, "rope")
            and check.resistance_kN is not None
            and (force := check.read_band("E_d")[1])
        ]
        if spare and on_action and min(spare) > 0.0:
            width = min(spare) / (on_action * pressure * across)
            named = name_member(guy)
            widths.append(say("row.guy_in_snow", member=named, width=width))
    if widths:
        yield say("row.guys_in_snow", guys=tuple(widths), pressure=pressure)


def bear_snow(force: float, resistance: float, cosine: float) -> float:
    """Load of snow down the slope that a guy bears beside its own force; (S23).

    Parameters
    ----------
    force, resistance : float
        Design values [kN].
    cosine : float
        Of the angle between the guy and the slope's line of fall, at least 0 [-].

    Returns
    -------
    float
        Design value [kN]; 0 where nothing is left.
    """
    if not resistance > force:
        return 0.0
    across = force**2 * (1.0 - cosine**2)
    return math.sqrt(resistance**2 - across) - force * cosine


def _find_cosine(row: NetRow, ranges: Ranges, guy: Member) -> float:
    """Largest cosine of a guy's angle to the line of fall [-]."""
    span, found = ranges["inclination"], []
    for points in (place_row(row, one) for one in (span.low, span.high)):
        anchor = points.find_anchor(guy)
        along = abs(points.head[0] - anchor[0])
        found.append(along / math.dist(points.head, anchor))
    return max(found) * math.cos(row.guys.splay or 0.0)


def list_sag_notes(row: NetRow, panel: PanelRecord | None) -> Iterator[Message]:
    """Height of the loaded net between two posts, in the case that is drawn."""
    if panel is None or panel.drawing is None:
        return
    height = panel.drawing.mid_net_m[-1][1]
    yield say(
        "row.loaded_net",
        height=height,
        of_net=height / row.net_height,
        of_snow=height / row.held_thickness,
    )
