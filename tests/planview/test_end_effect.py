"""End effect of a row: limits, ranges, and what is refused."""

import math
import random
from dataclasses import replace
from itertools import pairwise

import pytest

from netdesign.haefeli.slab import Slab, find_linear_slip
from netdesign.outcome import ModelError
from netdesign.planview.end_effect import compute_end_effect
from netdesign.planview.scales import compute_scales
from netdesign.planview.waves import WIDEST_HALF
from tests.each import each

SLAB = Slab(thickness=2.7, slope_angle=math.radians(38.5), density=283.0)


def effect(slab=SLAB, **changed):
    given = {"gap": 1.7, "glide_factor": 1.9, "length": 0.8}
    return compute_end_effect(slab, **(given | changed))


def test_without_a_gap_there_is_no_end():
    none = effect(gap=0.0)
    assert (none.free.factor, none.free.width) == (0.0, 0.0)
    assert (none.pulled.factor, none.pulled.width) == (0.0, 0.0)


def test_extra_grows_with_the_gap_up_to_an_end_alone():
    gaps = (0.03, 0.9, 2.1, 7.7, 31.0, math.inf)
    effects = [effect(gap=gap) for gap in gaps]
    for name in ("free", "pulled"):
        widths = [getattr(one, name).width for one in effects]
        factors = [getattr(one, name).factor for one in effects]
        assert widths == sorted(widths)
        # the widest gap solved and the end alone differ by the waves left out
        assert all(b > a * (1.0 - 2e-6) for a, b in pairwise(factors))
    assert all(one.pulled.width > one.free.width for one in effects)
    assert all(
        one.free.width < gap / 2.0 for one, gap in zip(effects, gaps, strict=True)
    )


def test_extra_grows_with_the_glide_factor():
    widths = [effect(glide_factor=n).free.width for n in (1.0, 1.3, 2.2, 3.2)]
    assert widths == sorted(widths)


def test_an_end_alone_carries_half_a_length_more():
    alone = effect(gap=math.inf)
    width = alone.scales.retarded_share * alone.scales.lateral
    assert alone.free.width == pytest.approx(0.5 * width, rel=1e-12)
    assert alone.pulled.width == pytest.approx(0.957106781 * width, rel=1e-8)


@pytest.mark.parametrize("side", ["free", "pulled"])
def test_nothing_jumps_where_the_closed_form_takes_over(side):
    scales = effect().scales
    gap = 2.0 * WIDEST_HALF * scales.lateral
    inner, outer = (getattr(effect(gap=gap * (1.0 + by)), side) for by in (-1e-9, 1e-9))
    assert inner.width == pytest.approx(outer.width, rel=2e-5)
    assert inner.factor == pytest.approx(outer.factor, rel=2e-5)
    assert abs(inner.width - outer.width) <= 3.0 * (inner.error + outer.error)


def test_factor_times_length_tends_to_the_extra_width():
    long = effect(length=60.0)
    assert 60.0 * long.free.factor == pytest.approx(long.free.width, rel=1e-9)
    assert 60.0 * long.pulled.factor == pytest.approx(long.pulled.width, rel=1e-9)


def test_all_lengths_scale_with_the_thickness():
    twice = replace(SLAB, thickness=5.4)
    small, large = effect(), effect(twice, gap=3.4, length=1.6)
    assert large.free.factor == pytest.approx(small.free.factor, rel=1e-12)
    assert large.pulled.width == pytest.approx(2.0 * small.pulled.width, rel=1e-12)


@pytest.mark.parametrize("glide", [1.0, 1.37, 2.9, 6.1])
def test_slip_of_a_glide_factor_raises_the_pressure_by_it(glide):
    """(W6) back through (W4), with the pressure at rest of both."""
    rough = compute_scales(SLAB, 0.0)
    slipping = compute_scales(SLAB, find_linear_slip(SLAB, glide))
    pressures = [one.longitudinal / one.retarded_share for one in (rough, slipping)]
    assert pressures[1] / pressures[0] == pytest.approx(glide, rel=1e-12)


def test_lengths_of_a_slab_by_hand():
    """rho 283: D 0.308615, a/b = exp(-0.72 + 3.26 D) = 1.331206, nu 0.199617."""
    assert SLAB.poisson == pytest.approx(0.199617, rel=2e-5)
    scales = compute_scales(SLAB, 1.1)
    assert scales.lateral == pytest.approx(math.sqrt(2.7 * 2.0), rel=1e-12)
    assert scales.longitudinal == pytest.approx(3.673354, rel=2e-5)
    rest = 0.249401 * 2.7 / (2.0 * math.tan(math.radians(38.5)))
    share = 3.673354 / (3.673354 + rest)
    assert scales.retarded_share == pytest.approx(share, rel=2e-5)


@each(
    "changed, named",
    [
        ({"gap": -0.1}, "gap to the next work"),
        ({"gap": math.nan}, "gap to the next work"),
        ({"glide_factor": 0.99}, "glide factor"),
        ({"glide_factor": math.inf}, "glide factor"),
        ({"length": 0.0}, "end length"),
        ({"length": math.nan}, "end length"),
    ],
)
def test_what_is_no_end_is_refused(changed, named):
    with pytest.raises(ModelError, match=named):
        effect(**changed)


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        ({"thickness": 0.0}, "snow thickness"),
        ({"slope_angle": 1.6}, "slope angle"),
        ({"density": -3.0}, "density"),
        ({"density": 917.0}, "density"),
    ],
)
def test_what_is_no_slab_is_refused(changed, named):
    with pytest.raises(ModelError, match=named):
        replace(SLAB, **changed)


def test_drawn_rows_keep_their_bounds():
    """A free gap sheds less than half of itself, and less than half of l_z."""
    draw = random.Random(20)
    for _ in range(150):
        slab = Slab(
            thickness=draw.uniform(0.5, 7.0),
            slope_angle=math.radians(draw.uniform(25.0, 60.0)),
            density=draw.uniform(120.0, 600.0),
        )
        gap, length = 10.0 ** draw.uniform(-6, 3), 10.0 ** draw.uniform(-2, 2)
        one = effect(slab, gap=gap, length=length, glide_factor=draw.uniform(1.0, 4.0))
        assert one.free.width < min(gap, one.scales.lateral * (1.0 + 1e-5)) / 2.0
        for side in (one.free, one.pulled):
            assert 0.0 < side.factor * length <= side.width * (1.0 + 1e-5)
        assert one.free.factor <= one.pulled.factor
        assert one.free.width <= one.pulled.width
