"""SVG of ours -> PNG, for programs that show no SVG.

Only what the drawings of a net row consist of is known; anything else is an error. The
letters are those of the font that matplotlib brings along, so that bytes do not depend
on the machine.
"""

from __future__ import annotations

import io
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree

from netdesign.report.drawing.plain_svg import measure_words

if TYPE_CHECKING:
    from matplotlib.path import Path

DOTS_PER_INCH = 200
_SCALE = DOTS_PER_INCH / 72.0  # of a point [pixels]
_STEP = re.compile(r"([A-DF-Za-df-z])([^A-DF-Za-df-z]*)")  # e is an exponent
_SIZES = {"M": 2, "L": 2, "l": 2, "H": 1, "h": 1, "V": 1, "v": 1, "Z": 0, "z": 0}
_NUMBER = re.compile(r"-?[\d.]+(?:e-?\d+)?")
_NUMBER_OF_COLOURS = 256

Look = Mapping[str, str]


@dataclass(frozen=True, slots=True)
class _Paper:
    """Surface to draw on: a renderer and its height."""

    renderer: Any  # matplotlib's, which has no types
    height: float  # [pt]


def read_size(svg: str) -> tuple[float, float]:
    """Width and height of a drawing [pt]."""
    frame = ElementTree.fromstring(svg).attrib["viewBox"].split()
    return float(frame[2]), float(frame[3])


def read_title(svg: str) -> str:
    """Words that stand for a drawing where it cannot be seen."""
    return ElementTree.fromstring(svg).attrib["aria-label"]


def render_png(svg: str) -> bytes:
    """PNG of a drawing, the same bytes each time.

    Raises
    ------
    ValueError
        If the drawing has a shape that is not known here.
    """
    from matplotlib.backends import backend_agg

    new_renderer: Any = backend_agg.RendererAgg
    root = ElementTree.fromstring(svg)
    width, height = read_size(svg)
    size = (round(width * _SCALE), round(height * _SCALE))
    paper = _Paper(new_renderer(*size, DOTS_PER_INCH), height)
    for shape, look in _list_shapes(root, {}):
        _draw(paper, shape, look)
    return _write_png(paper.renderer)


def _list_shapes(
    parent: ElementTree.Element, look: Look
) -> Iterator[tuple[ElementTree.Element, Look]]:
    """Shapes in the order of painting, each with what it and its groups say."""
    inherited = {**look, **parent.attrib}
    for child in parent:
        if _name(child) == "g":
            yield from _list_shapes(child, inherited)
        else:
            yield child, {**inherited, **child.attrib}


def _name(element: ElementTree.Element) -> str:
    return str(element.tag).rpartition("}")[2]


def _draw(paper: _Paper, shape: ElementTree.Element, look: Look) -> None:
    kind = _name(shape)
    if kind == "text":
        _write(paper, shape.text or "", look)
    else:
        _paint(paper, _trace(paper, kind, look), look)


def _trace(paper: _Paper, kind: str, look: Look) -> Path:
    """Outline of a shape in pixels, upwards."""
    from matplotlib.path import Path

    if kind == "circle":
        middle = (float(look["cx"]), float(look["cy"]))
        return _place(paper, Path.circle(middle, float(look["r"])))
    if kind == "path":
        return _place(paper, _follow(look["d"]))
    points = _list_corners(kind, look)
    is_closed = kind != "polyline"
    if is_closed:
        points.append(points[0])
    return _place(paper, Path(points, closed=is_closed))


def _list_corners(kind: str, look: Look) -> list[tuple[float, float]]:
    if kind not in ("polyline", "polygon"):
        raise ValueError(f"a drawing has a shape that is not known: {kind}")
    pairs = (pair.split(",") for pair in look["points"].split())
    return [(float(x), float(y)) for x, y in pairs]


def _follow(steps: str) -> Path:
    """Points of the steps of a path: straight ones only."""
    from matplotlib.path import Path

    points: list[tuple[float, float]] = []
    codes: list[Any] = []
    x = y = 0.0
    for command, text in _STEP.findall(steps):
        numbers = [float(number) for number in _NUMBER.findall(text)]
        if len(numbers) != _SIZES.get(command):
            raise ValueError(f"a drawing has a step that is not known: {command}{text}")
        dx, dy = (x, y) if command.islower() else (0.0, 0.0)
        if command in "MLl":
            x, y = numbers[0] + dx, numbers[1] + dy
        elif command in "Hh":
            x = numbers[0] + dx
        elif command in "Vv":
            y = numbers[0] + dy
        points.append((x, y))
        special = {"M": Path.MOVETO, "Z": Path.CLOSEPOLY, "z": Path.CLOSEPOLY}
        codes.append(special.get(command, Path.LINETO))
    return Path(points, codes)


def _place(paper: _Paper, path: Path) -> Path:
    """The same path in pixels, counted from the lower edge."""
    from matplotlib.transforms import Affine2D

    to_paper = Affine2D().scale(_SCALE, -_SCALE).translate(0.0, paper.height * _SCALE)
    return to_paper.transform_path(path)


def _paint(paper: _Paper, path: Path, look: Look) -> None:
    from matplotlib.colors import to_rgba
    from matplotlib.transforms import IdentityTransform

    pen = paper.renderer.new_gc()
    stroke, fill = look.get("stroke", "none"), look.get("fill", "none")
    width = float(look.get("stroke-width", "1")) if stroke != "none" else 0.0
    pen.set_linewidth(width)
    pen.set_foreground(to_rgba("#000" if stroke == "none" else stroke), isRGBA=True)
    pen.set_joinstyle("miter")
    if look.get("stroke-dasharray"):
        pen.set_dashes(0, [float(n) for n in look["stroke-dasharray"].split()])
    inside = None if fill == "none" else to_rgba(fill)
    paper.renderer.draw_path(pen, path, IdentityTransform(), inside)


def _write(paper: _Paper, text: str, look: Look) -> None:
    """One line of text; signs that the font lacks become question marks.

    The font is wider than those that the drawings reckon with: its letters are made
    smaller, as far as a line would be too long.
    """
    from matplotlib.colors import to_rgba
    from matplotlib.font_manager import FontProperties, findfont, get_font

    size = float(look["font-size"])
    font = FontProperties(
        family="DejaVu Sans", size=size, weight=look.get("font-weight", "normal")
    )
    known = get_font(findfont(font)).get_charmap()
    text = "".join(sign if ord(sign) in known else "?" for sign in text)
    width, _, _ = paper.renderer.get_text_width_height_descent(text, font, False)
    most = _SCALE * measure_words(text, size)
    if width > most:
        font.set_size(size * most / width)
        width, _, _ = paper.renderer.get_text_width_height_descent(text, font, False)
    share = {"middle": 0.5, "end": 1.0}.get(look.get("text-anchor", ""), 0.0)
    x = float(look["x"]) * _SCALE - share * width
    pen = paper.renderer.new_gc()
    pen.set_foreground(to_rgba(look["fill"]), isRGBA=True)
    paper.renderer.draw_text(pen, x, float(look["y"]) * _SCALE, text, font, 0.0)


def _write_png(renderer: Any) -> bytes:
    """PNG on white; few colours, so that a report of many rows can be sent by mail."""
    from PIL import Image

    size = (int(renderer.width), int(renderer.height))
    drawn = Image.frombytes("RGBA", size, bytes(renderer.buffer_rgba()))
    paper = Image.new("RGBA", drawn.size, "white")
    paper.alpha_composite(drawn)
    few = paper.convert("RGB").quantize(_NUMBER_OF_COLOURS, dither=Image.Dither.NONE)
    buffer = io.BytesIO()
    dots = (DOTS_PER_INCH, DOTS_PER_INCH)
    few.save(buffer, "PNG", optimize=True, dpi=dots)
    return buffer.getvalue()
