"""Sheets Nets and Ends: net rows, and the types of their first and last support."""

from __future__ import annotations

from dataclasses import replace

from netdesign.site.columns.dimension_columns import ROW_POSITION
from netdesign.site.columns.fields import Field, SheetPlan
from netdesign.site.columns.languages import word_plan
from netdesign.site.columns.panel_columns import PANEL, ROW_ENDS
from netdesign.site.columns.support_columns import GUYS_AND_AXES
from netdesign.site.columns.unit_names import (
    ANGLES,
    FORCES_PER_LENGTH,
    LENGTHS,
    SHARES,
    SLOPES,
)
from netdesign.snow.ground import LARGEST_GLIDE_FACTOR
from netdesign.structure.layout import DEFAULT_POST_TILT
from netdesign.units import degree_from_radian

# Chosen low: a tauter net pulls harder on its anchors.
DEFAULT_SLACK = 0.02

_SNOW_SIZE = ("snow_thickness", "snow_height")
_ANY_HEIGHT = (*_SNOW_SIZE, "net_height")
_ANY_ANCHOR = ("foot_anchor", "uphill_anchor", "downhill_anchor")
_ANY_GUY = ("uphill_guy", "downhill_guy")


def _reference(key: str, sheet: str) -> Field:
    return Field(
        key=key,
        kind="id",
        refers_to=sheet,
        note=f"id of sheet {sheet}; left empty, the checks of this member are "
        "not proven",
    )


# Bounds are a little wider than what is built; they catch slips of unit and comma.
UNCLEAR_SNOW = (
    *("snow depth", "snow", "neige", "Schnee", "hauteur manteau", "Schneetiefe"),
)
NETS = word_plan(
    SheetPlan(
        name="Nets",
        required=True,
        one_of=_SNOW_SIZE,
        unclear={
            **dict.fromkeys(UNCLEAR_SNOW, _SNOW_SIZE),
            **dict.fromkeys(("height", "hauteur", "Höhe", "H"), _ANY_HEIGHT),
            **dict.fromkeys(("anchor", "ancrage", "Anker"), _ANY_ANCHOR),
            **dict.fromkeys(("guy", "hauban", "Abspannseil"), _ANY_GUY),
            **dict.fromkeys(
                ("inclination", "inclinaison", "Neigung"), ("slope_angle", "post_tilt")
            ),
        },
        fields=(
            Field(
                key="id",
                aliases=("net row", "row"),
                kind="id",
                required=True,
                note="name of the net row; used once",
            ),
            Field(
                key="slope_angle",
                aliases=("slope",),
                units=SLOPES,
                bounds=(10.0, 75.0),
                required=True,
                note="against the horizontal",
            ),
            Field(
                key="snow_thickness",
                aliases=("snow thickness normal to slope",),
                units=LENGTHS,
                bounds=(0.1, 10.0),
                note="normal to the slope; fill this or the vertical height, not both",
            ),
            Field(
                key="snow_height",
                aliases=("snow height", "vertical snow height"),
                units=LENGTHS,
                bounds=(0.1, 15.0),
                note="vertical; fill this or the thickness, not both",
            ),
            Field(
                key="upslope_length",
                units=LENGTHS,
                bounds=(1.0, 200.0),
                required=True,
                note="snowpack that the net carries, along the slope up to the next "
                "row",
            ),
            Field(
                key="ground_law",
                aliases=("ground",),
                kind="word",
                required=True,
                instead=("slip_length", "glide_factor"),
                words={
                    "free": ("free glide",),
                    "no-slip": ("rough",),
                    "sliding": ("slides",),
                },
                note="free: the snow glides freely; no-slip: it does not move on the "
                "ground; sliding: give a slip length or a glide factor; left empty "
                "beside one of these, it slides",
            ),
            Field(
                key="slip_length",
                aliases=("stagnation depth",),
                units=LENGTHS,
                bounds=(0.001, 200.0),
                note="only for sliding ground, instead of a glide factor",
            ),
            Field(
                key="glide_factor",
                aliases=("glide factor N",),
                units=("-",),
                bounds=(1.0, LARGEST_GLIDE_FACTOR),
                note="N of the guidelines; only for sliding ground, instead of a slip "
                "length",
            ),
            Field(
                key="net_height",
                aliases=("net height normal to slope",),
                units=LENGTHS,
                bounds=(0.5, 10.0),
                required=True,
                note="normal to the slope, from foot to head",
            ),
            Field(
                key="net_stiffness",
                units=FORCES_PER_LENGTH,
                bounds=(100.0, 1_000_000.0),
                required=True,
                note="force per metre of width at unit strain",
            ),
            Field(
                key="slack",
                units=SHARES,
                bounds=(0.0, 0.3),
                default=DEFAULT_SLACK,
                note="unstressed length of the net over its chord, minus 1; left "
                "empty, the row is not proven",
            ),
            Field(
                key="post_spacing",
                units=LENGTHS,
                bounds=(0.5, 15.0),
                required=True,
                note="along the row; the width that loads one anchor",
            ),
            Field(
                key="post_tilt",
                units=ANGLES,
                bounds=(-30.0, 45.0),
                default=degree_from_radian(DEFAULT_POST_TILT),
                note="from the slope normal, head downslope positive; this or the "
                "distance of the post base; both empty, the row is not proven",
            ),
            Field(
                key="uphill_anchor_distance",
                units=LENGTHS,
                bounds=(0.0, 50.0),
                note="upslope of the net's foot, along the slope; left empty, the "
                "row is not proven",
            ),
            Field(
                key="downhill_anchor_distance",
                units=LENGTHS,
                bounds=(0.0, 50.0),
                note="downslope of the post's base, along the slope; left empty, the "
                "row is not proven",
            ),
            _reference("foot_anchor", "Anchors"),
            _reference("uphill_anchor", "Anchors"),
            _reference("downhill_anchor", "Anchors"),
            _reference("uphill_guy", "Ropes"),
            _reference("downhill_guy", "Ropes"),
            _reference("post", "Posts"),
            Field(
                key="snow_layers",
                kind="word",
                words={"uniform": (), "layered": (), "layered with temperatures": ()},
                note="uniform: of one density; layered: its layers stand in sheet "
                "Snow, and have temperatures there or not; left empty, the row is not "
                "proven",
            ),
            *ROW_POSITION,
            *GUYS_AND_AXES,
            *PANEL,
        ),
    )
)


# Types of the first and last support of a row, where they are not those of the others.
_END_NOTE = (
    "of the first and last support; left empty, its checks there are not proven, "
    "unless all types are those inside"
)
ENDS = word_plan(
    SheetPlan(
        name="Ends",
        fields=(
            Field(
                key="row",
                aliases=("row",),
                kind="id",
                required=True,
                refers_to="Nets",
                note="id of a row of sheet Nets; used once",
            ),
            *(
                replace(_reference(key, sheet), note=_END_NOTE)
                for key, sheet in (
                    *((anchor, "Anchors") for anchor in _ANY_ANCHOR),
                    *((guy, "Ropes") for guy in _ANY_GUY),
                    ("post", "Posts"),
                )
            ),
            Field(
                key="support_types",
                kind="word",
                words={"as inside": ()},
                note="as inside, instead of six types: they are those of sheet Nets",
            ),
            *ROW_ENDS,
        ),
    )
)
