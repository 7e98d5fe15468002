"""Meshes of the paper drawn, with the scale of their densities."""

import re
from xml.etree import ElementTree

import numpy as np

from netdesign.addons.evidence.paper.page import draw_meshes
from netdesign.addons.evidence.paper.study import Shape


def texts(svg):
    tag = "{http://www.w3.org/2000/svg}text"
    return [element.text for element in ElementTree.fromstring(svg).iter(tag)]


def picture(density):
    nodes = np.array([[-4.0, 0.0, 0.0, -4.0], [0.0, 0.0, 2.0, 2.0]])
    triangles = np.array([[0, 0], [1, 2], [2, 3]])
    density = np.asarray(density)
    curve = nodes[:, 1:3]
    return "one", Shape(nodes=nodes, triangles=triangles, density=density, curve=curve)


def test_density_scale_spans_the_densities():
    shown = texts(draw_meshes([picture([300.0, 500.0])]))
    assert {"300", "400", "500", "density [kg/m³]"} <= set(shown)


def test_uniform_snow_needs_no_scale():
    shown = texts(draw_meshes([picture([300.0, 300.0])]))
    assert "density 300 kg/m³ throughout" in shown


def test_drawings_hold_no_pictures_that_could_be_blocked():
    svg = draw_meshes([picture([300.0, 500.0])])
    assert not re.search(r"<image|base64|<script", svg)
