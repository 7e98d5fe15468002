"""Measured structures: what their file may hold, bands, misfits, the page."""

from dataclasses import replace
from importlib.resources import files

import pytest

from netdesign.addons.evidence.validation.measured_file import read_structures
from netdesign.addons.evidence.validation.structure import (
    Span,
    validate_structure,
)
from netdesign.outcome import ModelError
from tests.each import each

OWN = (
    files("netdesign.addons.evidence.validation").joinpath("measured.toml").read_bytes()
)
NET, OTHER_NET, ICELAND = read_structures(OWN)
KNOWN = {
    "slope_deg": 37.3,
    "net_height_m": 3.1,
    "filled": 0.93,
    "density_kg_m3": 361.0,
    "upslope_length_m": 14.7,
    "glide_factor": 1.63,
    "inclination_deg": 27.4,
    "friction_deg": 24.0,
    "slack": 0.041,
    "stiffness_kN_per_m": 9.1e3,
    "post_spacing_m": 3.6,
    "uphill_anchor_ratio": 1.1,
}


def of_one(low, high=None):
    return Span(low=low, high=low if high is None else high, mark="measured")


def known_net(**changes):
    inputs = {name: of_one(value) for name, value in (KNOWN | changes).items()}
    return replace(OTHER_NET, inputs=inputs)


def test_published_structures_are_never_known_and_say_what_is_missing():
    for one in (NET, OTHER_NET, ICELAND):
        assert not one.is_known
        assert one.open
        assert {"read"} == {force.mark for force in one.measured}
        assert "read" not in {span.mark for span in one.inputs.values()}
        assert all(span.low < span.high for span in one.inputs.values())


def test_measured_values_are_those_of_the_sources():
    values = {
        (one.id, force.name): force.value
        for one in (NET, OTHER_NET, ICELAND)
        for force in one.measured
    }
    assert sorted(values.values()) == [24, 28, 30, 34, 48, 70, 95, 150, 350]


def test_known_structure_has_one_case_and_a_misfit():
    found = validate_structure(known_net())
    assert (found.solved, found.failed) == (1, 0)
    for comparison in found.comparisons:
        for band in comparison.bands:
            assert band.low == band.high == band.middle[0]
    (row,) = (row for row in render_rows(found) if row["name"] == "force of the posts")
    post = next(b for c in found.comparisons for b in c.bands if b.member == "post")
    assert row["said"] == f"misfit {100.0 * (post.low / 95.0 - 1.0):+.1f} %"


def render_rows(found):
    from netdesign.addons.evidence.validation.page import _tabulate

    rows = _tabulate([found]).rows
    return [{"name": row[1].text, "said": row[-1].text} for row in rows]


def test_ropes_between_posts_are_solved_where_they_are_given():
    inputs = {name: of_one(value) for name, value in KNOWN.items()}
    inputs |= {"rope_stiffness_kN": of_one(1.5e4), "rope_sag": of_one(0.05)}
    found = validate_structure(replace(NET, inputs=inputs))
    ridge = found.comparisons[2].bands[0]
    assert ridge.member == "panel_upper_tension"
    assert ridge.low > 0.0


@each(
    "old, new, named",
    [
        ('schema = "netdesign.measured/1"', 'schema = "other"', "schema"),
        ("value_kN = 34.0", "value_kN = -34.0", "value_kN"),
        ("value_kN = 34.0", "value_kN = true", "value_kN"),
        ("value_kN = 34.0", "value_N = 34.0", "value_N"),
        ('mark = "read"', 'mark = "known"', "mark"),
        ("slope_deg = { low = 30.0", "slope_deg = { low = 50.0", "slope_deg"),
        ("slope_deg = { low = 30.0", "slope_deg = { value = 30.0", "slope_deg"),
        ("slope_deg = {", "slope = {", "slope"),
        ("value_kN = 34.0", "value_kN_per_m = 34.0", "value_kN_per_m"),
        ("rope_sag = {", "rope_slack = {", "rope_slack"),
        ('title = "', 'name = "', "name"),
        ('members = ["post"]', "members = []", "members"),
    ],
)
def test_file_is_refused_by_the_name_of_its_field(old, new, named):
    text = OWN.decode()
    assert old in text
    with pytest.raises(ModelError, match=named):
        read_structures(text.replace(old, new, 1).encode())


def test_example_of_the_readme_gets_a_band_and_with_a_value_a_misfit():
    page = (
        files("netdesign.addons.evidence.validation")
        .joinpath("README.md")
        .read_text("utf-8")
    )
    text = page.split("```toml")[1].split("```")[0]
    (net,) = read_structures(text.encode())
    assert not net.is_known
    assert validate_structure(net, samples=3).solved == 3
    known = text.replace("low = 1.3, high = 1.9", "value = 1.6")
    (net,) = read_structures(known.encode())
    assert net.is_known
    (row,) = render_rows(validate_structure(net))
    assert row["said"].startswith("misfit ")
