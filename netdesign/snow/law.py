"""Problem of one instant of flow, dimensionless, and the tangents of its laws.

Lengths are in snow thicknesses d, stresses in rho g d with the mean density, strain
rates in B a^((n+1)/2) (rho g d)^n with the B and a of the reference layer. Theory:
snow/THEORY.md, section 2.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Literal, NamedTuple

import numpy as np

from netdesign.numerics.arrays import Floats, freeze
from netdesign.snow.element import Element, interpolate_reference
from netdesign.snow.ground import GroundKind
from netdesign.snow.mesh import MeshTemplate

# Stress [rho g d] below which snow creeps linearly: keeps the fluidity above zero.
# Halving it moves end forces by less than 1e-5 (tests/snow/test_flow.py).
STRESS_FLOOR = 3e-3

Sides = Literal["one-sided", "two-sided"]

# Plane part of the unit tensor, and the compliance of a deviatoric stress (N18).
_UNIT = np.array([1.0, 1.0, 0.0])
_SHEAR, _VOLUME = np.diag([2.0, 2.0, 1.0]), np.outer(_UNIT, _UNIT)
_DEVIATOR_COMPLIANCE = np.array([[1.0, 0.5, 0.0], [0.5, 1.0, 0.0], [0.0, 0.0, 1.0]])
_DEVIATOR_STIFFNESS = np.linalg.inv(_DEVIATOR_COMPLIANCE)


@dataclass(frozen=True, slots=True, kw_only=True)
class FlowLayer:
    """One layer of snow, all relative to the reference.

    Attributes
    ----------
    top : float
        Height of its upper side over the thickness; 1 for the last layer.
    bulk_ratio : float
        a / b of the creep law [-].
    fluidity_ratio : float
        B a^((n+1)/2) over that of the reference [-].
    density : float
        Over the mean density [-].
    warmth : float
        B over that of the reference [-]; a part of ``fluidity_ratio``.
    """

    top: float = 1.0
    bulk_ratio: float
    fluidity_ratio: float = 1.0
    density: float = 1.0
    warmth: float = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class FlowProblem:
    """One instant of flow: creep, gravity, ground, contacts and end load.

    Attributes
    ----------
    exponent : float
        Creep exponent n [-].
    layers : tuple of FlowLayer
        From the ground up.
    gravity : tuple of float
        Gravity over g in the slope's axes [-].
    ground : str
        Kind of base law.
    slip_ratio : float
        Slip length over thickness [-]; 0 unless the ground is sliding.
    slip_exponent : float or None
        Of the stress in the law of a sliding ground [-]; None is ``exponent``.
    friction : float
        tan phi of snow on net [-]; infinite where the snow adheres.
    element : str
        ``velocity`` or, for nearly incompressible snow, ``mixed``.
    ground_contact, net_contact : str
        ``two-sided``: may pull on the snow; ``one-sided``: lets go instead.
    stress_floor : float
        Stress below which snow creeps linearly [-]; keeps the tangent regular.
    end_load : float
        Force along the slope on the upslope end, of snow beyond it [rho g d^2].
    """

    exponent: float
    layers: tuple[FlowLayer, ...]
    gravity: tuple[float, float]
    ground: GroundKind = "free"
    slip_ratio: float = 0.0
    slip_exponent: float | None = None
    friction: float = 0.0
    element: Element = "velocity"
    ground_contact: Sides = "two-sided"
    net_contact: Sides = "two-sided"
    stress_floor: float = STRESS_FLOOR
    end_load: float = 0.0


class Material(NamedTuple):
    """Layer properties where they are needed: numbers, or arrays over points.

    Attributes
    ----------
    bulk_ratio, fluidity_ratio, density : float or ndarray
        As in ``FlowLayer`` [-]; shape (n_triangles, n_points) or (n_triangles, 1).
    """

    bulk_ratio: float | Floats
    fluidity_ratio: float | Floats
    density: float | Floats

    @property
    def stiffness(self) -> Floats:
        """M of eq. (N7), shape (.., 3, 3): stress over strain rate, linear law."""
        coupling = np.asarray(self.bulk_ratio) - 2.0 / 3.0
        return np.asarray(_SHEAR + coupling[..., None, None] * _VOLUME)


class Tangent(NamedTuple):
    """A law linearised about a stress: intercept + modulus times strain rate.

    Attributes
    ----------
    modulus : ndarray, shape (.., R, R), or (n_edges, n_points) on the ground
        Stress over strain rate [-].
    intercept : ndarray, shape (.., R), or (n_edges, n_points) on the ground
        Stress without strain rate [rho g d].
    """

    modulus: Floats
    intercept: Floats


@lru_cache(maxsize=8)
def sample_material(problem: FlowProblem, template: MeshTemplate | None) -> Material:
    """Properties at the quadrature points.

    Parameters
    ----------
    problem : FlowProblem
        Its layers.
    template : MeshTemplate or None
        Reference mesh; uniform snow needs none.

    Returns
    -------
    Material
        Numbers for uniform snow, else arrays of shape (n_triangles, n_points).
    """
    if len(problem.layers) == 1:
        layer = problem.layers[0]
        return Material(layer.bulk_ratio, layer.fluidity_ratio, layer.density)
    assert template is not None  # layers lie at heights
    tops = np.array([layer.top for layer in problem.layers[:-1]])
    index = np.searchsorted(tops, interpolate_reference(template)[1])
    fields = ("bulk_ratio", "fluidity_ratio", "density")
    return Material(
        *(
            freeze(np.array([getattr(layer, name) for layer in problem.layers])[index])
            for name in fields
        )
    )


def linearise_creep(
    problem: FlowProblem, material: Material, stress: Floats
) -> Tangent:
    """Tangent of the creep law in the generalised strains of the law's element.

    Parameters
    ----------
    problem : FlowProblem
        Exponent and element.
    material : Material
        At the points.
    stress : ndarray, shape (n_triangles, n_points, 3 or 4)
        (xx, yy, xy); in the mixed element of the deviator, then the pressure.

    Returns
    -------
    Tangent
        Moduli (.., R, R) and intercepts (.., R), eqs (N9) and (N10), or (N20).
    """
    if problem.element == "mixed":
        return _linearise_mixed(problem, material, stress)
    size = squared_invariant(problem, material, stress)
    viscosity, reduction, share = _scalars(problem, size, size)
    outer = stress[..., :, None] * stress[..., None, :]
    moduli = material.stiffness - (reduction * share)[..., None, None] * outer
    moduli *= (viscosity / material.fluidity_ratio)[..., None, None]
    return Tangent(modulus=moduli, intercept=stress * (1.0 - share)[..., None])


def linearise_sliding(
    problem: FlowProblem, shear: Floats, fluidity_ratio: Floats | None = None
) -> Tangent:
    """Tangent of the law of a sliding ground, (N12) and (N22).

    Parameters
    ----------
    problem : FlowProblem
        Exponent and slip ratio.
    shear : ndarray, shape (n_edges, n_points)
        Shear stress on the ground [rho g d].
    fluidity_ratio : ndarray, shape (n_edges, 1), optional
        Of the snow on the ground, B a^((n+1)/2) over the reference [-]; default is that
        of the lowest layer.

    Returns
    -------
    Tangent
        Modulus and intercept, shape (n_edges, n_points) each.
    """
    if problem.slip_exponent is not None:
        problem = replace(problem, exponent=problem.slip_exponent)
    viscosity, _, share = _scalars(problem, shear**2, shear**2)
    slip = problem.slip_ratio * (
        problem.layers[0].fluidity_ratio if fluidity_ratio is None else fluidity_ratio
    )
    return Tangent(modulus=viscosity * share / slip, intercept=shear * (1.0 - share))


def advance_stress(
    problem: FlowProblem, tangent: Tangent, strain: Floats, more: Floats | None = None
) -> Floats:
    """Stress after a step.

    Parameters
    ----------
    problem : FlowProblem
        Its element.
    tangent : Tangent
        Of the creep law.
    strain : ndarray, shape (n_triangles, n_points, R)
        Generalised strain after the step [-].
    more : ndarray, optional
        Strain on top, of that shape [-]. It is added last: large velocities that deform
        little would otherwise leave their rounding in the balance of forces.

    Returns
    -------
    ndarray, shape (n_triangles, n_points, R)
        In the form that ``linearise_creep`` takes [rho g d].
    """
    stress = hold_stress(tangent, strain)
    pressure = strain[..., 3:]
    if more is not None:
        stress += (tangent.modulus @ more[..., None])[..., 0]
        pressure = pressure + more[..., 3:]
    if problem.element == "mixed":
        stress[..., :3] += pressure * _UNIT
        stress[..., 3:] = pressure
    return stress


def hold_stress(tangent: Tangent, strain: Floats) -> Floats:
    """Generalised stress of the linearised law at a strain.

    Parameters
    ----------
    tangent : Tangent
        Of the creep law.
    strain : ndarray, shape (n_triangles, n_points, R)
        Generalised strain [-].

    Returns
    -------
    ndarray, shape (n_triangles, n_points, R)
        [rho g d].
    """
    return np.asarray(tangent.intercept + (tangent.modulus @ strain[..., None])[..., 0])


def total_stress(problem: FlowProblem, stress: Floats) -> Floats:
    """Generalised stress whose nodal forces are the internal forces.

    In the mixed element the fourth row, conjugate to the pressure, is left out: it
    belongs to the law, not to equilibrium.

    Parameters
    ----------
    problem : FlowProblem
        Its element.
    stress : ndarray, shape (n_triangles, n_points, R)
        In the form that ``linearise_creep`` takes [rho g d].

    Returns
    -------
    ndarray, shape (n_triangles, n_points, R)
        [rho g d].
    """
    if problem.element == "velocity":
        return stress
    total = np.zeros_like(stress)
    total[..., :3] = stress[..., :3] - stress[..., 3:] * _UNIT
    return total


def squared_invariant(
    problem: FlowProblem, material: Material, stress: Floats
) -> Floats:
    """Squared stress invariant.

    Parameters
    ----------
    problem : FlowProblem
        Its element.
    material : Material
        At the points.
    stress : ndarray, shape (n_triangles, n_points, R)
        In the form that ``linearise_creep`` takes [rho g d].

    Returns
    -------
    ndarray, shape (n_triangles, n_points)
        S^2 of (N8) or (N18) [(rho g d)^2].
    """
    if problem.element == "mixed":
        deviator, pressure = stress[..., :3], stress[..., 3]
        return _square_deviator(deviator) + pressure**2 / material.bulk_ratio
    # sigma . M^-1 sigma, M^-1 = diag(1/2, 1/2, 1) - k / (4 (1 + k)) u u^T, written out
    coupling = np.asarray(material.bulk_ratio) - 2.0 / 3.0
    first, second, shear = stress[..., 0], stress[..., 1], stress[..., 2]
    return np.asarray(
        (first**2 + second**2) / 2.0
        + shear**2
        - coupling / (4.0 * (1.0 + coupling)) * (first + second) ** 2
    )


def _linearise_mixed(
    problem: FlowProblem, material: Material, stress: Floats
) -> Tangent:
    deviator, pressure = stress[..., :3], stress[..., 3]
    bulk = material.bulk_ratio
    part = _square_deviator(deviator)
    size = part + pressure**2 / bulk
    viscosity, reduction, share = _scalars(problem, size, part)
    viscosity = viscosity / material.fluidity_ratio
    pull = reduction * share * pressure / bulk  # q s p / r of eq. (N20)
    outer = deviator[..., :, None] * deviator[..., None, :]
    moduli = np.empty((*stress.shape, 4))
    moduli[..., :3, :3] = viscosity[..., None, None] * (
        _DEVIATOR_STIFFNESS - (reduction * share)[..., None, None] * outer
    )
    moduli[..., :3, 3] = moduli[..., 3, :3] = -_UNIT - pull[..., None] * deviator
    moduli[..., 3, 3] = -(1.0 / bulk + pull * pressure / bulk) / viscosity
    intercept = np.empty_like(stress)
    intercept[..., :3] = deviator * (1.0 - share + pull * pressure)[..., None]
    intercept[..., 3] = pull * size / viscosity
    return Tangent(modulus=moduli, intercept=intercept)


def _scalars(
    problem: FlowProblem, size: Floats, part: Floats
) -> tuple[Floats, Floats, Floats]:
    """Viscosity (S^2 + s0^2)^((1-n)/2), q of (N9), and 1 / (1 + q part)."""
    n = problem.exponent
    floored = size + problem.stress_floor**2
    reduction = (n - 1.0) / floored
    return floored ** ((1.0 - n) / 2.0), reduction, 1.0 / (1.0 + reduction * part)


def _square_deviator(deviator: Floats) -> Floats:
    """Part of the squared invariant (N18) that a deviator has."""
    strained = (_DEVIATOR_COMPLIANCE @ deviator[..., None])[..., 0]
    return np.asarray((strained * deviator).sum(axis=-1))
