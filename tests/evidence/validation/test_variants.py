"""Two forces outside: what is changed counts, and what brings them inside."""

import pytest

from netdesign.evidence.validation.measured_file import read_all
from netdesign.evidence.validation.variants import AS_GIVEN, examine


@pytest.fixture(scope="module")
def variants():
    return examine(read_all(None))


def test_each_force_lies_outside_as_given_and_something_explains_it(variants):
    by_structure = {}
    for one in variants:
        by_structure.setdefault(one.structure.id, {})[one.name] = one
    assert set(by_structure) == {"trumer-2007", "siglufjordur-2006"}
    for found in by_structure.values():
        assert not found[AS_GIVEN].explains
        assert any(one.explains for one in found.values())
        assert not all(one.explains for one in found.values() if one.name != AS_GIVEN)


def test_less_snow_more_sag_and_half_a_bay_lower_the_forces(variants):
    """A variant's middle band lies below that as given, end by end."""
    for one in variants:
        given = next(
            x
            for x in variants
            if x.structure.id == one.structure.id and x.name == AS_GIVEN
        )
        (band,), (whole,) = one.comparison.bands, given.comparison.bands
        if one.name != AS_GIVEN:
            assert band.middle[0] < whole.middle[0]
            assert band.middle[1] < whole.middle[1]


def test_other_structures_have_no_variants():
    others = [one for one in read_all(None) if one.id in ("oberalp-1995", "elm-1995")]
    assert len(others) == 2
    assert examine(others) == []
