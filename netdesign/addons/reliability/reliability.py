"""Reliability of a limit state: the index by sampling, explained by FORM.

Theory: addons/reliability/THEORY.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from netdesign.addons.reliability.form import (
    NotAvailable,
    approach_design_point,
    find_design_points,
)
from netdesign.addons.reliability.limit_state import LimitState
from netdesign.addons.reliability.sampling import estimate_betas
from netdesign.words.message import say


@dataclass(frozen=True, slots=True, kw_only=True)
class Reliability:
    """Notional reliability of one limit state.

    Attributes
    ----------
    beta, standard_error : float
        Index by sampling, and its error by sampling alone.
    beta_shifted : float or None
        Index with the margins shifted; None where its error is too large.
    beta_by_form : float
        Distance of the design point.
    alpha_squared : tuple of float
        Shares of the variables in that distance, in their order.
    design_point : tuple of float
        Values of the variables there, each in its unit, at most its cap.
    samples : int
        Number of samples.
    """

    beta: float
    standard_error: float
    beta_shifted: float | None
    beta_by_form: float
    alpha_squared: tuple[float, ...]
    design_point: tuple[float, ...]
    samples: int


def find_reliability(
    state: LimitState, shift: float | None = None
) -> Reliability | NotAvailable:
    """Reliability of a limit state, or the reason why there is none.

    Parameters
    ----------
    state : LimitState
        Its margins, in any unit.
    shift : float, optional
        By which the margins differ from those of another state, whose index is asked
        for too.

    Verified by
    -----------
    tests/verification/test_reliability.py
    """
    points = find_design_points(state)
    if isinstance(points, NotAvailable):
        return points
    nearest, shifts = points[0], [0.0]
    centres = np.array([one.place for one in points])
    if shift is not None:
        beside = approach_design_point(state, nearest, shift)
        if np.isfinite(beside).all():
            centres, shifts = np.vstack([centres, beside]), [0.0, shift]
    estimate, *others = estimate_betas(state, centres, shifts)
    if not estimate.is_sound:
        return NotAvailable(reason=say("reliability.not_sampled"))
    (values,) = state.place(nearest.place[None])
    return Reliability(
        beta=estimate.beta,
        standard_error=estimate.standard_error,
        beta_shifted=next((one.beta for one in others if one.is_sound), None),
        beta_by_form=nearest.beta,
        alpha_squared=tuple(float(one) for one in nearest.alpha_squared),
        design_point=tuple(float(one) for one in np.asarray(values)),
        samples=estimate.samples,
    )
