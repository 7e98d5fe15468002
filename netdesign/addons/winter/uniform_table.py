"""Table of the pulls of uniform snow on a row, from which many winters are read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from netdesign.addons.winter.day import DaySolver, RowDay
from netdesign.envelope.panel_forces import spread_out
from netdesign.numerics.arrays import Floats, Mask

if TYPE_CHECKING:
    from scipy.interpolate import RectBivariateSpline

_THICKNESSES, _DENSITIES = 9, 7  # of a table
_DEGREE = 2  # of its splines
_EDGE = 1.005  # how far a table reaches beyond what it was asked for


@dataclass(frozen=True, kw_only=True, eq=False)
class UniformTable:
    """Pulls of uniform snow at the nodes of a grid, as logarithms.

    Attributes
    ----------
    thicknesses : ndarray, shape (n_thicknesses,)
        ln d, ascending [d in m].
    densities : ndarray, shape (n_densities,)
        ln rho, ascending [rho in kg/m3].
    foot, head : ndarray, shape (n_thicknesses, n_densities)
        ln of the net's pulls [in N/m].
    error : float
        Of a pull that is read, relative: the largest of those that were solved [-].
    """

    thicknesses: Floats
    densities: Floats
    foot: Floats
    head: Floats
    error: float

    def find_pulls(self, thickness: Floats, density: Floats) -> tuple[Floats, Floats]:
        """Foot and head pulls [N/m], both (n_days,); NaN outside the table.

        Parameters
        ----------
        thickness : ndarray, shape (n_days,)
            d [m], above 0.
        density : ndarray, shape (n_days,)
            [kg/m3], above 0.
        """
        x, y = np.log(thickness), np.log(density)
        is_inside = (
            (x >= self.thicknesses[0])
            & (x <= self.thicknesses[-1])
            & (y >= self.densities[0])
            & (y <= self.densities[-1])
        )
        foot, head = (
            np.where(is_inside, np.exp(spline(x, y, grid=False)), np.nan)
            for spline in self._splines
        )
        return foot, head

    def read_days(self, days: Sequence[RowDay]) -> tuple[RowDay, ...]:
        """Days with their pulls, as if they were solved; without those outside.

        Parameters
        ----------
        days : sequence of RowDay
            Prepared.
        """
        foot, head = self.find_pulls(
            np.array([day.thickness for day in days]),
            np.array([day.density for day in days]),
        )
        return tuple(
            replace(
                day,
                ending="solved",
                foot=spread_out(float(at_foot), self.error * float(at_foot)),
                head=spread_out(float(at_head), self.error * float(at_head)),
            )
            for day, at_foot, at_head in zip(days, foot, head, strict=True)
            if np.isfinite(at_foot)
        )

    def find_density(self, thickness: float, foot: float) -> float | None:
        """Density of uniform snow that pulls so much [kg/m3]; None outside the table.

        Parameters
        ----------
        thickness : float
            d [m].
        foot : float
            Pull [N/m].
        """
        densities = np.exp(np.linspace(self.densities[0], self.densities[-1], 400))
        pulls, _ = self.find_pulls(np.full(densities.size, thickness), densities)
        if not np.isfinite(pulls).all() or not pulls[0] <= foot <= pulls[-1]:
            return None
        return float(np.interp(foot, pulls, densities))

    @cached_property
    def _splines(self) -> tuple[RectBivariateSpline, RectBivariateSpline]:
        """Splines of the pulls at foot and head; many winters ask one table."""
        from scipy.interpolate import RectBivariateSpline

        foot, head = (
            RectBivariateSpline(
                self.thicknesses, self.densities, values, kx=_DEGREE, ky=_DEGREE
            )
            for values in (self.foot, self.head)
        )
        return foot, head


def build_table(
    solver: DaySolver,
    thicknesses: tuple[float, float],
    densities: tuple[float, float],
) -> UniformTable | None:
    """Table of a row between two thicknesses and two densities.

    Thin snow that fails is left out from below. None if other nodes fail.

    Parameters
    ----------
    solver : DaySolver
        Of the row.
    thicknesses, densities : (float, float)
        Least and largest [m], [kg/m3].
    """
    top = solver.row.scene.net.height_normal
    high = min(thicknesses[1] * _EDGE, top)
    d = np.geomspace(min(thicknesses[0] / _EDGE, 0.9 * high), high, _THICKNESSES)
    rho = np.geomspace(densities[0] / _EDGE, densities[1] * _EDGE, _DENSITIES)
    d[-1] = high  # not above the net by rounding
    days = solver.solve(
        [
            RowDay(index=k, thickness=float(a), density=float(b), ending="open")
            for k, (a, b) in enumerate((a, b) for a in d for b in rho)
        ]
    )
    foot, head = (
        _collect(days, name).reshape(d.size, rho.size) for name in ("foot", "head")
    )
    usable: Mask = np.all(np.isfinite(foot), axis=1)
    first = int(np.argmax(usable))
    if not usable[first:].all() or usable.sum() <= _DEGREE:
        return None
    return UniformTable(
        thicknesses=np.log(d[first:]),
        densities=np.log(rho),
        foot=foot[first:],
        head=head[first:],
        error=max(
            pull.high / pull.value - 1.0
            for day in days[first * rho.size :]
            for pull in (day.foot, day.head)
            if pull
        ),
    )


def _collect(days: Sequence[RowDay], name: str) -> Floats:
    """Logarithm of one pull of each day; NaN of those that failed."""
    pulls = [getattr(day, name) for day in days]
    return np.array([np.log(pull.value) if pull else np.nan for pull in pulls])
