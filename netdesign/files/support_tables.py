"""Tables ``[support]`` and ``[panel]`` of a scene file: a net's support, its row.

Their fields are those of sheet Nets (site/columns); none of sag and cut has a default.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from netdesign.outcome import ModelError
from netdesign.panel.inputs import LARGEST_GUY_ANGLE, LARGEST_SAG, Cut, Panel, Rope
from netdesign.structure.layout import (
    DEFAULT_DOWNHILL_RATIO,
    DEFAULT_POST_TILT,
    DEFAULT_UPHILL_RATIO,
    SupportLayout,
)
from netdesign.units import newton_from_kilonewton
from netdesign.words.message import Message, say

Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
_Distance = Annotated[float, Field(ge=0, le=100)]
_Sag = Annotated[float, Field(ge=0, le=LARGEST_SAG)]


class Table(BaseModel):
    """Table of a scene file: no key that it does not have."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


class SupportTable(Table):
    """``[support]``; distances along the slope."""

    post_spacing_m: Positive
    post_tilt_deg: Annotated[float, Field(ge=-30, le=45)] | None = None
    post_base_distance_m: Annotated[float, Field(ge=-50, le=50)] | None = None
    uphill_anchor_distance_m: _Distance | None = None
    downhill_anchor_distance_m: _Distance | None = None


class PanelTable(Table):
    """``[panel]``; of stiffness and sag one value for both ropes, or one for each."""

    rope_stiffness_kN: Positive | None = None
    lower_rope_stiffness_kN: Positive | None = None
    upper_rope_stiffness_kN: Positive | None = None
    rope_sag: _Sag | None = None
    lower_rope_sag: _Sag | None = None
    upper_rope_sag: _Sag | None = None
    cut: Cut
    mid_span_anchors: bool = False
    end_guy_deg: (
        Annotated[float, Field(ge=0, le=round(math.degrees(LARGEST_GUY_ANGLE)))] | None
    ) = None


@dataclass(frozen=True, slots=True, kw_only=True)
class GivenSupport:
    """Support of a scene's net, and the row in which it stands.

    Attributes
    ----------
    layout : SupportLayout
        Geometry.
    panel : Panel or None
        Between two posts.
    end_guy_angle : float or None
        Of the guy that holds the row's end, to the row [rad].
    """

    layout: SupportLayout
    panel: Panel | None = None
    end_guy_angle: float | None = None


def build_support(
    support: SupportTable | None, panel: PanelTable | None, net_height: float | None
) -> GivenSupport | None:
    """Support of a scene in SI units; None without one.

    Parameters
    ----------
    support, panel : SupportTable, PanelTable or None
        The two tables.
    net_height : float or None
        Normal to the slope [m]; None of a wall.

    Raises
    ------
    ModelError
        With every fault of the two together.
    """
    if support is None and panel is None:
        return None
    faults = [] if panel is None else _list_faults(panel)
    if net_height is None:
        faults.append(say("scene_file.support_of_wall"))
    if support is None:
        faults.append(say("scene_file.panel_without_support"))
    if support is None or net_height is None or faults:
        raise ModelError(say("text.lines", lines=tuple(faults)))
    layout = _build_layout(support, net_height)
    if panel is None:
        return GivenSupport(layout=layout)
    angle = panel.end_guy_deg
    return GivenSupport(
        layout=layout,
        panel=_build_panel(panel, support.post_spacing_m),
        end_guy_angle=None if angle is None else math.radians(angle),
    )


def _list_faults(panel: PanelTable) -> list[Message]:
    """Stiffness and sag: one for both ropes or one for each, never both ways."""
    faults = []
    for name in ("stiffness_kN", "sag"):
        keys = [f"{which}rope_{name}" for which in ("", "lower_", "upper_")]
        given = tuple(getattr(panel, key) is not None for key in keys)
        if given not in ((True, False, False), (False, True, True)):
            faults.append(say("scene_file.both_ropes_or_each", name=name))
    return faults


def _build_layout(table: SupportTable, net_height: float) -> SupportLayout:
    tilt, uphill = table.post_tilt_deg, table.uphill_anchor_distance_m
    downhill = table.downhill_anchor_distance_m
    return SupportLayout(
        post_spacing=table.post_spacing_m,
        post_tilt=DEFAULT_POST_TILT if tilt is None else math.radians(tilt),
        uphill_anchor_distance=(
            DEFAULT_UPHILL_RATIO * net_height if uphill is None else uphill
        ),
        downhill_anchor_distance=(
            DEFAULT_DOWNHILL_RATIO * net_height if downhill is None else downhill
        ),
        post_base_distance=table.post_base_distance_m,
    )


def _build_panel(table: PanelTable, spacing: float) -> Panel:
    lower, upper = (_build_rope(table, rope) for rope in ("lower", "upper"))
    return Panel(
        post_spacing=spacing,
        lower=lower,
        upper=upper,
        cut=table.cut,
        has_mid_anchors=table.mid_span_anchors,
    )


def _build_rope(table: PanelTable, rope: str) -> Rope:
    """Rope ``lower`` or ``upper``: what is given for both, or its own."""
    stiffness, sag = (
        next(
            float(value)
            for which in ("", f"{rope}_")
            if (value := getattr(table, f"{which}rope_{name}")) is not None
        )
        for name in ("stiffness_kN", "sag")
    )
    return Rope(stiffness=newton_from_kilonewton(stiffness), sag=sag)
