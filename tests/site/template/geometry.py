"""Draws what the input workbook asks for: one section with every symbol on it.

``python -m tests.site.template.geometry`` writes the pictures that the package holds:
drawn each time, they would cost every ``check --example`` a second.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from netdesign.site.columns.all_tables import NETS, USUAL_QUANTITIES, load_file
from netdesign.site.template import workbook
from netdesign.site.template.workbook import name_picture
from netdesign.words.catalogue import LANGUAGES, Language

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_INK, _SOFT, _ACCENT, _SNOW = "#1b1e22", "#596069", "#b23a1e", "#e6edf4"
_DPI = 200
_COLOURS = 48
_SIZE_IN = (7.36, 5.4)
SYMBOLS = {
    one.key: one.symbol for one in (*NETS.fields, *USUAL_QUANTITIES) if one.symbol
}

# Of the section that is drawn; chosen so that nothing covers anything else.
_SLOPE = math.radians(33)
_INCLINATION = math.radians(30)
_POST_TILT = math.radians(7)
_HEIGHT, _THICKNESS = 4.0, 3.3
_UPHILL, _DOWNHILL, _LENGTH = 3.6, 3.6, 9.2
_SAG = 0.4

_Point = tuple[float, float]


def draw_geometry(language: Language) -> bytes:
    """PNG of the section, with the words of a language; equal bytes each time."""
    from matplotlib.figure import Figure

    texts = {
        **load_file("words/en")["drawing"],
        **load_file(f"words/{language}").get("drawing", {}),
    }
    figure = Figure(figsize=_SIZE_IN, facecolor="white")
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_axis_off()
    axes.set_aspect("equal")
    _draw_ground_and_snow(axes, texts)
    _draw_support(axes, texts)
    _draw_sizes(axes)
    _draw_angles(axes)
    axes.set_xlim(-9.2, 9.2)
    axes.set_ylim(-5.6, 7.9)
    content = BytesIO()
    figure.savefig(content, format="png", dpi=_DPI, metadata={"Software": None})
    return content.getvalue()


def _turn(x: float, y: float) -> _Point:
    """Point of the slope's axes (X downslope, Y normal) on the page."""
    cos, sin = math.cos(_SLOPE), math.sin(_SLOPE)
    return x * cos + y * sin, -x * sin + y * cos


def _head() -> _Point:
    return _HEIGHT * math.tan(_INCLINATION), _HEIGHT


def _net_points() -> list[_Point]:
    x_head, y_head = _head()
    points = []
    for k in range(41):
        s = k / 40
        bulge = 4 * _SAG * s * (1 - s)
        x = s * x_head + bulge * math.cos(_INCLINATION)
        points.append((x, s * y_head - bulge * math.sin(_INCLINATION)))
    return points


def _line(axes: Axes, points: list[_Point], color: str = _INK, **style: object) -> None:
    places = [_turn(x, y) for x, y in points]
    axes.plot(*zip(*places, strict=True), color=color, **style)  # type: ignore[arg-type]


def _label(
    axes: Axes, x: float, y: float, text: str, color: str = _INK, **style: object
) -> None:
    given = {"ha": "center", "va": "center", "fontsize": 9.5, **style}
    axes.text(*_turn(x, y), text, color=color, **given)  # type: ignore[arg-type]


def _draw_ground_and_snow(axes: Axes, texts: Mapping[str, str]) -> None:
    below = [point for point in _net_points() if point[1] <= _THICKNESS]
    snow = [(-_LENGTH, 0.0), *below, (below[-1][0], _THICKNESS), (-_LENGTH, _THICKNESS)]
    corners = [_turn(x, y) for x, y in snow]
    axes.fill(*zip(*corners, strict=True), color=_SNOW, linewidth=0)
    _line(axes, [(-_LENGTH, _THICKNESS), (below[-1][0], _THICKNESS)], _SOFT, lw=0.8)
    _line(axes, [(-_LENGTH - 0.8, 0.0), (9.4, 0.0)], lw=1.6)
    for k in range(36):
        x = -_LENGTH - 0.6 + 0.5 * k
        _line(axes, [(x, 0.0), (x - 0.16, -0.22)], _SOFT, lw=0.6)
    _label(axes, -2.6, 2.55, texts["snow"], _SOFT, fontsize=11, style="italic")


def _draw_support(axes: Axes, texts: Mapping[str, str]) -> None:
    x_head, y_head = _head()
    x_base = x_head - y_head * math.tan(_POST_TILT)
    x_down = x_base + _DOWNHILL
    _line(axes, [(-_UPHILL, 0), (x_head, y_head)], lw=1.1)
    _line(axes, [(x_down, 0), (x_head, y_head)], lw=1.1)
    _line(axes, [(x_base, 0), (x_head, y_head)], lw=3.2, solid_capstyle="round")
    _line(axes, _net_points(), _ACCENT, lw=2.0)
    for x, key in ((-_UPHILL, "uphill_anchor"), (0.0, "foot_anchor")):
        _draw_anchor(axes, x, texts[key])
    _draw_anchor(axes, x_down, texts["downhill_anchor"])
    _label(axes, 0.52, 1.6, texts["net"], _ACCENT)
    _label(axes, x_base + 0.35, 1.2, texts["post"], ha="left")
    _label(axes, -1.55, 1.72, texts["uphill_guy"], va="bottom", fontsize=9)
    _label(axes, x_down - 0.6, 1.7, texts["downhill_guy"], ha="left", fontsize=9)


def _draw_anchor(axes: Axes, x: float, name: str) -> None:
    _line(axes, [(x, 0.0), (x - 0.3, -0.85)], lw=2.2, solid_capstyle="round")
    _label(
        axes,
        x - 0.3,
        -1.3,
        name,
        fontsize=9,
        rotation=-math.degrees(_SLOPE),
        rotation_mode="anchor",
    )


def _draw_sizes(axes: Axes) -> None:
    x_head, y_head = _head()
    x_base = x_head - y_head * math.tan(_POST_TILT)
    x_down = x_base + _DOWNHILL
    _measure(axes, (-_LENGTH, -2.0), (0.0, -2.0), SYMBOLS["upslope_length"])
    _measure(axes, (-_UPHILL, -0.55), (-0.25, -0.55), SYMBOLS["uphill_anchor_distance"])
    _measure(
        axes,
        (x_base, -0.55),
        (x_down - 0.25, -0.55),
        SYMBOLS["downhill_anchor_distance"],
    )
    _measure(axes, (-8.0, 0.0), (-8.0, _THICKNESS), SYMBOLS["snow_thickness"])
    x = x_down + 2.4
    _line(axes, [(x_head, y_head), (x + 0.2, y_head)], _SOFT, lw=0.6, ls=(0, (4, 3)))
    _measure(axes, (x, 0.0), (x, y_head), SYMBOLS["net_height"])
    # the vertical height, seen from the same surface as the thickness
    rise = _THICKNESS * math.tan(_SLOPE)
    _measure(axes, (-4.4, 0.0), (-4.4 - rise, _THICKNESS), SYMBOLS["snow_height"])


def _measure(axes: Axes, start: _Point, end: _Point, symbol: str) -> None:
    """Draw a dimension line with its symbol in the middle."""
    places = {"xy": _turn(*end), "xytext": _turn(*start)}
    arrow = {
        "arrowstyle": "<|-|>",
        "color": _SOFT,
        "lw": 0.8,
        "shrinkA": 0,
        "shrinkB": 0,
    }
    axes.annotate("", **places, arrowprops=arrow)  # type: ignore[arg-type]
    middle = (start[0] + end[0]) / 2, (start[1] + end[1]) / 2
    box = {"facecolor": "white", "edgecolor": "none", "pad": 1.2}
    _label(axes, *middle, symbol, fontsize=11.5, fontweight="bold", bbox=box)


def _draw_angles(axes: Axes) -> None:
    """Slope against the horizontal, net and post against the slope normal."""
    x_head, y_head = _head()
    x_base = x_head - y_head * math.tan(_POST_TILT)
    corner = _turn(9.4, 0.0)
    axes.plot([corner[0] - 2.6, corner[0]], [corner[1]] * 2, color=_SOFT, lw=0.8)
    slope = math.degrees(_SLOPE)
    _arc(axes, corner, 1.6, 180.0 - slope, 180.0, SYMBOLS["slope_angle"])
    # angles of the page count from its horizontal; the slope normal leans by the slope
    normal = 90.0 - math.degrees(_SLOPE)
    for x, tilt, length, key in (
        (0.0, _INCLINATION, 4.9, "inclination"),
        (x_base, _POST_TILT, 5.2, "post_tilt"),
    ):
        _line(axes, [(x, 0.0), (x, length)], _SOFT, lw=0.8, ls=(0, (4, 3)))
        low = normal - math.degrees(tilt)
        _arc(axes, _turn(x, 0.0), length - 0.6, low, normal, SYMBOLS[key])


def _arc(
    axes: Axes, centre: _Point, radius: float, low: float, high: float, symbol: str
) -> None:
    from matplotlib.patches import Arc

    size = 2 * radius
    axes.add_patch(
        Arc(centre, size, size, theta1=low, theta2=high, color=_SOFT, lw=0.9)
    )
    middle = math.radians((low + high) / 2)
    axes.text(
        centre[0] + (radius + 0.4) * math.cos(middle),
        centre[1] + (radius + 0.4) * math.sin(middle),
        symbol,
        ha="center",
        va="center",
        fontsize=11.5,
        fontweight="bold",
        color=_INK,
    )


def write_pictures() -> None:
    """The pictures of all languages, of few colours: a quarter of the bytes."""
    from PIL import Image

    folder = Path(workbook.__file__).parent
    for language in LANGUAGES:
        picture = Image.open(BytesIO(draw_geometry(language))).convert("RGB")
        few = picture.quantize(_COLOURS, dither=Image.Dither.NONE)
        few.save(folder / name_picture(language), dpi=(_DPI, _DPI), optimize=True)


if __name__ == "__main__":
    write_pictures()
