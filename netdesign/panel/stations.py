"""Stations along half a panel, and the ropes' integrals of a load given at them.

The load on a rope is a polynomial in xi = 1 - 2 z / a through its values at Gauss
points, so that its integrals are exact. Theory: panel/THEORY.md, (P1) and (P5).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from netdesign.numerics.arrays import Floats, Ints


def _place_gauss_points(count: int) -> tuple[Floats, Floats]:
    """Gauss points and weights on 0 to 1."""
    points, weights = np.polynomial.legendre.leggauss(count)
    return (1.0 + points) / 2.0, weights / 2.0


# Points of the integral over a rope's length: exact to rounding up to steep slopes.
ROPE_POINTS, ROPE_WEIGHTS = _place_gauss_points(24)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Span:
    """A rope over half a panel as linear maps of the load at the stations.

    Attributes
    ----------
    deflection : ndarray, shape (K + 1, K)
        u H / (a/2)^2 at the stations and in mid-panel, per load at each station [-].
    shear : ndarray, shape (24, K)
        V / (a/2) at the points of integration [-].
    end_shear : ndarray, shape (2, K)
        The same at the post and in mid-panel.
    drape : ndarray, shape (K + 1,)
        As-built sag there, over s_b a [-].
    """

    deflection: Floats
    shear: Floats
    end_shear: Floats
    drape: Floats


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Stations:
    """Places of the strips on half a panel.

    Attributes
    ----------
    xi : ndarray, shape (K,)
        1 at the post, 0 in mid-panel [-].
    weights : ndarray, shape (K,)
        Of the mean over the half panel [-].
    lower, upper : Span
        Of the two ropes.
    """

    xi: Floats
    weights: Floats
    lower: Span
    upper: Span


@lru_cache(maxsize=4)
def build_stations(count: int, *, has_mid_anchors: bool) -> Stations:
    """Stations and spans of a panel.

    Without anchors in mid-panel all is even in xi there, and twice as many Gauss points
    over the whole panel serve: their positive half. With them the lower rope has a
    kink there, and half the panel stands alone.

    Parameters
    ----------
    count : int
        K, number of stations [-].
    has_mid_anchors : bool
        The lower rope is held in mid-panel too.
    """
    if has_mid_anchors:
        xi, weights = _place_gauss_points(count)
        powers = np.arange(count)
    else:
        points, doubled = np.polynomial.legendre.leggauss(2 * count)
        xi, weights = points[count:], doubled[count:]
        powers = 2 * np.arange(count)
    fit = np.asarray(np.linalg.inv(xi[:, None] ** powers), dtype=float)
    return Stations(
        xi=xi,
        weights=weights,
        lower=_build_span(xi, powers, fit, is_held=has_mid_anchors),
        upper=_build_span(xi, powers, fit, is_held=False),
    )


def _build_span(xi: Floats, powers: Ints, fit: Floats, *, is_held: bool) -> Span:
    """Rope that is held in mid-panel too, or is level there."""
    places = np.append(xi, 0.0)

    def deflect(at: Floats) -> Floats:
        """Zero at xi = 1; (P5)."""
        held = at[:, None] if is_held else 1.0
        bent = held - at[:, None] ** (powers + 2)
        return np.asarray(bent / ((powers + 1) * (powers + 2)) @ fit)

    def shear(at: Floats) -> Floats:
        """The deflection's slope towards mid-panel."""
        held = 1.0 / (powers + 2) if is_held else 0.0
        return np.asarray((at[:, None] ** (powers + 1) - held) / (powers + 1) @ fit)

    return Span(
        deflection=deflect(places),
        shear=shear(ROPE_POINTS),
        end_shear=shear(np.array([1.0, 0.0])),
        drape=2.0 * places * (1.0 - places) if is_held else 1.0 - places**2,
    )
