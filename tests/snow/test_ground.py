"""Base laws and the table from glide factor to slip length."""

import math

import pytest

from netdesign.coupling.steady.glide_factor import measure_glide_factor
from netdesign.errors import ModelError
from netdesign.snow.creep_law import BOUTILLIER_2004
from netdesign.snow.ground import (
    DEFAULT_CREEP_LAW,
    LARGEST_GLIDE_FACTOR,
    GroundLaw,
    build_ground_from_glide_factor,
    compute_slip_length,
    load_glide_tables,
)


@pytest.mark.parametrize("kind", ["free", "no-slip"])
def test_ground_without_slip_length(kind):
    assert GroundLaw(kind=kind).slip_length == 0.0


@pytest.mark.parametrize("kind", ["free", "no-slip"])
@pytest.mark.parametrize("length", [1.0, -1.0, math.nan, math.inf])
def test_slip_length_that_does_not_belong(kind, length):
    with pytest.raises(ModelError, match=f"only a sliding ground has one.*{kind}"):
        GroundLaw(kind=kind, slip_length=length)


@pytest.mark.parametrize("length", [0.0, -1.0, math.nan, math.inf])
def test_sliding_ground_needs_a_slip_length(length):
    with pytest.raises(ModelError, match="sliding ground needs a"):
        GroundLaw(kind="sliding", slip_length=length)


def test_smallest_slip_length():
    assert GroundLaw(kind="sliding", slip_length=1e-9).slip_length == 1e-9


@pytest.mark.parametrize("kind", ["", "Free", "rough"])
def test_unknown_kind(kind):
    with pytest.raises(ModelError, match="free, no-slip, sliding"):
        GroundLaw(kind=kind)


# FACTS.md, section 9.
@pytest.mark.parametrize(
    ("glide", "ratio"),
    [(1.1, 0.1), (1.2, 0.25), (1.34, 0.5), (1.52, 1), (1.76, 2), (2.07, 4), (2.45, 8)],
)
def test_table_lies_near_that_of_another_code(glide, ratio):
    """Both within 3 % of each other, the spread that FACTS.md, section 9, states."""
    table = load_glide_tables()[DEFAULT_CREEP_LAW]
    stored = dict(zip(table.slip_ratios, table.glide_factors, strict=True))
    assert stored[ratio] == pytest.approx(glide, rel=0.03)


@pytest.mark.parametrize("law", load_glide_tables())
def test_slip_length_at_the_entries_of_the_table(law):
    table = load_glide_tables()[law]
    for ratio, glide in zip(table.slip_ratios, table.glide_factors, strict=True):
        found = compute_slip_length(glide, 3.0, law)
        assert found == pytest.approx(3.0 * ratio, rel=1e-12)
    assert sorted(table.slip_ratios) == list(table.slip_ratios)
    assert sorted(table.glide_factors) == list(table.glide_factors)


def test_slip_length_between_entries():
    """Linear from no slip at N = 1 to the first entry."""
    table = load_glide_tables()[DEFAULT_CREEP_LAW]
    halfway = (1.0 + table.glide_factors[0]) / 2
    assert compute_slip_length(halfway, 1.0) == pytest.approx(
        table.slip_ratios[0] / 2, rel=1e-12
    )


def test_creep_law_without_a_table():
    with pytest.raises(ModelError, match=r"'gagliardini-1997' has no table"):
        compute_slip_length(1.5, 1.0, "gagliardini-1997")


def test_recipe_gives_the_stored_table():
    table = load_glide_tables()[DEFAULT_CREEP_LAW]
    place = table.slip_ratios.index(1.0)
    measured = measure_glide_factor(BOUTILLIER_2004, 1.0)
    assert measured == pytest.approx(table.glide_factors[place], rel=1e-3)  # as printed


@pytest.mark.parametrize("glide", [1.001, LARGEST_GLIDE_FACTOR])
def test_bounds_of_the_table_are_accepted(glide):
    assert compute_slip_length(glide, 1.0) > 0.0


@pytest.mark.parametrize(
    "glide",
    [
        math.nextafter(1.001, 0.0),
        math.nextafter(LARGEST_GLIDE_FACTOR, 9.0),
        math.nan,
        math.inf,
    ],
)
def test_no_extrapolation(glide):
    with pytest.raises(ModelError, match=r"glide factor = .* between 1\.001 and 2\.4$"):
        compute_slip_length(glide, 1.0)


def test_glide_factor_one_is_no_slip():
    assert build_ground_from_glide_factor(1.0, 3.0) == GroundLaw(kind="no-slip")


def test_glide_factor_above_one_slides():
    ground = build_ground_from_glide_factor(1.501, 3.0)  # the entry of 1
    assert ground.kind == "sliding"
    assert ground.slip_length == pytest.approx(3.0, rel=1e-12)
