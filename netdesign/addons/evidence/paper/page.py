"""The paper's study -> one page without script, drawings, CSV files."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from netdesign import __version__
from netdesign.addons.evidence.paper.mesh_figure import MeshPicture, draw_meshes
from netdesign.addons.evidence.paper.runs import (
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
    PaperRun,
    PaperStudy,
    Track,
    find_exchange,
    find_history,
    find_paper_time,
    find_steady,
)
from netdesign.addons.evidence.paper.tables import Listed, list_tables
from netdesign.addons.history.moments import (
    LEAST_STRAIN,
    NODE_DRIFT,
    PULL_DRIFT,
    REST_SHARE,
    REST_WAY,
)
from netdesign.report.blocks import (
    Block,
    Figure,
    Heading,
    Paragraph,
    Part,
    masthead,
    section,
    write_csv,
)
from netdesign.report.drawing.charts import Line, Mark, Panel, draw_panels
from netdesign.report.page.render import render_page
from netdesign.report.words import ENGLISH
from netdesign.units import day_from_second, kilonewton_from_newton

_NODES = ("lower", "upper")
# Creep time in which a straight net finds its first shape: not drawn.
_SETTLED = 1e-5


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
    ]
    return [plate for plate in plates if plate is not None]


def _plate_nodes(study: PaperStudy, kind: str) -> Plate | None:
    drag = study.settings.exchange_drag
    is_staggered = kind == "staggered"
    runs = [
        study[
            find_exchange(NORMAL_NET_DEG, phi)
            if is_staggered
            else find_history(NORMAL_NET_DEG, phi)
        ]
        for phi in FRICTIONS_DEG
    ]
    tracks = [(run.case, run.track) for run in runs if run.track is not None]
    if len(tracks) < len(runs):
        return None
    lower, upper = tracks[0][1].heights
    heading = ENGLISH(f"paper_plate.nodes_{kind}")
    shown = ENGLISH("paper_plate.nodes", lower=lower, upper=upper)
    svg = draw_panels(
        _list_node_panels(tracks, is_thin=is_staggered),
        heading,
        across=2,
        time_label=ENGLISH("paper_plate.since"),
        panel_pt=122.0,
        language="en",
    )
    return Plate(
        name=f"node-forces-{kind}",
        heading=heading,
        caption=f"{shown} {ENGLISH(f'paper_plate.nodes_{kind}_caption', drag=drag)}",
        svg=svg,
    )


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
            title=ENGLISH(f"paper_plate.{node}_node", axis=axis.upper()),
            lines=[
                draw(style, case, track, node, part)
                for style, (case, track) in enumerate(tracks)
            ],
        )
        for node in _NODES
        for part, axis in enumerate("xy")
    ]


def _plate_meshes(study: PaperStudy) -> Plate | None:
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
                title=_name_mesh(case, run.track),
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
        heading=ENGLISH("paper_plate.meshes"),
        caption=ENGLISH("paper_plate.meshes_caption"),
        svg=draw_meshes(pictures),
    )


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
    heading = ENGLISH("paper_plate.methods")
    return Plate(
        name="methods",
        heading=heading,
        caption=ENGLISH("paper_plate.methods_caption"),
        svg=draw_panels(
            panels,
            heading,
            across=1,
            panel_pt=137.0,
            time_label=ENGLISH("paper_plate.since"),
            language="en",
        ),
    )


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
            pulls, label = [pull / 1e3 for pull in track.foot], f"paper_plate.{way}"
            lines.append(_line(case, track, pulls, ENGLISH(label), style))
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
    case: PaperCase, track: Track, values: Sequence[float], label: str, style: int
) -> Line:
    """Line from when a straight net has its first shape."""
    settled = _SETTLED * case.scene.time_scale
    first = min(int((track.times <= settled).sum()), len(track.times) - 1)
    times = [day_from_second(float(time)) for time in track.times[first:]]
    return Line(label=label, x=times, y=list(values[first:]), style=style)


PAGE_FILE = "index.html"


def render_paper(study: PaperStudy) -> dict[str, bytes]:
    """Contents of all files of the study, by name.

    Parameters
    ----------
    study : PaperStudy
        As computed; how many runs gave no result is told on the page.
    """
    plates, tables = draw_plates(study), list_tables(study)
    files = {PAGE_FILE: _render_page(study, plates, tables).encode()}
    files |= {f"{plate.name}.svg": plate.svg.encode() for plate in plates}
    files |= {f"{listed.name}.csv": listed.render() for listed in tables}
    for run in study.runs.values():
        if run.track is not None:
            files[f"{name_history(run)}.csv"] = write_track(run.track)
    return files


def name_history(run: PaperRun) -> str:
    """Name of a history's CSV file, from what its run differs by."""
    case = run.case
    parts = [
        "history",
        case.method,
        f"net{case.inclination_deg:.0f}",
        f"friction{case.friction_deg:.0f}",
        "" if case.gravity == "full" else case.gravity,
        case.start if case.method == "transient" else "",
        f"{case.until:.0f}s" if case.until else "",
    ]
    return "-".join(part for part in parts if part)


def write_track(track: Track) -> bytes:
    """History of a run: pulls, forces of the net on two nodes, largest density."""
    low, high = (f"{height:.2f}m" for height in track.heights)
    columns = (
        track.times,
        track.foot / 1e3,
        track.head / 1e3,
        *(track.lower / 1e3),
        *(track.upper / 1e3),
        track.density,
    )
    headings = (
        "time_s",
        "foot_kN_per_m",
        "head_kN_per_m",
        *(f"node_at_{low}_{axis}_kN_per_m" for axis in "xy"),
        *(f"node_at_{high}_{axis}_kN_per_m" for axis in "xy"),
        "largest_relative_density",
    )
    return write_csv(headings, [list(row) for row in zip(*columns, strict=True)])


def _render_page(
    study: PaperStudy, plates: Sequence[Plate], tables: Sequence[Listed]
) -> str:
    lead = ENGLISH(
        "paper.lead",
        length=LENGTH,
        thickness=THICKNESS,
        density=RELATIVE_DENSITY,
        slope=ASSUMED_SLOPE_DEG,
        stiffness=kilonewton_from_newton(ASSUMED_STIFFNESS),
    )
    failures = sum(bool(run.failure) for run in study.runs.values())
    told = ENGLISH("paper.failures", count=failures) if failures else ""
    blocks = (
        masthead(
            f"netdesign paper · {__version__}",
            ENGLISH("paper.heading"),
            Paragraph(text=lead, look="lead"),
        ),
        section("pictures", ENGLISH("paper.pictures"), *_show_plates(plates)),
        section(
            "tables",
            ENGLISH("paper.tables"),
            *(
                Part(kind="div", id=f"table-{one.name}", blocks=(shown,))
                for one in tables
                for shown in [one.table.shown("study")]
            ),
            look="page",
        ),
        section(
            "how",
            ENGLISH("paper.how"),
            *(
                Paragraph(text=one, look="text")
                for one in (told, ENGLISH("paper.how_forces"), _tell_histories(study))
                if one
            ),
        ),
    )
    return render_page(blocks, ENGLISH("paper.title"), "en")


def _tell_histories(study: PaperStudy) -> str:
    return ENGLISH(
        "paper.how_histories",
        days=day_from_second(study.settings.horizon),
        criterion=ENGLISH(
            "solved.criterion",
            strain=LEAST_STRAIN,
            pull=PULL_DRIFT,
            node=NODE_DRIFT,
            rest=REST_SHARE,
            way=REST_WAY,
        ),
        hours=find_history(NORMAL_NET_DEG).scene.time_scale / 3600.0,
    )


def _show_plates(plates: Sequence[Plate]) -> Iterator[Block]:
    for number, plate in enumerate(plates, 1):
        yield Heading(text=f"{number}. {plate.heading}", level=3)
        yield Figure(
            svg=plate.svg,
            caption=plate.caption,
            id=f"plate-{plate.name}",
            look="plate",
        )
