"""``netdesign verify``, ``validate``, ``paper``: the program against what is known."""

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
from netdesign.commands.running import (
    follow,
    print_document,
    require_places,
    write_outputs,
)
from netdesign.commands.stored_study import (
    find_inputs,
    show_differences,
    solve_again,
)
from netdesign.commands.usage import UsageRefusal, tell
from netdesign.words.message import Message, say

if TYPE_CHECKING:
    from netdesign.study.document import Difference
    from netdesign.study.records import Study


_FAIL, _NOT_PROVEN = 1, 4
_SHOWN = 20  # differences at most


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
    from netdesign.study.record_provenance import find_time_fault, list_differences

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
    """Print the values that differ; the hash may differ by last digits alone."""
    from netdesign.study.document import SAME, hash_results, write_document

    stored, now = hash_results(study), hash_results(again)
    if stored == now or differences:
        _show_hash(say("verify.results"), stored, now)
    else:
        tell(say("verify.last_digits"))
    cases = sum(len(row.cases) for row in again.rows)
    tell(say("verify.compared", cases=cases, values=count))
    for line in show_differences(differences):
        tell(line)
    if not differences:
        is_equal = write_document(study) == write_document(again)
        same = say("verify.same_numbers", share=SAME)
        tell(say("verify.same_bytes") if is_equal else same)


def _show_unverified(study: Study, again: Study) -> bool:
    """Print what a new solve cannot verify; True if versions or missing rows do it."""
    from netdesign.study.record_provenance import list_versions

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
    from netdesign.addons.evidence.validation.page import (
        DOCUMENT_FILE,
        PAGE_FILE,
        gather,
        render_validation,
        write_validations,
    )
    from netdesign.addons.evidence.validation.structure import load_structures

    require_places(asked["out"], [PAGE_FILE, DOCUMENT_FILE], asked)
    structures = load_structures()
    with follow(len(structures), "structures", asked) as on_done:
        validations = gather(structures, on_done)
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
    from netdesign.addons.evidence.paper.runs import (
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
