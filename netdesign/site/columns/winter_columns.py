"""Sheet Winter: a station's snow heights, one day a line.

Names of columns stand in ``netdesign/words``, notes in ``words/*.toml``.
"""

from __future__ import annotations

from netdesign.site.columns.fields import Field, SheetPlan
from netdesign.site.columns.languages import word_plan
from netdesign.site.columns.unit_names import LENGTHS, TEMPERATURES

_FIRST_LINE = "; on the first line"

WINTER = word_plan(
    SheetPlan(
        name="Winter",
        fields=(
            Field(
                key="date",
                aliases=("day",),
                kind="text",
                required=True,
                note="such as 2003-02-18; one line a day, in order",
            ),
            Field(
                key="snow_height",
                aliases=("HS", "snow height"),
                units=LENGTHS,
                bounds=(0.0, 8.0),
                note="of the station, vertical; left empty where it was not read",
            ),
            Field(
                key="temperature",
                aliases=("temperature",),
                units=TEMPERATURES,
                bounds=(-60.0, 50.0),
            ),
            Field(key="station", kind="text", note="its name" + _FIRST_LINE),
            Field(
                key="altitude",
                units=LENGTHS,
                bounds=(0.0, 6000.0),
                note="of the station" + _FIRST_LINE,
            ),
            Field(
                key="height_factor",
                aliases=("exposure factor",),
                units=("-",),
                bounds=(0.2, 5.0),
                note="snow height at the net rows over that of the station, by "
                "exposure and drift; left empty, 1 is assumed" + _FIRST_LINE,
            ),
            Field(
                key="row",
                aliases=("row",),
                kind="id",
                refers_to="Nets",
                note="id of a row of sheet Nets, for which alone the height factor of "
                "this line holds; any line; the others have that of the first line",
            ),
        ),
    )
)
