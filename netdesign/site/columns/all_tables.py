"""The site workbook as one table: sheets, headings, units, bounds, defaults.

Names of sheets and columns stand in ``netdesign/words``; other headings and notes in
English beside their columns, in French and German in ``words/*.toml``.
"""

from __future__ import annotations

from collections.abc import Mapping

from netdesign.site.columns.dimension_columns import (
    ANCHOR_DIMENSIONS,
    POST_DIMENSIONS,
    ROPE_DIMENSIONS,
)
from netdesign.site.columns.fields import Field, SheetPlan
from netdesign.site.columns.languages import word_field, word_plan
from netdesign.site.columns.net_columns import ENDS, NETS
from netdesign.site.columns.panel_columns import ROPE_STIFFNESS
from netdesign.site.columns.range_quantities import RANGES
from netdesign.site.columns.support_columns import ANCHOR_BENDING, POST_BENDING
from netdesign.site.columns.unit_names import (
    DENSITIES,
    FORCES,
    LENGTHS,
    TEMPERATURES,
    TIMES,
)
from netdesign.site.columns.winter_columns import WINTER
from netdesign.words.catalogue import LANGUAGES, Language, render
from netdesign.words.message import say


def _resistance(key: str, *aliases: str) -> Field:
    return Field(
        key=key,
        aliases=aliases,
        units=FORCES,
        bounds=(1.0, 5000.0),
        note="characteristic; left empty, the checks that need it are not proven",
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
                required=True,
                note="id of a row of sheet Nets, or all",
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
    *(MONITORING, DECLARED, WINTER),
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
