"""``netdesign envelope``: the worst case of one scene over ranges."""

from __future__ import annotations

import json
import math
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.options import (
    RANGE,
    ShortHelpCommand,
    TypedRange,
    take_options,
)
from netdesign.commands.running import (
    UsageRefusal,
    open_phases,
    print_document,
    print_faults,
    require_places,
    speak,
    tell,
    write_outputs,
)
from netdesign.words.message import Message, say

if TYPE_CHECKING:
    from netdesign.edge.progress import Phase
    from netdesign.envelope.ranges import Ranges
    from netdesign.envelope.rows import RowTask
    from netdesign.report.words import Words
    from netdesign.solving.runner import Runner

_NOT_PROVEN = 4
_MOST_RANGES = 6
_USUAL_CASES = 18  # of a search, for each range
_MOST_GRID_CASES = 100_000
_DOCUMENT = "envelope.json"


@click.command(cls=ShortHelpCommand)
@click.argument("scene_file", type=click.Path(path_type=Path))
@take_options("envelope")
def envelope(scene_file: Path, **asked: Any) -> None:
    """Find the largest forces of a scene over ranges, with what may still hide.

    \b
    netdesign envelope scene.toml --density 250:450 --friction 15:45
    netdesign envelope scene.toml --inclination 25:35 --json
    netdesign envelope scene.toml --density 250:450:10 --friction 15:45:10
    """
    from netdesign.envelope.ranges import require_valid
    from netdesign.envelope.rows import build_search
    from netdesign.files.scene import read_scene_file

    out = asked["out"]
    ranging = [option.name or "" for option in _list_options()]
    spans = {name: asked[name] for name in ranging if asked[name] is not None}
    counts = _read_counts(spans)
    to_solve = read_scene_file(scene_file, "steady")
    ranges = _build_ranges(spans)
    require_valid(to_solve.scene, ranges)
    require_places(out, (_DOCUMENT,), asked)
    if to_solve.support is not None and not asked["quiet"]:
        tell(say("envelope.no_support"), err=True)
    start = time.perf_counter()
    with open_phases(_list_phases(counts, len(spans)), asked) as (runner, progress):
        task = build_search(
            *(to_solve.scene, ranges, asked["accuracy"]),
            is_confirmed=asked["confirm"] == "mesh",
        )
        document = _solve(task, counts, runner, start)
        progress.enter("outputs")
    failed = print_faults(runner.faults)
    if out:
        text = f"{json.dumps(document, indent=1, allow_nan=False)}\n"
        write_outputs(out, {_DOCUMENT: text.encode()}, asked)
    if asked["as_json"]:
        print_document(document)
    else:
        _show(document)
    sys.exit(failed or (_NOT_PROVEN if document["outcome"] == "not_proven" else 0))


def _list_options() -> list[click.Parameter]:
    """Options that take a range, in the order of the help."""
    command = click.get_current_context().command
    return [param for param in command.params if param.type is RANGE]


def _read_counts(spans: dict[str, TypedRange]) -> dict[str, int]:
    """Samples of each range of a grid; empty for a search. Too many are refused."""
    if not spans:
        flags = tuple(option.opts[0] for option in _list_options())
        raise UsageRefusal(say("usage.no_range", flags=flags))
    if len(spans) > _MOST_RANGES:
        raise UsageRefusal(
            say("usage.many_ranges", count=len(spans), most=_MOST_RANGES)
        )
    counts = {
        name: span.count for name, span in spans.items() if span.count is not None
    }
    if counts and len(counts) < len(spans):
        raise UsageRefusal(say("usage.mixed_ranges"))
    cases = math.prod(counts.values())
    if cases > _MOST_GRID_CASES:
        raise UsageRefusal(say("usage.large_grid", cases=cases, most=_MOST_GRID_CASES))
    return counts


def _list_phases(counts: dict[str, int], ranging: int) -> list[Phase]:
    """Phases with their estimated number of cases, confirmations included."""
    from netdesign.edge.progress import Phase

    number = math.prod(counts.values()) if counts else _USUAL_CASES * ranging
    words = say("phase.grid" if counts else "phase.search")
    return [
        Phase(key="envelope", words=words, cases=number),
        Phase(key="outputs", words=say("phase.outputs"), cases=0),
    ]


def _build_ranges(spans: dict[str, TypedRange]) -> Ranges:
    from netdesign.envelope.ranges import PARAMETERS, Interval, Ranges

    intervals = {}
    for name, span in spans.items():
        read = PARAMETERS[name].read
        intervals[name] = Interval(low=read(span.low), high=read(span.high))
    return Ranges.of(**intervals)


def _solve(
    task: RowTask,
    counts: dict[str, int],
    runner: Runner,
    start: float,
) -> dict[str, Any]:
    """Document of a grid with ``counts`` samples; without counts, of a search."""
    from netdesign.envelope.search import run_grid, search_rows
    from netdesign.files.cases import write_envelope_document, write_grid_document

    if counts:
        results, skipped = run_grid(task, counts, runner)
        elapsed = time.perf_counter() - start
        return write_grid_document(results, skipped, runner.counts, elapsed, speak())
    (extremes,) = search_rows([task], runner)
    elapsed = time.perf_counter() - start
    return write_envelope_document(extremes, runner.counts, elapsed, speak())


def _show(document: dict[str, Any]) -> None:
    from netdesign.report.words import Words, name_heading

    words = Words(speak())
    for extreme in document["extremes"]:
        line = words.show(_describe_extreme(extreme, words))
        click.echo(f"{name_heading(words, extreme['quantity']):30} {line}")
        confirmation = extreme.get("confirmation") or {}
        if confirmation.get("difference_percent") is not None:
            line = words.show(_describe_confirmation(confirmation))
            click.echo(f"{'':30} {line}")
    counts = tuple(
        say(f"case_count.{what}", count=count)
        for what, count in document["cases"].items()
    )
    seconds = document["cost"]["wall_s"]
    tell(say("envelope.cases", counts=counts, seconds=seconds))
    if document["reason"]:
        tell(say("envelope.not_proven", reason=document["reason"]))


def _describe_extreme(extreme: dict[str, Any], words: Words) -> Message:
    case = ", ".join(words.name_values(extreme["case"].items()))
    bound = extreme["upper_bound"]
    limit = say("envelope.no_bound")
    if bound is not None:
        limit = say("envelope.nowhere_above", bound=bound, high=extreme["high"])
    return say("envelope.at_case", max=extreme["max"], limit=limit, case=case)


def _describe_confirmation(confirmation: dict[str, Any]) -> Message:
    return say(
        "envelope.confirmed_again",
        force=confirmation["confirmed_kN_per_m"],
        elements=confirmation["elements"],
        difference=confirmation["difference_percent"],
    )
