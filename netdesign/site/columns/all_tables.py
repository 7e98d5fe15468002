"""The site workbook as one table: sheets, headings, units, bounds, defaults.

Names of sheets and columns stand in ``netdesign/words``; other headings and notes in
English here, in French and German in ``words/*.toml``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from netdesign.site.columns.dimension_columns import (
    ANCHOR_DIMENSIONS,
    POST_DIMENSIONS,
    ROPE_DIMENSIONS,
    ROW_POSITION,
)
from netdesign.site.columns.fields import Field, SheetPlan
from netdesign.site.columns.languages import word_field, word_plan
from netdesign.site.columns.panel_columns import PANEL, ROPE_STIFFNESS, ROW_ENDS
from netdesign.site.columns.support_columns import (
    ANCHOR_BENDING,
    GUYS_AND_AXES,
    POST_BENDING,
)
from netdesign.site.columns.unit_names import (
    ANGLES,
    DENSITIES,
    FORCES,
    FORCES_PER_LENGTH,
    LENGTHS,
    SHARES,
    SLOPES,
    TEMPERATURES,
    TIMES,
)
from netdesign.snow.ground import LARGEST_GLIDE_FACTOR
from netdesign.structure.layout import DEFAULT_POST_TILT
from netdesign.units import degree_from_radian
from netdesign.words.catalogue import LANGUAGES, Language, render
from netdesign.words.message import say

# Chosen low: a tauter net pulls harder on its anchors.
DEFAULT_SLACK = 0.02
SEARCHED = "searched"  # count of a range whose worst case is searched, not sampled
DEFAULT_INCLINATION_DEG = (25.0, 35.0)

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


def _resistance(key: str, *aliases: str) -> Field:
    return Field(
        key=key,
        aliases=aliases,
        units=FORCES,
        bounds=(1.0, 5000.0),
        note="characteristic; left empty, the checks that need it are not proven",
    )


# Bounds are a little wider than what is built; they catch slips of unit and comma.
NETS = word_plan(
    SheetPlan(
        name="Nets",
        required=True,
        one_of=_SNOW_SIZE,
        unclear={
            **dict.fromkeys(("snow depth", "snow", "neige", "Schnee"), _SNOW_SIZE),
            **dict.fromkeys(("hauteur manteau", "Schneetiefe"), _SNOW_SIZE),
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
                words={
                    "free": ("free glide",),
                    "no-slip": ("rough",),
                    "sliding": ("slides",),
                },
                note="free: the snow glides freely; no-slip: it does not move on the "
                "ground; sliding: give a slip length or a glide factor",
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
                note="unstressed length of the net over its chord, minus 1",
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
                note="from the slope normal, head downslope positive",
            ),
            Field(
                key="uphill_anchor_distance",
                units=LENGTHS,
                bounds=(0.0, 50.0),
                note="upslope of the net's foot, along the slope; left empty, it "
                "follows from the net height",
            ),
            Field(
                key="downhill_anchor_distance",
                units=LENGTHS,
                bounds=(0.0, 50.0),
                note="downslope of the post's base, along the slope; left empty, it "
                "follows from the net height",
            ),
            _reference("foot_anchor", "Anchors"),
            _reference("uphill_anchor", "Anchors"),
            _reference("downhill_anchor", "Anchors"),
            _reference("uphill_guy", "Ropes"),
            _reference("downhill_guy", "Ropes"),
            _reference("post", "Posts"),
            *ROW_POSITION,
            *GUYS_AND_AXES,
            *PANEL,
        ),
    )
)

# Types of the first and last support of a row, where they are not those of the others.
_END_NOTE = "of the first and last support; left empty, that of sheet Nets"
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
            *ROW_ENDS,
        ),
    )
)

# Layers by net row, one a line; a row without lines here is of uniform snow.
SNOW = word_plan(
    SheetPlan(
        name="Snow",
        one_of=("thickness", "height"),
        fields=(
            Field(
                key="row",
                aliases=("row",),
                kind="id",
                required=True,
                refers_to="Nets",
                note="id of a row of sheet Nets",
            ),
            Field(
                key="layer",
                aliases=("layer number",),
                kind="count",
                bounds=(1.0, 40.0),
                required=True,
                note="number from the ground: 1 lies on the ground",
            ),
            Field(
                key="thickness",
                aliases=("layer thickness",),
                units=LENGTHS,
                bounds=(0.01, 10.0),
                note="normal to the slope; fill this or the vertical height, not both",
            ),
            Field(
                key="height",
                aliases=("vertical height",),
                units=LENGTHS,
                bounds=(0.01, 15.0),
                note="vertical; fill this or the thickness, not both",
            ),
            Field(
                key="density",
                aliases=("snow density",),
                units=DENSITIES,
                bounds=(100.0, 900.0),
                required=True,
                note="the layers keep their proportions, their mean follows the range "
                "of density",
            ),
            Field(
                key="temperature",
                aliases=("snow temperature",),
                units=TEMPERATURES,
                bounds=(-60.0, 0.0),
                note="for all layers of a row, or for none",
            ),
        ),
    )
)

_TYPE_ID = Field(
    key="id",
    aliases=("type",),
    kind="id",
    required=True,
    note="name of the type, as sheet Nets uses it",
)

# The keys of the resistances are the modes of `model.MEMBER_MODES`.
ANCHORS = word_plan(
    SheetPlan(
        name="Anchors",
        fields=(
            _TYPE_ID,
            _resistance("tendon", "tendon"),
            _resistance("pull_out", "pull-out"),
            Field(
                key="basis",
                kind="word",
                words={"tested": ("test",), "computed": ("calculated",)},
                note="how the pull-out resistance is known",
            ),
            *ANCHOR_DIMENSIONS,
            *ANCHOR_BENDING,
        ),
    )
)
ROPES = word_plan(
    SheetPlan(
        name="Ropes",
        aliases=("Guys", "Haubans", "Abspannseile"),
        fields=(
            _TYPE_ID,
            _resistance("rope", "breaking force"),
            *ROPE_DIMENSIONS,
            *ROPE_STIFFNESS,
        ),
    )
)
POSTS = word_plan(
    SheetPlan(
        name="Posts",
        fields=(
            _TYPE_ID,
            _resistance("compression", "compression"),
            *POST_DIMENSIONS,
            *POST_BENDING,
        ),
    )
)

_GLIDE_FROM = 1.01  # of a range: below it the ground hardly slips

USUAL_QUANTITIES: tuple[Field, ...] = tuple(
    word_field(field, "quantities")
    for field in (
        Field(
            key="density",
            aliases=("snow density",),
            units=DENSITIES,
            bounds=(100.0, 900.0),
            required=True,
        ),
        Field(
            key="friction_angle",
            aliases=("friction",),
            units=ANGLES,
            bounds=(0.0, 45.0),
            required=True,
        ),
        Field(
            key="inclination",
            aliases=("inclination",),
            units=ANGLES,
            bounds=(0.0, 60.0),
        ),
    )
)
# What else may range: then no line of sheet Nets gives it. Keys are those of
# `envelope.parameters.PARAMETERS`.
FURTHER_QUANTITIES: tuple[Field, ...] = tuple(
    word_field(field, "quantities")
    for field in (
        Field(
            key="thickness",
            aliases=("snow thickness normal to slope", "thickness"),
            units=LENGTHS,
            bounds=(0.1, 10.0),
        ),
        Field(
            key="snow_height",
            aliases=("snow height", "vertical snow height"),
            units=LENGTHS,
            bounds=(0.1, 15.0),
        ),
        Field(key="upslope_length", units=LENGTHS, bounds=(1.0, 200.0)),
        Field(key="slack", units=SHARES, bounds=(0.0, 0.3)),
        Field(
            key="net_stiffness",
            units=FORCES_PER_LENGTH,
            bounds=(100.0, 1_000_000.0),
        ),
        Field(
            key="slip_length",
            aliases=("stagnation depth",),
            units=LENGTHS,
            bounds=(0.001, 200.0),
        ),
        Field(
            key="glide_factor",
            aliases=("glide factor N",),
            units=("-",),
            bounds=(_GLIDE_FROM, LARGEST_GLIDE_FACTOR),
        ),
    )
)
RANGE_QUANTITIES = (*USUAL_QUANTITIES, *FURTHER_QUANTITIES)
# The cells below low and high are read as the quantity of their line.
RANGES = word_plan(
    SheetPlan(
        name="Ranges",
        required=True,
        items=RANGE_QUANTITIES,
        fields=(
            Field(
                key="quantity",
                kind="text",
                required=True,
                note="density, friction angle or net inclination (default 25 to 35 "
                "deg); also snow thickness or height, upslope length, slack, net "
                "stiffness, slip length or glide factor: their column in sheet Nets "
                "then stays empty",
            ),
            Field(
                key="unit",
                aliases=("units",),
                kind="text",
                note="may stand in brackets behind the quantity instead",
            ),
            Field(
                key="low",
                aliases=("minimum", "min"),
                required=True,
                note="least value, in the unit of the row",
            ),
            Field(
                key="high",
                aliases=("maximum", "max"),
                required=True,
                note="largest value, in the unit of the row",
            ),
            Field(
                key="samples",
                aliases=("count",),
                kind="count",
                bounds=(1.0, 25.0),
                note="number of values from low to high; left empty: the worst case is "
                "searched, with a bound",
            ),
        ),
    )
)

PROJECT_ITEMS: tuple[Field, ...] = tuple(
    word_field(Field(key=key, kind="text"), "items")
    for key in (
        *("name", "number", "author", "checker", "revision", "standard"),
        "accepted_law",
    )
)
PROJECT = word_plan(
    SheetPlan(
        name="Project",
        items=PROJECT_ITEMS,
        fields=(
            Field(
                key="item",
                aliases=("name",),
                kind="text",
                required=True,
                note="identification printed on every output",
            ),
            Field(key="value", kind="text"),
        ),
    )
)

# Measurements, one a line, to stand beside a history; nothing is checked with them.
MONITORING = word_plan(
    SheetPlan(
        name="Monitoring",
        fields=(
            Field(
                key="row",
                kind="id",
                required=True,
                refers_to="Nets",
                note="id of a row of sheet Nets",
            ),
            Field(
                key="member",
                kind="word",
                required=True,
                words={
                    "foot anchor": (),
                    "uphill guy": ("uphill anchor",),
                    "downhill guy": ("downhill anchor",),
                    "post": (),
                },
            ),
            Field(
                key="time",
                units=TIMES,
                bounds=(0.0, 3650.0),
                note="or date and time in a column of its own",
            ),
            Field(
                key="date",
                aliases=("date",),
                kind="text",
                note="such as 2003-02-18 06:00, instead of a time",
            ),
            Field(
                key="tension",
                aliases=("force",),
                units=FORCES,
                bounds=(0.0, 5000.0),
                note="per anchor; this or the air temperature, or both",
            ),
            Field(
                key="temperature",
                aliases=("temperature",),
                units=TEMPERATURES,
                bounds=(-60.0, 50.0),
            ),
        ),
    )
)

# Checks that somebody has proven elsewhere, one a line.
DECLARED = word_plan(
    SheetPlan(
        name="Declared",
        fields=(
            Field(
                key="row",
                kind="id",
                refers_to="Nets",
                note="id of a row of sheet Nets; left empty, the line is of all rows",
            ),
            Field(
                key="check",
                kind="text",
                required=True,
                note='as the reports name it: Post base, bearing; without "end of the '
                'row" it holds at the ends of the row only where the type there is the '
                "same",
            ),
            Field(
                key="document",
                kind="text",
                required=True,
                note="where it is proven; the check is shown as declared, never as "
                "pass, and one that fails here stays failed",
            ),
            Field(key="author", kind="text", required=True, note="who proved it"),
            Field(
                key="date",
                aliases=("date of document",),
                kind="text",
                note="of the document, such as 2026-05-04",
            ),
        ),
    )
)

SHEETS: tuple[SheetPlan, ...] = (
    *(PROJECT, NETS, RANGES, SNOW, ANCHORS, ROPES, POSTS, ENDS),
    *(MONITORING, DECLARED),
)
# The sheet that an annotated copy lists its findings on, by language.
FINDINGS_SHEETS: Mapping[Language, str] = {
    language: render(say("annotated.findings_sheet"), language)
    for language in LANGUAGES
}
# Sheets of the program's own that hold nothing to read.
QUIET_SHEETS: tuple[str, ...] = (
    *("Notes", "Notice", "Hinweise"),
    *FINDINGS_SHEETS.values(),
)
