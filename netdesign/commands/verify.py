"""``netdesign verify``: the program against truth, or a stored study against itself."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterator, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

import click

from netdesign.commands.faults import tell_faults
from netdesign.commands.options import jobs_option, json_option
from netdesign.commands.solving import open_run
from netdesign.commands.stored_study import (
    NO_COMMAND,
    contradict_command,
    origin_options,
    read_own_site,
)

if TYPE_CHECKING:
    from netdesign.study.records import Study
    from netdesign.study.values import Difference

_FAIL, _NOT_PROVEN = 1, 4
_SHOWN = 20  # differences; more help nobody


@click.command()
@click.option(
    "--study",
    "study_file",
    type=click.Path(path_type=Path),
    metavar="STUDY.json",
    help="Hash and solve this study again instead.",
)
@origin_options
@jobs_option("Processes of --study [all cores].")
@json_option("cases")
def verify(
    *,
    study_file: Path | None,
    site_file: Path | None,
    standard: str | None,
    jobs: int | None,
    as_json: bool,
) -> None:
    """Run the verification pack, or verify a stored study.

    The pack: closed forms, invariants, other codes. Of a study: its hashes, its
    command, its own arithmetic, and every value of it, with their order, against a new
    solve that uses no stored case. Exit code 1 if anything differs; 4 if nothing does,
    but something could not be verified, which is then named.

    \b
    netdesign verify
    netdesign verify --json
    netdesign verify --study reports/study.json --site site.xlsx
    """
    if study_file is None:
        if site_file or standard or jobs:
            raise click.UsageError("--site, --standard and --jobs go with --study")
        sys.exit(_run_pack(as_json=as_json))
    if as_json:
        raise click.UsageError("--json: not with --study")
    sys.exit(_verify_study(study_file, site_file, standard, jobs))


def _run_pack(*, as_json: bool) -> int:
    from netdesign.edge.progress import show_progress
    from netdesign.evidence.verification.pack import GROUPS, run_pack, write_pack

    with show_progress(len(GROUPS), "groups of cases", quiet=False) as advance:
        cases = run_pack(advance)
    if as_json:
        click.echo(json.dumps(write_pack(cases), indent=1, allow_nan=False))
    else:
        from rich.console import Console

        from netdesign.evidence.verification.verification_table import print_cases

        print_cases(cases, Console())
    return 0 if all(case.passes for case in cases) else _FAIL


def _verify_study(
    path: Path, site_file: Path | None, standard: str | None, jobs: int | None
) -> int:
    """Exit code; inputs that are not those of the study are not solved."""
    from netdesign.checks import load_standard
    from netdesign.study.audit import audit_study
    from netdesign.study.check_site import check_site
    from netdesign.study.records import load_study
    from netdesign.study.repeat import build_run, is_of_ties, list_differences

    study = load_study(path)
    run = build_run(study, jobs or os.cpu_count() or 1)
    site = read_own_site(study, path, site_file)
    profile = load_standard(standard or study.profile.id)
    hashes = [
        _show_hash("site file", study.provenance.site_sha256, site.sha256),
        _show_hash("limit profile", study.profile.sha256, profile.sha256),
    ]
    if not all(hashes):
        click.echo("not solved again: these are not the inputs of the study")
        return _FAIL
    told = [
        _show_digest(study),
        _show_contradictions("its command", list(contradict_command(study))),
        _show_contradictions("its time", list(_contradict_time(study))),
        _show_contradictions("its own arithmetic", audit_study(study, profile, site)),
    ]
    with open_run(site, run, executor="", cache=False, quiet=False) as (runner, watch):
        (again,) = check_site(site, [profile], run, runner, watch)
    if failed := tell_faults(runner.faults):
        return failed
    count, differences = list_differences(study, again)
    ties = [one for one in differences if is_of_ties(one)]
    differences = [one for one in differences if one not in ties]
    _show_comparison(study, again, count, differences)
    left = _show_unverified(study, again, ties)
    if differences or not all(told):
        return _FAIL
    return _NOT_PROVEN if left else 0


def _show_hash(what: str, stored: str, again: str) -> bool:
    from netdesign.edge.given_files import make_printable

    is_equal = stored == again
    click.echo(f"{what}, SHA-256: {'equal' if is_equal else 'DIFFERS'}")
    click.echo(f"  stored {make_printable(stored)}\n  now    {again}")
    return is_equal


def _show_digest(study: Study) -> bool:
    """Whether the document is as it was written; one without a digest may be."""
    from netdesign.study.records import compute_digest

    if not study.digest:
        return True
    return _show_hash("document", study.digest, compute_digest(study))


def _show_contradictions(what: str, found: Sequence[str]) -> bool:
    from netdesign.edge.given_files import make_printable

    for one in found[:_SHOWN]:
        click.echo(f"{what}: DIFFERS: {make_printable(one)}")
    if not found:
        click.echo(f"{what}: holds")
    return not found


def _contradict_time(study: Study) -> Iterator[str]:
    """The time of the run lies in no future and has a zone; more nobody can know."""
    started = study.provenance.started
    if not started:
        return
    time = datetime.fromisoformat(started)
    if time.tzinfo is None:
        yield f"{started} has no time zone"
    elif time > datetime.now(UTC):
        yield f"{started} lies in the future"


def _show_comparison(
    study: Study, again: Study, count: int, differences: Sequence[Difference]
) -> None:
    """Tell which values do not come out; the hash may differ in last digits."""
    from netdesign.edge.given_files import make_printable
    from netdesign.report.view.tables import hash_results
    from netdesign.study.records import write_document
    from netdesign.study.values import SAME

    stored, now = hash_results(study), hash_results(again)
    if stored == now or differences:
        _show_hash("results", stored, now)
    else:
        click.echo("results, SHA-256: not equal, by last digits only")
    cases = sum(len(row.cases) for row in again.rows)
    click.echo(f"{cases} cases solved again, {count} values compared")
    for one in differences[:_SHOWN]:
        click.echo(f"  DIFFERS: {make_printable(str(one))}")
    if differences[_SHOWN:]:
        click.echo(f"  and {len(differences) - _SHOWN} more")
    if not differences:
        is_equal = write_document(study) == write_document(again)
        same = f"same numbers, within {SAME:g} of each"
        click.echo("same bytes" if is_equal else same)


def _show_unverified(study: Study, again: Study, ties: Sequence[Difference]) -> bool:
    """Tell what no new solve can show; whether any of it might have been shown."""
    from netdesign.edge.given_files import make_printable
    from netdesign.study.repeat import list_versions

    made = study.provenance
    old, new = list_versions(study), list_versions(again)
    others = [name for name in old | new if old.get(name) != new.get(name)]
    for name in others:
        then = make_printable(str(old.get(name)))
        click.echo(f"not verified: {name} {then} then, {new.get(name)} now")
    if ties:
        click.echo(
            f"not verified: {len(ties)} values in the logs of the searches, in which "
            f"other processors break ties in other ways; the first: "
            f"{make_printable(str(ties[0]))}"
        )
    if not study.digest:
        click.echo("not verified: whether it was altered, since it has no SHA-256")
    if made.command == NO_COMMAND:
        click.echo("not verified: its command, which is not stated")
    time = make_printable(made.started) or "not stated"
    click.echo(
        f"as stated, known to nobody else: time of the run ({time}), the words of its "
        "command that decide no value; the document's SHA-256 shows only that nobody "
        "altered them without computing it again"
    )
    unknown = (others, ties, not study.digest, made.command == NO_COMMAND)
    return any(map(bool, unknown))
