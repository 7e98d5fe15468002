"""Drawings as PNG: the same shapes at the same places, on every machine."""

import io

import pytest
from PIL import Image

from netdesign.addons.charts import draw_tiles
from netdesign.report.drawing.plain_svg import Chart
from netdesign.report.drawing.raster import (
    DOTS_PER_INCH,
    render_png,
)


def draw(sketch):
    svg = sketch.write(72.0, "A <title>", width=144.0)
    return Image.open(io.BytesIO(render_png(svg))).convert("RGB")


def look(picture, x, y):
    """Colour at a place in points."""
    scale = DOTS_PER_INCH / 72.0
    return picture.getpixel((int(x * scale), int(y * scale)))


def test_shapes_stand_where_the_drawing_has_them():
    sketch = Chart()
    draw_tiles(sketch, [(10.0, 10.0, 20.0, 10.0, "#b23a1e")])
    sketch.area([(60.0, 10.0), (90.0, 10.0), (90.0, 40.0), (60.0, 40.0)], "#7d838b")
    sketch.line([(0.0, 61.3), (144.0, 61.3)], stroke="#1b1e22", width=4.0)
    draw_tiles(sketch, [(100.0, 20.0, 12.0, 8.0, "#d3d7dc")])
    sketch.dot((120.0, 50.0), 5.0, fill="#b23a1e")
    picture = draw(sketch)
    assert picture.size == (400, 200)
    assert look(picture, 20, 15) == look(picture, 120, 50) == (0xB2, 0x3A, 0x1E)
    assert look(picture, 75, 30) == (0x7D, 0x83, 0x8B)
    assert look(picture, 40, 61.3) == (0x1B, 0x1E, 0x22)
    assert look(picture, 106, 24) == (0xD3, 0xD7, 0xDC)
    assert look(picture, 20, 30) == look(picture, 40, 15) == (255, 255, 255)


@pytest.mark.parametrize(
    "shape", ['<image x="1"/>', '<path d="M0 0Q1 1 2 2"/>', '<path d="M0 0L1 1 2 2"/>']
)
def test_an_unknown_shape_is_a_fault_never_a_gap(shape):
    svg = Chart().write(72.0, "A", width=144.0).replace("</svg>", f"{shape}</svg>")
    with pytest.raises(ValueError, match="not known"):
        render_png(svg)
