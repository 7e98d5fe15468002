"""End pulls of a net under an even load against closed forms of cables."""

import math

import pytest

from netdesign.cable.net import compute_parabola_sag
from netdesign.guideline.load_model import compute_net_pull
from netdesign.outcome import ModelError
from tests.each import each


def a_pull(resultant=(40e3, 0.0), **changes):
    values = {
        "inclination": 0.0,
        "chord": 4.0,
        "loaded_share": 1.0,
        "stiffness": 20e6,
        "slack": 0.0,
    }
    return compute_net_pull(resultant, **(values | changes))


def test_tight_cable_of_the_collection_of_standards():
    """q = 10 kN/m over 4 m, ES = 20 MN: H = 110.1 kN, T = 111.9 kN."""
    pull = a_pull()
    assert pull.chord_tension / 1e3 == pytest.approx(110.1, abs=0.05)
    assert math.hypot(*pull.foot) / 1e3 == pytest.approx(111.9, abs=0.05)
    assert pull.head == pytest.approx((pull.foot[0], -pull.foot[1]), rel=1e-12)


@pytest.mark.parametrize("slack", [0.0, 0.02, 0.08])
def test_even_load_gives_the_parabola(slack):
    """H = q c^2 / (8 f), with the sag of the same small-sag equation."""
    chord, stiffness = 4.0, 1e7
    sag = compute_parabola_sag(1e4, chord, stiffness / (1.0 + slack), slack)
    pull = a_pull(slack=slack, stiffness=stiffness)
    assert pull.chord_tension == pytest.approx(1e4 * chord**2 / (8 * sag), rel=1e-9)


@each("inclination", [0.0, 0.3, 0.6])
@each("loaded", [0.5, 0.77, 1.0])
def test_pulls_sum_up_to_the_load_and_turn_about_its_point(inclination, loaded):
    load, chord = (30e3, -8e3), 3.5
    pull = a_pull(load, inclination=inclination, chord=chord, loaded_share=loaded)
    assert pull.foot[0] + pull.head[0] == pytest.approx(load[0], rel=1e-12)
    assert pull.foot[1] + pull.head[1] == pytest.approx(load[1], rel=1e-12)
    along = (math.sin(inclination), math.cos(inclination))
    by_head = chord * (along[0] * pull.head[1] - along[1] * pull.head[0])
    by_load = 0.5 * loaded * chord * (along[0] * load[1] - along[1] * load[0])
    assert by_head == pytest.approx(by_load, rel=1e-12)


def test_partial_load_against_a_sum_over_short_pieces():
    """Length of the slack net's polygon under the same load, piece by piece."""
    loaded, slack, stiffness, count = 0.6, 0.05, 1e7, 20000
    pull = a_pull(loaded_share=loaded, slack=slack, stiffness=stiffness)
    length = 0.0
    for piece in range(count):
        x = (piece + 0.5) / count
        shear = 40e3 * (1 - loaded / 2 - min(x, loaded) / loaded)
        length += 0.5 * (shear / pull.chord_tension) ** 2 / count
    given = slack + (1 + slack) * pull.chord_tension / stiffness
    assert length == pytest.approx(given, rel=1e-6)


def test_load_that_lifts_the_net_off_is_refused():
    with pytest.raises(ModelError, match="load across the net"):
        a_pull((-1.0, 0.0))
