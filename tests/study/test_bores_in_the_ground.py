"""A bore that runs out of the ground holds nothing."""

import math
import random

from netdesign.study.anchor_ground import BondInGround


def build_bond(cover):
    return BondInGround(
        anchor="downhill_anchor", cover=cover, length=4.0, has_soil=False
    )


def test_a_bond_above_the_surface_leaves_the_ground():
    rng = random.Random(11)
    for _ in range(50):
        height = rng.uniform(0.0, 4.0) * math.sin(rng.uniform(0.01, 1.0))
        assert build_bond(-height).leaves_ground
        assert not build_bond(height + 1e-9).leaves_ground
