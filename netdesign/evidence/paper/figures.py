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
from netdesign.evidence.paper.runs import PaperStudy, Track
from netdesign.report.drawing.charts import Line, Mark, Panel, draw_panels
from netdesign.report.drawing.net_figures import MeshPicture, draw_meshes
from netdesign.report.words import Words
from netdesign.units import day_from_second

_NODES = ("lower", "upper")
_NETS = (NORMAL_NET_DEG, DESIGN_NET_DEG)


@dataclass(frozen=True, slots=True, kw_only=True)
class Plate:
    """One drawing of the page: name of its file, heading, what it shows."""

    name: str
    heading: str
    caption: str
    svg: str


def draw_plates(study: PaperStudy, words: Words) -> list[Plate]:
    """All drawings, in the order of the page; those without a run are left out."""
    plates = [
        _plate_nodes(study, words, "staggered"),
        _plate_nodes(study, words, "implicit"),
        _plate_meshes(study, words),
        _plate_methods(study, words),
        _plate_trend(study, words),
        _plate_drift(study, words),
        _plate_inclination(study, words),
        _plate_gravity(study, words),
    ]
    return [plate for plate in plates if plate is not None]


def _plate_nodes(study: PaperStudy, words: Words, kind: str) -> Plate | None:
    drag = study.settings.exchange_drag
    is_staggered = kind == "staggered"
    runs = [
        study[
            find_exchange(NORMAL_NET_DEG, study.settings, phi)
            if is_staggered
            else find_history(NORMAL_NET_DEG, phi)
        ]
        for phi in FRICTIONS_DEG
    ]
    tracks = [(run.case, run.track) for run in runs if run.track is not None]
    if len(tracks) < len(runs):
        return None
    lower, upper = tracks[0][1].heights
    heading = words(f"paper_plate.nodes_{kind}")
    shown = words("paper_plate.nodes", lower=lower, upper=upper)
    svg = draw_panels(
        _list_node_panels(tracks, words, is_thin=is_staggered),
        heading,
        across=2,
        time_label=words("paper_plate.since"),
        panel_pt=122.0,
        language=words.language,
    )
    return Plate(
        name=f"node-forces-{kind}",
        heading=heading,
        caption=f"{shown} {words(f'paper_plate.nodes_{kind}_caption', drag=drag)}",
        svg=svg,
    )


def _list_node_panels(
    tracks: Sequence[tuple[PaperCase, Track]], words: Words, *, is_thin: bool
) -> list[Panel]:
    """Both parts of both nodes' forces, a line for each friction angle."""

    def draw(style: int, case: PaperCase, track: Track, node: str, part: int) -> Line:
        values = [force / 1e3 for force in getattr(track, node)[part]]
        line = _line(case, track, values, f"{case.friction_deg:.0f}°", 2 - style)
        return replace(line, is_thin=is_thin)

    return [
        Panel(
            title=words(f"paper_plate.{node}_node", axis=axis.upper()),
            lines=[
                draw(style, case, track, node, part)
                for style, (case, track) in enumerate(tracks)
            ],
        )
        for node in _NODES
        for part, axis in enumerate("xy")
    ]


def _plate_meshes(study: PaperStudy, words: Words) -> Plate | None:
    cases = [find_paper_time()]
    cases += [find_history(NORMAL_NET_DEG, phi) for phi in reversed(FRICTIONS_DEG)]
    cases.append(find_history(DESIGN_NET_DEG))
    pictures = []
    for case in cases:
        run = study[case]
        if run.shape is None or run.track is None:
            continue
        pictures.append(
            MeshPicture(
                title=_name_mesh(case, run.track, words),
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
        heading=words("paper_plate.meshes"),
        caption=words("paper_plate.meshes_caption"),
        svg=draw_meshes(pictures, words),
    )


def _name_mesh(case: PaperCase, track: Track, words: Words) -> str:
    angles = {"friction": case.friction_deg, "inclination": case.inclination_deg}
    if case.until:
        return words("paper_plate.mesh_after_s", seconds=case.until, **angles)
    days = day_from_second(float(track.times[-1]))
    return words("paper_plate.mesh_after_days", days=days, **angles)


def _plate_methods(study: PaperStudy, words: Words) -> Plate | None:
    panels = []
    for net in _NETS:
        straight = find_history(net)
        lines = [
            *_pulls(
                study,
                find_exchange(net, study.settings),
                words("paper_plate.staggered"),
                2,
            ),
            *_pulls(study, straight, words("paper_plate.straight"), 0),
            *_pulls(
                study, replace(straight, start="sagged"), words("paper_plate.sagged"), 1
            ),
        ]
        panels.append(_with_steady(study, straight, lines, words))
    return _plate(panels, "methods", words)


def _plate_trend(study: PaperStudy, words: Words) -> Plate | None:
    *staggered, history = find_trend(study.settings)
    shown = [staggered[0], staggered[-2], staggered[-1]]
    lines = [
        line
        for style, case in zip((2, 1, 0), shown, strict=True)
        for line in _pulls(
            study, case, words("paper_plate.drag", drag=case.drag), style
        )
    ]
    lines += [
        replace(line, is_accent=True)
        for line in _pulls(study, history, words("paper_plate.implicit"), 0)
    ]
    end = day_from_second(study.settings.trend_time * history.scene.time_scale)
    lines = [_cut(line, end) for line in lines]
    return _plate(
        [Panel(title=words("paper_plate.foot_at", inclination=0.0), lines=lines)]
        if lines
        else [],
        "trend",
        words,
    )


def _plate_drift(study: PaperStudy, words: Words) -> Plate | None:
    panels = []
    for net in _NETS:
        lines = []
        steady = study[find_steady(find_history(net))].foot
        for start, style in (("sagged", 0), ("straight", 1)):
            for densifies in (True, False):
                case = replace(find_history(net), densifies=densifies)
                if start == "sagged":
                    case = replace(case, start="sagged")
                word = words(f"paper_plate.{start}") if densifies else ""
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
                Panel(
                    title=words("paper_plate.foot_over_steady", inclination=net),
                    lines=lines,
                )
            )
    return _plate(panels, "drift", words)


def _plate_inclination(study: PaperStudy, words: Words) -> Plate | None:
    panels = []
    for end in ("foot", "head"):
        lines = [
            line
            for style, net in enumerate(INCLINATIONS_DEG)
            for line in _pulls(study, find_history(net), f"{net:.0f}°", style, end)
        ]
        if lines:
            title = words(f"paper_plate.pull_{end}")
            panels.append(Panel(title=title, lines=lines))
    return _plate(panels, "inclination", words, across=2)


def _plate_gravity(study: PaperStudy, words: Words) -> Plate | None:
    panels = []
    for net in _NETS:
        lines = []
        for end, accent in (("foot", True), ("head", False)):
            full = find_history(net)
            for case, kind, style in (
                (full, "full", 0),
                (replace(full, gravity="parallel"), "parallel", 2),
            ):
                lines += [
                    replace(line, is_accent=accent)
                    for line in _pulls(
                        study, case, words(f"paper_plate.{end}_{kind}"), style, end
                    )
                ]
        if lines:
            panels.append(
                Panel(title=words("paper_plate.both_at", inclination=net), lines=lines)
            )
    return _plate(panels, "gravity", words, across=2)


def _plate(
    panels: Sequence[Panel], name: str, words: Words, *, across: int = 1
) -> Plate | None:
    if not panels:
        return None
    heading = words(f"paper_plate.{name}")
    svg = draw_panels(
        panels,
        heading,
        across=across,
        panel_pt=137.0,
        time_label=words("paper_plate.since"),
        language=words.language,
    )
    caption = words(f"paper_plate.{name}_caption")
    return Plate(name=name, heading=heading, caption=caption, svg=svg)


def _with_steady(
    study: PaperStudy, case: PaperCase, lines: list[Line], words: Words
) -> Panel:
    steady = study[find_steady(case)].foot
    ends = [float(line.x[-1]) for line in lines]
    begins = [float(line.x[0]) for line in lines]
    if steady is not None and ends:
        x = [min(begins), max(ends)]
        level = [steady / 1e3] * 2
        lines = [
            *lines,
            Line(label=words("paper_plate.steady"), x=x, y=level, is_accent=True),
        ]
    track = study[case].track
    marks = []
    if track is not None and track.plateau is not None:
        begin = day_from_second(float(track.times[track.plateau]))
        marks.append(Mark(x=begin, label=words("solved.plateau_from")))
    return Panel(
        title=words("paper_plate.foot_at", inclination=case.inclination_deg),
        lines=lines,
        marks=marks,
    )


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
