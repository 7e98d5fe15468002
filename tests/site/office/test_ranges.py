"""Ranges in the cells of a row and of its net type."""

import math

import pytest

from netdesign.cable.net import find_slack
from netdesign.outcome import SiteDataError
from netdesign.site.reader import read_site
from tests.each import each
from tests.make import find_cell, write_site
from tests.site.office.drawn import draw_tables

LANGUAGES = ("en", "fr", "de")


def write_ranged(tmp_path, seed, language="en", measures=None, **cells):
    """Tables whose first row, or its net type, has other texts in some cells."""
    tables = draw_tables(seed)
    first = tables["rows"][0]
    (net,) = (one for one in tables["net_types"] if one["id"] == first["net_type"])
    for key, value in cells.items():
        (net if key in net else first)[key] = value
    return write_site(tmp_path / "site.xlsx", tables, language, measures), tables


def list_places(path):
    """Cells of the findings that refuse a workbook."""
    with pytest.raises(SiteDataError) as refused:
        read_site(path)
    return {f"{one.sheet}!{one.cell}" for one in refused.value.findings}


@each("seed, language", [(n, LANGUAGES[n % 3]) for n in range(3)])
def test_a_range_of_a_row_is_searched_in_that_row(tmp_path, seed, language):
    cells = {"glide_factor": (1.6, 2.2), "upslope_length": (14.5, 21)}
    path, _ = write_ranged(tmp_path, seed, language, **cells)
    row, *others = read_site(path).rows
    for key, ends in cells.items():
        assert (row.ranges[key].low, row.ranges[key].high) == ends
    assert (row.glide_factor, row.upslope_length) == (2.2, 21.0)
    assert all("glide_factor" not in dict(one.ranges.intervals) for one in others)


@each("measure, key", [("vertical", "snow_height"), ("normal", "thickness")])
def test_a_range_of_the_snow_is_that_of_its_unit_cell(tmp_path, measure, key):
    of_snow = {("rows", "snow"): measure}
    path, _ = write_ranged(tmp_path, 4, measures=of_snow, snow=(2.1, 2.4))
    row = read_site(path).rows[0]
    assert (row.ranges[key].low, row.ranges[key].high) == (2.1, 2.4)
    factor = math.cos(row.slope_angle) if measure == "vertical" else 1.0
    assert row.snow_thickness == pytest.approx(2.4 * factor)


def test_a_range_of_the_sag_is_one_of_slack_whose_low_end_is_severe(tmp_path):
    of_sag = {("net_types", "slack"): "sag"}
    path, tables = write_ranged(tmp_path, 5, measures=of_sag, slack=(9.5, 14))
    for net in tables["net_types"]:
        net["slack"] = (9.5, 14)
    write_site(path, tables, "fr", of_sag)
    row = read_site(path).rows[0]
    ends = (row.ranges["slack"].low, row.ranges["slack"].high)
    assert ends == pytest.approx((find_slack(0.095), find_slack(0.14)))
    assert row.slack == pytest.approx(ends[0])


def test_a_range_of_the_support_counts_at_its_ends(tmp_path):
    path, _ = write_ranged(tmp_path, 6, post_tilt=(9, 17), guy_splay=(12, 20))
    row = read_site(path).rows[0]
    found = {one.key: one for one in row.assumed if one.is_typed}
    assert set(found) == {"post_tilt", "guy_splay"}
    assert found["post_tilt"].shown == pytest.approx((9, 17))
    assert found["guy_splay"].shown == pytest.approx((12, 20))


@each("key, ends", [("ridge_sag", (4, 8)), ("lower_sag", (5, 9))])
def test_a_range_that_nothing_searches_is_refused(tmp_path, key, ends):
    path, tables = write_ranged(tmp_path, 7, **{key: ends})
    number = [net[key] for net in tables["net_types"]].index(ends)
    assert list_places(path) == {find_cell("net_types", key, number)}


def test_ends_are_in_order(tmp_path):
    path, _ = write_ranged(tmp_path, 9, glide_factor=(2.2, 1.6))
    assert list_places(path) == {find_cell("rows", "glide_factor")}
