"""``netdesign bench``: run time against error, stability, honesty of errors."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.options import (
    refuse_without,
    take_options,
)
from netdesign.commands.running import (
    follow,
    print_document,
    require_places,
    write_outputs,
)
from netdesign.commands.usage import UsageRefusal
from netdesign.words.message import say

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from netdesign.addons.evidence.benchmark.precision import Row
    from netdesign.coupling.scene import Scene

_EXIT_FAIL = 1
_RANDOM = ("--stress", "--errors")  # over random scenes


@click.command()
@take_options("bench")
def bench(**asked: Any) -> None:
    """Measure the program itself: run time against error, stability, honesty.

    \b
    netdesign bench --plot bench.svg
    netdesign bench --stress 2000 --seed 1 --jobs 2
    netdesign bench --errors 200 --seed 1 --jobs 2
    netdesign bench --against netdesign-0.1.0-py3-none-any.whl
    """
    wanted = (*_RANDOM, "--against")
    options = [name for name in wanted if asked[name.strip("-")] is not None]
    _refuse_mixtures(options, asked)
    if not options:
        document = _run_named(asked)
    elif options == ["--against"]:
        document = _run_against(asked)
    else:
        document = _run_random(options[0], asked)
    if asked["as_json"]:
        print_document(document)
    else:
        _show(document, is_named=not options)
    sys.exit(0 if document.get("pass", True) else _EXIT_FAIL)


def _refuse_mixtures(options: Sequence[str], asked: Mapping[str, Any]) -> None:
    """Refuse options that do not go together."""
    if len(options) > 1:
        raise UsageRefusal(say("bench.one_of", given=tuple(options)))
    if options and (asked["scenes"] or asked["plot"]):
        raise UsageRefusal(say("bench.named_only"))
    is_random = bool(set(options) & set(_RANDOM))
    if asked["quick"] and is_random:
        raise UsageRefusal(say("bench.not_quick"))
    if not is_random:
        refuse_without(("seed", "accuracy", "jobs"), *_RANDOM)


def _show(document: dict[str, Any], *, is_named: bool) -> None:
    from rich.console import Console

    from netdesign.addons.evidence.benchmark.precision import print_bench
    from netdesign.addons.evidence.table import show_document

    show = print_bench if is_named else show_document
    show(document, Console())


def _run_random(option: str, asked: Mapping[str, Any]) -> dict[str, Any]:
    """Document of a run over random scenes."""
    from netdesign.addons.evidence.benchmark.random_scenes import (
        attempt_scenes,
        write_errors,
        write_stress,
    )

    count, seed, accuracy = asked[option.strip("-")], asked["seed"], asked["accuracy"]
    with follow(count, "scenes", asked) as on_done:
        attempts = attempt_scenes(
            count,
            seed,
            accuracy=accuracy,
            jobs=asked["jobs"],
            is_compared=option == "--errors",
            on_done=on_done,
        )
    write = write_errors if option == "--errors" else write_stress
    return write(attempts, seed, accuracy)


def _run_against(asked: Mapping[str, Any]) -> dict[str, Any]:
    from netdesign.addons.evidence.benchmark.versions import (
        QUICK,
        Size,
        compare_versions,
        count_runs,
        open_version,
        read_version,
    )

    size = QUICK if asked["quick"] else Size()
    with open_version(asked["against"]) as python:
        read_version(python)  # refused before the first run
        with follow(count_runs(size), "runs", asked) as on_done:
            return compare_versions(python, size, on_done)


def _run_named(asked: Mapping[str, Any]) -> dict[str, Any]:
    from netdesign.addons.evidence.benchmark.precision import (
        draw_work_precision,
        time_accuracies,
        write_bench,
    )
    from netdesign.addons.evidence.benchmark.scenes import load_scenes

    plot: Path | None = asked["plot"]
    require_places(plot and plot.parent, [plot.name] if plot else [], asked)
    names = asked["scenes"].split(",") if asked["scenes"] else ()
    chosen = load_scenes(tuple(name.strip() for name in names))
    rows = _measure(chosen, asked)
    if plot is not None:
        drawn = draw_work_precision(rows)
        write_outputs(plot.parent, {plot.name: drawn.encode()}, asked)
    return write_bench(rows, time_accuracies(chosen.values()))


def _measure(chosen: Mapping[str, Scene], asked: Mapping[str, Any]) -> Sequence[Row]:
    from netdesign.addons.evidence.benchmark.precision import (
        QUICK,
        measure_steady,
        measure_transient,
    )
    from netdesign.addons.evidence.benchmark.scenes import HISTORY_SCENES

    quick = asked["quick"]
    rows: list[Row] = []
    with follow(len(chosen), "scenes", asked) as on_done:
        for name, scene in chosen.items():
            rows += measure_steady(name, scene, **(QUICK if quick else {}))
            if name in HISTORY_SCENES and not quick:
                rows += measure_transient(name, scene)
            if on_done is not None:
                on_done(name)
    return rows
