"""Post head against the closing triangle of forces."""

import math

import numpy as np
import pytest

from netdesign.structure.head import compute_head_forces
from netdesign.structure.layout import SupportPoints

HEIGHT = 3.0
PULL = 80e3


def points_from_angles(tilt: float, uphill: float, downhill: float) -> SupportPoints:
    """Post tilted by ``tilt`` from the normal, guys at these angles to the ground."""
    return SupportPoints(
        net_foot=(0.0, 0.0),
        head=(1.5, HEIGHT),
        post_base=(1.5 - HEIGHT * math.tan(tilt), 0.0),
        uphill_anchor=(1.5 - HEIGHT / math.tan(uphill), 0.0),
        downhill_anchor=(1.5 + HEIGHT / math.tan(downhill), 0.0),
    )


def a_pull(angle: float) -> tuple[float, float]:
    """Pull of size PULL, ``angle`` from downslope, positive out of the ground."""
    return (PULL * math.cos(angle), PULL * math.sin(angle))


# Tilt of the post, angles of the uphill guy, the downhill guy and the pull.
OF_UPHILL = [(15, 40, -50), (0, 45, 0), (-10, 30, -20), (25, 55, -80), (15, 40, 20)]
OF_DOWNHILL = [(15, 40, -130), (0, 45, 180), (-10, 30, -170), (25, 60, -150)]
CASES = [
    *((tilt, guy, 35, pull, "uphill") for tilt, guy, pull in OF_UPHILL),
    *((tilt, 35, guy, pull, "downhill") for tilt, guy, pull in OF_DOWNHILL),
]


@pytest.mark.parametrize(("tilt", "up", "down", "pull", "side"), CASES)
def test_law_of_sines(tilt, up, down, pull, side):
    """Lami: each force is to the sine of the angle between the other two."""
    tilt, up, down, pull = np.radians((tilt, up, down, pull))
    forces = compute_head_forces(a_pull(pull), points_from_angles(tilt, up, down))
    push = math.pi / 2 - tilt  # of the post on the head
    guy = math.pi + up if side == "uphill" else -down  # of the guy on the head
    ratio = PULL / math.sin(guy - push)
    found = {
        "uphill": forces.uphill_guy_tension,
        "downhill": forces.downhill_guy_tension,
    }
    post = -ratio * math.sin(guy - pull)
    assert forces.post_compression == pytest.approx(post, rel=1e-13)
    tension = ratio * math.sin(push - pull)
    assert found.pop(side) == pytest.approx(tension, rel=1e-13)
    assert [*found.values()] == [0.0]


@pytest.mark.parametrize("tilt", np.radians([-30, -10, 0, 15, 45]))
def test_pull_down_the_post_is_held_by_the_post_alone(tilt):
    forces = compute_head_forces(
        a_pull(-math.pi / 2 - tilt), points_from_angles(tilt, 0.6, 0.7)
    )
    assert forces.post_compression == pytest.approx(PULL, rel=1e-14)
    assert forces.uphill_guy_tension == forces.downhill_guy_tension == 0.0
