"""Friction along the net against Euler and Eytelwein, T2 / T1 = exp(mu w)."""

import math
from itertools import pairwise

import numpy as np
import pytest

from netdesign.cable.funicular import solve_funicular
from netdesign.outcome import Outcome

RADIUS, STIFFNESS = 2.0, 50.0
FRICTION = 0.4


def arc_forces(wrap, n, start_tension):
    """Consistent nodal forces and unstressed lengths of n elements on the circle."""
    angles = np.linspace(0.0, wrap, n + 1)
    points, weights = np.polynomial.legendre.leggauss(12)
    lengths, forces = np.zeros(n), np.zeros((2, 2 * n + 1))
    for e, (low, high) in enumerate(pairwise(angles)):
        w = (low + high) / 2 + (high - low) / 2 * points
        tension = start_tension * np.exp(FRICTION * w)
        arc = RADIUS * (high - low) / 2 * weights
        stretched = (1 + tension / STIFFNESS) ** -1
        lengths[e] = (arc * stretched).sum()
        # material coordinate within the element, -1 to 1
        s = 2 * unstressed_arc(w, low, start_tension) / lengths[e] - 1
        shape = np.array([s * (s - 1) / 2, 1 - s**2, s * (s + 1) / 2])
        outward = np.array([np.cos(w), np.sin(w)])
        forward = np.array([-np.sin(w), np.cos(w)])
        traction = tension / RADIUS * (outward - FRICTION * forward)
        forces[:, 2 * e : 2 * e + 3] += np.einsum("q,aq,iq->ai", arc, traction, shape)
    return forces, lengths


def unstressed_arc(angle, start, tension):
    """Integral of R dw / (1 + T1 e^(mu w) / ES), by hand with z = T / ES."""
    z1 = tension / STIFFNESS * np.exp(FRICTION * start)
    z2 = tension / STIFFNESS * np.exp(FRICTION * angle)
    # int dw / (1 + z) = [log(z / (1 + z))] / mu
    return RADIUS / FRICTION * (np.log(z2 / (1 + z2)) - np.log(z1 / (1 + z1)))


def solve_arc(wrap, n, start_tension):
    forces, lengths = arc_forces(wrap, n, start_tension)
    origin = np.array([RADIUS, 0.0])
    head = RADIUS * np.array([math.cos(wrap), math.sin(wrap)]) - origin
    cable = solve_funicular(forces, lengths, STIFFNESS, head, np.array([0.3, 2.0]))
    assert cable.outcome is Outcome.CONVERGED
    return cable, cable.curve + origin[:, None]


@pytest.mark.parametrize("wrap", [0.5, 1.5, 3.0])
def test_cable_on_a_circle(wrap):
    """The tractions of a capstan hang it on the circle, at the capstan's ratio."""
    errors = []
    for n in (8, 16, 32):
        cable, curve = solve_arc(wrap, n, start_tension=5.0)
        ratio = np.hypot(*cable.head_pull) / np.hypot(*cable.foot_pull)
        off_circle = np.abs(np.hypot(*curve) / RADIUS - 1).max()
        errors.append([abs(ratio / math.exp(FRICTION * wrap) - 1), off_circle])
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders.min() >= 3.8  # fourth order; asked for: 1.9
    assert errors[-1][0] <= 1e-6


# --- coupled -----------------------------------------------------------------


def measure_capstan(solution):
    """Larger over smaller end tension, and over exp(tan phi * turning angle)."""
    foot = np.array([solution.foot.x, solution.foot.y])
    head = -np.array([solution.head.x, solution.head.y])
    turning = abs(math.atan2(foot[0] * head[1] - foot[1] * head[0], foot @ head))
    ratio = solution.foot.size / solution.head.size
    capstan = math.exp(solution.scene.net.friction * turning)
    return ratio, max(ratio, 1 / ratio) / capstan - 1.0, capstan


@pytest.mark.parametrize("friction_deg", [1.0, 5.0, 10.0])
def test_snow_that_slips_down_the_net(solved, friction_deg):
    """Rough ground, net normal to the slope: the head end pulls harder."""
    solution = solved(ground="no-slip", friction_deg=friction_deg)
    ratio, excess, capstan = measure_capstan(solution)
    assert solution.net_slides[1:].all()
    assert ratio < 1.0
    assert capstan > 1.005
    assert abs(excess) <= 1e-6


@pytest.mark.parametrize(
    ("scene", "finest"),
    [
        ({"ground": "sliding", "slip_length_m": 2.0, "friction_deg": 5.0}, 5e-5),
        ({"friction_deg": 10.0}, 3e-4),
    ],
    ids=str,
)
def test_snow_that_slips_up_the_net(solved, scene, finest):
    """Inclined net: the foot end pulls harder."""
    excesses = []
    for level in (0, 1, 2):
        solution = solved(level, inclination_deg=30.0, **scene)
        ratio, excess, capstan = measure_capstan(solution)
        assert solution.net_slides[1:].all()
        assert ratio > 1.0
        assert capstan > 1.03
        excesses.append(abs(excess))
    assert excesses[0] > 1.5 * excesses[1] > 1.3 * 1.3 * excesses[2]
    assert excesses[2] <= finest


@pytest.mark.parametrize("ground", ["free", "no-slip"])
@pytest.mark.parametrize("inclination", [0.0, 30.0])
def test_snow_that_sticks_stays_below(solved, ground, inclination):
    """The formula is a bound."""
    solution = solved(inclination_deg=inclination, ground=ground, friction_deg=45.0)
    _, excess, _ = measure_capstan(solution)
    assert excess < -0.1
