"""Own numbering and shape functions against scikit-fem's, to the last digit."""

import numpy as np
import pytest
import skfem
from scipy.spatial import Delaunay
from skfem.quadrature import get_quadrature

from netdesign.snow.element import (
    QUADRATURE_DEGREE,
    add_pressure_rows,
    reference_element,
)
from netdesign.snow.triangulation import number_nodes


def drawn_triangles(seed, count):
    """Points on no grid, and triangles in any order."""
    rng = np.random.default_rng(seed)
    points = rng.uniform(-3.7, 11.3, (count, 2))
    triangles = Delaunay(points).simplices.astype(np.int64)
    order = rng.permuted(np.tile(np.arange(3), (len(triangles), 1)), axis=1)
    return points, np.take_along_axis(triangles, order, axis=1)


@pytest.mark.parametrize(("seed", "count"), [(1, 3), (2, 17), (3, 211)])
def test_nodes_and_edges_are_those_of_scikit_fem(seed, count):
    points, triangles = drawn_triangles(seed, count)
    mesh = skfem.MeshTri(points.T.copy(), triangles.T.copy())
    basis = skfem.Basis(mesh, skfem.ElementTriP2(), intorder=1)
    found = number_nodes(points, triangles)
    assert np.array_equal(found.nodes, basis.doflocs)
    assert np.array_equal(found.triangles, basis.element_dofs)
    assert np.array_equal(found.edges, mesh.facets)
    assert np.array_equal(found.boundary, mesh.boundary_facets())
    assert found.nodes.shape[1] - found.edges.shape[1] == count


def test_shape_functions_are_those_of_scikit_fem():
    element = skfem.ElementTriP2()
    points, weights = get_quadrature(element.refdom, QUADRATURE_DEGREE)
    shape, gradients, found_weights = reference_element()
    for number in range(6):
        value, gradient = element.lbasis(points, number)
        assert np.array_equal(shape[:, number], value)
        assert np.array_equal(gradients[number], gradient)
    assert np.array_equal(found_weights, weights)


def test_pressures_are_linear_as_those_of_scikit_fem():
    element = skfem.ElementTriP1()
    points, _ = get_quadrature(element.refdom, QUADRATURE_DEGREE)
    operator = add_pressure_rows(np.zeros((2, points.shape[1], 3, 12)))
    for number in range(3):
        wanted = element.lbasis(points, number)[0]
        assert np.array_equal(operator[1, :, 3, 12 + number], wanted)
