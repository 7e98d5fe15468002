"""Sheet Ranges: quantities that range over all net rows of a site."""

from __future__ import annotations

from dataclasses import replace

from netdesign.site.columns.fields import Field, SheetPlan
from netdesign.site.columns.languages import word_field, word_plan
from netdesign.site.columns.net_columns import NETS, UNCLEAR_SNOW
from netdesign.site.columns.unit_names import ANGLES, DENSITIES
from netdesign.snow.ground import LARGEST_GLIDE_FACTOR

SEARCHED = "searched"  # count of a range whose worst case is searched, not sampled
DEFAULT_INCLINATION_DEG = (25.0, 35.0)
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
_COLUMNS = {field.key: field for field in NETS.fields}


def _range_column(key: str, *aliases: str, column: str = "") -> Field:
    """Quantity in the units and bounds of its column of sheet Nets."""
    like = _COLUMNS[column or key]
    return Field(key=key, aliases=aliases, units=like.units, bounds=like.bounds)


# What else may range: then no line of sheet Nets gives it. Keys are those of
# `envelope.parameters.PARAMETERS`.
FURTHER_QUANTITIES: tuple[Field, ...] = tuple(
    word_field(field, "quantities")
    for field in (
        _range_column(
            "thickness",
            *("snow thickness normal to slope", "thickness"),
            column="snow_thickness",
        ),
        _range_column("snow_height", "snow height", "vertical snow height"),
        _range_column("upslope_length"),
        _range_column("slack"),
        _range_column("net_stiffness"),
        _range_column("slip_length", "stagnation depth"),
        replace(
            _range_column("glide_factor", "glide factor N"),
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
        unclear=dict.fromkeys(UNCLEAR_SNOW, ("thickness", "snow_height")),
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
            Field(
                key="justification",
                aliases=("basis", "source"),
                kind="text",
                note="why this range; netdesign winter writes one for the density; "
                "shown with the range in every report",
            ),
        ),
    )
)
# As offices type it, with both ends in one cell; the template does not offer that.
_SPAN = word_field(Field(key="span", kind="text"), "Ranges")
RANGES_AS_TYPED = replace(RANGES, fields=(*RANGES.fields, _SPAN))
