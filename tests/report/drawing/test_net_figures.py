"""Forces along the net turned into pressure and shear; drawings that say so."""

import math
import re
from xml.etree import ElementTree

import numpy as np
import pytest

from netdesign.coupling.face import Face
from netdesign.report.drawing.net_figures import (
    MeshPicture,
    draw_meshes,
    draw_node_forces,
    draw_stick_slip,
)
from tests.digits import write_force

PRESSURE, SHEAR = 30e3, 6e3  # [Pa]
TILT = math.radians(30.0)


def build_face(*, is_quadratic=True, slides=None, friction=0.5):
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
        slides=np.zeros(9, bool) if slides is None else slides,
        friction=friction,
        is_quadratic=is_quadratic,
    )


@pytest.mark.parametrize("is_quadratic", [True, False])
def test_tractions_are_those_that_made_the_forces(is_quadratic):
    pressure, shear = build_face(is_quadratic=is_quadratic).tractions
    assert pressure == pytest.approx(np.full(9, PRESSURE))
    assert shear == pytest.approx(np.full(9, SHEAR))


def texts(svg):
    tag = "{http://www.w3.org/2000/svg}text"
    return [element.text for element in ElementTree.fromstring(svg).iter(tag)]


def test_stick_and_slip_are_counted_and_differ_without_colour():
    slides = np.arange(9) > 5
    shown = texts(draw_stick_slip(build_face(slides=slides)))
    assert "sticks: 5 of 7 nodes" in shown  # without the two ends
    assert "slips: 2 of 7 nodes" in shown


@pytest.mark.parametrize("friction", [0.0, None])
def test_without_a_limit_there_is_no_drawing(friction):
    assert draw_stick_slip(build_face(friction=friction)) == ""


def test_longest_arrow_is_the_largest_force():
    face = build_face()
    largest = np.hypot(*face.forces).max() / 1e3
    shown = texts(draw_node_forces(face))
    assert f"{write_force(largest)} kN/m" in shown


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
