"""Density of settled snow, and the creep law that follows it."""

from dataclasses import replace

import numpy as np
import pytest

from netdesign.addons.history.body import Settling, build_body, build_material
from netdesign.addons.history.settings import TRANSIENT_LEVELS
from netdesign.snow.creep_law import (
    CREEP_LAWS,
    compute_bulk_factor,
    compute_shear_factor,
)
from netdesign.snow.law import FlowLayer, sample_material
from netdesign.snow.mesh import build_template

LAW = CREEP_LAWS["boutillier-2004"]
DENSITY = 0.4


def a_body(law, tops=()):
    template = build_template(5.0, TRANSIENT_LEVELS[0], tops)
    fractions = template.net_fractions
    return build_body(law, template, np.array([0.0 * fractions, fractions]))


def settled(body, jacobian):
    """The body under an even settling: every area times the Jacobian."""
    return replace(body, vertices=body.vertices * np.array([[1.0], [jacobian]]))


def settling(**changes):
    return replace(Settling(creep_law=LAW, mean_density=DENSITY), **changes)


# --- material ----------------------------------------------------------------


def test_undeformed_snow_has_the_material_of_the_scene(a_flow_problem):
    shear, bulk = (f(LAW, DENSITY) for f in (compute_shear_factor, compute_bulk_factor))
    law = a_flow_problem(bulk_ratio=shear / bulk)
    found = build_material(settling(), law, a_body(law))
    expected = sample_material(law, a_body(law).topology.template)
    for name in ("bulk_ratio", "fluidity_ratio", "density"):
        np.testing.assert_allclose(
            getattr(found, name), getattr(expected, name), rtol=1e-12
        )


@pytest.mark.parametrize(
    ("exponent", "jacobian"), [(3.0, 0.9), (3.0, 1.05), (1.0, 0.9)]
)
def test_density_is_that_of_the_start_over_the_jacobian(
    a_flow_problem, exponent, jacobian
):
    """a and b are taken there; the fluidity goes with a^((n + 1) / 2)."""
    creep, law = replace(LAW, exponent=exponent), a_flow_problem(exponent=exponent)
    stretches = settling(creep_law=creep, least_density=0.5)
    found = build_material(stretches, law, settled(a_body(law), jacobian))
    density = DENSITY / jacobian
    shear, bulk = (
        f(creep, density) for f in (compute_shear_factor, compute_bulk_factor)
    )
    np.testing.assert_allclose(found.density, 1.0 / jacobian, rtol=1e-12)
    np.testing.assert_allclose(found.bulk_ratio, shear / bulk, rtol=1e-11)
    ratio = shear / compute_shear_factor(creep, DENSITY)
    softer = ratio ** ((exponent + 1.0) / 2.0)
    np.testing.assert_allclose(found.fluidity_ratio, softer, rtol=1e-11)
    assert found.density.shape == (a_body(law).mass.size, 1)


def test_warm_snow_stays_warm(a_flow_problem):
    """Warmth multiplies the fluidity, whatever the density has become."""
    law = a_flow_problem()
    body = settled(a_body(law), 0.9)
    cold = build_material(settling(), law, body)
    warm = build_material(
        settling(), law, replace(body, warmth=np.full_like(body.warmth, 3.0))
    )
    np.testing.assert_allclose(
        warm.fluidity_ratio, 3.0 * cold.fluidity_ratio, rtol=1e-14
    )
    np.testing.assert_array_equal(warm.bulk_ratio, cold.bulk_ratio)


@pytest.mark.parametrize("tops", [(), (0.4,)], ids=["uniform", "layers"])
def test_without_densification_the_material_is_that_of_the_start(a_flow_problem, tops):
    law = a_flow_problem()
    if tops:
        below = FlowLayer(top=0.4, bulk_ratio=2.5, fluidity_ratio=0.7, density=1.2)
        above = FlowLayer(top=1.0, bulk_ratio=1.4, fluidity_ratio=2.0, density=0.867)
        law = replace(law, layers=(below, above))
    body = settled(a_body(law, tops), 0.8)
    found = build_material(settling(densifies=False), law, body)
    expected = sample_material(law, body.topology.template)
    for name in ("bulk_ratio", "fluidity_ratio", "density"):
        np.testing.assert_array_equal(getattr(found, name), getattr(expected, name))
    assert np.any(
        build_material(settling(), law, body).fluidity_ratio
        != np.asarray(found.fluidity_ratio)
    )


# --- the largest density -----------------------------------------------------


def test_stretched_snow_is_no_looser_than_the_loosest_layer(a_flow_problem):
    """Twice the area: the law still sees the density of the start."""
    law = a_flow_problem()
    body = a_body(law)
    start, stretched = (
        build_material(settling(), law, part) for part in (body, settled(body, 2.0))
    )
    np.testing.assert_allclose(
        stretched.fluidity_ratio, start.fluidity_ratio, rtol=1e-12
    )
    np.testing.assert_allclose(stretched.bulk_ratio, start.bulk_ratio, rtol=1e-12)
    looser = settling(least_density=0.25)
    softer = build_material(looser, law, settled(body, 2.0))
    assert (softer.fluidity_ratio > 10.0 * start.fluidity_ratio).all()
