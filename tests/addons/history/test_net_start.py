"""Where a history begins: shapes of known length, snow at rest against them."""

import math

import numpy as np
import pytest

from netdesign.addons.evidence.verification.closed_forms import slide_on
from netdesign.addons.history.net_pulls import join_points, measure_arcs
from netdesign.addons.history.settings import TRANSIENT_LEVELS
from netdesign.coupling.steady.net import guess_pressure
from netdesign.outcome import Outcome, SolveError
from netdesign.snow.mesh import MeshSize
from tests.addons.history.starts import begin
from tests.each import each

SLACKS = [0.0, 0.02, 0.15]
LEVEL = TRANSIENT_LEVELS[1]


# Fine enough for sags and lengths that are read off the nodes.
FINE = MeshSize(net_spacing=0.06, corner=2.5e-3, sectors=10, upslope_spacing=0.25)


def largest_sag(problem, points):
    """Largest distance from the chord over the chord, of a net that is a parabola."""
    along = problem.head / np.hypot(*problem.head)
    across = along[1] * points[0] - along[0] * points[1]
    chord = np.hypot(*problem.head)
    share, lowest = (along @ points) / chord, across[1:-1].argmax() + 1
    # f = y / (4 x (1 - x)) at every point; no node need be in the middle
    return across[lowest] / chord / (4.0 * share * (1.0 - share))[lowest]


def parabola_length(sag):
    """Over the chord, of y = 4 f x (1 - x), by fine chords."""
    x = np.linspace(0.0, 1.0, 20001)
    return np.hypot(np.diff(x), np.diff(4.0 * sag * x * (1.0 - x))).sum()


@pytest.mark.parametrize("slack", SLACKS[1:])
@pytest.mark.parametrize("inclination", [0.0, 20.0])
def test_straight_start_takes_up_its_slack(a_scene, slack, inclination):
    """A parabola as long as the net: c (1 + slack)."""
    problem, state = begin(
        a_scene(slack=slack, inclination_deg=inclination), "straight", size=FINE
    )
    points = join_points(state.net_nodes, problem.head)
    assert parabola_length(largest_sag(problem, points)) == pytest.approx(
        1.0 + slack, rel=1e-4
    )
    # the nodes' arcs are those of the parabola up to their fourth order
    assert measure_arcs(points).sum() == pytest.approx(problem.length, rel=1e-4)
    assert state.lengths.sum() == pytest.approx(problem.length, rel=1e-14)


@each("slack", SLACKS)
@each("ground", ["free", "no-slip"])
def test_sagged_net_hangs_under_the_mean_pressure(a_scene, slack, ground):
    """Parabola of the guideline: H = p c / (8 f), V = p / 2, T = ES strain."""
    problem, state = begin(a_scene(slack=slack, ground=ground), "sagged", size=FINE)
    points = join_points(state.net_nodes, problem.head)
    sag = largest_sag(problem, points)
    pressure = guess_pressure(problem.snow, 5.0)
    tension = pressure * math.hypot(1.0 / (8.0 * sag), 1.0 / 2.0)
    # force of half the load at each end: p c / 2
    strain = parabola_length(sag) / (1.0 + slack) - 1.0
    middle = pressure / (8.0 * sag)
    assert middle <= strain * problem.stiffness <= tension * (1.0 + 1e-3)
    net = slide_on(points, state.lengths, 0.5, problem.stiffness)
    assert net.tensions.min() > 0.0
    assert state.lengths.sum() == pytest.approx(problem.length, rel=1e-14)


# --- refused -----------------------------------------------------------------


@pytest.mark.parametrize(("stiffness", "clear"), [(2e3, False), (2e4, True)])
def test_net_that_would_sag_to_the_ground_is_refused(a_scene, stiffness, clear):
    """Its sag over the chord, against that at which a parabola's end is level."""
    scene = a_scene(inclination_deg=40.0, slack=0.15, stiffness_kN_per_m=stiffness)
    if clear:
        problem, state = begin(scene, "sagged", LEVEL)
        sag = largest_sag(problem, join_points(state.net_nodes, problem.head))
        assert 0.23 < sag < math.tan(math.radians(50.0)) / 4.0
        return
    with pytest.raises(SolveError, match="the net touches the ground") as failure:
        begin(scene, "sagged", LEVEL)
    assert failure.value.outcome is Outcome.OUT_OF_VALIDITY
