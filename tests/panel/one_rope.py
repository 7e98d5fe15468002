"""One rope alone: its force along the row, by another root finder."""

import math

import numpy as np
from scipy.optimize import brentq

from netdesign.panel.equations import compute_excess_length, measure_lengths


def find_force_along(shear, rope):
    """H for which the rope has its length, from V (2, 24) at ``ROPE_POINTS``."""

    def miss(log_along):
        along = np.full(2, math.exp(log_along))
        both = np.array([shear, shear])
        excess = measure_lengths(both, np.full(2, rope.stiffness), along).excess
        assert excess[0] == excess[1]
        return excess[0] - compute_excess_length(rope.sag)

    return math.exp(brentq(miss, -20.0, 40.0, xtol=1e-14, rtol=1e-14))
