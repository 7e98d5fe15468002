"""Fast assembly of the creep problem on one placed mesh.

Same integrals as the readable forms in ``snow/forms.py`` (tests compare them),
written with arrays over (triangle, quadrature point). Unknowns are velocities in node
axes, (normal, tangential) to the net at its nodes and (X, Y) elsewhere, interleaved;
then, in the mixed element, one pressure per vertex. Plane tensors are stored as
(xx, yy, xy); strain rates with the engineering shear.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from netdesign.numerics.arrays import Floats, Ints
from netdesign.snow.linear import Blocks
from netdesign.snow.mesh import MeshTemplate

if TYPE_CHECKING:
    import scipy.sparse as sparse

# Degree of exactness: strain rates of straight triangles are linear, the creep law of
# them is not. Three points a triangle; six (degree 4) move end forces by some 0.005 %,
# at most 0.1 %, and not nearer to the truth.
QUADRATURE_DEGREE = 2
_EDGE_POINTS, _EDGE_WEIGHTS = np.polynomial.legendre.leggauss(4)
# Quadratic shape functions (n_points, 3) of an edge's start, middle and end, and their
# derivatives; weighted products of the two (3, 3).
_EDGE_SHAPE = np.column_stack(
    [
        _EDGE_POINTS * (_EDGE_POINTS - 1.0) / 2.0,
        1.0 - _EDGE_POINTS**2,
        _EDGE_POINTS * (_EDGE_POINTS + 1.0) / 2.0,
    ]
)
_EDGE_SLOPE = np.column_stack(
    [_EDGE_POINTS - 0.5, -2.0 * _EDGE_POINTS, _EDGE_POINTS + 0.5]
)
_EDGE_TANGENT = (_EDGE_WEIGHTS[:, None] * _EDGE_SHAPE).T @ _EDGE_SLOPE

Element = Literal["velocity", "mixed"]


@dataclass(frozen=True, kw_only=True, eq=False)
class PlacedMesh:
    """A template whose nodes have been placed, with all that depends on the place.

    The number of rows R is 3 for the velocity element, whose generalised strains are
    (xx, yy, xy), and 4 for the mixed one, which adds the pressure. The number of
    columns C is 12, or 15 with the three vertex pressures.

    Attributes
    ----------
    template : MeshTemplate
        The reference mesh.
    nodes : ndarray, shape (2, n_nodes)
        Positions in the slope's axes [thickness].
    weights : ndarray, shape (n_triangles, n_points)
        Quadrature weights times the area element.
    operator : ndarray, shape (n_triangles, n_points, R, C)
        Generalised strains per unknown.
    dofs : ndarray, shape (n_triangles, C)
        Unknowns of each triangle.
    load : ndarray, shape (n_nodes,)
        Integral of each shape function: nodal share of a unit body force.
    net_normal : ndarray, shape (2, n_net)
        Unit normals of the net's nodes, pointing out of the snow.
    axes : ndarray, shape (2, n_nodes)
        Cosine and sine of the first node axis; (1, 0) away from the net and at its
        foot, which is held in both directions.
    """

    template: MeshTemplate
    nodes: Floats
    weights: Floats
    operator: Floats
    dofs: Ints
    load: Floats
    net_normal: Floats
    axes: Floats

    @property
    def area(self) -> float:
        """Area of the snowpack [thickness^2]."""
        return float(self.weights.sum())

    @property
    def is_valid(self) -> bool:
        """No triangle is turned over or without area."""
        return bool(np.isfinite(self.weights).all() and self.weights.min() > 0)

    @property
    def n_velocities(self) -> int:
        """Number of velocity components, constrained ones included."""
        return 2 * int(self.nodes.shape[1])

    @property
    def n_dofs(self) -> int:
        """Number of unknowns, constrained ones included."""
        is_mixed = self.operator.shape[2] == 4
        return self.n_velocities + (self.template.n_vertices if is_mixed else 0)

    def to_node_axes(self, vectors: Floats) -> Floats:
        """Vectors as unknowns.

        Parameters
        ----------
        vectors : ndarray, shape (2, n_nodes)
            In the slope's axes, any unit.

        Returns
        -------
        ndarray, shape (n_dofs,)
            Unknowns in node axes; pressures are 0.
        """
        cosine, sine = self.axes
        x, y = vectors
        unknowns = np.zeros(self.n_dofs)
        unknowns[: self.n_velocities : 2] = cosine * x + sine * y
        unknowns[1 : self.n_velocities : 2] = -sine * x + cosine * y
        return unknowns

    def to_slope_axes(self, unknowns: Floats) -> Floats:
        """Unknowns as vectors.

        Parameters
        ----------
        unknowns : ndarray, shape (n_dofs,)
            In node axes, any unit.

        Returns
        -------
        ndarray, shape (2, n_nodes)
            In the slope's axes.
        """
        return _turn(self.axes, *unknowns[: self.n_velocities].reshape(-1, 2).T)

    def net_in_slope_axes(self, unknowns: Floats) -> Floats:
        """Vectors of the net's nodes.

        Parameters
        ----------
        unknowns : ndarray, shape (n_dofs,)
            In node axes, any unit.

        Returns
        -------
        ndarray, shape (2, n_net)
            In the slope's axes, foot to head.
        """
        net = self.template.net
        return _turn(self.axes[:, net], unknowns[2 * net], unknowns[2 * net + 1])

    @cached_property
    def base(self) -> BaseEdges:
        """Quadrature on the ground."""
        return _build_base(self.template, self.nodes)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BaseEdges:
    """Quadrature on the edges that lie on the ground.

    Attributes
    ----------
    dofs : ndarray, shape (n_edges, 3)
        Components of the velocity along the ground.
    shape : ndarray, shape (n_points, 3)
        Shape functions at the points.
    weights : ndarray, shape (n_edges, n_points)
        Quadrature weights times the length element.
    """

    dofs: Ints
    shape: Floats
    weights: Floats


def _turn(axes: Floats, first: Floats, second: Floats) -> Floats:
    """Components along node axes (2, n) to those in the slope's axes."""
    cosine, sine = axes
    return np.array([cosine * first - sine * second, sine * first + cosine * second])


def build_placed_mesh(
    template: MeshTemplate, nodes: Floats, element: Element = "velocity"
) -> PlacedMesh:
    """Everything that assembly needs on placed nodes.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.
    nodes : ndarray, shape (2, n_nodes)
        Positions [thickness].
    element : str
        ``velocity`` or ``mixed``.
    """
    gradients, area_element = map_gradients(template, nodes)
    shape, _, point_weights = reference_element()
    weights = area_element * point_weights
    net_normal = _net_normals(template, nodes)
    axes = np.zeros_like(nodes)
    axes[0] = 1.0
    axes[:, template.net[1:]] = net_normal[:, 1:]
    operator = build_strain_operator(template, gradients, axes)
    if element == "mixed":
        operator = add_pressure_rows(operator)
    return PlacedMesh(
        template=template,
        nodes=nodes,
        weights=weights,
        operator=operator,
        dofs=list_dofs(template, element),
        load=gather(template.triangles.T, weights @ shape, nodes.shape[1]),
        net_normal=net_normal,
        axes=axes,
    )


def point_heights(template: MeshTemplate) -> Floats:
    """Reference heights of the quadrature points.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.

    Returns
    -------
    ndarray, shape (n_triangles, n_points)
        [thickness].
    """
    shape, _, _ = reference_element()
    return np.asarray(template.nodes[1, template.triangles.T] @ shape.T)


def interpolate_reference(template: MeshTemplate) -> Floats:
    """Reference coordinates of the quadrature points.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.

    Returns
    -------
    ndarray, shape (2, n_triangles, n_points)
        (xi, eta) [thickness].
    """
    shape, _, _ = reference_element()
    return np.asarray(template.nodes[:, template.triangles.T] @ shape.T)


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


def build_stiffness(mesh: PlacedMesh, moduli: Floats) -> Blocks:
    """Element blocks of moduli.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    moduli : ndarray, shape (n_triangles, n_points, R, R)
        Stress over strain rate [-].
    """
    n_triangles, n_points, n_rows, n_columns = mesh.operator.shape
    flat = (n_triangles, n_points * n_rows, n_columns)
    stresses = (moduli * mesh.weights[..., None, None]) @ mesh.operator
    values = mesh.operator.reshape(flat).transpose(0, 2, 1) @ stresses.reshape(flat)
    return Blocks(mesh.dofs, values, n_paired=12)


def assemble_stiffness(mesh: PlacedMesh, moduli: Floats) -> sparse.csr_matrix:
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
    return build_stiffness(mesh, moduli).to_matrix(mesh.n_dofs)


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
    eta = mesh.template.nodes[1]
    start, middle, stop = _edge_triples(mesh.template.upstream)
    lengths = eta[stop] - eta[start]
    load = np.zeros_like(mesh.nodes)
    np.add.at(load[0], start, force * lengths / 6.0)
    np.add.at(load[0], middle, force * lengths * 4.0 / 6.0)
    np.add.at(load[0], stop, force * lengths / 6.0)
    return mesh.to_node_axes(load)


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
    base = mesh.base
    forces = (base.weights * shear) @ base.shape
    return gather(base.dofs, forces, mesh.n_dofs)


def build_base_stiffness(mesh: PlacedMesh, modulus: Floats) -> Blocks:
    """Edge blocks of a base modulus.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    modulus : ndarray, shape (n_edges, n_points)
        Shear stress over velocity [-].
    """
    base = mesh.base
    weighted = base.weights * modulus
    values = np.einsum("eq,qi,qj->eij", weighted, base.shape, base.shape)
    return Blocks(base.dofs, values, n_paired=0)


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
    return np.asarray(velocity[mesh.base.dofs] @ mesh.base.shape.T)


def gather(places: Ints, values: Floats, size: int) -> Floats:
    """Sums of the values that go to each place.

    Parameters
    ----------
    places : ndarray of int, any shape
        Where each value goes.
    values : ndarray
        Of that shape, any unit.
    size : int
        Number of places.

    Returns
    -------
    ndarray, shape (size,)
        In that unit.
    """
    sums = np.bincount(places.ravel(), values.ravel(), minlength=size)
    return np.asarray(sums, dtype=np.float64)


def map_gradients(template: MeshTemplate, nodes: Floats) -> tuple[Floats, Floats]:
    """Shape gradients and area element of placed nodes.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.
    nodes : ndarray, shape (2, n_nodes)
        Positions [thickness].

    Returns
    -------
    ndarray, shape (2, n_triangles, n_points, 6)
        Gradients of the shape functions [1 / thickness].
    ndarray, shape (n_triangles, n_points)
        Area element; not above 0 where a triangle is turned over.
    """
    _, reference, _ = reference_element()
    corners = nodes[:, template.triangles]
    jacobian = np.einsum("aie,ijq->ajeq", corners, reference)
    determinant = jacobian[0, 0] * jacobian[1, 1] - jacobian[0, 1] * jacobian[1, 0]
    inverse = np.array(
        [[jacobian[1, 1], -jacobian[0, 1]], [-jacobian[1, 0], jacobian[0, 0]]]
    )
    inverse /= determinant
    gradients = np.einsum("ijq,jaeq->aeqi", reference, inverse)
    return gradients, determinant * template.orientation[:, None]


def build_strain_operator(
    template: MeshTemplate, gradients: Floats, axes: Floats
) -> Floats:
    """Strains per velocity.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.
    gradients : ndarray, shape (2, n_triangles, n_points, 6)
        Of the shape functions [1 / thickness].
    axes : ndarray, shape (2, n_nodes)
        Cosine and sine of the first node axis [-].

    Returns
    -------
    ndarray, shape (n_triangles, n_points, 3, 12)
        (xx, yy, xy) for each velocity component of a triangle.
    """
    d_dx, d_dy = gradients
    operator = np.zeros((*d_dx.shape[:2], 3, 12))
    operator[..., 0, ::2] = operator[..., 2, 1::2] = d_dx
    operator[..., 1, 1::2] = operator[..., 2, ::2] = d_dy
    on_net = _touch_net(template)
    cosine, sine = axes[:, template.triangles.T[on_net]][:, :, None, None, :]
    in_x, in_y = operator[on_net, :, :, ::2], operator[on_net, :, :, 1::2]
    operator[on_net, :, :, ::2] = cosine * in_x + sine * in_y
    operator[on_net, :, :, 1::2] = cosine * in_y - sine * in_x
    return operator


@lru_cache(maxsize=256)
def _touch_net(template: MeshTemplate) -> Ints:
    """Triangles with a node on the net, whose axes are turned."""
    return np.flatnonzero(np.isin(template.triangles, template.net).any(axis=0))


def _net_normals(template: MeshTemplate, nodes: Floats) -> Floats:
    """Unit normals, each the normal integrated with the node's shape function."""
    shares = nodes[:, _list_edges(template).net] @ _EDGE_TANGENT.T
    tangents = np.zeros((2, template.net.size))
    tangents[:, :-2:2] = shares[..., 0]
    tangents[:, 1::2] = shares[..., 1]
    tangents[:, 2::2] += shares[..., 2]
    along, up = tangents / np.hypot(*tangents)
    return np.array([up, -along])


def turn_normals(mesh: PlacedMesh) -> Floats:
    """Angle by which each net node's normal turns as net nodes move.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.

    Returns
    -------
    ndarray, shape (n_net, 2, n_net)
        Counter-clockwise [rad per thickness].
    """
    count = mesh.template.net.size
    weights = np.zeros((count, count))
    for first in range(0, count - 2, 2):
        weights[first : first + 3, first : first + 3] += _EDGE_TANGENT
    tangent = mesh.nodes[:, mesh.template.net] @ weights.T
    unit = tangent / (tangent**2).sum(axis=0)
    return np.stack([-unit[1][:, None] * weights, unit[0][:, None] * weights], axis=1)


def _build_base(template: MeshTemplate, nodes: Floats) -> BaseEdges:
    triples = _list_edges(template).ground
    half = np.abs(nodes[0, triples[:, 2]] - nodes[0, triples[:, 0]]) / 2.0
    return BaseEdges(
        dofs=_list_edges(template).ground_dofs,
        shape=_EDGE_SHAPE,
        weights=half[:, None] * _EDGE_WEIGHTS,
    )


class _Edges(NamedTuple):
    """Start, middle and end node (n, 3) of the edges on the net and on the ground."""

    net: Ints
    ground: Ints
    ground_dofs: Ints  # components of the velocity along the ground


@lru_cache(maxsize=256)
def _list_edges(template: MeshTemplate) -> _Edges:
    net, ground = (
        np.column_stack(_edge_triples(chain))
        for chain in (template.net, template.ground)
    )
    ground_dofs = 2 * ground
    ground_dofs.setflags(write=False)
    return _Edges(net=net, ground=ground, ground_dofs=ground_dofs)


def _edge_triples(chain: Ints) -> tuple[Ints, Ints, Ints]:
    """Start, middle and end node of each edge of an alternating chain."""
    return chain[:-2:2], chain[1::2], chain[2::2]


@lru_cache(maxsize=1)
def reference_element() -> tuple[Floats, Floats, Floats]:
    """Shape functions (n_points, 6), gradients (6, 2, n_points), weights."""
    from skfem import ElementTriP2
    from skfem.quadrature import get_quadrature

    element = ElementTriP2()
    points, weights = get_quadrature(element.refdom, QUADRATURE_DEGREE)
    values, gradients = zip(*(element.lbasis(points, i) for i in range(6)), strict=True)
    return np.array(values).T, np.array(gradients), weights


@lru_cache(maxsize=256)
def list_dofs(template: MeshTemplate, element: Element) -> Ints:
    """Unknowns of each triangle.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.
    element : str
        ``velocity`` or ``mixed``.

    Returns
    -------
    ndarray of int, shape (n_triangles, C)
        Velocities first.
    """
    dofs = list_velocity_dofs(template)
    if element == "mixed":
        first = 2 * template.nodes.shape[1]
        dofs = np.hstack([dofs, first + template.triangles[:3].T])
    dofs.setflags(write=False)
    return dofs


def list_velocity_dofs(template: MeshTemplate) -> Ints:
    """Velocity components of each triangle.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.

    Returns
    -------
    ndarray of int, shape (n_triangles, 12)
        X and Y of each node in turn.
    """
    first = 2 * template.triangles.T
    return np.stack([first, first + 1], axis=-1).reshape(len(first), 12)


def add_pressure_rows(strain: Floats) -> Floats:
    """Operator of the mixed element.

    Parameters
    ----------
    strain : ndarray, shape (n_triangles, n_points, 3, 12)
        Operator of the velocity element.

    Returns
    -------
    ndarray, shape (n_triangles, n_points, 4, 15)
        Its fourth strain is the pressure, linear in a triangle.
    """
    from skfem import ElementTriP1
    from skfem.quadrature import get_quadrature

    element = ElementTriP1()
    points, _ = get_quadrature(element.refdom, QUADRATURE_DEGREE)
    operator = np.zeros((*strain.shape[:2], 4, 15))
    operator[..., :3, :12] = strain
    operator[..., 3, 12:] = np.array([element.lbasis(points, i)[0] for i in range(3)]).T
    return operator
