"""Draws the section of the input workbook, with the names of its headings.

``python .ci/section.py`` writes the pictures that the package holds.
"""

import math
from io import BytesIO
from pathlib import Path

from matplotlib.figure import Figure

from netdesign.site.columns.office import load_columns
from netdesign.site.template import office_notes
from netdesign.words.catalogue import LANGUAGES

SLOPE, TILT, DIP = math.radians(35), math.radians(15), math.radians(15)
INK, SOFT, POST, ANCHOR, SNOW = "#1F2A36", "#777777", "#8C3B2A", "#A65E1A", "#6FA8DC"
HEAD, BASE, UPHILL, DOWNHILL, DEPTH = (1.75, 3.0), 0.95, -3.0, 3.9, 2.7


def turn(along, normal):
    """Point of the slope's axes on the page."""
    cos, sin = math.cos(SLOPE), math.sin(SLOPE)
    return along * cos + normal * sin, -along * sin + normal * cos


def draw_section(language):
    """PNG of the section in a language; equal bytes each time."""
    names = {
        (one.field.table, one.field.key): one.field.label_in(language)
        for table in ("rows", "net_types")
        for one in load_columns(table)
    }
    figure = Figure(figsize=(11.5, 5.6))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_aspect("equal")
    axes.axis("off")
    draw_lines(axes)
    draw_anchors(axes, names)
    draw_names(axes, names)
    draw_sizes(axes)
    content = BytesIO()
    figure.savefig(content, format="png", dpi=130, metadata={"Software": None})
    return content.getvalue()


def line(axes, start, end, **style):
    axes.plot(*zip(turn(*start), turn(*end), strict=True), **style)


def draw_lines(axes):
    line(axes, (-7, 0), (6.6, 0), color="#6B5B45", lw=2)
    line(axes, (-7, DEPTH), (1.55, DEPTH), color=SNOW, lw=1.2, ls="--")
    steps = [n / 30 for n in range(31)]
    bulges = [0.22 * math.sin(math.pi * n) for n in steps]
    net = [
        turn(1.75 * n + 0.87 * bulge, 3 * n - 0.5 * bulge)
        for n, bulge in zip(steps, bulges, strict=True)
    ]
    axes.plot(*zip(*net, strict=True), color=INK, lw=2.2)
    line(axes, (BASE, 0), HEAD, color=POST, lw=4, solid_capstyle="butt")
    for place in (UPHILL, DOWNHILL):
        line(axes, (place, 0), HEAD, color="#4A5A6A", lw=1.4)


def tip(axes, text, point, place, **style):
    arrow = {"arrowstyle": "-", "color": SOFT, "lw": 0.8}
    given = {"fontsize": 11, "color": INK, "arrowprops": arrow, **style}
    axes.annotate(text, point, place, **given)


def draw_anchors(axes, names):
    for place, length in ((UPHILL, 1.5), (0, 1.7)):
        x, y = turn(place, 0)
        reach = (x - length * math.cos(DIP), y - length * math.sin(DIP))
        axes.plot((x, reach[0]), (y, reach[1]), color=ANCHOR, lw=3)
    x, y = turn(DOWNHILL, 0)
    axes.plot((x, x - 0.35), (y, y - 1.3), color=ANCHOR, lw=3)
    tip(axes, names["rows", "downhill_anchor"], (x - 0.2, y - 0.8), (x - 0.2, y - 1.75))
    x, y = turn(0, 0)
    axes.plot((x - 2.6, x), (y, y), color="#999999", lw=0.7, ls=":")
    foot = names["rows", "foot_anchor"]
    tip(axes, foot, (x - 1.2, y - 0.32), (x - 2.6, y - 1.75), ha="center")
    degrees = {"ha": "right", "va": "center"}
    tip(axes, "15°", (x - 1.55, y - 0.18), (x - 2.75, y - 0.28), **degrees)
    x, y = turn(UPHILL, 0)
    uphill = names["rows", "uphill_anchor"]
    tip(axes, uphill, (x - 0.9, y - 0.24), (x - 2.4, y - 1.15), ha="center")


def draw_names(axes, names):
    x, y = turn(*HEAD)
    tip(axes, names["net_types", "post"], turn(1.22, 1.0), (x + 1.2, y - 1.5))
    height = names["net_types", "net_height"]
    tip(axes, height, turn(0.25, 2.2), (x + 0.9, y + 0.4))
    tip(axes, names["net_types", "uphill_guy"], turn(-1.3, 1.07), (x - 4.6, y + 1.0))
    tip(axes, names["net_types", "downhill_guy"], turn(2.6, 1.82), (x + 1.4, y - 0.5))
    x, y = turn(-5.4, DEPTH)
    tip(axes, names["rows", "snow"], (x, y), (x + 0.2, y + 0.75))


def draw_sizes(axes):
    both = {"arrowstyle": "<->", "color": SOFT}
    of_snow = {"arrowstyle": "<->", "color": SNOW}

    def size(start, end, style, text, place):
        axes.annotate("", start, end, arrowprops=style)
        if text:
            axes.text(*place, text, fontsize=11)

    size(turn(0.25, 0), turn(0.25, 3.0), both, "", (0, 0))
    start, end = turn(-5.4, 0), turn(-5.4, DEPTH)
    middle = ((start[0] + end[0]) / 2 + 0.1, (start[1] + end[1]) / 2)
    size(start, end, of_snow, "d", middle)
    x, y = turn(-4.4, 0)
    upright = y + DEPTH / math.cos(SLOPE)
    size((x, y), (x, upright), of_snow, "H", (x + 0.1, y + 0.7))
    for first, last, below, text in (
        (UPHILL, 0, -0.35, "e₁"),
        (BASE, DOWNHILL, -0.25, "e₂"),
    ):
        start, end = turn(first, below), turn(last, below)
        place = ((start[0] + end[0]) / 2 - 0.1, (start[1] + end[1]) / 2 - 0.38)
        size(start, end, both, text, place)
    x, y = turn(6.4, 0)
    axes.plot((x - 1.8, x), (y, y), color=SOFT, lw=0.8)
    axes.text(x - 1.35, y + 0.16, "ψ", fontsize=12)


def main():
    folder = Path(office_notes.__file__).parent
    for language in LANGUAGES:
        path = folder / office_notes.name_section(language)
        path.write_bytes(draw_section(language))


if __name__ == "__main__":
    main()
