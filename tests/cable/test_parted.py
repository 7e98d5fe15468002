"""Parts of a cable that begin and end at given heights."""

import numpy as np
import pytest

from netdesign.cable.funicular import solve_funicular
from netdesign.cable.parted import PartedCable, part_cable

STIFFNESS, SLACK = 400.0, 0.06
PARTS = 4
ELEMENTS = 3  # in each part


def draw_cable(seed):
    """A cable whose parts rise unevenly, and forces that press it downslope."""
    rng = np.random.default_rng(seed)
    shares = rng.uniform(0.3, 1.0, (PARTS, ELEMENTS))
    shares /= shares.sum(axis=1, keepdims=True)
    rises, head_x = rng.uniform(0.1, 0.7, PARTS), rng.uniform(0.0, 0.9)
    cable = PartedCable(
        shares=shares.ravel(),
        firsts=np.arange(0, PARTS * ELEMENTS, ELEMENTS),
        rises=rises,
        head_x=head_x,
        length=(1.0 + SLACK) * float(np.hypot(head_x, rises.sum())),
        stiffness=STIFFNESS,
    )
    forces = rng.uniform(0.01, 0.4, (2, 2 * cable.shares.size + 1)) / cable.shares.size
    forces[1] *= -0.3
    return cable, forces


def hang(cable, forces, parts, start):
    head = np.array([cable.head_x, cable.rises.sum()])
    lengths = cable.shares * np.repeat(parts, ELEMENTS)
    return solve_funicular(forces, lengths, cable.stiffness, head, start)


def guess_pull(cable, forces):
    even = cable.rises / cable.rises.sum() * cable.length
    return hang(cable, forces, even, np.array([0.1, 1.0])).pull


@pytest.mark.parametrize("seed", range(8))
def test_parts_end_at_their_heights(seed):
    """The cable hung with these lengths, and with no others, is the one asked for."""
    cable, forces = draw_cable(seed)
    start = guess_pull(cable, forces)
    parts = part_cable(cable, forces, start)
    assert parts.sum() == pytest.approx(cable.length, rel=1e-11)
    found = hang(cable, forces, parts, start)
    ends = found.curve[1, 2 * np.append(cable.firsts[1:], cable.shares.size)]
    np.testing.assert_allclose(ends, np.cumsum(cable.rises), atol=1e-9)


def test_a_cable_that_need_not_bend_is_parted_like_its_rises():
    cable, forces = draw_cable(0)
    straight = np.outer([cable.head_x, cable.rises.sum()], [5.0])[:, 0]
    taut = float(np.hypot(*straight)) / 5.0
    cable = PartedCable(
        shares=cable.shares,
        firsts=cable.firsts,
        rises=cable.rises,
        head_x=cable.head_x,
        length=taut * 0.99,
        stiffness=STIFFNESS,
    )
    parts = part_cable(cable, 0.0 * forces, straight)
    expected = cable.rises / cable.rises.sum() * cable.length
    np.testing.assert_allclose(parts, expected, rtol=1e-10)


def test_a_part_that_cannot_rise_has_no_length():
    """All of the load hangs in the lowest part, which it pulls below the foot."""
    cable, forces = draw_cable(1)
    forces = 0.0 * forces
    forces[1, 2] = -30.0
    assert part_cable(cable, forces, np.array([0.1, 1.0])) is None
