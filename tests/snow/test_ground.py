"""Base laws and the table from glide factor to slip length."""

import math

import pytest

from netdesign.errors import ModelError
from netdesign.snow.ground import (
    LARGEST_GLIDE_FACTOR,
    GroundLaw,
    build_ground_from_glide_factor,
    compute_slip_length,
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


# physics.md, section 2, sliding law.
@pytest.mark.parametrize(
    ("glide", "ratio"),
    [(1.1, 0.1), (1.2, 0.25), (1.34, 0.5), (1.52, 1), (1.76, 2), (2.07, 4), (2.45, 8)],
)
def test_slip_length_at_the_entries_of_the_table(glide, ratio):
    assert compute_slip_length(glide, 3.0) == pytest.approx(3.0 * ratio, rel=1e-12)


def test_slip_length_between_entries():
    assert compute_slip_length(1.05, 1.0) == pytest.approx(0.05, rel=1e-12)


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
    with pytest.raises(ModelError, match=r"glide factor = .* between 1\.001 and 2\.45"):
        compute_slip_length(glide, 1.0)


def test_glide_factor_one_is_no_slip():
    assert build_ground_from_glide_factor(1.0, 3.0) == GroundLaw(kind="no-slip")


def test_glide_factor_above_one_slides():
    ground = build_ground_from_glide_factor(1.52, 3.0)
    assert ground.kind == "sliding"
    assert ground.slip_length == pytest.approx(3.0, rel=1e-12)
