"""Base laws and the table from glide factor to slip length."""

import pytest

from netdesign.snow.ground import (
    DEFAULT_CREEP_LAW,
    GroundLaw,
    build_ground_from_glide_factor,
    compute_slip_length,
    find_glide_step,
    load_glide_tables,
)
from tests.each import each


# FACTS.md, section 9.
@each(
    "glide, ratio",
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


@each("glide", [1.001, 1.0278, 1.37, 2.713, 3.2, 3.346])
def test_a_slip_length_leads_back_to_its_glide_factor(glide):
    table = load_glide_tables()[DEFAULT_CREEP_LAW]
    ratio = compute_slip_length(glide, 2.3) / 2.3
    assert table.find_glide_factor(ratio) == pytest.approx(glide, rel=1e-12)


def test_a_step_holds_the_factor_between_its_entries():
    step = find_glide_step(2.713)
    assert step.glide_factors == (2.6728, 2.8377)
    assert step.slip_ratios == (12.5, 16.0)
    by_hand = 12.5 + (2.713 - 2.6728) / (2.8377 - 2.6728) * 3.5
    assert step.interpolate(2.713) == pytest.approx(by_hand, rel=1e-14)


def test_glide_factor_one_is_no_slip():
    assert build_ground_from_glide_factor(1.0, 3.0) == GroundLaw(kind="no-slip")


def test_glide_factor_above_one_slides():
    ground = build_ground_from_glide_factor(1.5010, 3.0)  # the entry of 1
    assert ground.kind == "sliding"
    assert ground.slip_length == pytest.approx(3.0, rel=1e-12)
