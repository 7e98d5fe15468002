"""Optional columns: the panel between two posts, and the ropes that it hangs on."""

from __future__ import annotations

from netdesign.panel.inputs import CUTS, LARGEST_GUY_ANGLE, LARGEST_SAG
from netdesign.site.columns.fields import Field
from netdesign.site.columns.unit_names import ANGLES, FORCES, SHARES
from netdesign.units import degree_from_radian

_ROPE_NOTE = "id of sheet Ropes; left empty, an EA of 5 to 60 MN, the worse counts"
_SAG_NOTE = "as built, without snow, over the post spacing; left empty, 3 to 10 %"

PANEL = (
    Field(
        key="panel_system",
        kind="word",
        words={
            "none": (),
            "rectangular": ("ridge rope and lower rope",),
            "triangular": (),
        },
        note="rectangular: the net hangs on a ridge rope and a lower rope; triangular "
        "nets are not covered; none: no ropes between posts; left empty, it is taken "
        "as rectangular",
    ),
    Field(
        key="net_cut",
        kind="word",
        words={cut: () for cut in CUTS},
        note="uniform: as long everywhere; upper: cut to the hanging ridge rope; "
        "fitted: to both ropes; left empty, the worst of them counts",
    ),
    Field(key="ridge_rope", kind="id", refers_to="Ropes", note=_ROPE_NOTE),
    Field(key="ridge_sag", units=SHARES, bounds=(0.0, LARGEST_SAG), note=_SAG_NOTE),
    Field(key="lower_rope", kind="id", refers_to="Ropes", note=_ROPE_NOTE),
    Field(key="lower_sag", units=SHARES, bounds=(0.0, LARGEST_SAG), note=_SAG_NOTE),
    Field(
        key="mid_anchors",
        kind="word",
        words={"no": (), "yes": ()},
        note="whether the lower rope is also anchored half way between the posts; left "
        "empty, the worse counts",
    ),
)
_HELD = "left empty, its checks are not proven"
ROW_ENDS = (
    Field(
        key="lateral_anchor",
        kind="id",
        refers_to="Anchors",
        note="holds the lower rope along the row, beside the foot anchor; id of sheet "
        f"Anchors; {_HELD}",
    ),
    Field(
        key="end_guy",
        kind="id",
        refers_to="Ropes",
        note=f"holds the post's head along the row; id of sheet Ropes; {_HELD}",
    ),
    Field(
        key="end_guy_anchor",
        kind="id",
        refers_to="Anchors",
        note=f"of the end guy; id of sheet Anchors; {_HELD}",
    ),
    Field(
        key="end_guy_angle",
        units=ANGLES,
        bounds=(0.0, round(degree_from_radian(LARGEST_GUY_ANGLE), 9)),
        note="between the end guy and the row; has no default",
    ),
)
ROPE_STIFFNESS = (
    Field(
        key="axial_stiffness",
        aliases=("EA",),
        units=FORCES,
        bounds=(500.0, 1_000_000.0),
        note="EA: force at unit strain; left empty, it follows from the breaking force",
    ),
)
