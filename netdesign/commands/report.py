"""``netdesign report``, ``netdesign diff``: stored studies, shown without solving."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.options import STUDY, ShortHelpCommand, take_options
from netdesign.commands.running import find_exit_code, print_document, report_places
from netdesign.commands.stored_study import require_verified
from netdesign.commands.usage import tell
from netdesign.edge.output import PART_MARK, WHAT_IF_MARK
from netdesign.words.catalogue import Language
from netdesign.words.message import say

if TYPE_CHECKING:
    from netdesign.report.difference import Change
    from netdesign.report.files import ReportStyle
    from netdesign.study.records import Study

# Reports by the options that ask for them.
_REPORTS = {
    "html": "report.html",
    "pdf": "report.pdf",
    "docx": "report.docx",
    "excel": "report.xlsx",
    "csv": "cases.csv",
}
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
    wanted = {option: asked[option] for option in _REPORTS}
    if wanted["pdf"]:
        from netdesign.report.files import require_pdf

        require_pdf()
    if wanted["docx"]:
        from netdesign.report.document.styles import require_docx

        require_docx()
    return [name for option, name in _REPORTS.items() if wanted[option]]


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
