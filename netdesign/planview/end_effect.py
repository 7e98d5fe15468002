"""End effect of a net row in the sense of the guideline, from the plan view.

Theory: planview/THEORY.md, section 5.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

from netdesign.haefeli.slab import Slab, find_linear_slip
from netdesign.outcome import require_positive, require_within
from netdesign.planview.free_gap import find_isolated_excess, solve_free_gap
from netdesign.planview.gap import GapFlow, find_excess_within
from netdesign.planview.pulled_gap import ISOLATED_EXCESS, solve_pulled_gap
from netdesign.planview.scales import Scales, compute_scales
from netdesign.planview.waves import WIDEST_HALF

# What waves left out cost at most, over l_z; the widest gap solved has it.
_LEFT_OUT = 2e-6


@dataclass(frozen=True, slots=True, kw_only=True)
class ExtraLoad:
    """Extra load of a long row's end, over as much of an endless row.

    Attributes
    ----------
    factor : float
        Mean of the extra over the end length, over the load of an endless row: what the
        guideline calls f_R [-].
    width : float
        Width of an endless row that carries as much as the whole extra [m].
    error : float
        Of ``width``, numerical [m].
    """

    factor: float
    width: float
    error: float


@dataclass(frozen=True, slots=True, kw_only=True)
class EndEffect:
    """Extra load on the end of a row, with two states of the snow below it.

    What the model is worth: planview/THEORY.md, sections 6 and 7.

    Attributes
    ----------
    free : ExtraLoad
        The snow in the gap is neither pushed nor pulled by the snow below.
    pulled : ExtraLoad
        The snow below has come off the nets and hangs on that in the gap.
    length : float
        Over which the factors are means, from the end inwards [m].
    scales : Scales
        Lengths of the plan view.
    """

    free: ExtraLoad
    pulled: ExtraLoad
    length: float
    scales: Scales


def compute_end_effect(
    slab: Slab, *, gap: float, glide_factor: float, length: float
) -> EndEffect:
    """End effect beside a gap between long rows; (W20).

    Parameters
    ----------
    slab : Slab
        Snow, as high as the net.
    gap : float
        A, free distance to the next row; infinite for none [m].
    glide_factor : float
        N, at least 1 [-].
    length : float
        Over which the factor is a mean, from the end inwards [m].

    Raises
    ------
    ModelError
        If a number is out of its range.

    Verified by
    -----------
    tests/verification/test_plan_view.py
    """
    require_positive("end length", length, "m")
    if gap != math.inf:
        require_within("gap to the next work", gap, 0.0, math.inf, "m")
    scales = compute_scales(slab, find_linear_slip(slab, glide_factor))
    half, distance = gap / 2.0 / scales.lateral, length / scales.lateral
    return EndEffect(
        free=_scale(scales, length, _find_free(half, distance)),
        pulled=_scale(scales, length, _find_pulled(half, distance)),
        length=length,
        scales=scales,
    )


def _scale(
    scales: Scales, length: float, excess: tuple[float, float, float]
) -> ExtraLoad:
    """Loads over l_z as parts of the whole pressure, (W20)."""
    total, within, error = excess
    width = scales.retarded_share * scales.lateral
    return ExtraLoad(
        factor=width * within / length, width=width * total, error=width * error
    )


def _find_free(half: float, distance: float) -> tuple[float, float, float]:
    """Whole excess, that within a distance, and the error, over l_z."""
    if half <= WIDEST_HALF:
        return _find_beside(solve_free_gap, half, distance)
    whole = find_isolated_excess(math.inf)
    return whole, find_isolated_excess(distance), _find_lost(half)


def _find_pulled(half: float, distance: float) -> tuple[float, float, float]:
    if half <= WIDEST_HALF:
        return _find_beside(solve_pulled_gap, half, distance)
    # no closed form of the distribution: that of the widest gap solved
    _, within, error = _find_beside(_solve_widest, WIDEST_HALF, distance)
    return ISOLATED_EXCESS, within, error + _find_lost(half)


@lru_cache(maxsize=1)
def _solve_widest(half: float) -> GapFlow:
    """Widest gap solved, made once: every wider one has its distribution."""
    return solve_pulled_gap(half)


def _find_beside(
    solve: Callable[[float], GapFlow], half: float, distance: float
) -> tuple[float, float, float]:
    if half == 0.0:
        return 0.0, 0.0, 0.0
    gap = solve(half)
    return gap.excess, find_excess_within(gap, distance), gap.error + _LEFT_OUT


def _find_lost(half: float) -> float:
    """Largest share that the two ends of a wide gap still feel of each other."""
    return math.exp(-2.0 * min(half, 350.0))
