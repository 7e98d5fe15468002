"""Exact solutions: a manufactured flow, and a slab of linear creep on a wall.

**Flow.** The velocity is a polynomial that no element represents; the body force that
makes it a solution follows from the law by the chain rule. The functions of x and y
take arrays and symbols alike: ``tests/verification/test_manufactured.py`` proves with
them that the residual of the exact solution is zero. **Slab.** verification/THEORY.md.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.sparse.linalg import splu

from netdesign.addons.evidence.verification.case import (
    Found,
    VerificationCase,
    judge,
    observe_order,
)
from netdesign.numerics.arrays import Floats, Mask
from netdesign.outcome import Outcome, SolveError
from netdesign.snow.creep_law import (
    BOUTILLIER_2004,
    ICE_DENSITY,
    compute_bulk_factor,
    compute_shear_factor,
)
from netdesign.snow.element import Element
from netdesign.snow.kernel import (
    assemble_body_force,
    assemble_stiffness,
    assemble_stress,
    compute_strain,
    interpolate,
)
from netdesign.snow.law import (
    FlowLayer,
    FlowProblem,
    advance_stress,
    linearise_creep,
    sample_material,
    squared_invariant,
)
from netdesign.snow.mesh import MeshTemplate, place_nodes, triangulate
from netdesign.snow.placed_mesh import PlacedMesh, build_placed_mesh
from netdesign.snow.snowpack import GRAVITY

Vector = tuple[Any, Any, Any]  # (xx, yy, xy)

EXPONENT = 3
BULK_RATIO = 3
_DIVISIONS = (4, 8, 16)
_BULGE = 0.15  # of the curved side, over its height


def exact_velocity(x: Any, y: Any) -> tuple[Any, Any]:
    """Velocity; its strain rate vanishes nowhere on the bench."""
    u = x + x * y / 2 + 3 * x**2 * y / 10 - y**3 / 5
    v = -2 * y / 5 + 3 * x**2 / 10 + x * y**2 / 4
    return u, v


def exact_strain(x: Any, y: Any) -> Vector:
    """Strain rate of the velocity, with the engineering shear."""
    return (
        (10 + 5 * y + 6 * x * y) / 10,
        (5 * x * y - 4) / 10,
        (22 * x + 6 * x**2 - 7 * y**2) / 20,
    )


def strain_slopes(x: Any, y: Any) -> tuple[Vector, Vector]:
    """Derivatives of the strain rate along x and along y."""
    along_x = (3 * y / 5, y / 2, (11 + 6 * x) / 10)
    along_y = ((5 + 6 * x) / 10, x / 2, -7 * y / 10)
    return along_x, along_y


def linear_stress(strain: Vector) -> Vector:
    """M times a strain rate, snow/THEORY.md (N7)."""
    xx, yy, xy = strain
    bulk = BULK_RATIO * (xx + yy) - (xx + yy) * 2 / 3
    return 2 * xx + bulk, 2 * yy + bulk, xy


def exact_body_force(x: Any, y: Any) -> tuple[Any, Any]:
    """Minus the divergence of the stress."""
    strain = exact_strain(x, y)
    shape = linear_stress(strain)
    size = _dot(strain, shape)
    power = _power(strain)
    slopes = []
    for slope in strain_slopes(x, y):
        change = linear_stress(slope)
        growth = 2 * _dot(slope, shape) * power / size
        slopes.append(
            tuple(
                size**power * (d + growth * s)
                for d, s in zip(change, shape, strict=True)
            )
        )
    along_x, along_y = slopes
    return -(along_x[0] + along_y[2]), -(along_x[2] + along_y[1])


def list_manufactured() -> list[VerificationCase]:
    """Errors and orders of both elements."""
    results = {}
    elements: dict[str, Element] = {"p2": "velocity", "p2p1": "mixed"}
    for name, element in elements.items():
        for field, errors in _measure(element).items():
            order = observe_order([1.0 / pieces for pieces in _DIVISIONS], errors)
            results[f"mms-{name}-{field}"] = Found(errors[-1], 0.0, order)
    return judge(results)


def build_law(element: Element) -> FlowProblem:
    """Law of the bench, with a stress floor far below its stresses."""
    return FlowProblem(
        exponent=float(EXPONENT),
        layers=(FlowLayer(bulk_ratio=float(BULK_RATIO)),),
        gravity=(0.0, 0.0),
        element=element,
        stress_floor=1e-9,
    )


def solve_bench(divisions: int, element: Element) -> tuple[PlacedMesh, PrescribedFlow]:
    """Manufactured problem on a square with ``divisions`` pieces along each side."""
    template = build_square(divisions)
    heights = template.net_fractions
    curve = np.array([4 * _BULGE * heights * (1 - heights), heights])
    mesh = build_placed_mesh(template, place_nodes(template, curve), element)
    distance, height = template.nodes
    on_side = (distance == 0) | (distance == 1) | (height == 0) | (height == 1)
    flow = solve_prescribed(
        build_law(element),
        mesh,
        held=np.array([on_side, on_side]),
        values=np.array(exact_velocity(*mesh.nodes)),
        body_force=np.array(exact_body_force(*interpolate(mesh, mesh.nodes))),
    )
    return mesh, flow


def build_square(divisions: int) -> MeshTemplate:
    """Reference mesh of a square with equal pieces along its sides."""
    ticks = np.linspace(0.0, 1.0, divisions + 1)
    x, y = np.meshgrid(ticks, ticks)
    return triangulate(np.column_stack([x.ravel(), y.ravel()]), 1.0)


def _measure(element: Element) -> dict[str, list[float]]:
    """Relative L2 errors of velocity, strain rate and pressure over the meshes."""
    velocity, strain, pressure = [], [], []
    for divisions in _DIVISIONS:
        mesh, flow = solve_bench(divisions, element)
        places = interpolate(mesh, mesh.nodes)
        got = interpolate(mesh, flow.velocity)
        velocity.append(_error(mesh, got, np.array(exact_velocity(*places))))
        exact = np.array(exact_strain(*places))
        strain.append(_error(mesh, np.moveaxis(flow.strain, -1, 0), exact))
        pressure.append(_error(mesh, _pressure(flow), exact_pressure(*places)))
    return {"velocity": velocity, "strain-rate": strain, "pressure": pressure}


def exact_pressure(x: Any, y: Any) -> Any:
    """Mean pressure of the velocity."""
    return _press(exact_strain(x, y))


def _press(strain: Vector) -> Any:
    size = _dot(strain, linear_stress(strain))
    return -BULK_RATIO * (strain[0] + strain[1]) * size ** _power(strain)


def _pressure(flow: PrescribedFlow) -> Floats:
    if flow.stress.shape[-1] == 4:
        return np.asarray(flow.stress[..., 3])
    return np.asarray(_press(tuple(np.moveaxis(flow.strain, -1, 0))))


def _error(mesh: PlacedMesh, got: Floats, exact: Floats) -> float:
    missed = (mesh.weights * (got - exact) ** 2).sum()
    return float(np.sqrt(missed / (mesh.weights * exact**2).sum()))


def _dot(first: Vector, second: Vector) -> Any:
    return sum(a * b for a, b in zip(first, second, strict=True))


def _power(strain: Vector) -> Any:
    """(1 - n) / (2 n) as an exact fraction where the strain is symbolic."""
    unity = strain[0] / strain[0]
    return unity * (1 - EXPONENT) / (2 * EXPONENT)


_LARGEST_ITERATIONS = 60
_TOLERANCE = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PrescribedFlow:
    """Solution on one mesh.

    Attributes
    ----------
    velocity : ndarray, shape (2, n_nodes)
        In the mesh's axes.
    strain : ndarray, shape (n_triangles, n_points, 3)
        (xx, yy, engineering xy).
    stress : ndarray, shape (n_triangles, n_points, 3 or 4)
        As the law's element takes it.
    """

    velocity: Floats
    strain: Floats
    stress: Floats


def solve_prescribed(
    problem: FlowProblem,
    mesh: PlacedMesh,
    *,
    held: Mask,
    values: Floats,
    body_force: Floats,
) -> PrescribedFlow:
    """Velocities where some components are given.

    Parameters
    ----------
    problem : FlowProblem
        Creep law; its ground, friction and gravity are not used.
    mesh : PlacedMesh
        Of the law's element.
    held : ndarray of bool, shape (2, n_nodes)
        Components that are given; all or none of a node on the net's side.
    values : ndarray, shape (2, n_nodes)
        Their values.
    body_force : ndarray, shape (2, n_triangles, n_points)
        At the quadrature points.

    Raises
    ------
    SolveError
        If Newton's method does not converge.
    """
    material = sample_material(problem, mesh.template)
    prescribed = mesh.to_node_axes(np.where(held, values, 0.0))
    free = np.ones(mesh.n_dofs, dtype=bool)
    free[: mesh.n_velocities] = ~held.T.ravel()
    places = np.flatnonzero(free)
    load = assemble_body_force(mesh, body_force)
    stress = np.zeros((*mesh.weights.shape, mesh.operator.shape[2]))
    current = replace(problem, exponent=1.0)  # a linear start
    for _ in range(_LARGEST_ITERATIONS):
        tangent = linearise_creep(current, material, stress)
        matrix = assemble_stiffness(mesh, tangent.modulus)
        force = assemble_stress(mesh, tangent.intercept) - load + matrix @ prescribed
        unknowns = prescribed.copy()
        unknowns[places] = splu(matrix[places][:, places].tocsc()).solve(-force[places])
        strain = compute_strain(mesh, unknowns)
        before, stress = stress, advance_stress(current, tangent, strain)
        change = _norm(problem, mesh, stress - before) / _norm(problem, mesh, stress)
        if current is problem and change < _TOLERANCE:
            velocity = mesh.to_slope_axes(unknowns)
            return PrescribedFlow(
                velocity=velocity, strain=strain[..., :3], stress=stress
            )
        current = problem
    raise SolveError(Outcome.MAX_ITERATIONS, "flow with prescribed velocities")


def _norm(problem: FlowProblem, mesh: PlacedMesh, stress: Floats) -> float:
    size = squared_invariant(problem, sample_material(problem, mesh.template), stress)
    return float(np.sqrt((mesh.weights * size).sum()))


# The drag on snow that sticks to the ground acts like a slip over this share of d.
PROFILE_SHARE = 1.0 / 3.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Slab:
    """Snow of linear creep on a slope.

    Attributes
    ----------
    thickness : float
        d, normal to the slope [m].
    slope_angle : float
        psi [rad].
    density : float
        [kg/m3]; it decides the ratio a/b of the creep law.
    """

    thickness: float
    slope_angle: float
    density: float

    @property
    def poisson(self) -> float:
        """Viscous Poisson's ratio nu [-]; (H3)."""
        relative = self.density / ICE_DENSITY
        a = compute_shear_factor(BOUTILLIER_2004, relative)
        b = compute_bulk_factor(BOUTILLIER_2004, relative)
        return (3.0 * a - 2.0 * b) / (6.0 * a + 2.0 * b)

    @property
    def side_length(self) -> float:
        """Length of slope as heavy as the pressure at rest is large [m]; (H8)."""
        side = self.poisson / (1.0 - self.poisson)
        return side * self.thickness / (2.0 * math.tan(self.slope_angle))


def compute_influence_length(slab: Slab, slip_length: float) -> float:
    """Length over which a wall's influence fades upslope; (H4).

    Parameters
    ----------
    slab : Slab
        Snow.
    slip_length : float
        D* of linear creep, the stagnation depth; 0 without slip [m].

    Returns
    -------
    float
        l [m].

    Verified by
    -----------
    tests/verification/test_slab_force.py
    """
    drag = slab.thickness * (slip_length + PROFILE_SHARE * slab.thickness)
    return math.sqrt(2.0 / (1.0 - slab.poisson) * drag)


def scale_slip_length(slab: Slab, slip_length: float, ratio: float) -> float:
    """Slip length at which an endless slab presses with a multiple of its force; (H9).

    Parameters
    ----------
    slab : Slab
        Snow.
    slip_length : float
        D* of linear creep that belongs to the force [m].
    ratio : float
        Wanted force over this one [-].

    Returns
    -------
    float
        D* of linear creep [m].
    """
    now = compute_influence_length(slab, slip_length)
    wanted = ratio * now + (ratio - 1.0) * slab.side_length
    rough = compute_influence_length(slab, 0.0)
    return PROFILE_SHARE * slab.thickness * ((wanted / rough) ** 2 - 1.0)


def compute_slab_force(
    slab: Slab, *, slip_length: float, upslope_length: float = math.inf
) -> float:
    """Force of a slab on a smooth face normal to the slope; (H6).

    It is the creep and glide that is held back, and the settling, which cannot spread.

    Parameters
    ----------
    slab : Slab
        Snow, as high as the face.
    slip_length : float
        D* of linear creep; 0 without slip [m].
    upslope_length : float
        L, from the face to the free upslope end [m].

    Returns
    -------
    float
        Along the slope, per metre of width [N/m].

    Verified by
    -----------
    tests/verification/test_slab_force.py, ``netdesign verify``, cases haefeli-*
    """
    sine, cosine = math.sin(slab.slope_angle), math.cos(slab.slope_angle)
    weight = slab.density * GRAVITY * slab.thickness  # of a metre of slope [N/m2]
    length = compute_influence_length(slab, slip_length)
    lengths = upslope_length / length
    dynamic = weight * (length * math.tanh(lengths)) * sine
    side = slab.poisson / (1.0 - slab.poisson) / 2.0
    spread = 1.0 - 1.0 / math.cosh(lengths)
    return dynamic + spread * side * weight * slab.thickness * cosine
