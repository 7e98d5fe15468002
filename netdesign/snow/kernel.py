"""Fast assembly of the creep problem on one placed mesh (``snow/placed_mesh.py``).

Same integrals as the readable forms in ``snow/forms.py`` (tests compare them),
written with arrays over (triangle, quadrature point). Unknowns are velocities in node
axes, (normal, tangential) to the net at its nodes and (X, Y) elsewhere, interleaved;
then, in the mixed element, one pressure per vertex. Plane tensors are stored as
(xx, yy, xy); strain rates with the engineering shear.
"""

from __future__ import annotations

import numpy as np

from netdesign.numerics.arrays import Floats, gather
from netdesign.snow.element import reference_element
from netdesign.snow.linear import Matrix, sum_blocks
from netdesign.snow.mesh import MeshTemplate, edge_triples
from netdesign.snow.placed_mesh import EDGE_SHAPE, PlacedMesh
from netdesign.snow.shared_mesh import find_once


def interpolate(mesh: PlacedMesh, nodal: Floats) -> Floats:
    """Values at the quadrature points.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    nodal : ndarray, shape (.., n_nodes)
        Any unit.

    Returns
    -------
    ndarray, shape (.., n_triangles, n_points)
        In that unit.
    """
    shape, _, _ = reference_element()
    return np.asarray(nodal[..., mesh.template.triangles.T] @ shape.T)


def compute_strain(mesh: PlacedMesh, unknowns: Floats) -> Floats:
    """Generalised strains at the quadrature points.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    unknowns : ndarray, shape (n_dofs,)
        Velocities, and pressures of the mixed element.

    Returns
    -------
    ndarray, shape (n_triangles, n_points, R)
        (xx, yy, xy) and, in the mixed element, the pressure.
    """
    n_triangles, n_points, n_rows, n_columns = mesh.operator.shape
    operator = mesh.operator.reshape(n_triangles, n_points * n_rows, n_columns)
    strains = operator @ unknowns[mesh.dofs][..., None]
    return np.asarray(strains.reshape(n_triangles, n_points, n_rows))


def assemble_stress(mesh: PlacedMesh, stress: Floats) -> Floats:
    """Nodal forces of stresses.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    stress : ndarray, shape (n_triangles, n_points, R)
        Generalised stresses [rho g d].

    Returns
    -------
    ndarray, shape (n_dofs,)
        In node axes [rho g d^2].
    """
    n_triangles, n_points, n_rows, n_columns = mesh.operator.shape
    operator = mesh.operator.reshape(n_triangles, n_points * n_rows, n_columns)
    weighted = (stress * mesh.weights[..., None]).reshape(n_triangles, 1, -1)
    return gather(mesh.dofs, weighted @ operator, mesh.n_dofs)


def assemble_stiffness(mesh: PlacedMesh, moduli: Floats) -> Matrix:
    """Matrix of moduli.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    moduli : ndarray, shape (n_triangles, n_points, R, R)
        Stress over strain rate [-].

    Returns
    -------
    sparse matrix, shape (n_dofs, n_dofs)
        In node axes.
    """
    n_triangles, n_points, n_rows, n_columns = mesh.operator.shape
    flat = (n_triangles, n_points * n_rows, n_columns)
    stresses = (moduli * mesh.weights[..., None, None]) @ mesh.operator
    values = mesh.operator.reshape(flat).transpose(0, 2, 1) @ stresses.reshape(flat)
    return sum_blocks(mesh.dofs, values, mesh.n_dofs)


def assemble_body_force(mesh: PlacedMesh, force: Floats) -> Floats:
    """Nodal loads of a body force.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    force : ndarray, shape (2, n_triangles, n_points)
        In the slope's axes [rho g].

    Returns
    -------
    ndarray, shape (n_dofs,)
        In node axes [rho g d^2].
    """
    shape, _, _ = reference_element()
    n_nodes = mesh.nodes.shape[1]
    nodal = [
        gather(mesh.template.triangles.T, (mesh.weights * part) @ shape, n_nodes)
        for part in force
    ]
    return mesh.to_node_axes(np.array(nodal))


def assemble_end_load(mesh: PlacedMesh, force: float) -> Floats:
    """Nodal loads of a uniform traction on the upslope end.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    force : float
        Along X, for each metre of width [rho g d^2].

    Returns
    -------
    ndarray, shape (n_dofs,)
        In node axes [rho g d^2].
    """
    along = force * share_end_load(mesh.template)
    return mesh.to_node_axes(np.array([along, np.zeros_like(along)]))


@find_once
def share_end_load(template: MeshTemplate) -> Floats:
    """Shares of the nodes in a uniform traction on the upslope end.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh, which is the placed one there.

    Returns
    -------
    ndarray, shape (n_nodes,)
        [-]
    """
    eta = template.nodes[1]
    start, middle, stop = edge_triples(template.upstream)
    lengths = eta[stop] - eta[start]
    shares = np.zeros(eta.size)
    np.add.at(shares, start, lengths / 6.0)
    np.add.at(shares, middle, lengths * 4.0 / 6.0)
    np.add.at(shares, stop, lengths / 6.0)
    return shares


def assemble_base_force(mesh: PlacedMesh, shear: Floats) -> Floats:
    """Nodal forces of a shear stress on the ground.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    shear : ndarray, shape (n_edges, n_points)
        Shear stress on the ground [rho g d].

    Returns
    -------
    ndarray, shape (n_dofs,)
        In node axes [rho g d^2].
    """
    forces = (mesh.base_weights * shear) @ EDGE_SHAPE
    return gather(mesh.base_dofs, forces, mesh.n_dofs)


def assemble_base_stiffness(mesh: PlacedMesh, modulus: Floats) -> Matrix:
    """Matrix of a base modulus.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    modulus : ndarray, shape (n_edges, n_points)
        Shear stress over velocity [-].

    Returns
    -------
    sparse matrix, shape (n_dofs, n_dofs)
        In node axes.
    """
    weighted = mesh.base_weights * modulus
    values = np.einsum("eq,qi,qj->eij", weighted, EDGE_SHAPE, EDGE_SHAPE)
    return sum_blocks(mesh.base_dofs, values, mesh.n_dofs)


def compute_base_velocity(mesh: PlacedMesh, velocity: Floats) -> Floats:
    """Velocity along the ground.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    velocity : ndarray, shape (n_dofs,)
        Unknowns in node axes [velocity scale].

    Returns
    -------
    ndarray, shape (n_edges, n_points)
        [velocity scale].
    """
    return np.asarray(velocity[mesh.base_dofs] @ EDGE_SHAPE.T)
