"""Weak forms of the creep problem, written to be read beside the theory.

The reference for ``snow/kernel.py``: the same integrals over the same six-node
triangles and quadrature points, in the idiom of scikit-fem and in the slope's axes
throughout. No solve calls it; tests compare the two to rounding. Plane tensors are
(xx, yy, xy), strain rates with the engineering shear. Theory: snow/THEORY.md.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
import scipy.sparse as sparse
import skfem
from skfem.element import DiscreteField
from skfem.helpers import dot, grad

from netdesign.numerics.arrays import Floats
from netdesign.snow.element import QUADRATURE_DEGREE
from netdesign.snow.placed_mesh import PlacedMesh


@lru_cache(maxsize=2)
def build_basis(mesh: PlacedMesh) -> skfem.Basis:
    """Quadratic velocities on a placed mesh, its net edges parabolas.

    Components are numbered as in the kernel: (X, Y) of node 0, of node 1, ...

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    """
    curved = skfem.MeshTri2(doflocs=mesh.nodes, t=mesh.template.triangles[:3])
    velocity = skfem.ElementVector(skfem.ElementTriP2())
    return skfem.Basis(curved, velocity, intorder=QUADRATURE_DEGREE)


def assemble_tangent_form(mesh: PlacedMesh, moduli: Floats) -> sparse.csr_matrix:
    """Integral of eps(w) . C eps(v): matrix of the tangent, eq. (N9).

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    moduli : ndarray, shape (n_triangles, n_points, 3, 3)
        C at the quadrature points [-].

    Returns
    -------
    sparse matrix, shape (n_dofs, n_dofs)
        In the slope's axes, no boundary condition applied.

    Verified by
    -----------
    tests/snow/test_forms.py
    """
    form = skfem.BilinearForm(_tangent)
    return sparse.csr_matrix(form.assemble(build_basis(mesh), moduli=_field(moduli)))


def assemble_mixed_form(mesh: PlacedMesh, moduli: Floats) -> sparse.csr_matrix:
    """Taylor-Hood tangent: eps(w) . (C eps(v) + c p) + q (c . eps(v) + k p), (N20).

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh of the mixed element.
    moduli : ndarray, shape (n_triangles, n_points, 4, 4)
        [[C, c], [c, k]] at the quadrature points [-].

    Returns
    -------
    sparse matrix, shape (n_dofs, n_dofs)
        Velocities in the slope's axes, then pressures; no boundary condition.
    """
    velocity = build_basis(mesh)
    pressure = velocity.with_element(skfem.ElementTriP1())
    tangent = skfem.BilinearForm(_tangent).assemble(
        velocity, moduli=_field(moduli[..., :3, :3])
    )
    coupling = skfem.BilinearForm(_coupling).assemble(
        pressure, velocity, coupling=_field(moduli[..., :3, 3])
    )
    compression = skfem.BilinearForm(_compression).assemble(
        pressure, modulus=_field(moduli[..., 3, 3])
    )
    blocks = [[tangent, coupling], [coupling.T, compression]]
    return sparse.csr_matrix(sparse.bmat(blocks))


def assemble_stress_form(mesh: PlacedMesh, stress: Floats) -> Floats:
    """Integral of eps(w) . sigma: internal nodal forces.

    The stress is in equilibrium, (N6), where these forces equal those of
    ``assemble_gravity_form``.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    stress : ndarray, shape (n_triangles, n_points, 3)
        (xx, yy, xy) at the quadrature points [rho g d].

    Returns
    -------
    ndarray, shape (n_dofs,)
        In the slope's axes [rho g d^2].
    """
    form = skfem.LinearForm(_internal_power)
    return np.asarray(form.assemble(build_basis(mesh), stress=_field(stress)))


def assemble_gravity_form(
    mesh: PlacedMesh, gravity: tuple[float, float], density: Floats
) -> Floats:
    """Integral of rho w . g / |g|: nodal forces of gravity.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    gravity : tuple of float, shape (2,)
        Over g, in the slope's axes [-].
    density : ndarray, shape (n_triangles, n_points)
        Over the mean [-].

    Returns
    -------
    ndarray, shape (n_dofs,)
        In the slope's axes [rho g d^2].
    """
    x, y = gravity
    form = skfem.LinearForm(lambda w, at: at.density * (x * w[0] + y * w[1]))
    return np.asarray(form.assemble(build_basis(mesh), density=density))


def _tangent(v: Any, w: Any, at: Any) -> Any:
    return dot(_strain_rate(w), np.einsum("ijeq,jeq->ieq", at.moduli, _strain_rate(v)))


def _coupling(p: Any, w: Any, at: Any) -> Any:
    return dot(_strain_rate(w), at.coupling) * p


def _compression(p: Any, q: Any, at: Any) -> Any:
    return q * at.modulus * p


def _internal_power(w: Any, at: Any) -> Any:
    return dot(_strain_rate(w), at.stress)


def _strain_rate(v: Any) -> Any:
    """(eps_xx, eps_yy, 2 eps_xy) of a velocity."""
    (xx, xy), (yx, yy) = grad(v)
    return np.array([xx, yy, xy + yx])


def _field(values: Floats) -> DiscreteField:
    """Values at (triangle, point, ...) in scikit-fem's order (..., triangle, point)."""
    return DiscreteField(np.moveaxis(values, (0, 1), (-2, -1)))
