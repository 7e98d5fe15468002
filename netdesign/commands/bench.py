"""``netdesign bench``: run time against error, stability, honesty of errors."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.options import (
    refuse_without,
    take_options,
)
from netdesign.commands.running import print_document
from netdesign.commands.usage import UsageRefusal
from netdesign.words.catalogue import Language
from netdesign.words.message import say

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rich.console import Console

    from netdesign.evidence.benchmark.precision import Row
    from netdesign.report.words import Words

Show = Callable[[dict[str, Any], "Console", "Words"], None]

_EXIT_FAIL = 1
_RANDOM = ("--stress", "--errors", "--lines")  # over random scenes


@dataclass(frozen=True, slots=True)
class _Output:
    """Form of a result: tables in a language, or JSON."""

    language: Language
    as_json: bool

    def write(self, document: dict[str, Any], show: Show | None = None) -> None:
        """Print a document; on a terminal, by a function of its own if one is given."""
        if self.as_json:
            print_document(document)
            return
        from rich.console import Console

        from netdesign.evidence.table import show_document
        from netdesign.report.words import Words

        (show or show_document)(document, Console(), Words(self.language))


@click.command()
@take_options("bench")
def bench(
    *,
    stress: int | None,
    errors: int | None,
    lines: int | None,
    against: Path | None,
    seed: int,
    accuracy: float,
    jobs: int,
    scenes: str | None,
    quick: bool,
    plot: Path | None,
    force: bool,
    as_json: bool,
    language: Language,
) -> None:
    """Measure the program itself: run time against error, stability, honesty.

    \b
    netdesign bench --plot bench.svg
    netdesign bench --stress 2000 --seed 1 --jobs 2
    netdesign bench --errors 200 --seed 1 --jobs 2
    netdesign bench --lines 60 --jobs 2
    netdesign bench --against netdesign-0.1.0-py3-none-any.whl
    """
    counts = {"--stress": stress, "--errors": errors, "--lines": lines}
    wanted = {**counts, "--against": against}
    given = [name for name, value in wanted.items() if value is not None]
    _refuse_mixtures(given, quick=quick, named=bool(scenes or plot))
    if not set(given) & set(_RANDOM):
        refuse_without(("seed", "accuracy", "jobs"), _RANDOM, language)
    output = _Output(language, as_json)
    for option, count in counts.items():
        if count is not None:
            asked = {"accuracy": accuracy, "jobs": jobs}
            sys.exit(_run_random(option, count, seed, output, asked))
    if against is not None:
        sys.exit(_run_against(against, output, quick=quick))
    names = tuple(name.strip() for name in scenes.split(",")) if scenes else ()
    _run_named(names, plot, output, quick=quick, force=force)


def _refuse_mixtures(given: Sequence[str], *, quick: bool, named: bool) -> None:
    """Refuse options that do not go together."""
    if len(given) > 1:
        raise UsageRefusal(say("bench.one_of", given=tuple(given)))
    if given and named:
        raise UsageRefusal(say("bench.named_only"))
    if quick and set(given) & set(_RANDOM):
        raise UsageRefusal(say("bench.not_quick"))


def _run_random(
    option: str, count: int, seed: int, output: _Output, asked: dict[str, Any]
) -> int:
    """Exit code of a run over random scenes."""
    from netdesign.edge.progress import show_progress
    from netdesign.evidence.benchmark.attempts import (
        attempt_scenes,
        write_errors,
        write_stress,
    )
    from netdesign.evidence.benchmark.lines import study_lines, write_lines

    shown = output.language
    ends = (seed, asked["accuracy"], "en" if output.as_json else shown)
    what = "lines" if option == "--lines" else "scenes"
    with show_progress(count, what, quiet=False, language=shown) as on_done:
        asked |= {"on_done": on_done}
        if option == "--lines":
            document = write_lines(study_lines(count, seed, **asked), *ends)
        else:
            is_compared = option == "--errors"
            write = write_errors if is_compared else write_stress
            found = attempt_scenes(count, seed, **asked, is_compared=is_compared)
            document = write(found, *ends)
    output.write(document)
    return 0 if document["pass"] else _EXIT_FAIL


def _run_against(path: Path, output: _Output, *, quick: bool) -> int:
    """Exit code: 0 where this version did all that was timed."""
    from netdesign.edge.progress import show_progress
    from netdesign.evidence.benchmark.against import (
        QUICK,
        Size,
        compare_versions,
        count_runs,
        open_version,
        read_version,
    )

    size, shown = QUICK if quick else Size(), output.language
    with open_version(path) as python:
        read_version(python)  # refused before the first run
        runs = count_runs(size)
        with show_progress(runs, "runs", quiet=False, language=shown) as on_done:
            document = compare_versions(python, size, on_done)
    output.write(document)
    return 0 if document["pass"] else _EXIT_FAIL


def _run_named(
    names: tuple[str, ...],
    plot: Path | None,
    output: _Output,
    *,
    quick: bool,
    force: bool,
) -> None:
    from netdesign.commands.usage import tell
    from netdesign.edge.output import require_free, write_files
    from netdesign.evidence.benchmark.precision import print_bench, write_bench

    if plot is not None:
        require_free([plot], overwrite=force)
    rows = _measure(names, output.language, quick=quick)
    if plot is not None:
        from netdesign.evidence.benchmark.precision import draw_work_precision
        from netdesign.report.words import Words

        drawn = draw_work_precision(rows, Words(output.language))
        write_files({plot: drawn.encode()}, overwrite=force)
        tell(say("cli.wrote", path=str(plot)), output.language, err=True)
    output.write(write_bench(rows), print_bench)


def _measure(
    names: tuple[str, ...], language: Language, *, quick: bool
) -> Sequence[Row]:
    from netdesign.edge.progress import show_progress
    from netdesign.evidence.benchmark.precision import (
        QUICK,
        measure_steady,
        measure_transient,
    )
    from netdesign.evidence.benchmark.scenes import HISTORY_SCENES, load_scenes

    chosen = load_scenes(names)
    rows: list[Row] = []
    with show_progress(
        len(chosen), "scenes", quiet=False, language=language
    ) as on_done:
        for name, scene in chosen.items():
            rows += measure_steady(name, scene, **(QUICK if quick else {}))
            if name in HISTORY_SCENES and not quick:
                rows += measure_transient(name, scene)
            if on_done is not None:
                on_done(name)
    return rows
