"""The paper's study -> one page without script, drawings, CSV files."""

from __future__ import annotations

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
from netdesign.evidence.paper.findings import list_findings, word_finding
from netdesign.evidence.paper.runs import PaperRun, PaperStudy
from netdesign.evidence.paper.tables import list_tables
from netdesign.report.page.csv_text import write_csv
from netdesign.report.page.render import build_environment, load_style, mark_safe
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
    findings = list_findings(study)
    template = build_environment(words.language).get_template("paper.html")
    return template.render(
        css=load_style("report.css", "study.css"),
        language=words.language,
        claims=[word_finding(finding, words) for finding in findings],
        agreed=sum(finding.call == "agrees" for finding in findings),
        scene=_describe_scene(study, words),
        criterion=describe_criterion(words),
        version=__version__,
        plates=[
            {
                "name": plate.name,
                "heading": plate.heading,
                "caption": plate.caption,
                "svg": mark_safe(plate.svg),
            }
            for plate in plates
        ],
        tables=list_tables(study, words),
        failures=[run for run in study.runs.values() if run.failure],
    )


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
