"""Parts of a cable that begin and end at given heights."""

from typing import NamedTuple

import numpy as np
import pytest

from netdesign.cable.funicular import CableParts, find_part_lengths, solve_funicular
from tests.each import each

STIFFNESS, SLACK = 400.0, 0.06
PARTS = 4
ELEMENTS = 3  # in each part


class Cable(NamedTuple):
    parts: CableParts
    head_x: float
    length: float

    @property
    def rises(self):
        return self.parts.rises

    @property
    def size(self):
        return self.parts.shares.size


def part_cable(cable, forces, start):
    known = (cable.parts, forces, cable.head_x, cable.length, STIFFNESS)
    return find_part_lengths(*known, start)


def draw_cable(seed):
    """A cable whose parts rise unevenly, and forces that press it downslope."""
    rng = np.random.default_rng(seed)
    shares = rng.uniform(0.3, 1.0, (PARTS, ELEMENTS))
    shares /= shares.sum(axis=1, keepdims=True)
    rises, head_x = rng.uniform(0.1, 0.7, PARTS), rng.uniform(0.0, 0.9)
    parts = CableParts(
        shares=shares.ravel(),
        part=np.repeat(np.arange(PARTS), ELEMENTS),
        firsts=np.arange(0, PARTS * ELEMENTS, ELEMENTS),
        rises=rises,
    )
    length = (1.0 + SLACK) * float(np.hypot(head_x, rises.sum()))
    cable = Cable(parts, head_x, length)
    forces = rng.uniform(0.01, 0.4, (2, 2 * cable.size + 1)) / cable.size
    forces[1] *= -0.3
    return cable, forces


def hang(cable, forces, parts, start):
    head = np.array([cable.head_x, cable.rises.sum()])
    lengths = cable.parts.shares * parts[cable.parts.part]
    return solve_funicular(forces, lengths, STIFFNESS, head, start)


def guess_pull(cable, forces):
    even = cable.rises / cable.rises.sum() * cable.length
    return hang(cable, forces, even, np.array([0.1, 1.0])).pull


@each("seed", range(8))
def test_parts_end_at_their_heights(seed):
    """The cable hung with these lengths, and with no others, is the one asked for."""
    cable, forces = draw_cable(seed)
    start = guess_pull(cable, forces)
    parts = part_cable(cable, forces, start)
    assert parts.sum() == pytest.approx(cable.length, rel=1e-11)
    found = hang(cable, forces, parts, start)
    ends = found.curve[1, 2 * np.append(cable.parts.firsts[1:], cable.size)]
    np.testing.assert_allclose(ends, np.cumsum(cable.rises), atol=1e-9)


def test_a_cable_that_need_not_bend_is_parted_like_its_rises():
    cable, forces = draw_cable(0)
    straight = np.outer([cable.head_x, cable.rises.sum()], [5.0])[:, 0]
    taut = float(np.hypot(*straight)) / 5.0
    cable = cable._replace(length=taut * 0.99)
    parts = part_cable(cable, 0.0 * forces, straight)
    expected = cable.rises / cable.rises.sum() * cable.length
    np.testing.assert_allclose(parts, expected, rtol=1e-10)


def test_a_part_that_cannot_rise_has_no_length():
    """All of the load hangs in the lowest part, which it pulls below the foot."""
    cable, forces = draw_cable(1)
    forces = 0.0 * forces
    forces[1, 2] = -30.0
    assert part_cable(cable, forces, np.array([0.1, 1.0])) is None
