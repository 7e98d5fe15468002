"""The paper's study -> one page without script, drawings, CSV files."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from netdesign import __version__
from netdesign.coupling.moments import (
    LEAST_STRAIN,
    NODE_DRIFT,
    PULL_DRIFT,
    REST_SHARE,
    REST_WAY,
)
from netdesign.evidence.paper.findings import (
    SETTLED,
    list_findings,
    word_finding,
)
from netdesign.evidence.paper.runs import (
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
from netdesign.evidence.paper.tables import list_tables
from netdesign.report.blocks import (
    Block,
    Figure,
    Heading,
    Pairs,
    Paragraph,
    Part,
    Piece,
    masthead,
    section,
    strong,
    write_csv,
)
from netdesign.report.drawing.charts import Line, Mark, Panel, draw_panels
from netdesign.report.drawing.net_figures import MeshPicture, draw_meshes
from netdesign.report.page.render import render_page
from netdesign.report.words import ENGLISH, Words
from netdesign.units import day_from_second, kilonewton_from_newton
from netdesign.words.catalogue import Language

_NODES = ("lower", "upper")


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
    panels = [_compare_ways(study, net, words) for net in NETS_DEG]
    if not any(panel.lines for panel in panels):
        return None
    heading = words("paper_plate.methods")
    return Plate(
        name="methods",
        heading=heading,
        caption=words("paper_plate.methods_caption"),
        svg=draw_panels(
            panels,
            heading,
            across=1,
            panel_pt=137.0,
            time_label=words("paper_plate.since"),
            language=words.language,
        ),
    )


def _compare_ways(study: PaperStudy, net: float, words: Words) -> Panel:
    """Pull on the foot by each way, and that of the steady state."""
    straight = find_history(net)
    ways = {
        "staggered": (find_exchange(net, study.settings), 2),
        "straight": (straight, 0),
        "sagged": (replace(straight, start="sagged"), 1),
    }
    lines = []
    for way, (case, style) in ways.items():
        if (track := study[case].track) is not None:
            pulls, label = [pull / 1e3 for pull in track.foot], f"paper_plate.{way}"
            lines.append(_line(case, track, pulls, words(label), style))
    steady, marks = study[find_steady(straight)].foot, []
    if steady is not None and lines:
        x = [min(line.x[0] for line in lines), max(line.x[-1] for line in lines)]
        label, level = words("paper_plate.steady"), [steady / 1e3] * 2
        lines.append(Line(label=label, x=x, y=level, is_accent=True))
    begin = study[straight].plateau_time
    if begin is not None:
        label = words("solved.plateau_from")
        marks.append(Mark(x=day_from_second(begin), label=label))
    title = words("paper_plate.foot_at", inclination=net)
    return Panel(title=title, lines=lines, marks=marks)


def _line(
    case: PaperCase, track: Track, values: Sequence[float], label: str, style: int
) -> Line:
    """Line from when a straight net has its first shape."""
    settled = SETTLED * case.scene.time_scale
    first = min(int((track.times <= settled).sum()), len(track.times) - 1)
    times = [day_from_second(float(time)) for time in track.times[first:]]
    return Line(label=label, x=times, y=list(values[first:]), style=style)


PAGE_FILE = "index.html"


def render_paper(study: PaperStudy, language: Language = "en") -> dict[str, bytes]:
    """Contents of all files of the study, by name.

    CSV files are for programs: the same in every language.

    Parameters
    ----------
    study : PaperStudy
        As computed; a run without a result is named on the page.
    language : str
        Of page and drawings.
    """
    words = Words(language)
    plates = draw_plates(study, words)
    files = {PAGE_FILE: _render_page(study, plates, words).encode()}
    files |= {f"{plate.name}.svg": plate.svg.encode() for plate in plates}
    tables = list_tables(study, ENGLISH)
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
        case.start if case.method == "transient" else f"drag{case.drag:g}",
        "" if case.densifies else "undensified",
        "coarse" if case.is_coarse else "",
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


def _render_page(study: PaperStudy, plates: list[Plate], words: Words) -> str:
    findings, scene = list_findings(study), _describe_scene(study, words)
    lead = words(
        "paper.lead",
        length=scene["length"],
        thickness=scene["thickness"],
        density=scene["density"],
        count=len(findings),
        agreed=sum(finding.call == "agrees" for finding in findings),
    )
    rule = words("paper.rule", slope=scene["slope"], stiffness=scene["stiffness"])
    blocks = (
        masthead(
            f"netdesign paper · {__version__}",
            words("paper.heading"),
            Paragraph(text=lead, look="lead"),
        ),
        section(
            "statements",
            words("paper.statements"),
            Pairs(
                look="claims",
                pairs=tuple(word_finding(one, words) for one in findings),
            ),
            Paragraph(text=rule, look="small"),
        ),
        section("pictures", words("paper.pictures"), *_show_plates(plates)),
        section(
            "tables", words("paper.tables"), *_show_tables(study, words), look="page"
        ),
        section("how", words("paper.how"), *_describe_method(scene, words)),
    )
    return render_page(blocks, words("paper.title"), words.language)


def _show_plates(plates: list[Plate]) -> Iterator[Block]:
    for number, plate in enumerate(plates, 1):
        yield Heading(text=f"{number}. {plate.heading}", level=3)
        yield Figure(
            svg=plate.svg,
            caption=plate.caption,
            id=f"plate-{plate.name}",
            look="plate",
        )


def _show_tables(study: PaperStudy, words: Words) -> Iterator[Block]:
    for listed in list_tables(study, words):
        yield Part(
            kind="div", id=f"table-{listed.name}", blocks=(listed.table.shown("study"),)
        )
    failures = sum(bool(run.failure) for run in study.runs.values())
    if failures:
        count = strong(words("paper.failures", count=failures))
        text = (*count, Piece(f" {words('paper.failures_mean')}"))
        yield Part(
            kind="div",
            id="failures",
            look="notes open",
            blocks=(Paragraph(text=text),),
        )


def _describe_method(scene: dict[str, str], words: Words) -> list[Paragraph]:
    histories = words(
        "paper.how_histories",
        days=scene["days"],
        criterion=words(
            "solved.criterion",
            strain=LEAST_STRAIN,
            pull=PULL_DRIFT,
            node=NODE_DRIFT,
            rest=REST_SHARE,
            way=REST_WAY,
        ),
        time_scale=scene["time_scale"],
    )
    told = (words("paper.how_forces"), histories, words("paper.how_files"))
    return [Paragraph(text=text, look="text") for text in told]


def _describe_scene(study: PaperStudy, words: Words) -> dict[str, str]:
    """Numbers that the page's sentences name, as the language writes them."""
    numbers = {
        "length": f"{LENGTH:g}",
        "thickness": f"{THICKNESS:g}",
        "density": f"{RELATIVE_DENSITY:g}",
        "slope": f"{ASSUMED_SLOPE_DEG:g}",
        "stiffness": f"{kilonewton_from_newton(ASSUMED_STIFFNESS):g}",
        "time_scale": f"{find_history(0.0).scene.time_scale / 3600.0:.1f}",
        "days": f"{study.settings.horizon / 86_400.0:g}",
    }
    return {name: words.write(number) for name, number in numbers.items()}
