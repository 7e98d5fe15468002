"""Joining of layers: mass and thickness stay, whatever is drawn."""

import numpy as np
import pytest

from netdesign.addons.winter.day import merge_layers
from netdesign.snow.snowpack import build_layered_snowpack


def drawn_packs(seed=17, count=60):
    rng = np.random.default_rng(seed)
    for _ in range(count):
        n = int(rng.integers(1, 70))
        yield rng.lognormal(-3.0, 1.2, n), rng.uniform(81.0, 560.0, n)


def test_thickness_and_mass_are_kept_and_few_layers_left():
    for thicknesses, densities in drawn_packs():
        layers = merge_layers(thicknesses, densities)
        assert 1 <= len(layers) <= 4
        total = sum(layer.thickness for layer in layers)
        mass = sum(layer.thickness * layer.density for layer in layers)
        assert total == pytest.approx(thicknesses.sum(), rel=1e-12)
        assert mass == pytest.approx((thicknesses * densities).sum(), rel=1e-12)
        if len(layers) > 1:
            assert min(layer.thickness for layer in layers) >= 0.06 * total
            assert min(layer.density for layer in layers) >= 100.0
        build_layered_snowpack(layers, slope_angle=0.7, upslope_length=11.0)


def test_pair_that_matters_least_goes_first():
    layers = merge_layers([0.5, 0.5, 0.5, 0.5], [400.0, 395.0, 250.0, 150.0], most=3)
    assert [la.density for la in layers] == pytest.approx([397.5, 250.0, 150.0])
