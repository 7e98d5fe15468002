"""``netdesign bench``: run time against error, stability, honesty, envelopes.

It speaks English only: it is for whoever develops or examines the program.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click

from netdesign.commands.options import accuracy_option, jobs_option, json_option

if TYPE_CHECKING:
    from collections.abc import Sequence

    from netdesign.evidence.benchmark.rows import Row
    from netdesign.study.records import Study

Kind = Literal["stress", "errors", "lines"]

_EXIT_FAIL = 1
_REACHED = {True: "reached", False: "NOT reached"}


@click.command()
@click.option(
    "--stress",
    type=click.IntRange(1),
    metavar="N",
    help="Solve N random scenes instead; each has to converge or to be refused.",
)
@click.option(
    "--errors",
    type=click.IntRange(1),
    metavar="N",
    help="Compare N random scenes with finer meshes instead: are errors honest?",
)
@click.option(
    "--lines",
    type=click.IntRange(1),
    metavar="N",
    help="Follow N lines of 200 scenes instead: does a force jump beyond its error?",
)
@click.option(
    "--envelope",
    is_flag=True,
    help="Measure envelopes instead: cases, time, misses, store, workers.",
)
@click.option(
    "--panel",
    is_flag=True,
    help="Measure what a panel adds to the searches of the example's rows instead.",
)
@click.option(
    "--missed",
    type=click.IntRange(1),
    default=5,
    show_default=True,
    metavar="N",
    help="Random scenes of --envelope that are held against grids.",
)
@click.option(
    "--seed", type=click.IntRange(0), default=1, show_default=True, help="Of --stress."
)
@accuracy_option("Asked of the random scenes.", default=0.005)
@jobs_option(
    "Processes for random scenes; more than cores make times useless.",
    default=1,
    show_default=True,
)
@click.option("--scenes", metavar="A,B", help="Only these named scenes.")
@click.option("--quick", is_flag=True, help="Less of everything, for a first look.")
@click.option(
    "--plot",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Write run time against error as SVG.",
)
@click.option("--force", is_flag=True, help="Overwrite an existing plot.")
@json_option("result")
def bench(
    *,
    stress: int | None,
    errors: int | None,
    lines: int | None,
    envelope: bool,
    panel: bool,
    missed: int,
    seed: int,
    accuracy: float,
    jobs: int,
    scenes: str | None,
    quick: bool,
    plot: Path | None,
    force: bool,
    as_json: bool,
) -> None:
    """Measure the program itself: run time against error, stability, honesty.

    \b
    netdesign bench --plot bench.svg
    netdesign bench --stress 2000 --seed 1 --jobs 2
    netdesign bench --errors 200 --seed 1 --jobs 2
    netdesign bench --lines 60 --jobs 2
    netdesign bench --envelope --json
    netdesign bench --envelope --missed 200
    netdesign bench --panel
    """
    random: dict[Kind, int | None] = {
        "stress": stress,
        "errors": errors,
        "lines": lines,
    }
    wanted = {kind: count for kind, count in random.items() if count is not None}
    if len(wanted) + envelope + panel > 1:
        kinds = "--stress, --errors, --lines, --envelope, --panel"
        raise click.UsageError(f"give one of {kinds}")
    if (wanted or envelope or panel) and (scenes or plot):
        raise click.UsageError("--scenes and --plot are for named scenes only")
    if wanted and quick:
        raise click.UsageError("--quick: not with random scenes")
    for kind, count in wanted.items():
        sys.exit(_run_random(kind, count, seed, accuracy, jobs, as_json=as_json))
    if envelope:
        sys.exit(_run_envelope(missed, quick=quick, as_json=as_json))
    if panel:
        sys.exit(_run_panel(quick=quick, as_json=as_json))
    names = tuple(name.strip() for name in scenes.split(",")) if scenes else ()
    _run_named(names, plot, quick=quick, force=force, as_json=as_json)


def _run_random(
    kind: Kind, count: int, seed: int, accuracy: float, jobs: int, *, as_json: bool
) -> int:
    """Exit code of a run over random scenes."""
    from netdesign.edge.progress import show_progress
    from netdesign.evidence.benchmark.bench_table import (
        print_errors,
        print_lines,
        print_stress,
    )
    from netdesign.evidence.benchmark.honesty import study_errors, write_errors
    from netdesign.evidence.benchmark.lines import study_lines, write_lines
    from netdesign.evidence.benchmark.stress import run_stress, write_stress

    known: dict[Kind, tuple[Any, Any, Any]] = {
        "stress": (run_stress, write_stress, print_stress),
        "errors": (study_errors, write_errors, print_errors),
        "lines": (study_lines, write_lines, print_lines),
    }
    study, write, show = known[kind]
    what = "lines" if kind == "lines" else "scenes"
    with show_progress(count, what, quiet=False) as on_done:
        found = study(count, seed, accuracy=accuracy, jobs=jobs, on_done=on_done)
        document = write(found, seed, accuracy)
    if as_json:
        _print_json(document)
    else:
        from rich.console import Console

        show(document, Console())
    return 0 if document["pass"] else _EXIT_FAIL


def _run_envelope(missed: int, *, quick: bool, as_json: bool) -> int:
    """Exit code: a quick look reaches nothing and so fails at nothing."""
    from netdesign.evidence.benchmark.envelope import (
        QUICK,
        BenchSize,
        run_envelope_bench,
    )
    from netdesign.report.files import render_files

    def render(study: Study) -> object:
        files = ("study.json", "report.html", "report.xlsx")
        return render_files([study], [[Path(name) for name in files]])

    size = QUICK if quick else BenchSize(missed_scenes=missed)
    show = _ignore if as_json else _show_row
    document = run_envelope_bench(render, size, show)
    if as_json:
        _print_json(document)
    return 0 if quick or document["pass"] else _EXIT_FAIL


def _run_panel(*, quick: bool, as_json: bool) -> int:
    """Exit code: a quick look reaches nothing and so fails at nothing."""
    from netdesign.evidence.benchmark.panel_cost import ROWS, measure_panel_cost

    document = measure_panel_cost(repeats=1 if quick else 7, rows=1 if quick else ROWS)
    if as_json:
        _print_json(document)
    else:
        _show_row(document)
    return 0 if quick or document["reached"] else _EXIT_FAIL


def _ignore(_: object) -> None:
    """Wait for the whole document."""


def _show_row(row: dict[str, Any]) -> None:
    click.echo(f"{row['what']}\n  {row['reach']}: {_REACHED[row['reached']]}")
    for name, value in row.items():
        if name not in ("what", "reach", "reached"):
            for one in value if isinstance(value, list) else [value]:
                click.echo(f"  {name:20} {one}")


def _run_named(
    names: tuple[str, ...],
    plot: Path | None,
    *,
    quick: bool,
    force: bool,
    as_json: bool,
) -> None:
    from netdesign.edge.output import require_free, write_files
    from netdesign.evidence.benchmark.precision import write_bench

    if plot is not None:
        require_free([plot], overwrite=force)
    rows = _measure(names, quick=quick)
    if plot is not None:
        from netdesign.evidence.benchmark.bench_figure import draw_work_precision

        write_files({plot: draw_work_precision(rows).encode()}, overwrite=force)
        click.echo(f"wrote {plot}", err=True)
    if as_json:
        _print_json(write_bench(rows))
    else:
        from rich.console import Console

        from netdesign.evidence.benchmark.bench_table import print_rows

        print_rows(rows, Console())


def _measure(names: tuple[str, ...], *, quick: bool) -> Sequence[Row]:
    from netdesign.edge.progress import show_progress
    from netdesign.evidence.benchmark.precision import (
        FULL,
        QUICK,
        measure_steady,
        measure_transient,
    )
    from netdesign.evidence.benchmark.scenes import HISTORY_SCENES, load_scenes

    chosen = load_scenes(names)
    rows: list[Row] = []
    with show_progress(len(chosen), "scenes", quiet=False) as on_done:
        for name, scene in chosen.items():
            rows += measure_steady(name, scene, QUICK if quick else FULL)
            if name in HISTORY_SCENES and not quick:
                rows += measure_transient(name, scene, FULL)
            if on_done is not None:
                on_done(name)
    return rows


def _print_json(document: dict[str, Any]) -> None:
    click.echo(json.dumps(document, indent=1, allow_nan=False))
