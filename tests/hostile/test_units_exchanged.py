"""A unit is never taken for another one: stated, it counts; wrong, it is refused."""

import copy
import math

import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.columns.fields import convert_unit
from netdesign.site.columns.office import load_plan
from netdesign.site.reader import read_site
from tests.site.conftest import SOUND
from tests.site.csv_folder import write_csv_folder

# Sheet, block of office.toml, label, and the unit that the example has.
COLUMNS = [
    ("Rows", "rows", "slope ψ", "deg"),
    ("Rows", "rows", "snow height", "m"),
    ("Rows", "rows", "upslope length L", "m"),
    ("Rows", "rows", "post spacing b", "m"),
    ("Net types", "net_types", "effective height D_K", "m"),
    ("Net types", "net_types", "net stiffness", "kN/m"),
    ("Anchors", "anchor_types", "tendon R_k", "kN"),
    ("Anchors", "anchor_types", "pull-out", "kN"),
    ("Parts", "ropes", "breaking force", "kN"),
    ("Parts", "posts", "base R_k", "kN"),
]
CASES = [
    (sheet, label, unit, other)
    for sheet, block, label, unit in COLUMNS
    for field in load_plan(block).fields
    if field.label_in("en") == label
    for other in field.units
]


def with_column(sheet, label, unit, change):
    """The example with another unit in a heading and other numbers below it."""
    tables = copy.deepcopy(SOUND)
    start, place = next(
        (start, place)
        for start, row in enumerate(tables[sheet])
        for place, heading in enumerate(row)
        if str(heading).startswith(label)
    )
    measure = " normal" if label == "snow height" else ""
    tables[sheet][start][place] = f"{label} [{unit}{measure}]"
    for row in tables[sheet][start + 1 :]:
        if not row:  # what follows is another block
            break
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

    sound = list_numbers(read(tmp_path, SOUND))
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
    tables = copy.deepcopy(SOUND)
    tables["Rows"][0][1] = "slope ψ"
    with pytest.raises(SiteDataError, match="slope"):
        read(tmp_path, tables)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("tendon R_k [kN]", "pull-out [kN]"),
        ("effective height D_K [m]", "net stiffness [kN/m]"),
        ("slope ψ [deg]", "snow height [m normal]"),
        ("post spacing b [m]", "upslope length L [m]"),
    ],
)
def test_columns_go_by_their_heading_not_by_their_place(tmp_path, one, other):
    tables = copy.deepcopy(SOUND)
    rows = next(rows for rows in tables.values() if one in rows[0])
    left, right = rows[0].index(one), rows[0].index(other)
    for row in rows:
        row[left], row[right] = row[right], row[left]
    exchanged = list_numbers(read(tmp_path, tables))
    assert exchanged == list_numbers(read(tmp_path, SOUND))
