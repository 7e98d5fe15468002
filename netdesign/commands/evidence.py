"""``netdesign verify``, ``validate``, ``paper``: the program against what is known."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.options import (
    refuse_without,
    take_options,
)
from netdesign.commands.running import (
    follow,
    format_time,
    open_run,
    print_document,
    print_faults,
    require_places,
    write_outputs,
)
from netdesign.commands.stored_study import (
    NO_COMMAND,
    contradict_command,
    read_own_site,
)
from netdesign.commands.usage import UsageRefusal, speak, tell
from netdesign.words.message import Message, say

if TYPE_CHECKING:
    from netdesign.study.records import Study
    from netdesign.study.values import Difference


_FAIL, _NOT_PROVEN = 1, 4
_SHOWN = 20  # differences; more help nobody


@click.command()
@take_options("verify")
def verify(**asked: Any) -> None:
    """Run the verification pack, or verify a stored study.

    The pack: closed forms, invariants, other codes. Of a study: its hashes, its
    command, its own arithmetic, and every value of it, with their order, against a new
    solve that uses no stored case. Exit code 1 if anything differs; 4 if nothing does,
    but something could not be verified, which is then named.

    \b
    netdesign verify
    netdesign verify --json
    netdesign verify --out verification
    netdesign verify --study reports/study.json --site site.xlsx
    """
    if asked["study_file"] is None:
        refuse_without(("site_file", "standard", "jobs"), "--study")
        sys.exit(_run_pack(asked))
    if asked["out"] is not None:
        raise UsageRefusal(say("usage.out_not_with_study"))
    if asked["as_json"]:
        raise UsageRefusal(say("usage.json_not_with_study"))
    sys.exit(_verify_study(asked["study_file"], asked))


def _run_pack(asked: Mapping[str, Any]) -> int:
    from netdesign.evidence.validation.page import gather, list_pages, render_pages
    from netdesign.evidence.verification.pack import GROUPS, run_pack, write_pack

    require_places(asked["out"], list_pages(), asked)
    with follow(len(GROUPS), "groups", asked) as advance:
        cases = run_pack(advance)
    if asked["as_json"]:
        print_document(write_pack(cases))
    else:
        from rich.console import Console

        from netdesign.evidence.verification.pack import print_cases
        from netdesign.report.words import Words

        print_cases(cases, Console(), Words(speak()))
    if asked["out"] is not None:
        pages = render_pages(gather((), cases=cases), speak())
        write_outputs(asked["out"], pages, asked)
    return 0 if all(case.passes for case in cases) else _FAIL


def _verify_study(path: Path, asked: Mapping[str, Any]) -> int:
    """Exit code; inputs that are not those of the study are not solved."""
    from netdesign.study.check_site import check_site
    from netdesign.study.document import load_study
    from netdesign.study.record_provenance import (
        build_run,
        list_differences,
        load_own_profile,
    )
    from netdesign.study.rejudge import rejudge

    study = load_study(path)
    run = build_run(study, asked["jobs"] or os.cpu_count() or 1)
    site = read_own_site(study, path, asked["site_file"])
    if study.left_out:
        site = site.take_rows([row.id for row in study.rows])
    profile = load_own_profile(study.profile, asked["standard"])
    made = study.provenance
    hashes = [
        _show_hash(say("verify.site_file"), made.site_sha256, site.sha256),
        _show_hash(say("verify.limit_profile"), study.profile.sha256, profile.sha256),
    ]
    if not all(hashes):
        tell(say("verify.not_its_inputs"))
        return _FAIL
    arithmetic = rejudge(study, profile, site)
    told = [
        _show_digest(study),
        _show_contradictions(say("verify.its_command"), contradict_command(study)),
        _show_contradictions(say("verify.its_time"), _contradict_time(study)),
        _show_contradictions(say("verify.its_arithmetic"), arithmetic),
    ]
    solving = {"jobs": run.jobs, "executor": "", "cache": False, "quiet": False}
    with open_run(site, run, solving) as (runner, watch):
        (again,) = check_site(site, [profile], run, runner, watch)
    if failed := print_faults(runner.faults):
        return failed
    count, differences = list_differences(study, again)
    _show_comparison(study, again, count, differences)
    left = _show_unverified(study, again)
    if differences or not all(told):
        return _FAIL
    return _NOT_PROVEN if left else 0


def _contradict_time(study: Study) -> Iterator[Message]:
    """Contradictions of the run's time: it has no zone, or lies in the future."""
    started = study.provenance.started
    if not started:
        return
    time = datetime.fromisoformat(started)
    if time.tzinfo is None:
        yield say("verify.no_zone", time=started)
    elif time > datetime.now(UTC):
        yield say("verify.in_future", time=started)


def _show_hash(what: Message, stored: str, now: str) -> bool:
    """Tell two hashes; True if they are equal."""
    is_equal = stored == now
    key = "verify.hash_equal" if is_equal else "verify.hash_differs"
    tell(say(key, what=what))
    tell(say("verify.hashes", stored=stored, now=now))
    return is_equal


def _show_digest(study: Study) -> bool:
    """Tell the document's digest; True if it holds, or if there is none."""
    from netdesign.study.document import compute_digest

    if not study.digest:
        return True
    return _show_hash(say("verify.document"), study.digest, compute_digest(study))


def _show_contradictions(what: Message, found: Iterable[Message]) -> bool:
    """Tell the first contradictions; True if there are none."""
    told = list(found)
    for one in told[:_SHOWN]:
        tell(say("verify.differs", what=what, reason=one))
    if not told:
        tell(say("verify.holds", what=what))
    return not told


def _show_comparison(
    study: Study, again: Study, count: int, differences: Sequence[Difference]
) -> None:
    """Tell which values do not come out; the hash may differ in last digits."""
    from netdesign.study.document import hash_results, write_document
    from netdesign.study.values import SAME

    stored, now = hash_results(study), hash_results(again)
    if stored == now or differences:
        _show_hash(say("verify.results"), stored, now)
    else:
        tell(say("verify.last_digits"))
    cases = sum(len(row.cases) for row in again.rows)
    tell(say("verify.compared", cases=cases, values=count))
    for one in differences[:_SHOWN]:
        tell(say("verify.difference", value=one.message))
    if differences[_SHOWN:]:
        tell(say("verify.more", count=len(differences) - _SHOWN))
    if not differences:
        is_equal = write_document(study) == write_document(again)
        same = say("verify.same_numbers", share=SAME)
        tell(say("verify.same_bytes") if is_equal else same)


def _show_unverified(study: Study, again: Study) -> bool:
    """Tell what a new solve cannot show; True if some of it is avoidable."""
    from netdesign.study.record_provenance import list_versions

    made = study.provenance
    old, new = list_versions(study), list_versions(again)
    others = [name for name in old | new if old.get(name) != new.get(name)]
    for name in others:
        then, now = str(old.get(name)), str(new.get(name))
        tell(say("verify.other_version", name=name, then=then, now=now))
    if not study.digest:
        tell(say("verify.no_digest"))
    if made.command == NO_COMMAND:
        tell(say("verify.no_command"))
    tell(say("verify.as_stated", time=made.started or say("verify.not_stated")))
    return bool(others) or not study.digest or made.command == NO_COMMAND


def _predict(structures: Path | None, asked: Mapping[str, Any]) -> int:
    """Exit code; writes form and letter, a prediction, or forces beside one."""
    from netdesign.edge.given_files import MAX_TOML_BYTES, read_bounded
    from netdesign.evidence.validation import prediction_page as page
    from netdesign.evidence.validation.measured_file import read_form
    from netdesign.evidence.validation.prediction import (
        compare,
        open_sealed,
        predict,
        seal,
        write_hits,
    )

    if structures or (asked["form"] and asked["predict"]):
        raise UsageRefusal(say("usage.one_of_predict"))
    folder, language = asked["out"], asked["language"]
    if asked["form"]:
        write_outputs(folder, page.write_form(language), asked)
        return 0
    form, stored = read_form(asked["predict"]), folder / page.PREDICTION_FILE
    if not stored.exists():
        made = predict(form, format_time())
        told = page.render_prediction(made, language)
        files = {page.PREDICTION_FILE: seal(made), page.PAGE_FILE: told}
        write_outputs(folder, files, asked)
        if asked["as_json"]:
            print_document(json.loads(seal(made)))
        else:
            tell(say("prediction.stored", digest=made.digest))
        return 0
    prediction = open_sealed(read_bounded(stored, MAX_TOML_BYTES).decode())
    hits = compare(form, prediction)
    told = page.render_comparison(prediction, hits, language)
    write_outputs(folder, {page.COMPARISON_FILE: told}, asked)
    if asked["as_json"]:
        print_document(write_hits(hits, prediction))
    return 0 if all(one.is_inside for one in hits) else _NOT_PROVEN


@click.command()
@click.argument(
    "structures", required=False, type=click.Path(path_type=Path), metavar="[FILE.toml]"
)
@take_options("validate")
def validate(structures: Path | None, **asked: Any) -> None:
    """Write one page: verification, settling of snow, measured structures.

    With a file, its structures stand first: one whose inputs are all values gets a
    misfit, others a band. The form is that of the program's own,
    netdesign/evidence/validation/measured.toml. Exit code 1 if a case of the
    verification fails, 4 if a measured force lies outside its band.

    \b
    netdesign validate --out validation
    netdesign validate my-net.toml --out validation
    netdesign validate --out validation --json > validation.json
    netdesign validate --form --out my-net
    netdesign validate --predict my-net/form.toml --out my-net
    """
    if asked["form"] or asked["predict"]:
        sys.exit(_predict(structures, asked))
    from netdesign.evidence.validation.measured_file import read_all
    from netdesign.evidence.validation.page import (
        count_parts,
        gather,
        list_pages,
        render_pages,
        write_evidence,
    )

    require_places(asked["out"], list_pages(), asked)
    known = read_all(structures)
    with follow(count_parts(known), "parts", asked) as advance:
        evidence = gather(known, advance)
    write_outputs(asked["out"], render_pages(evidence, asked["language"]), asked)
    if asked["as_json"]:
        print_document(write_evidence(evidence))
    if not all(case.passes for case in evidence.cases):
        sys.exit(_FAIL)
    bands = [one for one in evidence.validations if not one.structure.is_known]
    if not all(c.is_inside for one in bands for c in one.comparisons):
        sys.exit(_NOT_PROVEN)


@click.command()
@take_options("paper")
def paper(**asked: Any) -> None:
    """Reproduce the source paper's study: histories, meshes, plateaus.

    \b
    netdesign paper --out paper
    """
    from netdesign.evidence.paper.page import PAGE_FILE, render_paper
    from netdesign.evidence.paper.runs import PaperSettings, list_cases, run_study

    settings, jobs = PaperSettings(), asked["jobs"] or os.cpu_count() or 1
    require_places(asked["out"], [PAGE_FILE], asked)
    with follow(len(list_cases(settings)), "runs", asked) as on_done:
        study = run_study(settings, jobs=jobs, on_done=on_done)
    files = render_paper(study, asked["language"])
    write_outputs(asked["out"], files, {**asked, "quiet": True})
    if not asked["quiet"]:
        page = str(asked["out"] / PAGE_FILE)
        tell(say("paper.wrote", path=page, count=len(files) - 1), err=True)
    if any(run.failure for run in study.runs.values()):
        sys.exit(_NOT_PROVEN)
