"""Drivers of a quantity by the search's own model.

The model is evaluated on a tensor rule, so that nothing is random. The parameters
count as independent and uniform in their ranges: that is an assumption of the
indices, not a statement about snow. Theory: search/THEORY.md, eq. (M9) and (M10).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from itertools import product

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.search.maxima import Maxima
from netdesign.search.surrogate import Point, Surrogate

# Gauss points per axis: exact for the polynomials of degree 2 n - 1.
_RULE = {1: 24, 2: 16, 3: 8, 4: 8, 5: 6, 6: 5}
_ALONG = 65  # points of a line along one parameter


@dataclass(frozen=True, slots=True, kw_only=True)
class Sensitivity:
    """Answer of one force to one parameter.

    Attributes
    ----------
    axis : int
        Which parameter.
    low, high : float
        Smallest and largest force along it through the governing case.
    at_low, at_high : float
        Forces at the ends of its range, the others as in the governing case.
    first_order, total : float
        Sobol indices [-]: share of the variance that it causes alone, and with all
        others. 0 where the force does not vary at all.
    """

    axis: int
    low: float
    high: float
    at_low: float
    at_high: float
    first_order: float
    total: float


def measure_sensitivity(
    maxima: Maxima, *quantities: int
) -> tuple[tuple[Sensitivity, ...], ...]:
    """Answer of some forces to every parameter, in their order; () without a model.

    Parameters
    ----------
    maxima : Maxima
        End of a search.
    *quantities : int
        Which forces; together they cost little more than one.

    Verified by
    -----------
    tests/search/test_sensitivity.py
    """
    model = maxima.surrogate
    if model is None:
        return ((),) * len(quantities)
    dimension = model.places.shape[1]
    grid, weights = _build_rule(dimension)
    found = model.evaluate(grid, *quantities)
    values = [one.reshape((len(weights),) * dimension) for one in found]
    return tuple(
        _measure_one(maxima, model, quantity, _compute_indices(one, weights))
        for quantity, one in zip(quantities, values, strict=True)
    )


def _measure_one(
    maxima: Maxima, model: Surrogate, quantity: int, indices: tuple[Floats, Floats]
) -> tuple[Sensitivity, ...]:
    governing = maxima.points[maxima.governing[quantity]]
    found = []
    for axis, (first, total) in enumerate(zip(*indices, strict=True)):
        _, line = _draw_line(governing, axis, _ALONG)
        (forces,) = model.evaluate(line, quantity)
        found.append(
            Sensitivity(
                axis=axis,
                low=float(forces.min()),
                high=float(forces.max()),
                at_low=float(forces[0]),
                at_high=float(forces[-1]),
                first_order=float(first),
                total=float(total),
            )
        )
    return tuple(found)


def measure_unexplained(maxima: Maxima, quantity: int) -> float | None:
    """Share of the variance that held-out cases deny the model [-].

    The error of the indices: 0 for a model that predicts every case from the others.
    None without a model; 0 where all cases give the same force.
    """
    model = maxima.surrogate
    if model is None:
        return None
    values = np.array([v[quantity] for v in maxima.values if v is not None])
    spread = float(np.var(values[: len(model.places)]))
    error = float(np.mean(model.held_out[:, quantity] ** 2))
    return min(1.0, error / spread) if spread > 0.0 else 0.0


def follow_axis(
    model: Surrogate, through: Point, axis: int, quantity: int, count: int
) -> tuple[Floats, Floats, Floats]:
    """Shares of a parameter, forces and their standard errors along it."""
    shares, line = _draw_line(through, axis, count)
    mean, standard_error = model.predict(line, (quantity,))
    return shares, mean[:, 0], standard_error[:, 0]


def _draw_line(through: Point, axis: int, count: int) -> tuple[Floats, Floats]:
    """Shares of a parameter, and the places along it through a point."""
    shares = np.linspace(0.0, 1.0, count)
    line = np.tile(np.array(through), (count, 1))
    line[:, axis] = shares
    return shares, line


@lru_cache
def _build_rule(dimension: int) -> tuple[Floats, Floats]:
    """Nodes of a tensor Gauss rule, and the weights along each axis."""
    nodes, weights = np.polynomial.legendre.leggauss(_RULE[dimension])
    nodes, weights = (nodes + 1.0) / 2.0, weights / 2.0
    return np.array(list(product(nodes, repeat=dimension))), weights


def _compute_indices(values: Floats, weights: Floats) -> tuple[Floats, Floats]:
    """First-order and total Sobol indices of values at the rule's nodes."""
    dimension = values.ndim
    noise = 1e-9 * abs(values.flat[0])
    values = values - _average(values, range(dimension), weights)
    variance = float(_average(values**2, range(dimension), weights))
    first, total = np.zeros(dimension), np.zeros(dimension)
    if variance <= noise**2:
        return first, total
    for axis in range(dimension):
        others = [other for other in range(dimension) if other != axis]
        alone = _average(values, others, weights)
        first[axis] = np.sum(weights * alone**2) / variance
        without = _average(values, [axis], weights)
        rest = _average(without**2, range(dimension - 1), weights)
        total[axis] = 1.0 - float(rest) / variance
    return np.clip(first, 0.0, 1.0), np.clip(total, 0.0, 1.0)


def _average(values: Floats, axes: Iterable[int], weights: Floats) -> Floats:
    """Mean over some axes under the rule's weights."""
    for axis in sorted(axes, reverse=True):
        values = np.tensordot(values, weights, axes=(axis, 0))
    return np.asarray(values, dtype=np.float64)
