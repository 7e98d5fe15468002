"""Random net rows: no case of a grid exceeds the bound of their search."""

import math
import random
from itertools import product

import numpy as np
import pytest

from netdesign.addons.evidence.scene import build_scene
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.envelope.ranges import Interval, Ranges
from netdesign.envelope.rows import RowTask, build_point_task
from netdesign.envelope.run import run_cases
from netdesign.envelope.search import search_rows
from netdesign.search.maxima import SearchSettings
from netdesign.snow.ground import GroundLaw
from netdesign.solving.runner import Runner
from netdesign.structure.layout import SupportLayout

ACCURACY = 0.005
# Points of a grid that are solved: all near a maximum of the model, and one in so many
# of the others; of a small grid all.
_NEAR, _EVERY, _WHOLE = 0.95, 40, 200
_RANGES = Ranges(
    intervals=(
        ("density", Interval(low=250.0, high=450.0)),
        ("friction_angle", Interval(low=math.radians(15.0), high=math.radians(45.0))),
        ("inclination", Interval(low=math.radians(25.0), high=math.radians(35.0))),
    )
)


def build_random_task(seed, settings=None):
    """Net row drawn from the usual ranges of the theory page; same seed, same row."""
    draw = random.Random(seed)
    thickness = draw.uniform(1.5, 5.0)
    kind = draw.choice(("free", "no-slip", "sliding"))
    slip = draw.uniform(0.1, 4.0) * thickness if kind == "sliding" else 0.0
    return RowTask(
        scene=build_scene(
            (thickness, 350.0),
            slope=draw.uniform(30.0, 50.0),
            length=draw.uniform(2.0, 8.0) * thickness,
            ground=GroundLaw(kind=kind, slip_length=slip),
            height=thickness * draw.uniform(1.0, 1.2),
            stiffness=10.0 ** draw.uniform(6.5, 7.7),
            slack=draw.uniform(0.0, 0.1),
        ),
        ranges=_RANGES,
        layouts=(
            SupportLayout(
                post_spacing=draw.uniform(2.5, 4.0),
                uphill_anchor_distance=draw.uniform(2.0, 5.0),
                downhill_anchor_distance=draw.uniform(2.0, 5.0),
            ),
        ),
        settings=settings or SolverSettings(accuracy=ACCURACY),
        search=SearchSettings(gap=ACCURACY),
        confirmed_by=None,
    )


def measure_excess(task, found, samples):
    """Largest force of a grid beyond the stated bound, relative.

    Negative if the bound holds everywhere. Of a large grid those points are solved at
    which the search's own model comes near a maximum, and every 40th of the others,
    in case the model is wrong. Cases that fail count as far as they give a force.
    """
    points = _choose_points(found, samples)
    results = run_cases([build_point_task(task, point) for point in points], Runner())
    return max(
        result.member_forces[member].value / found.maxima.upper_bound[place] - 1.0
        for result in results
        if result.is_converged
        for place, member in enumerate(found.members)
        if found.maxima.upper_bound[place] > 0.0
    )


def _choose_points(found, samples):
    """Points of a grid near a maximum of the model, and every 40th of the others."""
    shares = [k / (samples - 1) for k in range(samples)]
    grid = list(product(shares, repeat=len(found.task.ranges.axes)))
    model, maxima = found.maxima.surrogate, found.maxima
    if model is None or len(grid) <= _WHOLE:
        return grid
    chosen = set(grid[::_EVERY])
    for place in range(len(found.members)):
        least = _NEAR * maxima.maximum[place]
        if least > 0.0:
            near = model.evaluate(np.array(grid), place)[0] >= least
            chosen |= {
                point for point, is_near in zip(grid, near, strict=True) if is_near
            }
    return sorted(chosen)


COARSE = SolverSettings(accuracy=0.1, levels=MESH_LEVELS[:2])
NOT_CLOSED = {123}  # of 200 random rows


@pytest.mark.parametrize("seed", [1, 4])
def test_no_case_of_a_grid_exceeds_the_bound(seed):
    """The same as below, thinned: coarse meshes, 4 x 4 x 4 cases."""
    task = build_random_task(seed, COARSE)
    (found,) = search_rows([task], Runner())
    assert found.gap is None
    assert measure_excess(task, found, 4) <= 0.0


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(200))
def test_no_case_of_a_dense_grid_exceeds_the_bound(seed):
    """Nor that of a search which ended for want of cases, and says so."""
    task = build_random_task(seed)
    (found,) = search_rows([task], Runner())
    assert ("could still exceed" in str(found.gap)) is (seed in NOT_CLOSED)
    assert (found.gap is None) is (seed not in NOT_CLOSED)
    assert measure_excess(task, found, 15) <= 0.0
