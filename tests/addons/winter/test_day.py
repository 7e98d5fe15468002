"""One day: its layers, its scene, and every way in which it may end."""

import math

import numpy as np
import pytest

from netdesign.addons.winter.day import RowDay, build_day_scene, merge_layers
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.steady.solve import solve_steady
from netdesign.snow.snowpack import Layer, build_layered_snowpack
from tests.addons.winter.made_up_row import SLOPE, a_pack, a_solver


def prepare(pack, **changes):
    layered = changes.pop("layered", True)
    (day,) = a_solver(**changes).prepare({7: pack}, layered=layered)
    return day


def test_heights_become_thicknesses_normal_to_the_slope():
    day = prepare(a_pack([1.1, 0.9], [391.0, 203.0]), factor=1.2)
    assert day.thickness == pytest.approx(1.2 * 2.0 * math.cos(SLOPE), rel=1e-12)
    assert day.density == pytest.approx((1.1 * 391.0 + 0.9 * 203.0) / 2.0, rel=1e-12)
    assert [la.density for la in day.layers] == pytest.approx([391.0, 203.0])
    share = day.layers[0].thickness / day.thickness
    assert share == pytest.approx(0.55, rel=1e-12)


def test_thin_snow_is_uniform():
    assert prepare(a_pack([0.6, 0.7], [380.0, 150.0])).layers == ()
    assert len(prepare(a_pack([0.7, 0.8], [380.0, 150.0])).layers) == 2
    assert prepare(a_pack([1.4, 1.0], [380.0, 150.0]), layered=False).layers == ()


def test_uniform_day_is_its_own_steady_state():
    solver = a_solver()
    days = solver.prepare({3: a_pack([1.7], [327.0])}, layered=True)
    (day,) = solver.solve(days)
    scene = build_day_scene(solver.row.scene, day)
    alone = solve_steady(scene, SolverSettings(accuracy=0.01))
    assert day.foot.value == alone.foot.size
    assert day.head.value == alone.head.size
    assert day.foot.high - day.foot.value == pytest.approx(alone.foot.error)
    assert day.member_forces == {}


def test_snow_that_the_law_refuses_fails_with_its_reason():
    solver = a_solver()
    (day,) = solver.solve(solver.prepare({0: a_pack([1.0], [81.0])}, layered=True))
    assert day.ending == "failed"
    assert day.pull is None
    assert "3a" in str(day.reason)


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


def test_layers_that_fail_are_tried_as_uniform_snow():
    solver = a_solver()
    too_thin = (Layer(thickness=1.99, density=300.0), Layer(thickness=0.01, density=90))
    open_day = RowDay(
        index=5, thickness=2.0, density=298.95, layers=too_thin, ending="open"
    )
    (day,) = solver.solve([open_day])
    assert day.ending == "solved"
    assert day.layers == ()
    assert day.reason is not None
