"""Inputs of a panel: what is refused, and by which name."""

import math

import pytest

from netdesign.outcome import ModelError
from netdesign.panel.inputs import LARGEST_SAG, Panel, Rope

ROPE = Rope(stiffness=17.3e6, sag=0.047)


def test_sag_and_cut_have_no_default():
    with pytest.raises(TypeError, match="sag"):
        Rope(stiffness=17.3e6)
    with pytest.raises(TypeError, match="cut"):
        Panel(post_spacing=3.9, lower=ROPE, upper=ROPE)


@pytest.mark.parametrize("stiffness", [0.0, -1.0, math.nan, math.inf])
def test_rope_without_a_finite_stiffness_is_refused(stiffness):
    with pytest.raises(ModelError, match="rope stiffness"):
        Rope(stiffness=stiffness, sag=0.05)


@pytest.mark.parametrize("sag", [-1e-9, LARGEST_SAG + 1e-9, math.nan])
def test_sag_out_of_its_range_is_refused(sag):
    with pytest.raises(ModelError, match="rope sag"):
        Rope(stiffness=18e6, sag=sag)


@pytest.mark.parametrize("sag", [0.0, LARGEST_SAG])
def test_sag_at_its_bounds_is_taken(sag):
    assert Rope(stiffness=18e6, sag=sag).sag == sag


@pytest.mark.parametrize("spacing", [0.0, -3.0, math.nan, math.inf])
def test_spacing_that_is_none_is_refused(spacing):
    with pytest.raises(ModelError, match="post spacing"):
        Panel(post_spacing=spacing, lower=ROPE, upper=ROPE, cut="upper")


def test_unknown_cut_is_refused():
    with pytest.raises(ModelError, match=r"cut = 'level'.*uniform.*upper.*fitted"):
        Panel(post_spacing=3.9, lower=ROPE, upper=ROPE, cut="level")
