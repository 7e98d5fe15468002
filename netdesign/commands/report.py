"""``netdesign report``, ``netdesign diff``: stored studies, shown or solved again."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.options import STUDY, ShortHelpCommand, take_options
from netdesign.commands.running import (
    find_exit_code,
    print_document,
    report_places,
    tell,
)
from netdesign.commands.site_input import temporary_example
from netdesign.edge.output import PART_MARK, WHAT_IF_MARK
from netdesign.outcome import StudyError
from netdesign.words.catalogue import Language
from netdesign.words.message import Message, say

if TYPE_CHECKING:
    from netdesign.checks import Standard
    from netdesign.report.difference import Change
    from netdesign.report.files import ReportStyle
    from netdesign.site.model import Site
    from netdesign.study.document import Difference
    from netdesign.study.records import Study

_TURNED = 1


def mark_names(
    names: Sequence[str], *, is_what_if: object, is_part: object
) -> list[str]:
    """Names of outputs, marked where they are of a what-if or of some net rows."""
    mark = (WHAT_IF_MARK if is_what_if else "") + (PART_MARK if is_part else "")
    return [f"{mark}{name}" for name in names]


def list_wanted(asked: Mapping[str, Any]) -> list[str]:
    """Names of the reports that the options of a command ask for.

    Raises
    ------
    NetDesignError
        If a report cannot be written on this machine.
    """
    from netdesign.report.files import NAMES, require_pdf

    if asked["pdf"]:
        require_pdf()
    if asked["docx"]:
        from netdesign.report.document.styles import require_docx

        require_docx()
    is_wanted = {**asked, "xlsx": asked["excel"]}
    return [name for kind, name in NAMES.items() if is_wanted[kind]]


def choose_style(asked: Mapping[str, Any]) -> ReportStyle:
    """Style of the reports."""
    from netdesign.report.files import ReportStyle

    return ReportStyle(language=asked["language"], has_annexes=asked["annexes"])


@click.command(cls=ShortHelpCommand)
@click.argument("study_file", metavar="STUDY", type=STUDY)
@take_options("report")
def report(study_file: Path, **asked: Any) -> None:
    """Render the reports of a stored study again, without solving.

    They say that the study is not verified, unless --verify solves it again, as
    `netdesign verify STUDY` does, and every value of it comes out.

    \b
    netdesign report netdesign-out --out again
    netdesign report netdesign-out --verify --out verified
    netdesign report netdesign-out --language fr --out rapport
    netdesign report netdesign-out --annexes --no-excel --force

    STUDY, OLD and NEW of such commands are a study.json or the folder with it.
    """
    from netdesign.edge.output import require_free, write_files
    from netdesign.report.files import render_files
    from netdesign.study.document import load_study

    study = load_study(study_file)
    wanted = mark_names(
        list_wanted(asked), is_what_if=study.what_if, is_part=study.left_out
    )
    paths = [asked["out"] / name for name in wanted]
    require_free(paths, overwrite=asked["force"])
    is_verified = _look_at((study,), (study_file,), asked)
    style = replace(choose_style(asked), is_verified=is_verified)
    files = render_files(dict.fromkeys(paths, study), style)
    write_files(files, overwrite=asked["force"], is_recorded=True)
    report_places(files, asked)
    sys.exit(find_exit_code([study]))


def _look_at(
    studies: Sequence[Study], paths: Sequence[Path], asked: Mapping[str, Any]
) -> bool:
    """Verify the studies if ``--verify`` asks for it, and print whether it was done.

    Raises
    ------
    StudyError
        If a study differs when it is solved again.
    """
    if asked["verify"]:
        for study, path in zip(studies, paths, strict=True):
            require_verified(study, path, asked)
    if not asked.get("as_json"):
        tell(say("standing.verified" if asked["verify"] else "standing.not_verified"))
    return bool(asked["verify"])


@click.command()
@click.argument("old", type=STUDY)
@click.argument("new", type=STUDY)
@take_options("diff")
def diff(old: Path, new: Path, **asked: Any) -> None:
    """Show what changed from one study to another: verdicts, checks, inputs.

    Verdicts that got worse come first. Exit code 1 if a verdict turned: of the study,
    of a net row or of any check in it. The studies are not verified, unless --verify
    solves both again.

    \b
    netdesign diff rev-a rev-b
    netdesign diff rev-a/study.json rev-b/study.json --json
    """
    from netdesign.report.difference import compare_studies, write_difference
    from netdesign.study.document import load_study

    before, after = load_study(old), load_study(new)
    is_verified = _look_at((before, after), (old, new), asked)
    changes = compare_studies(before, after)
    if asked["as_json"]:
        document = write_difference(changes, asked["language"])
        print_document({**document, "is_verified": is_verified})
    else:
        _show(changes, asked["language"])
    sys.exit(_TURNED if any(change.is_turned for change in changes) else 0)


def _show(changes: Sequence[Change], language: Language) -> None:
    from netdesign.report.difference import name_area, share_rows

    area = ""
    for change, rows in share_rows(changes):
        if change.area != area:
            area = change.area
            click.echo(name_area(area, language))
        click.echo(f"  {change.tell(language, rows)}")
    if not changes:
        tell(say("diff.same"))


_SHOWN = 20  # differences; more are counted


@dataclass(frozen=True, slots=True, kw_only=True)
class Inputs:
    """Present site and limit profile of a stored study."""

    site: Site
    profile: Standard

    def list_hashes(self, study: Study) -> list[tuple[Message, str, str]]:
        """Name, stored hash and present hash of each input."""
        made, used = study.provenance, study.profile
        return [
            (say("verify.site_file"), made.site_sha256, self.site.sha256),
            (say("verify.limit_profile"), used.sha256, self.profile.sha256),
        ]


def find_inputs(study: Study, study_file: Path, asked: Mapping[str, Any]) -> Inputs:
    """Find site and profile by their names, or by the options ``asked``.

    Raises
    ------
    NetDesignError
        If an input is missing, or cannot be read.
    """
    from netdesign.study.record_provenance import load_own_profile

    site = read_own_site(study, study_file, asked.get("site_file"))
    if study.left_out:
        site = site.take_rows([row.id for row in study.rows])
    profile = load_own_profile(study.profile, asked.get("standard"))
    return Inputs(site=site, profile=profile)


def read_own_site(study: Study, study_file: Path, site_file: Path | None) -> Site:
    """Read the site of a study: ``site_file``, a file of its name, or the example.

    Raises
    ------
    StudyError
        If no such site is found.
    """
    from netdesign.edge.input_files import is_there, make_printable

    name = Path(study.provenance.site_file).name  # never a path out of these folders
    folder = study_file.absolute().parent
    places = [parent / name for parent in (folder, folder.parent)]
    if site_file is not None:
        return _read_again(study, site_file)
    site_path = next((path for path in places if name and is_there(path)), None)
    if site_path is None:  # a study has a blank for a sign that would steer a terminal
        beside = (path for place in places for path in sorted(place.parent.iterdir()))
        alike = (path for path in beside if make_printable(path.name) == name)
        site_path = next(alike, None)
    if site_path is not None:
        return _read_again(study, site_path)
    with temporary_example() as path:
        if name == path.name:
            return _read_again(study, path)
    raise StudyError(say("stored.no_site", study=str(study_file), site=f"{name!r:.60}"))


def _read_again(study: Study, path: Path) -> Site:
    """Read a site again with the options that the study was made with."""
    from netdesign.site.declared_sheet import split_replacement
    from netdesign.site.reader import read_site
    from netdesign.study.record_provenance import read_library_name, read_text_format

    library = Path(read_library_name(study.provenance)).name
    net_types = path.parent / library if library else None
    instead = (split_replacement(f"{cell.cell}={cell.now}") for cell in study.what_if)
    cells = dict(filter(None, instead))
    form = read_text_format(study.provenance)
    return read_site(path, form, cells, net_types=net_types)


def solve_again(study: Study, inputs: Inputs, asked: Mapping[str, Any]) -> Study:
    """Solve the same inputs again, without stored cases.

    A fault of the program in a solve ends the command.
    """
    from netdesign.commands.running import open_run, print_faults
    from netdesign.study.check_site import check_site
    from netdesign.study.record_provenance import build_run

    run = build_run(study)
    jobs = asked.get("jobs")
    solving = {"jobs": jobs, "executor": "", "cache": False, "quiet": False}
    with open_run(inputs.site, solving) as (runner, watch):
        (again,) = check_site(inputs.site, [inputs.profile], run, runner, watch)
    if failed := print_faults(runner.faults):
        sys.exit(failed)
    return again


def require_inputs(study: Study, study_file: Path, asked: Mapping[str, Any]) -> Inputs:
    """Find site and profile, which must have the hashes of the study.

    Raises
    ------
    StudyError
        If an input has another hash.
    """
    inputs = find_inputs(study, study_file, asked)
    hashes = inputs.list_hashes(study)
    others = [what for what, stored, now in hashes if stored != now]
    _refuse(study_file, [say("verify.hash_differs", what=what) for what in others])
    return inputs


def require_verified(study: Study, study_file: Path, asked: Mapping[str, Any]) -> None:
    """Refuse a study whose values differ when it is solved again.

    Raises
    ------
    StudyError
        Names the values that differ, or the input with another hash.
    """
    from netdesign.study.record_provenance import list_differences

    inputs = require_inputs(study, study_file, asked)
    _, differences = list_differences(study, solve_again(study, inputs, asked))
    _refuse(study_file, show_differences(differences))


def _refuse(study_file: Path, lines: list[Message]) -> None:
    if lines:
        raise StudyError(
            say("stored.not_again", study=str(study_file), lines=tuple(lines))
        )


def show_differences(differences: list[Difference]) -> list[Message]:
    """Lines about the first differences, and the number of the others."""
    messages = (difference.message for difference in differences[:_SHOWN])
    lines = [say("verify.difference", value=message) for message in messages]
    if differences[_SHOWN:]:
        lines.append(say("verify.more", count=len(differences) - _SHOWN))
    return lines
