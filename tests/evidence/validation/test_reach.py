"""How far a net holds the snow back: bounds, order, and finer solutions."""

from itertools import pairwise

import numpy as np
import pytest

from netdesign.coupling.scene import SolverSettings
from netdesign.evidence.validation import reach
from netdesign.evidence.validation.reach import MARKS, find_reaches


@pytest.fixture(scope="module")
def reaches():
    return find_reaches()


def test_glide_grows_with_the_distance_and_falls_with_the_glide_factor(reaches):
    for one in reaches:
        for shares in (one.of_row, one.of_net):
            assert min(shares) > 0.0
            assert max(shares) < 1.001
            assert np.all(np.diff(shares) > -1e-3)
    for less, more in pairwise(reaches):
        for mark in MARKS:
            assert all(np.array(more.find(mark)) < less.find(mark))


def test_a_row_holds_back_more_than_a_net_alone(reaches):
    for one in reaches:
        assert np.all(np.array(one.of_row)[10:] < np.array(one.of_net)[10:])


def test_glide_stays_on_a_finer_mesh_and_a_longer_slope(reaches, monkeypatch):
    monkeypatch.setattr(reach, "_SETTINGS", SolverSettings(accuracy=0.0005))
    monkeypatch.setattr(reach, "_LENGTH", 1.5 * reach._LENGTH)
    for rough, fine in zip(reaches, find_reaches(), strict=True):
        assert np.abs(np.subtract(rough.of_row, fine.of_row)).max() < 0.015
