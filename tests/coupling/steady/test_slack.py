"""Less slack pulls more, over random scenes; layers of ice and their work."""

import re
from dataclasses import replace

import numpy as np

from netdesign.addons.evidence.benchmark.scenes import build_tables, draw_scene
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.solution import FailedSolution, Solution
from netdesign.coupling.steady import solve as steady_solve
from netdesign.coupling.steady.solve import MOST_MIXED_TRIANGLES, solve_steady
from netdesign.outcome import ModelError
from netdesign.snow.snowpack import Layer, build_layered_snowpack
from tests.coupling.drawn_scenes import draw_scene as draw_untidy
from tests.each import each

ROUGH = SolverSettings(accuracy=0.05)


def test_less_slack_pulls_more():
    compared = 0
    for number in range(60):
        try:
            scene = build_tables(draw_scene(23, number))
        except ModelError:
            continue
        slack = scene.net.slack
        if slack < 0.01 or scene.snowpack.layers:
            continue
        tauter = replace(scene, net=replace(scene.net, slack=0.75 * slack))
        pair = [solve_steady(one, ROUGH) for one in (scene, tauter)]
        if not all(isinstance(one, Solution) for one in pair):
            continue
        own, more = pair
        assert more.foot.size + more.foot.error > own.foot.size - own.foot.error
        assert more.head.size + more.head.error > own.head.size - own.head.error
        assert more.foot.size > own.foot.size
        compared += 1
    assert compared > 8


# --- fault 18: layers of ice between light ones cost no more than is said -----------


def build_light_and_heavy(seed):
    """One drawn layer of 870 to 907 kg/m3 among light ones, on any ground."""
    rng = np.random.default_rng([61, 18, seed])
    scene = draw_untidy(seed, is_uniform=True)
    light = [float(one) for one in rng.uniform(120.0, 300.0, rng.integers(2, 5))]
    densities = [*light, float(rng.uniform(870.0, 907.0))]
    rng.shuffle(densities)
    layers = tuple(
        Layer(thickness=float(rng.uniform(0.1, 0.8)), density=density)
        for density in densities
    )
    pack = build_layered_snowpack(
        layers,
        slope_angle=scene.snowpack.slope_angle,
        upslope_length=scene.snowpack.upslope_length,
    )
    net = replace(scene.net, height_normal=pack.thickness)
    return replace(scene, snowpack=pack, net=net)


@each("seed", range(4))
def test_layers_of_ice_end_within_the_work_that_is_allowed(seed):
    scene = build_light_and_heavy(seed)
    solved = solve_steady(scene, SolverSettings(accuracy=1e-3))
    if isinstance(solved, FailedSolution):
        assert len(str(solved.reason).split()) > 5
    else:
        assert solved.cost.elements <= MOST_MIXED_TRIANGLES
        assert solved.cost.linear_solves < 400


def test_a_mesh_beyond_the_work_is_refused_with_the_layer(monkeypatch):
    monkeypatch.setattr(steady_solve, "MOST_MIXED_TRIANGLES", 50)
    solved = solve_steady(build_light_and_heavy(0), ROUGH)
    assert isinstance(solved, FailedSolution)
    assert re.search(r"layer of [789]\d\d kg/m3 .* at most 50 ", str(solved.reason))
