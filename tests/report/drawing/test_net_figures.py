"""Forces along the net turned into pressure; meshes drawn."""

import math
import re
from xml.etree import ElementTree

import numpy as np
import pytest

from netdesign.coupling.face import Face
from netdesign.report.drawing.net_figures import (
    MeshPicture,
    draw_meshes,
)

PRESSURE, SHEAR = 30e3, 6e3  # [Pa]
TILT = math.radians(30.0)


def build_face(*, is_quadratic):
    """Plane face 4 m high under uniform pressure and upward shear, exact forces."""
    along = np.array([math.sin(TILT), math.cos(TILT)])
    normal = np.array([along[1], -along[0]])
    distances = np.linspace(0.0, 4.0, 9)
    shares = np.full(9, 0.5)
    shares[[0, -1]] = 0.25
    if is_quadratic:  # Simpson: 1 4 2 4 2 4 2 4 1 times h / 6 of each edge of 1 m
        shares = np.array([1, 4, 2, 4, 2, 4, 2, 4, 1]) / 6.0
    traction = PRESSURE * normal + SHEAR * along
    return Face(
        points=np.outer(along, distances),
        forces=np.outer(traction, shares),
        is_quadratic=is_quadratic,
    )


@pytest.mark.parametrize("is_quadratic", [True, False])
def test_pressures_are_those_that_made_the_forces(is_quadratic):
    pressures = build_face(is_quadratic=is_quadratic).pressures
    assert pressures == pytest.approx(np.full(9, PRESSURE))


def texts(svg):
    tag = "{http://www.w3.org/2000/svg}text"
    return [element.text for element in ElementTree.fromstring(svg).iter(tag)]


def picture(density):
    nodes = np.array([[-4.0, 0.0, 0.0, -4.0], [0.0, 0.0, 2.0, 2.0]])
    triangles = np.array([[0, 0], [1, 2], [2, 3]])
    return MeshPicture(
        title="one",
        nodes=nodes,
        triangles=triangles,
        density=np.asarray(density),
        face=nodes[:, 1:3],
    )


def test_density_scale_spans_the_densities():
    shown = texts(draw_meshes([picture([300.0, 500.0])]))
    assert {"300", "400", "500", "density [kg/m³]"} <= set(shown)


def test_uniform_snow_needs_no_scale():
    shown = texts(draw_meshes([picture([300.0, 300.0])]))
    assert "density 300 kg/m³ throughout" in shown


def test_drawings_hold_no_pictures_that_could_be_blocked():
    svg = draw_meshes([picture([300.0, 500.0])])
    assert not re.search(r"<image|base64|<script", svg)
