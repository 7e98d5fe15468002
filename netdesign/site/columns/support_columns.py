"""Optional columns: axes of anchors, guys beside the section, snow on the post."""

from __future__ import annotations

from netdesign.site.columns.fields import Field
from netdesign.site.columns.unit_names import (
    ANGLES,
    DIAMETERS,
    FORCES,
    SECTION_MODULI,
    SHARES,
)
from netdesign.structure.axis import LEAST_AXIS, MOST_AXIS
from netdesign.structure.splay import LEAST_SPLAY, MOST_SPLAY
from netdesign.units import degree_from_radian


def _in_degrees(least: float, most: float) -> tuple[float, float]:
    """Bounds in degrees, without what rounding leaves of whole ones."""
    return round(degree_from_radian(least), 9), round(degree_from_radian(most), 9)


def _axis(key: str, way: str) -> Field:
    return Field(
        key=key,
        units=ANGLES,
        bounds=_in_degrees(LEAST_AXIS, MOST_AXIS),
        note=f"against the slope surface, 0 {way} along the slope, 90 straight out of "
        "the ground; left empty, bending and direction are not proven, unless the "
        "anchors are drilled along the pull",
    )


GUYS_AND_AXES = (
    Field(
        key="guy_count",
        kind="count",
        bounds=(1.0, 2.0),
        note="1 or 2, uphill and downhill alike; 1 holds no load along the row; left "
        "empty, the row is not proven",
    ),
    Field(
        key="guy_splay",
        units=ANGLES,
        bounds=_in_degrees(LEAST_SPLAY, MOST_SPLAY),
        note="between each of two guys and the section across the row; left empty "
        "beside two guys, the row is not proven",
    ),
    _axis("foot_axis", "downslope"),
    _axis("uphill_axis", "downslope"),
    _axis("downhill_axis", "upslope"),
    Field(
        key="anchor_axes",
        kind="word",
        words={"along the pull": ()},
        note="along the pull, instead of three axes: each anchor is drilled along its "
        "mean pull, as the report gives it",
    ),
)
ANCHOR_BENDING = (
    Field(
        key="kind",
        kind="word",
        words={
            "bar": ("solid bar",),
            "micropile": ("tube", "hollow bar"),
            "rope anchor": (),
        },
        note="bar or micropile: bends where the pull leaves its axis; rope anchor: "
        "turns up to an angle of the profile; left empty, it is judged as both, and "
        "the worse counts",
    ),
    Field(
        key="inner_diameter",
        units=DIAMETERS,
        bounds=(5.0, 190.0),
        note="of a micropile or hollow bar; an anchor of the kind bar is solid",
    ),
    Field(
        key="lever_arm",
        units=DIAMETERS,
        bounds=(0.0, 1000.0),
        note="free length from the grout or ground to the point of pull, over which a "
        "bar or micropile bends",
    ),
)
POST_BENDING = (
    Field(
        key="post_width",
        units=DIAMETERS,
        bounds=(20.0, 600.0),
        note="that the snow presses on; with section modulus and the columns of the "
        "compression resistance, for bending",
    ),
    Field(
        key="section_modulus",
        units=SECTION_MODULI,
        bounds=(1.0, 10_000.0),
        note="elastic, about the axis along the row: the snow pushes downslope",
    ),
    Field(
        key="sliding",
        units=FORCES,
        bounds=(0.5, 5000.0),
        note="characteristic, of the base plate along the slope; this or a friction",
    ),
    Field(
        key="base_friction",
        units=SHARES,
        bounds=(0.05, 1.5),
        note="characteristic coefficient of base plate on ground, instead of a sliding "
        "resistance",
    ),
)
