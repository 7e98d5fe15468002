"""``netdesign verify``, ``bench``, ``validate``, ``paper``: the program measured."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.options import (
    STUDY,
    refuse_without,
    take_options,
)
from netdesign.commands.report import (
    find_inputs,
    show_differences,
    solve_again,
)
from netdesign.commands.running import (
    UsageRefusal,
    follow,
    print_document,
    require_places,
    tell,
    write_outputs,
)
from netdesign.words.message import Message, say

if TYPE_CHECKING:
    from collections.abc import Sequence

    from netdesign.addons.evidence.benchmark.precision import Row
    from netdesign.coupling.scene import Scene
    from netdesign.study.document import Difference
    from netdesign.study.records import Study

_FAIL, _NOT_PROVEN = 1, 4


@click.command()
@click.argument("study", required=False, type=STUDY)
@take_options("verify")
def verify(study: Path | None, **asked: Any) -> None:
    """Run the verification pack, or verify a stored study.

    The pack: closed forms, invariants, other codes. Of a study: its hashes, and every
    value of it, with their order, against a new solve that uses no stored case. Exit
    code 1 if anything differs; 4 if nothing does, but something could not be verified,
    which is then named.

    \b
    netdesign verify
    netdesign verify --json
    netdesign verify reports --site site.xlsx
    """
    study = study or asked["study_file"]
    if study is None:
        refuse_without(("site_file", "standard", "jobs"), "STUDY")
        sys.exit(_run_pack(asked))
    if asked["as_json"]:
        raise UsageRefusal(say("usage.json_not_with_study"))
    sys.exit(_verify_study(study, asked))


def _run_pack(asked: Mapping[str, Any]) -> int:
    from netdesign.addons.evidence.verification.pack import GROUPS, run_pack, write_pack

    with follow(len(GROUPS), "groups", asked) as advance:
        cases = run_pack(advance)
    if asked["as_json"]:
        print_document(write_pack(cases))
    else:
        from rich.console import Console

        from netdesign.addons.evidence.verification.pack import print_cases

        print_cases(cases, Console())
    return 0 if all(case.passes for case in cases) else _FAIL


def _verify_study(path: Path, asked: Mapping[str, Any]) -> int:
    """Exit code; inputs that are not those of the study are not solved."""
    from netdesign.study.document import load_study
    from netdesign.study.record_provenance import list_differences

    study = load_study(path)
    inputs = find_inputs(study, path, asked)
    hashes = inputs.list_hashes(study)
    for entry in hashes:
        _show_hash(*entry)
    if any(stored != now for _, stored, now in hashes):
        tell(say("verify.not_its_inputs"))
        return _FAIL
    again = solve_again(study, inputs, asked)
    count, differences = list_differences(study, again)
    if wrong := find_time_fault(study):
        tell(wrong)
    _show_comparison(study, again, count, differences)
    left = _show_unverified(study, again)
    if differences or wrong:
        return _FAIL
    return _NOT_PROVEN if left else 0


def _show_hash(what: Message, stored: str, now: str) -> None:
    """Print a stored hash beside the present one."""
    key = "verify.hash_equal" if stored == now else "verify.hash_differs"
    tell(say(key, what=what))
    tell(say("verify.hashes", stored=stored, now=now))


def _show_comparison(
    study: Study, again: Study, count: int, differences: list[Difference]
) -> None:
    """Print the values that differ."""
    from netdesign.study.document import SAME, write_document

    cases = sum(len(row.cases) for row in again.rows)
    tell(say("verify.compared", cases=cases, values=count))
    for line in show_differences(differences):
        tell(line)
    if not differences:
        is_equal = write_document(study) == write_document(again)
        same = say("verify.same_numbers", share=SAME)
        tell(say("verify.same_bytes") if is_equal else same)


def list_versions(study: Study) -> dict[str, str]:
    """Program and libraries that made a study."""
    made = study.provenance
    return {"netdesign": made.version, **made.libraries}


def find_time_fault(study: Study) -> Message | None:
    """Fault of the time of a run: it has no zone, or lies in the future."""
    from datetime import UTC, datetime

    started = study.provenance.started
    time = datetime.fromisoformat(started or "1980-01-01T00:00+00:00")
    if time.tzinfo is None:
        return say("verify.no_zone", time=started)
    is_past = time <= datetime.now(UTC)
    return None if is_past else say("verify.in_future", time=started)


def _show_unverified(study: Study, again: Study) -> bool:
    """Print what a new solve cannot verify; True if versions or missing rows do it."""
    old, new = list_versions(study), list_versions(again)
    others = [name for name in old | new if old.get(name) != new.get(name)]
    for name in others:
        then, now = str(old.get(name)), str(new.get(name))
        tell(say("verify.other_version", name=name, then=then, now=now))
    if study.left_out:
        tell(say("verify.left_out", rows=tuple(study.left_out)))
    time = study.provenance.started or say("verify.not_stated")
    tell(say("verify.as_stated", time=time))
    return bool(others or study.left_out)


@click.command()
@take_options("validate")
def validate(**asked: Any) -> None:
    """Write one page: forces measured on structures, in the bands of the model.

    Exit code 4 if a measured force lies outside its band.

    \b
    netdesign validate --out validation
    netdesign validate --out validation --json > validation.json
    """
    from netdesign.addons.evidence.measurements import spread
    from netdesign.addons.evidence.validation import (
        DOCUMENT_FILE,
        PAGE_FILE,
        load_structures,
        render_validation,
        validate_structure,
        write_validations,
    )

    require_places(asked["out"], [PAGE_FILE, DOCUMENT_FILE], asked)
    structures = load_structures()
    with follow(len(structures), "structures", asked) as on_done:
        validations = spread(validate_structure, structures, on_done=on_done)
    write_outputs(asked["out"], render_validation(validations), asked)
    if asked["as_json"]:
        print_document(write_validations(validations))
    pairs = [pair for validation in validations for pair in validation.comparisons]
    if not all(pair.is_inside for pair in pairs):
        sys.exit(_NOT_PROVEN)


@click.command()
@take_options("paper")
def paper(**asked: Any) -> None:
    """Reproduce the source paper's study: numbers, and four plates.

    \b
    netdesign paper --out paper
    """
    from netdesign.addons.evidence.paper.page import PAGE_FILE, render_paper
    from netdesign.addons.evidence.paper.study import (
        PaperSettings,
        list_cases,
        run_study,
    )

    settings, jobs = PaperSettings(), asked["jobs"] or os.cpu_count() or 1
    require_places(asked["out"], [PAGE_FILE], asked)
    with follow(len(list_cases()), "runs", asked) as on_done:
        study = run_study(settings, jobs=jobs, on_done=on_done)
    write_outputs(asked["out"], render_paper(study), asked)
    if any(run.failure for run in study.runs.values()):
        sys.exit(_NOT_PROVEN)


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
    sys.exit(0 if document.get("pass", True) else _FAIL)


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
    from netdesign.addons.evidence.measurements import show_document

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
