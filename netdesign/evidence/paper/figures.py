"""Drawings of the paper's study."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from netdesign.evidence.paper.cases import (
    DESIGN_NET_DEG,
    FRICTIONS_DEG,
    INCLINATIONS_DEG,
    NORMAL_NET_DEG,
    PaperCase,
    find_exchange,
    find_history,
    find_paper_time,
    find_steady,
    find_trend,
)
from netdesign.evidence.paper.findings import SETTLED
from netdesign.evidence.paper.runs import Track
from netdesign.evidence.paper.study import PaperStudy
from netdesign.report.drawing.charts import Line, Mark, Panel, draw_panels
from netdesign.report.drawing.net_figures import MeshPicture, draw_meshes
from netdesign.units import day_from_second

_NODES = (("lower", "Lower node"), ("upper", "Upper node"))
_NETS = (NORMAL_NET_DEG, DESIGN_NET_DEG)


@dataclass(frozen=True, slots=True, kw_only=True)
class Plate:
    """One drawing of the page: name of its file, heading, what it shows."""

    name: str
    heading: str
    caption: str
    svg: str


def draw_plates(study: PaperStudy) -> list[Plate]:
    """All drawings, in the order of the page; those without a run are left out."""
    plates = [
        _plate_nodes(study, "staggered"),
        _plate_nodes(study, "implicit"),
        _plate_meshes(study),
        _plate_methods(study),
        _plate_trend(study),
        _plate_drift(study),
        _plate_inclination(study),
        _plate_gravity(study),
    ]
    return [plate for plate in plates if plate is not None]


def _plate_nodes(study: PaperStudy, kind: str) -> Plate | None:
    runs = [
        study[
            find_exchange(NORMAL_NET_DEG, study.settings, phi)
            if kind == "staggered"
            else find_history(NORMAL_NET_DEG, phi)
        ]
        for phi in FRICTIONS_DEG
    ]
    tracks = [(run.case, run.track) for run in runs if run.track is not None]
    if len(tracks) < len(runs):
        return None
    lower, upper = tracks[0][1].heights
    caption = (
        f"Force of the net on the snow at nodes {lower:.2f} m and {upper:.2f} m above "
        "the ground, for friction angles of 15°, 30°, 45°; net normal to the slope, "
        "straight at the start. "
    )
    if kind == "staggered":
        drag = study.settings.exchange_drag
        heading = "Node forces as the paper computed them"
        caption += (
            f"Staggered exchange, base drag {drag:g}. The paper's figures 8 to 11. The "
            "oscillation comes from the scheme."
        )
    else:
        heading = "The same forces, implicit in the net's stiffness"
        caption += "The mesh is finer: a node stands for less of the net."
    panels = _list_node_panels(tracks, is_thin=kind == "staggered")
    svg = draw_panels(
        panels, f"nodes-{kind}", heading, across=2, time_label=_SINCE, panel_in=1.7
    )
    return Plate(name=f"node-forces-{kind}", heading=heading, caption=caption, svg=svg)


def _list_node_panels(
    tracks: Sequence[tuple[PaperCase, Track]], *, is_thin: bool
) -> list[Panel]:
    """Both parts of both nodes' forces, a line for each friction angle."""

    def draw(style: int, case: PaperCase, track: Track, node: str, part: int) -> Line:
        values = [force / 1e3 for force in getattr(track, node)[part]]
        line = _line(case, track, values, f"{case.friction_deg:.0f}°", 2 - style)
        return replace(line, is_thin=is_thin)

    return [
        Panel(
            title=f"{title}, {axis.upper()} [kN/m]",
            lines=[
                draw(style, case, track, node, part)
                for style, (case, track) in enumerate(tracks)
            ],
        )
        for node, title in _NODES
        for part, axis in enumerate("xy")
    ]


_SINCE = "time since the start, logarithmic"


def _plate_meshes(study: PaperStudy) -> Plate | None:
    cases = [find_paper_time()]
    cases += [find_history(NORMAL_NET_DEG, phi) for phi in reversed(FRICTIONS_DEG)]
    cases.append(find_history(DESIGN_NET_DEG))
    pictures = []
    for case in cases:
        run = study[case]
        if run.shape is None or run.track is None:
            continue
        days = day_from_second(float(run.track.times[-1]))
        when = f"{case.until:.0f} s" if case.until else f"{days:.0f} days"
        pictures.append(
            MeshPicture(
                title=f"φ = {case.friction_deg:.0f}°, θ = {case.inclination_deg:.0f}°, "
                f"after {when}",
                nodes=run.shape.nodes,
                triangles=run.shape.triangles,
                density=run.shape.density,
                face=run.shape.curve,
            )
        )
    if not pictures:
        return None
    return Plate(
        name="meshes",
        heading="Deformed snow",
        caption="The paper's figures 12 to 14 with their densities, and an inclined "
        "net. Displacements to scale. The net is red.",
        svg=draw_meshes(pictures, "meshes"),
    )


def _plate_methods(study: PaperStudy) -> Plate | None:
    panels = []
    for net in _NETS:
        straight = find_history(net)
        lines = [
            *_pulls(study, find_exchange(net, study.settings), "staggered", 2),
            *_pulls(study, straight, "straight start", 0),
            *_pulls(study, replace(straight, start="sagged"), "sagged start", 1),
        ]
        panels.append(_with_steady(study, straight, lines, f"Foot, θ = {net:.0f}°"))
    return _plate(
        panels,
        "methods",
        "One scene, four ways to its plateau",
        "Pull on the foot at a friction of 30°. The steady state is an upper figure: a "
        "straight net has pushed and densified snow on its way. The first tensions of "
        "a sagged net follow from the guess of its shape.",
    )


def _plate_trend(study: PaperStudy) -> Plate | None:
    *staggered, history = find_trend(study.settings)
    shown = [staggered[0], staggered[-2], staggered[-1]]
    lines = [
        line
        for style, case in zip((2, 1, 0), shown, strict=True)
        for line in _pulls(study, case, f"drag {case.drag:g}", style)
    ]
    lines += [
        replace(line, is_accent=True) for line in _pulls(study, history, "implicit", 0)
    ]
    end = day_from_second(study.settings.trend_time * history.scene.time_scale)
    lines = [_cut(line, end) for line in lines]
    return _plate(
        [Panel(title="Foot, θ = 0° [kN/m]", lines=lines)] if lines else [],
        "trend",
        "The staggered scheme as drag and step vanish",
        "The step follows the drag; on one mesh. The oscillation dies out sooner, and "
        "the pull tends to the implicit history's.",
    )


def _plate_drift(study: PaperStudy) -> Plate | None:
    panels = []
    for net in _NETS:
        lines = []
        steady = study[find_steady(find_history(net))].foot
        for start, style in (("sagged", 0), ("straight", 1)):
            for densifies in (True, False):
                case = replace(find_history(net), densifies=densifies)
                if start == "sagged":
                    case = replace(case, start="sagged")
                word = f"{start} start" if densifies else ""
                lines += [
                    replace(
                        line,
                        y=[1e5 * value / steady for value in line.y],
                        is_accent=densifies,
                    )
                    for line in _pulls(study, case, word, style)
                    if steady
                ]
        if lines:
            panels.append(
                Panel(title=f"Foot over steady state [%], θ = {net:.0f}°", lines=lines)
            )
    return _plate(
        panels,
        "drift",
        "After the plateau: a slow drift",
        "Red: with densification; black: without, followed for a shorter time. Full "
        "lines: at the start the net sags and the snow lies against it; dashed: the "
        "net is straight. The table of drifts has the rates per e-fold of time.",
    )


def _plate_inclination(study: PaperStudy) -> Plate | None:
    panels = []
    for end in ("foot", "head"):
        lines = [
            line
            for style, net in enumerate(INCLINATIONS_DEG)
            for line in _pulls(study, find_history(net), f"{net:.0f}°", style, end)
        ]
        if lines:
            title = f"Pull on the {end} [kN/m]"
            panels.append(Panel(title=title, lines=lines))
    return _plate(
        panels,
        "inclination",
        "Announced and not shown: inclination",
        "Net inclination 25°, 30°, 35° from the slope's normal, friction 30°, straight "
        "start. A leaning net carries more at its foot and less at its head.",
        across=2,
    )


def _plate_gravity(study: PaperStudy) -> Plate | None:
    panels = []
    for net in _NETS:
        lines = []
        for end, accent in (("foot", True), ("head", False)):
            full = find_history(net)
            for case, word, style in (
                (full, "full", 0),
                (replace(full, gravity="parallel"), "parallel", 2),
            ):
                lines += [
                    replace(line, is_accent=accent)
                    for line in _pulls(study, case, f"{end}, {word}", style, end)
                ]
        if lines:
            panels.append(
                Panel(title=f"Foot and head, θ = {net:.0f}° [kN/m]", lines=lines)
            )
    return _plate(
        panels,
        "gravity",
        "Announced and not shown: gravity",
        "Full gravity (full lines) against its part along the slope alone (dotted), "
        "friction 30°, straight start.",
        across=2,
    )


def _plate(
    panels: Sequence[Panel], name: str, heading: str, caption: str, *, across: int = 1
) -> Plate | None:
    if not panels:
        return None
    svg = draw_panels(
        panels, name, heading, across=across, panel_in=1.9, time_label=_SINCE
    )
    return Plate(name=name, heading=heading, caption=caption, svg=svg)


def _with_steady(
    study: PaperStudy, case: PaperCase, lines: list[Line], title: str
) -> Panel:
    steady = study[find_steady(case)].foot
    ends = [float(line.x[-1]) for line in lines]
    begins = [float(line.x[0]) for line in lines]
    if steady is not None and ends:
        x = [min(begins), max(ends)]
        level = [steady / 1e3] * 2
        lines = [*lines, Line(label="steady state", x=x, y=level, is_accent=True)]
    track = study[case].track
    marks = []
    if track is not None and track.plateau is not None:
        begin = day_from_second(float(track.times[track.plateau]))
        marks.append(Mark(x=begin, label="plateau from"))
    return Panel(title=f"{title} [kN/m]", lines=lines, marks=marks)


def _cut(line: Line, end: float) -> Line:
    """Line up to a time [d]."""
    count = sum(time <= end * 1.001 for time in line.x)
    return replace(line, x=line.x[:count], y=line.y[:count])


def _pulls(
    study: PaperStudy, case: PaperCase, label: str, style: int, end: str = "foot"
) -> list[Line]:
    """Line of a history's pull in kN/m; none without the run."""
    run = study[case]
    if run.track is None:
        return []
    values = [value / 1e3 for value in getattr(run.track, end)]
    return [_line(run.case, run.track, values, label, style)]


def _line(
    case: PaperCase, track: Track, values: Sequence[float], label: str, style: int
) -> Line:
    """Line from when a straight net has its first shape."""
    settled = SETTLED * case.scene.time_scale
    first = min(int((track.times <= settled).sum()), len(track.times) - 1)
    times = [day_from_second(float(time)) for time in track.times[first:]]
    return Line(label=label, x=times, y=list(values[first:]), style=style)
