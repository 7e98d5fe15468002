"""A bore that runs out of the ground holds nothing, whatever cover is asked."""

import math
import random

from netdesign.study.anchor_ground import BondInGround


def build_bond(cover, least=None):
    return BondInGround(
        anchor="downhill_anchor",
        cover=cover,
        edge=None,
        length=4.0,
        least_cover=least,
        least_edge=None,
        has_soil=False,
    )


def test_a_bond_above_the_surface_is_short_whatever_is_asked():
    rng = random.Random(11)
    for _ in range(50):
        height = rng.uniform(0.0, 4.0) * math.sin(rng.uniform(0.01, 1.0))
        for least in (None, rng.uniform(0.0, 2.0)):
            (short,) = build_bond(-height, least).list_short()
            assert short.key == "bores.leaves_ground"
            assert build_bond(-height, least).is_checked
        assert not list(build_bond(height + 1e-9).list_short())
