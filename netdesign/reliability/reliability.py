"""Reliability of a limit state: the index by sampling, explained by FORM.

Theory: reliability/THEORY.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from netdesign.reliability.form import (
    DesignPoint,
    NotAvailable,
    find_design_points,
    follow_design_point,
)
from netdesign.reliability.limit_state import LimitState
from netdesign.reliability.sampling import estimate_beta
from netdesign.words.message import say


@dataclass(frozen=True, slots=True, kw_only=True)
class Reliability:
    """Notional reliability of one limit state.

    Attributes
    ----------
    beta, standard_error : float
        Index by sampling, and its error by sampling alone.
    beta_by_form : float
        Distance of the design point.
    alpha_squared : tuple of float
        Shares of the variables in that distance, in their order.
    design_point : tuple of float
        Values of the variables there, each in its unit, at most its cap.
    samples : int
        Number of samples.
    nearest : DesignPoint
        The design point in standard normal space.
    """

    beta: float
    standard_error: float
    beta_by_form: float
    alpha_squared: tuple[float, ...]
    design_point: tuple[float, ...]
    samples: int
    nearest: DesignPoint


def find_index_near(state: LimitState, found: Reliability) -> float | None:
    """Index of a limit state that differs from one that is known by its shift [-].

    By sampling about the design point that follows from the known one; None where it
    is not available.
    """
    point = follow_design_point(state, found.nearest)
    if point is None:
        return None
    estimate = estimate_beta(state, [point])
    return estimate.beta if estimate.is_sound else None


def find_reliability(state: LimitState) -> Reliability | NotAvailable:
    """Reliability of a limit state, or the reason why there is none.

    Verified by
    -----------
    tests/verification/test_reliability.py
    """
    points = find_design_points(state)
    if isinstance(points, NotAvailable):
        return points
    estimate = estimate_beta(state, points)
    if not estimate.is_sound:
        return NotAvailable(reason=say("reliability.not_sampled"))
    nearest = points[0]
    (values,) = state.place(nearest.place[None])
    return Reliability(
        beta=estimate.beta,
        standard_error=estimate.standard_error,
        beta_by_form=nearest.beta,
        alpha_squared=tuple(float(one) for one in nearest.alpha_squared),
        design_point=tuple(float(one) for one in np.asarray(values)),
        samples=estimate.samples,
        nearest=nearest,
    )
