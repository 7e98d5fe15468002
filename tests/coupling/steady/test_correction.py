"""Steps of rounds that gain too little alone."""

from types import SimpleNamespace

import numpy as np
import pytest

from netdesign.coupling.steady import round as rounded
from netdesign.coupling.steady.round import RoundResult, carry_tangent, correct_round

CURVE = np.array([[0.0, 0.1, 0.2], [0.0, 0.5, 1.0]])


def a_round(curve, image):
    return RoundResult(
        curve=curve,
        image=image,
        mesh=None,
        state=None,
        net=None,
        linear_solves=1,
        change=0.0,
        condense=None,
    )


PROBLEM = SimpleNamespace(snow=None, stiffness=None)


@pytest.mark.parametrize("seed", range(4))
def test_the_step_ends_where_a_linear_round_stays(monkeypatch, seed):
    """Also where the round alone circles round its fixed point or flees from it."""
    rng = np.random.default_rng(seed)
    matrix, still = rng.normal(0.0, 2.0, (6, 6)), rng.normal(size=6)
    monkeypatch.setattr(
        rounded, "linearise_round", lambda *_: matrix.reshape(2, 3, 2, 3)
    )
    image = (still + matrix @ (CURVE.ravel() - still)).reshape(2, 3)
    found = correct_round(PROBLEM, a_round(CURVE, image), None)
    np.testing.assert_allclose(found.target.ravel(), still, atol=1e-10)


def test_a_round_that_made_things_worse_is_half_taken_back(monkeypatch):
    monkeypatch.setattr(rounded, "linearise_round", lambda *_: np.zeros((2, 3, 2, 3)))
    first = correct_round(PROBLEM, a_round(CURVE, CURVE + 0.01), None)
    worse = a_round(first.target, first.target + 0.03)
    second = correct_round(PROBLEM, worse, first)
    np.testing.assert_allclose(second.target, CURVE + 0.005, atol=1e-15)
    better = a_round(first.target, first.target + 0.002)
    third = correct_round(PROBLEM, better, first)
    np.testing.assert_allclose(third.target, first.target + 0.002, atol=1e-15)


def test_a_derivative_is_carried_as_what_it_does_to_straight_pieces():
    rng = np.random.default_rng(3)
    known = np.array([0.0, 0.21, 0.58, 1.0])
    wanted = np.sort(np.append(known, [0.07, 0.33, 0.71, 0.86]))
    tangent, corners = rng.normal(size=(2, 4, 2, 4)), rng.normal(size=(2, 4))

    def refine(values):
        return np.array([np.interp(wanted, known, row) for row in values])

    carried = carry_tangent(tangent, known, wanted)
    np.testing.assert_allclose(
        np.tensordot(carried, refine(corners), 2),
        refine(np.tensordot(tangent, corners, 2)),
        atol=1e-14,
    )
