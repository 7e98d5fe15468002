"""Page of `netdesign paper`: drawings with their meshes, and tables."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from netdesign import __version__
from netdesign.addons.charts import (
    GREYS,
    Line,
    Mark,
    Panel,
    draw_panels,
    draw_tiles,
    shade,
)
from netdesign.addons.evidence.paper.study import (
    ASSUMED_SLOPE_DEG,
    ASSUMED_STIFFNESS,
    DESIGN_NET_DEG,
    FRICTIONS_DEG,
    LENGTH,
    NETS_DEG,
    NORMAL_NET_DEG,
    RELATIVE_DENSITY,
    THICKNESS,
    PaperCase,
    PaperStudy,
    Track,
    find_exchange,
    find_history,
    find_paper_time,
    find_steady,
    list_tables,
)
from netdesign.addons.history.moments import CRITERION
from netdesign.coupling.solution import Solution
from netdesign.numerics.arrays import Floats
from netdesign.report.blocks import (
    Block,
    Figure,
    Heading,
    Paragraph,
    Part,
    masthead,
    section,
)
from netdesign.report.drawing.plain_svg import (
    ACCENT,
    TEXT_PT,
    WIDTH,
    Chart,
    Point,
    show_place,
)
from netdesign.report.page import render_page
from netdesign.report.words import ENGLISH
from netdesign.units import day_from_second, kilonewton_from_newton

_STACKED = 0.84  # width of meshes below each other, so that five fit on a page
_SCALE_PT = 150.0  # width of the density scale [pt]
_ONE_DENSITY = 0.5  # [kg/m3] below which snow counts as uniform
# Share of the snow's area, at each end, that the shades need not tell apart: one that
# is all but empty at the overhanging surface would flatten all others.
_OUTLIERS = 0.005


def draw_meshes(named: Sequence[tuple[str, Solution]]) -> str:
    """SVG of deformed meshes below each other, to one scale of length and density."""
    pictures = [solution for _, solution in named]
    wide = max(float(np.ptp(picture.mesh_nodes[0])) for picture in pictures)
    tall = max(float(picture.mesh_nodes[1].max()) for picture in pictures)
    right = max(float(picture.net_curve[0].max()) for picture in pictures)
    shown = 1.0 if len(pictures) == 1 else _STACKED
    scale = shown * (WIDTH - 22.0) / (1.02 * wide)
    each = scale * tall * 1.06 + 22.0
    quantiles = [_find_ends(picture) for picture in pictures]
    limits = (min(low for low, _ in quantiles), max(high for _, high in quantiles))
    sketch = Chart()
    for place, (title, picture) in enumerate(named):
        base = np.array([(wide * 1.03 - right) * scale, each * (place + 1) - 6.0])
        sketch.text(2.0, each * place + TEXT_PT + 2.0, title, bold=True)
        _draw_mesh(sketch, picture, base, scale, limits)
    height = each * len(pictures) + 36.0
    _draw_scale(sketch, limits, height)
    density = ENGLISH("net_drawing.density")
    values = (ENGLISH("show.label", label=density, text=ENGLISH.show_range(limits)),)
    what = ENGLISH("net_drawing.mesh")
    return sketch.write(
        height, ENGLISH("drawing.with_values", what=what, values=values)
    )


def _find_ends(picture: Solution) -> tuple[float, float]:
    """Low and high density; nearly all of the snow's area lies between them."""
    corners, density = picture.mesh_triangles, picture.mesh_density
    first, second, third = (picture.mesh_nodes[:, corner] for corner in corners)
    side, other = second - first, third - first
    areas = np.abs(side[0] * other[1] - side[1] * other[0])
    order = np.argsort(density)
    shares = np.cumsum(areas[order]) / areas.sum()
    low, high = np.searchsorted(shares, [_OUTLIERS, 1.0 - _OUTLIERS])
    return float(density[order[low]]), float(density[order[high]])


def _place_points(points: Floats, base: Floats, scale: float) -> list[Point]:
    """Points (2, n) [m] on paper; y upwards from the base [pt]."""
    across, down = base[0] + scale * points[0], base[1] - scale * points[1]
    return [(float(x), float(y)) for x, y in zip(across, down, strict=True)]


def _draw_mesh(
    sketch: Chart,
    picture: Solution,
    base: Floats,
    scale: float,
    limits: tuple[float, float],
) -> None:
    """Triangles, those of one shade in one path, with ground and net."""
    corners = _place_points(picture.mesh_nodes, base, scale)
    paths: dict[str, str] = {}
    triangles, densities = picture.mesh_triangles.T, picture.mesh_density
    for triangle, density in zip(triangles, densities, strict=True):
        fill = _shade(float(density), limits)
        path = "L".join(
            f"{show_place(corners[k][0])} {show_place(corners[k][1])}" for k in triangle
        )
        paths[fill] = f"{paths.get(fill, '')}M{path}z"
    for fill, path in paths.items():
        sketch.shapes.append(
            f'<path d="{path}" fill="{fill}" stroke="#fff" stroke-width="0.25"/>'
        )
    ends = [float(picture.mesh_nodes[0].min()), float(picture.net_curve[0].max())]
    sketch.line(_place_points(np.array([ends, [0.0, 0.0]]), base, scale), width=1.0)
    face = _place_points(picture.net_curve, base, scale)
    sketch.line(face, stroke=ACCENT, width=1.5)
    for at in (face[0], face[-1]):
        sketch.dot(at, 1.5, fill=ACCENT, stroke=ACCENT)


def _shade(density: float, limits: tuple[float, float]) -> str:
    """Grey of a density, of the loosest snow still darker than paper."""
    low, high = limits
    if high - low < _ONE_DENSITY:
        low, high = low - 50.0, low + 50.0
    return shade(density, low - 0.15 * (high - low), high)


def _draw_scale(sketch: Chart, limits: tuple[float, float], height: float) -> None:
    """Shades of the densities, three of them named."""
    low, high = limits
    if high - low < _ONE_DENSITY:
        text = ENGLISH("net_drawing.one_density", density=low)
        sketch.text(6.0, height - 9.0, text)
        return
    step = _SCALE_PT / len(GREYS)
    middles = [(place + 0.5) / len(GREYS) for place in range(len(GREYS))]
    fills = [_shade(low + middle * (high - low), limits) for middle in middles]
    tiles = [
        (10.0 + place * step, height - 22.0, step + 0.2, 7.0, fill)
        for place, fill in enumerate(fills)
    ]
    draw_tiles(sketch, tiles)
    for share in (0.0, 0.5, 1.0):
        at, shown = 10.0 + share * _SCALE_PT, f"{low + share * (high - low):.0f}"
        sketch.text(at, height - 4.0, shown, anchor="middle")
    sketch.text(24.0 + _SCALE_PT, height - 15.5, ENGLISH("net_drawing.density"))


_NODES = ("lower", "upper")
# Creep time in which a straight net finds its first shape: not drawn.
_SETTLED = 1e-5


Plate = tuple[str, Figure]  # heading and drawing


def draw_plates(study: PaperStudy) -> list[Plate]:
    """All drawings, in the order of the page; those without a run are left out."""
    plates = [
        _plate_nodes(study, "staggered"),
        _plate_nodes(study, "implicit"),
        _plate_meshes(study),
        _plate_methods(study),
    ]
    return [plate for plate in plates if plate is not None]


def _plate_nodes(study: PaperStudy, kind: str) -> Plate | None:
    drag = study.settings.exchange_drag
    find = {"staggered": find_exchange, "implicit": find_history}[kind]
    runs = [study[find(NORMAL_NET_DEG, phi)] for phi in FRICTIONS_DEG]
    tracks = [(run.case, run.track) for run in runs if run.track is not None]
    if len(tracks) < len(runs):
        return None
    lower, upper = tracks[0][1].heights
    heading = ENGLISH(f"paper_plate.nodes_{kind}")
    shown = ENGLISH("paper_plate.nodes", lower=lower, upper=upper)
    svg = draw_panels(
        _list_node_panels(tracks, is_thin=kind == "staggered"),
        heading,
        across=2,
        time_label=ENGLISH("paper_plate.since"),
        panel_pt=122.0,
    )
    caption = f"{shown} {ENGLISH(f'paper_plate.nodes_{kind}_caption', drag=drag)}"
    return _build_plate(f"node-forces-{kind}", heading, caption, svg)


def _build_plate(name: str, heading: str, caption: str, svg: str) -> Plate:
    figure = Figure(svg=svg, caption=caption, id=f"plate-{name}", look="plate")
    return heading, figure


def _list_node_panels(
    tracks: Sequence[tuple[PaperCase, Track]], *, is_thin: bool
) -> list[Panel]:
    """Both parts of both nodes' forces, a line for each friction angle."""
    return [
        Panel(
            title=ENGLISH(f"paper_plate.{node}_node", axis=axis.upper()),
            lines=[
                _line(
                    case,
                    track,
                    getattr(track, node)[part] / 1e3,
                    f"{case.friction_deg:.0f}°",
                    len(tracks) - style,
                    is_thin=is_thin,
                )
                for style, (case, track) in enumerate(tracks, 1)
            ],
        )
        for node in _NODES
        for part, axis in enumerate("xy")
    ]


def _plate_meshes(study: PaperStudy) -> Plate | None:
    cases = [find_paper_time()]
    cases += [find_history(NORMAL_NET_DEG, phi) for phi in reversed(FRICTIONS_DEG)]
    cases.append(find_history(DESIGN_NET_DEG))
    pictures = [
        (_name_mesh(run.case, run.track), run.solution)
        for run in map(study.__getitem__, cases)
        if run.solution is not None and run.track is not None
    ]
    if not pictures:
        return None
    heading, caption = (ENGLISH(f"paper_plate.meshes{x}") for x in ("", "_caption"))
    return _build_plate("meshes", heading, caption, draw_meshes(pictures))


def _name_mesh(case: PaperCase, track: Track) -> str:
    angles = {"friction": case.friction_deg, "inclination": case.inclination_deg}
    if case.until:
        return ENGLISH("paper_plate.mesh_after_s", seconds=case.until, **angles)
    days = day_from_second(float(track.times[-1]))
    return ENGLISH("paper_plate.mesh_after_days", days=days, **angles)


def _plate_methods(study: PaperStudy) -> Plate | None:
    panels = [_compare_ways(study, net) for net in NETS_DEG]
    if not any(panel.lines for panel in panels):
        return None
    heading, caption = (ENGLISH(f"paper_plate.methods{x}") for x in ("", "_caption"))
    since = ENGLISH("paper_plate.since")
    svg = draw_panels(panels, heading, panel_pt=137.0, time_label=since)
    return _build_plate("methods", heading, caption, svg)


def _compare_ways(study: PaperStudy, net: float) -> Panel:
    """Pull on the foot by each way, and that of the steady state."""
    straight = find_history(net)
    ways = {
        "staggered": (find_exchange(net), 2),
        "straight": (straight, 0),
        "sagged": (replace(straight, start="sagged"), 1),
    }
    lines = []
    for way, (case, style) in ways.items():
        if (track := study[case].track) is not None:
            label = ENGLISH(f"paper_plate.{way}")
            lines.append(_line(case, track, track.foot / 1e3, label, style))
    steady, marks = study[find_steady(straight)].foot, []
    if steady is not None and lines:
        x = [min(line.x[0] for line in lines), max(line.x[-1] for line in lines)]
        label, level = ENGLISH("paper_plate.steady"), [steady / 1e3] * 2
        lines.append(Line(label=label, x=x, y=level, is_accent=True))
    begin = study[straight].plateau_time
    if begin is not None:
        label = ENGLISH("solved.plateau_from")
        marks.append(Mark(x=day_from_second(begin), label=label))
    title = ENGLISH("paper_plate.foot_at", inclination=net)
    return Panel(title=title, lines=lines, marks=marks)


def _line(
    case: PaperCase,
    track: Track,
    values: Floats,
    label: str,
    style: int,
    *,
    is_thin: bool = False,
) -> Line:
    """Line from when a straight net has its first shape."""
    settled = _SETTLED * case.scene.time_scale
    first = min(int((track.times <= settled).sum()), len(track.times) - 1)
    times = [day_from_second(float(time)) for time in track.times[first:]]
    y = values[first:].tolist()
    return Line(label=label, x=times, y=y, style=style, is_thin=is_thin)


PAGE_FILE = "index.html"


def render_paper(study: PaperStudy) -> dict[str, bytes]:
    """Page of the study, by the name of its file.

    Parameters
    ----------
    study : PaperStudy
        Its runs.
    """
    lead = ENGLISH(
        "paper.lead",
        length=LENGTH,
        thickness=THICKNESS,
        density=RELATIVE_DENSITY,
        slope=ASSUMED_SLOPE_DEG,
        stiffness=kilonewton_from_newton(ASSUMED_STIFFNESS),
    )
    failures = sum(bool(run.failure) for run in study.runs.values())
    failed = ENGLISH("paper.failures", count=failures) if failures else ""
    blocks = (
        masthead(
            f"netdesign paper · {__version__}",
            ENGLISH("paper.heading"),
            Paragraph(text=lead, look="lead"),
        ),
        section(
            "pictures", ENGLISH("paper.pictures"), *_show_plates(draw_plates(study))
        ),
        section(
            "tables",
            ENGLISH("paper.tables"),
            *(
                Part(kind="div", id=f"table-{name}", blocks=(table.shown("study"),))
                for name, table in list_tables(study).items()
            ),
            look="page",
        ),
        section(
            "how",
            ENGLISH("paper.how"),
            *(
                Paragraph(text=sentence, look="text")
                for sentence in (
                    failed,
                    ENGLISH("paper.how_forces"),
                    _tell_histories(study),
                )
                if sentence
            ),
        ),
    )
    return {PAGE_FILE: render_page(blocks, ENGLISH("paper.title"), "en").encode()}


def _tell_histories(study: PaperStudy) -> str:
    return ENGLISH(
        "paper.how_histories",
        days=day_from_second(study.settings.horizon),
        criterion=CRITERION,
        hours=find_history(NORMAL_NET_DEG).scene.time_scale / 3600.0,
    )


def _show_plates(plates: Sequence[Plate]) -> Iterator[Block]:
    for number, (heading, figure) in enumerate(plates, 1):
        yield Heading(text=f"{number}. {heading}", level=3)
        yield figure
