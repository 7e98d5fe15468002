"""Net on nodes that yield: friction, forces and positions agree with each other."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from netdesign.addons.history import yielding
from netdesign.addons.history.net_pulls import measure_arcs
from netdesign.addons.history.yielding import NetGuess, YieldingNodes, settle_net
from netdesign.outcome import Outcome, SolveError
from tests.addons.history.starts import find_breach
from tests.each import each

STIFFNESS = 300.0
HEAD = np.array([0.4, 1.0])


def bulge(count, sag=0.06):
    """Nodes (2, n) on a parabola over the chord, closer together at its ends."""
    even = np.linspace(0.0, 1.0, count + 2)[1:-1]
    part = (1.0 - np.cos(np.pi * even)) / 2.0
    outward = np.array([HEAD[1], -HEAD[0]])
    return np.outer(HEAD, part) + np.outer(outward, 4.0 * sag * part * (1.0 - part))


def points_of(place):
    return np.column_stack([np.zeros(2), place, HEAD])


def lengths_of(place, strain=0.02, spread=0.0):
    """Unstressed lengths under this strain, tighter towards the foot."""
    arcs = measure_arcs(points_of(place))
    return arcs / (1.0 + strain * (1.0 + spread * np.linspace(1.0, -1.0, arcs.size)))


def yielding_nodes(place, softness, seed=1):
    """Nodes of a random symmetric compliance, pushed out of place without the net."""
    rng = np.random.default_rng(seed)
    count = place.size
    root = rng.normal(size=(count, count)) / math.sqrt(count)
    push = softness * rng.normal(size=place.shape)
    return YieldingNodes(
        positions=place + push,
        forces=np.ones_like(place),
        compliance=softness * (root @ root.T + 0.1 * np.eye(count)),
    )


def settle(nodes, place, lengths, friction, signs=None):
    signs = np.zeros(lengths.size - 1, dtype=np.int8) if signs is None else signs
    return settle_net(
        nodes,
        NetGuess.at_rest(place, signs),
        HEAD,
        lengths,
        friction=friction,
        stiffness=STIFFNESS,
    )


@each("softness", [1e-5, 1e-4, 1e-3])
@each("friction", [0.0, 0.1, 0.6, 1.0])
def test_forces_positions_and_friction_agree(friction, softness):
    """Snow that is stiffer than the net, and softer."""
    for seed in range(12):
        place = bulge(11)
        lengths = lengths_of(place, spread=0.5 - seed % 3 * 0.5)
        nodes = yielding_nodes(place, softness, seed)
        response, end = settle(nodes, place, lengths, friction)
        off = nodes.place(response.forces) - end.place
        assert np.abs(off).max() < 1e-11
        assert response.tensions.min() > 0.0
        assert response.lengths.sum() == pytest.approx(lengths.sum(), rel=1e-14)
        slides = np.cumsum(response.lengths - lengths)[:-1]
        glides = response.slide_signs != 0
        assert np.abs(slides[~glides]).max(initial=0.0) < 1e-13
        points, tensions = points_of(end.place), response.tensions
        assert find_breach(points, friction, slides, glides, tensions) < 1e-7


@pytest.mark.parametrize("push", [1e-6, 1e-3, 0.1])
def test_straight_net_takes_up_its_load(push):
    """One node in the middle, yielding across the net: one equation, by bisection."""
    half = float(np.hypot(*HEAD)) / 2.0
    outward = np.array([HEAD[1], -HEAD[0]]) / (2.0 * half)
    softness = 1e-4

    def miss(way):
        slope = way / half
        bend = 2.0 * math.atan(slope)
        arc = half * math.hypot(1.0, slope) * (1.0 + bend**2 / 24.0)
        tension = STIFFNESS * (arc / half - 1.0)
        force = 2.0 * tension * slope / math.hypot(1.0, slope)
        return push - softness * force - way

    middle = (HEAD / 2.0)[:, None]
    nodes = YieldingNodes(
        positions=middle + push * outward[:, None],
        forces=np.zeros((2, 1)),
        compliance=softness * np.outer(outward, outward),
    )
    _, end = settle(nodes, middle, np.full(2, half), 0.3)
    way = float(outward @ (end.place - middle)[:, 0])
    assert way == pytest.approx(brentq(miss, 0.0, push, xtol=1e-16), rel=1e-6)


def test_iterations_that_do_not_suffice_are_an_error(monkeypatch):
    monkeypatch.setattr(yielding, "_MOST_ITERATIONS", 1)
    place = bulge(5)
    with pytest.raises(SolveError, match="friction of the net") as failure:
        settle(yielding_nodes(place, 1e-3), place, lengths_of(place), 0.2)
    assert failure.value.outcome is Outcome.MAX_ITERATIONS
