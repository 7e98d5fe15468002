"""Distance of anchors in the ground against places worked by hand and a minimiser."""

import math

import numpy as np
import pytest
from scipy.optimize import minimize

from netdesign.structure.row_position import (
    Bore,
    measure_distances,
    measure_to_row_above,
)
from tests.each import each


def a_bore(start, direction, length=5.0):
    size = math.sqrt(sum(one**2 for one in direction))
    return Bore(
        start=start, direction=tuple(one / size for one in direction), length=length
    )


def measure_distance(one, other):
    return float(measure_distances([one], [other])[0, 0])


def test_parallel_anchors_are_as_far_as_their_axes():
    slanted = (-1.0, -0.7, 0.0)
    one, other = a_bore((0, 0, 0), slanted), a_bore((0, 0, 1.7), slanted)
    assert measure_distance(one, other) == pytest.approx(1.7)


def test_crossing_anchors_touch_inside_both():
    one = a_bore((0.0, 0.0, 0.0), (0.0, -1.0, 1.0))
    other = a_bore((0.0, 0.0, 2.0), (0.0, -1.0, -1.0))
    assert measure_distance(one, other) == pytest.approx(0.0, abs=1e-12)


def test_anchors_that_end_before_they_cross_are_nearest_at_their_ends():
    # both ends lie 0.5 along the diagonal: 2 - 2 * 0.5 / sqrt(2) apart
    one = a_bore((0.0, 0.0, 0.0), (0.0, -1.0, 1.0), length=0.5)
    other = a_bore((0.0, 0.0, 2.0), (0.0, -1.0, -1.0), length=0.5)
    expected = 2.0 - 2.0 * 0.5 / math.sqrt(2.0)
    assert measure_distance(one, other) == pytest.approx(expected)


@each("seed", range(25))
def test_drawn_anchors_are_as_far_as_a_minimiser_finds(seed):
    draw = np.random.default_rng(seed)
    one, other = (
        a_bore(tuple(draw.uniform(-3, 3, 3)), tuple(draw.normal(size=3)), length)
        for length in draw.uniform(0.7, 6.0, 2)
    )

    def measure(along):
        places = [
            np.array(bore.start) + share * bore.length * np.array(bore.direction)
            for bore, share in zip((one, other), along, strict=True)
        ]
        return float(np.sum((places[0] - places[1]) ** 2))

    starts = [(a, b) for a in (0.1, 0.5, 0.9) for b in (0.1, 0.5, 0.9)]
    bounds = [(0.0, 1.0)] * 2
    least = min(minimize(measure, start, bounds=bounds).fun for start in starts)
    found = measure_distance(one, other)
    assert found == pytest.approx(math.sqrt(max(least, 0.0)), abs=2e-4)
    assert measure_distance(other, one) == pytest.approx(found)
    of_all = measure_distances([one, other], [other, one])
    assert of_all == pytest.approx(np.array([[found, 0.0], [0.0, found]]))


def test_anchors_of_a_row_above_come_towards_those_of_the_row():
    """At 45 degrees: 17.3 m less both places, and twice 5 cos 45 between their ends."""
    uphill = a_bore((-3.7, 0.0, 1.1), (-1.0, -1.0, 0.0))
    downhill = a_bore((4.9, 0.0, 1.1), (1.0, -1.0, 0.0))
    apart = 17.3 - 3.7 - 4.9 - 2.0 * 5.0 / math.sqrt(2.0)
    both = [uphill, downhill]
    found = measure_to_row_above(both, 17.3)
    assert found.min() == pytest.approx(apart)
    # 10 m apart they cross, wherever they stand along the row
    beside = a_bore((-3.7, 0.0, 9.2), (-1.0, -1.0, 0.0))
    least = measure_to_row_above([beside, downhill], 10.0)[0, 1]
    assert least == pytest.approx(0.0, abs=1e-9)


@each("seed", range(20))
def test_seen_along_the_row_no_drawn_anchors_are_nearer(seed):
    draw = np.random.default_rng(seed)
    bores = [
        a_bore(tuple(draw.uniform(-5, 5, 3)), tuple(draw.normal(size=3)))
        for _ in range(4)
    ]
    least = measure_to_row_above(bores, 9.0)
    for row, one in enumerate(bores):
        for column, other in enumerate(bores):
            x, y, z = other.start
            moved = (x - 9.0, y, z + float(draw.uniform(-4, 4)))
            above = Bore(start=moved, direction=other.direction, length=other.length)
            assert measure_distance(one, above) >= least[row, column] - 1e-9
