"""The element: six-node triangles, their shape functions, strains and unknowns.

Unknowns are velocities, interleaved by node; then, in the mixed element, one pressure
per vertex. Templates of like aspects are one triangulation, its columns stretched: a
search for a limit moves the aspect in small steps. What hangs on the numbers of nodes
and on their heights alone, above all the order of elimination, is then found once.
Theory: snow/THEORY.md, section 3.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable
from dataclasses import replace
from functools import lru_cache, wraps
from typing import Concatenate, Literal, ParamSpec, TypeVar, cast

import numpy as np

from netdesign.numerics.arrays import Floats, Ints, freeze
from netdesign.snow.mesh import (
    BESIDE,
    MeshSize,
    MeshTemplate,
    build_template,
    require_aspect,
)

# Preferred numbers of ISO 3, twenty to a decade: steps of an eighth at most.
_PREFERRED = (
    *(1.0, 1.12, 1.25, 1.4, 1.6, 1.8, 2.0, 2.24, 2.5, 2.8),
    *(3.15, 3.55, 4.0, 4.5, 5.0, 5.6, 6.3, 7.1, 8.0, 9.0, 10.0),
)
_SHORTEST = 1.5  # snowpacks that are shorter have too few columns to stretch

Given = ParamSpec("Given")
Found = TypeVar("Found")


@lru_cache(maxsize=256)
def share_template(
    aspect: float, size: MeshSize, interfaces: tuple[float, ...] = ()
) -> MeshTemplate:
    """Reference mesh of a snowpack, which all of about its aspect have.

    Parameters
    ----------
    aspect : float
        Upslope length over thickness [-].
    size : MeshSize
        Resolution.
    interfaces : tuple of float
        Heights between layers over the thickness, ascending [-].

    Raises
    ------
    ModelError
        If the aspect is out of its range.
    """
    require_aspect(aspect)
    near = find_preferred(aspect) if aspect > _SHORTEST else aspect
    template = build_template(near, size, interfaces)
    return template if near == aspect else stretch_template(template, aspect)


def find_preferred(value: float) -> float:
    """Preferred number next to a value, by their ratio.

    Parameters
    ----------
    value : float
        Positive [-].
    """
    decade = 10.0 ** math.floor(math.log10(value))
    return min(
        (round(step * decade, 12) for step in _PREFERRED),
        key=lambda step: abs(math.log(step / value)),
    )


def stretch_template(template: MeshTemplate, aspect: float) -> MeshTemplate:
    """Template with its columns moved apart, or together; the rings stay.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.
    aspect : float
        Wanted upslope length over thickness [-].
    """
    ratio = (aspect - BESIDE) / (template.aspect - BESIDE)
    nodes = template.nodes.copy()
    beyond = np.maximum(nodes[0] - BESIDE, 0.0)
    nodes[0] += (ratio - 1.0) * beyond
    nodes[0, template.upstream] = aspect
    start, end = template.edges
    nodes[0, template.n_vertices :] = (nodes[0, start] + nodes[0, end]) / 2.0
    return replace(template, nodes=freeze(nodes), aspect=aspect, source=template.origin)


def find_once(
    find: Callable[Concatenate[MeshTemplate, Given], Found],
) -> Callable[Concatenate[MeshTemplate, Given], Found]:
    """Function of a template's numbers and heights, asked once for all that share them.

    Parameters
    ----------
    find : callable
        Of a template, and of what else can be a key.
    """
    cached = lru_cache(maxsize=256)(find)

    @wraps(cached)
    def find_of_origin(
        template: MeshTemplate, *arguments: Hashable, **named: Hashable
    ) -> Found:
        return cached(template.origin, *arguments, **named)

    return cast("Callable[Concatenate[MeshTemplate, Given], Found]", find_of_origin)


# Degree of exactness: strain rates of straight triangles are linear, the creep law of
# them is not. Three points a triangle; six (degree 4) move end forces by some 0.005 %,
# at most 0.1 %, and not nearer to the truth.
QUADRATURE_DEGREE = 2
# Places of the three points in the reference triangle, of equal weight.
_POINTS = ((1.0 / 6.0, 1.0 / 6.0), (2.0 / 3.0, 1.0 / 6.0), (1.0 / 6.0, 2.0 / 3.0))

Element = Literal["velocity", "mixed"]


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


@find_once
def _touch_net(template: MeshTemplate) -> Ints:
    """Triangles with a node on the net, whose axes are turned."""
    return np.flatnonzero(np.isin(template.triangles, template.net).any(axis=0))


@lru_cache(maxsize=1)
def reference_element() -> tuple[Floats, Floats, Floats]:
    """Shape functions (n_points, 6), gradients (6, 2, n_points), weights.

    The order of the sums is scikit-fem's: the two agree to the last digit.
    """
    x, y = np.array(_POINTS).T
    values = [
        1.0 - 3.0 * x - 3.0 * y + 2.0 * x**2 + 4.0 * x * y + 2.0 * y**2,
        2.0 * x**2 - x,
        2.0 * y**2 - y,
        4.0 * x - 4.0 * x**2 - 4.0 * x * y,
        4.0 * x * y,
        4.0 * y - 4.0 * x * y - 4.0 * y**2,
    ]
    gradients = [
        [-3.0 + 4.0 * x + 4.0 * y, -3.0 + 4.0 * x + 4.0 * y],
        [4.0 * x - 1.0, 0.0 * x],
        [0.0 * x, 4.0 * y - 1.0],
        [4.0 - 8.0 * x - 4.0 * y, -4.0 * x],
        [4.0 * y, 4.0 * x],
        [-4.0 * y, 4.0 - 4.0 * x - 8.0 * y],
    ]
    return np.array(values).T, np.array(gradients), np.full(x.size, 0.5 / x.size)


@find_once
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
        X and Y of each node in turn, then the pressures.
    """
    first = 2 * template.triangles.T
    dofs = np.stack([first, first + 1], axis=-1).reshape(len(first), 12)
    if element == "mixed":
        pressures = 2 * template.nodes.shape[1] + template.triangles[:3].T
        dofs = np.hstack([dofs, pressures])
    return freeze(dofs)


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
    x, y = np.array(_POINTS).T
    operator = np.zeros((*strain.shape[:2], 4, 15))
    operator[..., :3, :12] = strain
    operator[..., 3, 12:] = np.array([1.0 - x - y, x, y]).T
    return operator
