"""Creep law of snow whose density has changed while it settled."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from netdesign.snow.body import SnowBody
from netdesign.snow.creep_law import DENSEST_SNOW, CreepLaw, compute_factors
from netdesign.snow.law import FlowProblem, Material, sample_material


@dataclass(frozen=True, slots=True, kw_only=True)
class Settling:
    """Creep law that follows the density, or not.

    Attributes
    ----------
    creep_law : CreepLaw
        Set of a(D), b(D).
    mean_density : float
        Relative density D that counts as 1 in the body [-].
    densifies : bool
        False keeps a and b as they were at the start; mass is kept in any case.
    least_density : float
        Of the loosest layer at the start, over the mean. Snow that is stretched counts
        as no looser (assumed): the law is a fit of snow that settles, and snow that
        softened as it is stretched would part in a single triangle, whatever its size.
    """

    creep_law: CreepLaw
    mean_density: float
    densifies: bool = True
    least_density: float = 1.0


def build_material(
    settling: Settling, problem: FlowProblem, body: SnowBody
) -> Material:
    """Material at the quadrature points of a body.

    Parameters
    ----------
    settling : Settling
        Whether and how the law follows the density.
    problem : FlowProblem
        Exponent and layers.
    body : SnowBody
        As it is now.

    Returns
    -------
    Material
        Numbers, or arrays of shape (n_triangles, 1): a triangle has one density.
    """
    if not settling.densifies:
        return sample_material(problem, body.topology.template)
    density = np.maximum(body.density, settling.least_density)
    shear, bulk = compute_factors(settling.creep_law, settling.mean_density * density)
    start = np.array([settling.mean_density])
    reference, _ = compute_factors(settling.creep_law, start)
    power = (problem.exponent + 1.0) / 2.0
    return Material(
        bulk_ratio=(shear / bulk)[:, None],
        fluidity_ratio=(body.warmth * (shear / reference) ** power)[:, None],
        density=body.density[:, None],
    )


def largest_density(settling: Settling, body: SnowBody) -> float:
    """Largest relative density of a body.

    Parameters
    ----------
    settling : Settling
        Its mean density.
    body : SnowBody
        As it is now.

    Returns
    -------
    float
        D [-], at most ``DENSEST_SNOW``.
    """
    return min(settling.mean_density * float(body.density.max()), DENSEST_SNOW)
