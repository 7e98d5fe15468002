"""``netdesign verify``: the program against truth, or a stored study against itself."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from netdesign.commands.options import jobs_option, json_option
from netdesign.commands.site_input import temporary_example
from netdesign.commands.solving import judge_rows, open_rows

if TYPE_CHECKING:
    from netdesign.site.model import Site
    from netdesign.study import Study

_FAIL = 1
_SHOWN = 20  # differences; more help nobody


@click.command()
@click.option(
    "--study",
    "study_file",
    type=click.Path(path_type=Path),
    metavar="STUDY.json",
    help="Hash and solve this study again instead.",
)
@click.option(
    "--site",
    "site_file",
    type=click.Path(path_type=Path),
    help="Its site file [by its name, beside the study or one folder up].",
)
@click.option(
    "--standard",
    metavar="ID",
    help="Its limit profile, or a folder with it [by its id].",
)
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

    The pack: closed forms, invariants, other codes. Of a study: its hashes, its own
    arithmetic, and every value of it against a new solve that uses no stored case;
    exit code 1 if anything differs.

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
    from netdesign.progress import show_progress
    from netdesign.verification.pack import GROUPS, run_pack, write_pack

    with show_progress(len(GROUPS), "groups of cases", quiet=False) as advance:
        cases = run_pack(advance)
    if as_json:
        click.echo(json.dumps(write_pack(cases), indent=1, allow_nan=False))
    else:
        from rich.console import Console

        from netdesign.report.verification_table import print_cases

        print_cases(cases, Console())
    return 0 if all(case.passes for case in cases) else _FAIL


def _verify_study(
    path: Path, site_file: Path | None, standard: str | None, jobs: int | None
) -> int:
    """Exit code; inputs that are not those of the study are not solved."""
    from netdesign.checks import load_standard
    from netdesign.study import load_study
    from netdesign.study_repeat import build_run

    study = load_study(path)
    run = build_run(study, jobs or os.cpu_count() or 1)
    site = _read_site(study, path, site_file)
    profile = load_standard(standard or study.profile.id)
    hashes = [
        _show_hash("site file", study.provenance.site_sha256, site.sha256),
        _show_hash("limit profile", study.profile.sha256, profile.sha256),
    ]
    if not all(hashes):
        click.echo("not solved again: these are not the inputs of the study")
        return _FAIL
    is_sound = _show_arithmetic(study)
    with open_rows(site, run, executor="", cache=False, quiet=False) as solved:
        (again,) = judge_rows(site, run, solved, [profile])
    is_same = _show_comparison(study, again)
    return 0 if is_sound and is_same else _FAIL


def _read_site(study: Study, study_file: Path, site_file: Path | None) -> Site:
    """Site of a study: as given, by its name, or the built-in example.

    Raises
    ------
    StudyError
        If there is none.
    """
    from netdesign.errors import StudyError
    from netdesign.given_files import is_there
    from netdesign.site.reader import read_site

    name = Path(study.provenance.site_file).name  # never a path out of these folders
    folder = study_file.absolute().parent
    near = [one / name for one in (folder, folder.parent)]
    if site_file is not None:
        return read_site(site_file)
    found = next((one for one in near if name and is_there(one)), None)
    if found is not None:
        return read_site(found)
    if " --example" not in study.provenance.command:
        raise StudyError(
            f"{study_file}: no site file {name!r:.60} beside it or one folder up: "
            "give it with --site"
        )
    with temporary_example() as path:
        return read_site(path)


def _show_hash(what: str, stored: str, again: str) -> bool:
    from netdesign.given_files import make_printable

    is_equal = stored == again
    click.echo(f"{what}, SHA-256: {'equal' if is_equal else 'DIFFERS'}")
    click.echo(f"  stored {make_printable(stored)}\n  now    {again}")
    return is_equal


def _show_arithmetic(study: Study) -> bool:
    """Whether verdicts and ratios of the study follow from its own numbers."""
    from netdesign.errors import NetDesignError
    from netdesign.given_files import make_printable
    from netdesign.report.gate import require_consistent

    try:
        require_consistent(study)
    except NetDesignError as error:
        click.echo(f"its own arithmetic: DIFFERS: {make_printable(str(error))}")
        return False
    click.echo("its own arithmetic: holds")
    return True


def _show_comparison(study: Study, again: Study) -> bool:
    from netdesign.given_files import make_printable
    from netdesign.report.tables import hash_results
    from netdesign.study import write_document
    from netdesign.study_repeat import list_differences, list_versions
    from netdesign.study_values import SAME

    old, new = list_versions(study), list_versions(again)
    for name in [name for name in old | new if old.get(name) != new.get(name)]:
        then = make_printable(str(old.get(name)))
        click.echo(f"other version: {name} {then} then, {new.get(name)} now")
    count, differences = list_differences(study, again)
    _show_hash("results", hash_results(study), hash_results(again))
    cases = sum(len(row.cases) for row in again.rows)
    click.echo(f"{cases} cases solved again, {count} values compared")
    for one in differences[:_SHOWN]:
        click.echo(f"  DIFFERS: {make_printable(str(one))}")
    if differences[_SHOWN:]:
        click.echo(f"  and {len(differences) - _SHOWN} more")
    if differences:
        return False
    is_equal = write_document(study) == write_document(again)
    click.echo("same bytes" if is_equal else f"same numbers, within {SAME:g} of each")
    return True
