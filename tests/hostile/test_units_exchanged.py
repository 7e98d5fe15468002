"""A unit is never taken for another one: stated, it counts; wrong, it is refused."""

import math

import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.columns.all_tables import SHEETS
from netdesign.site.columns.fields import convert_unit
from netdesign.site.reader import read_site
from tests.fuzz.targets import example_tables
from tests.site.csv_folder import write_csv_folder

PLANS = {plan.name: plan for plan in SHEETS}
# Sheet, label, and the unit that the example has.
COLUMNS = [
    *(("Nets", label, "m") for label in ("snow thickness", "upslope length")),
    *(("Nets", label, "m") for label in ("net height", "post spacing")),
    ("Nets", "net stiffness", "kN/m"),
    ("Nets", "slope angle", "deg"),
    *(("Anchors", f"{label} resistance", "kN") for label in ("tendon", "pull-out")),
    ("Ropes", "minimum breaking force", "kN"),
    ("Posts", "compression resistance", "kN"),
]
CASES = [
    (sheet, label, unit, other)
    for sheet, label, unit in COLUMNS
    for field in PLANS[sheet].fields
    if field.label == label
    for other in field.units
]


def with_column(sheet, label, unit, change):
    """The example with another unit in a heading and other numbers below it."""
    tables = {
        name: [list(row) for row in rows] for name, rows in example_tables().items()
    }
    head, *rows = tables[sheet]
    place = next(k for k, heading in enumerate(head) if heading.startswith(label))
    head[place] = f"{label} [{unit}]"
    for row in rows:
        if row[place]:
            row[place] = repr(change(float(row[place])))
    return tables


def read(tmp_path, tables):
    return read_site(write_csv_folder(tmp_path / "site", tables))


def list_numbers(site):
    """Everything of the rows that enters a calculation [SI]."""
    return [
        number
        for row in site.rows
        for number in (
            row.slope_angle,
            row.snow_thickness,
            row.upslope_length,
            row.net_height,
            row.net_stiffness_per_m,
            row.layout.post_spacing,
            *(one.value for one in row.resistances if one.value is not None),
        )
    ]


@pytest.mark.parametrize(("sheet", "label", "unit", "other"), CASES)
def test_the_same_size_in_another_unit_is_the_same_site(
    tmp_path, sheet, label, unit, other
):
    def convert(value):
        if unit == "deg":
            return round(_slope_in(value, other), 14)
        return value / convert_unit(1.0, other, unit)

    sound = list_numbers(read(tmp_path, example_tables()))
    same = list_numbers(read(tmp_path, with_column(sheet, label, other, convert)))
    assert same == pytest.approx(sound, rel=1e-12)


def _slope_in(degrees, unit):
    radians = math.radians(degrees)
    return {
        "deg": degrees,
        "rad": radians,
        "gon": degrees / 0.9,
        "%": 100.0 * math.tan(radians),
    }[unit]


@pytest.mark.parametrize(
    ("sheet", "label", "unit", "other"),
    [
        case
        for case in CASES
        if case[2] != "deg" and not 0.02 < convert_unit(1.0, case[3], case[2]) < 50.0
    ],
)
def test_a_number_under_a_unit_far_from_its_own_is_refused(
    tmp_path, sheet, label, unit, other
):
    with pytest.raises(SiteDataError) as caught:
        read(tmp_path, with_column(sheet, label, other, lambda value: value))
    assert label in str(caught.value)
    assert "accepted" in str(caught.value)


def test_a_slope_without_a_unit_is_refused(tmp_path):
    tables = {
        name: [list(row) for row in rows] for name, rows in example_tables().items()
    }
    tables["Nets"][0][1] = "slope angle"
    with pytest.raises(SiteDataError, match="slope"):
        read(tmp_path, tables)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("tendon resistance [kN]", "pull-out resistance [kN]"),
        ("net height [m]", "snow thickness [m]"),
        ("post spacing [m]", "upslope length [m]"),
    ],
)
def test_columns_go_by_their_heading_not_by_their_place(tmp_path, one, other):
    tables = {
        name: [list(row) for row in rows] for name, rows in example_tables().items()
    }
    rows = next(rows for rows in tables.values() if one in rows[0])
    left, right = rows[0].index(one), rows[0].index(other)
    for row in rows:
        row[left], row[right] = row[right], row[left]
    exchanged = list_numbers(read(tmp_path, tables))
    assert exchanged == list_numbers(read(tmp_path, example_tables()))
