"""Measured structures: their file, and the bands of the model."""

from dataclasses import replace

from netdesign.addons.evidence.validation import (
    Span,
    load_structures,
    validate_structure,
)

NET, OTHER_NET, ICELAND = load_structures()
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


def test_published_structures_have_ranges_and_say_what_is_missing():
    for net in (NET, OTHER_NET, ICELAND):
        assert net.open
        assert net.inputs.keys() - {"rope_stiffness_kN", "rope_sag"} == KNOWN.keys()
        assert {"read"} == {force.mark for force in net.measured}
        assert all(force.members for force in net.measured)
        assert "read" not in {span.mark for span in net.inputs.values()}
        assert all(span.low < span.high for span in net.inputs.values())


def test_a_structure_without_ranges_has_a_band_without_width():
    found = validate_structure(known_net(), samples=1)
    assert (found.solved, found.failed) == (1, 0)
    for comparison in found.comparisons:
        for band in comparison.bands:
            assert band.low == band.high == band.middle[0]
