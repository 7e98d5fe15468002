"""Measured structures: their file, and the bands of the model."""

from dataclasses import replace

from netdesign.addons.evidence.validation import (
    Span,
    load_structures,
    validate_structure,
)
from netdesign.cable.net import LARGEST_SLACK
from netdesign.panel.inputs import LARGEST_SAG
from netdesign.snow.ground import LARGEST_GLIDE_FACTOR

NET, OTHER_NET, ICELAND = load_structures()
# Inputs of a structure, and between which values each is possible.
INPUTS = {
    "slope_deg": (5.0, 70.0),
    "net_height_m": (0.5, 10.0),
    "filled": (0.05, 1.0),
    "density_kg_m3": (50.0, 700.0),
    "upslope_length_m": (0.5, 300.0),
    "glide_factor": (1.0, LARGEST_GLIDE_FACTOR),
    "inclination_deg": (0.0, 70.0),
    "friction_deg": (0.0, 60.0),
    "slack": (0.0, LARGEST_SLACK),
    "stiffness_kN_per_m": (10.0, 1e7),
    "post_spacing_m": (0.5, 20.0),
    "uphill_anchor_ratio": (0.0, 10.0),
}
ROPE_INPUTS = {"rope_stiffness_kN": (10.0, 1e7), "rope_sag": (0.0, LARGEST_SAG)}
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
        assert net.inputs.keys() in (INPUTS.keys(), (INPUTS | ROPE_INPUTS).keys())
        assert {"read"} == {force.mark for force in net.measured}
        assert all(force.members for force in net.measured)
        assert "read" not in {span.mark for span in net.inputs.values()}
        for name, span in net.inputs.items():
            low, high = (INPUTS | ROPE_INPUTS)[name]
            assert low <= span.low < span.high <= high


def test_a_structure_without_ranges_has_a_band_without_width():
    found = validate_structure(known_net(), samples=1)
    assert (found.solved, found.failed) == (1, 0)
    for comparison in found.comparisons:
        for band in comparison.bands:
            assert band.low == band.high == band.middle[0]
