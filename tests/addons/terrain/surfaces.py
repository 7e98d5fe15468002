"""Grids of surfaces whose slopes and lengths are known, turned and shifted at will."""

import math

import numpy as np
import shapely

from netdesign.addons.terrain.grid import Grid
from netdesign.addons.terrain.plan import NetLine, Plan

SPACING = 3.0


def build_grid(
    height, *, cell=1.0, size=120.0, turned=0.0, shift=(0.0, 0.0), noise=0.0
):
    """Grid of ``height(x, y)``, y up the slope, turned about its middle."""
    count = round(size / cell) + 1
    own = cell * (np.arange(count) - count // 2)
    east, north = np.meshgrid(own + shift[0], own + shift[1])
    x, y = turn(east - shift[0], north - shift[1], -turned)
    heights = height(x, y)
    if noise:
        heights = heights + np.random.default_rng(7).normal(0.0, noise, heights.shape)
    return Grid(
        west=own[0] + shift[0], south=own[0] + shift[1], cell=cell, heights=heights
    )


def turn(x, y, angle):
    cosine, sine = math.cos(angle), math.sin(angle)
    return cosine * x - sine * y, sine * x + cosine * y


def draw_line(points, *, name="R1", turned=0.0, shift=(0.0, 0.0), **cells):
    """Row through points in the surface's own axes."""
    x, y = turn(*np.array(points, dtype=float).T, turned)
    given = {"id": name, "net_height": 3.0, "post_spacing": SPACING}
    return NetLine(id=name, points=np.column_stack((x, y)) + shift, cells=given | cells)


def plan_of(*lines, zones=()):
    return Plan(lines=lines, zones=tuple(map(shapely.Polygon, zones)))


def plane(angle):
    return lambda x, y: 1500.0 + math.tan(angle) * y + 0.0 * x
