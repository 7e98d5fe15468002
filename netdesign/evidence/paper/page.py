"""The paper's study -> one page without script, drawings, CSV files."""

from __future__ import annotations

from collections.abc import Iterator

from netdesign import __version__
from netdesign.evidence.paper.cases import (
    ASSUMED_SLOPE_DEG,
    ASSUMED_STIFFNESS,
    LENGTH,
    RELATIVE_DENSITY,
    THICKNESS,
    find_history,
)
from netdesign.evidence.paper.figures import Plate, draw_plates
from netdesign.evidence.paper.findings import Claim, list_findings, word_finding
from netdesign.evidence.paper.runs import PaperRun, PaperStudy
from netdesign.evidence.paper.tables import list_tables
from netdesign.report.blocks import (
    SMALL,
    Block,
    Figure,
    Heading,
    Pair,
    Pairs,
    Paragraph,
    Part,
    Piece,
    masthead,
    section,
    strong,
    write_csv,
)
from netdesign.report.page.render import render_page
from netdesign.report.page.solution_page import describe_criterion
from netdesign.report.words import ENGLISH, Words
from netdesign.units import kilonewton_from_newton
from netdesign.words.catalogue import Language

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
            files[f"{name_history(run)}.csv"] = write_track(run)
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


def write_track(run: PaperRun) -> bytes:
    """History of a run: pulls, forces of the net on two nodes, largest density."""
    track = run.track
    if track is None:
        return b""
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
                pairs=tuple(_show_claim(word_finding(one, words)) for one in findings),
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


def _show_claim(claim: Claim) -> Pair:
    call = f"{claim.symbol} {claim.call}"
    text = [Piece(claim.said, "said"), Piece(claim.found, "found")]
    text += [Piece(claim.reason, SMALL)] if claim.reason else []
    return Pair(name=call, text=tuple(text), look="differs" if claim.differs else "")


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
        criterion=describe_criterion(words),
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
