"""Carries out the check of a site: solves, judges, writes and prints."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from netdesign.commands.report import choose_style, list_wanted, mark_names
from netdesign.commands.running import (
    find_exit_code,
    open_run,
    print_document,
    print_faults,
    print_next_step,
    report_places,
    speak,
    tell,
)
from netdesign.edge.output import (
    STUDY_FILE,
    WHAT_IF_MARK,
    print_json,
    write_files,
)
from netdesign.words.catalogue import render
from netdesign.words.message import say

if TYPE_CHECKING:
    from netdesign.checks import Standard
    from netdesign.edge.progress import RunProgress
    from netdesign.site.model import Site
    from netdesign.solving.runner import Runner
    from netdesign.study.check_site import OnRow
    from netdesign.study.records import RowStudy, Study
    from netdesign.study.row_to_check import CheckRun
    from netdesign.study.sizing import ReadInstead, SizedCell

    # smallest types under one profile; no study where nothing is replaced
    Sized = tuple[Sequence[SizedCell], Study | None]


def carry_out(
    site: Site,
    profiles: Sequence[Standard],
    run: CheckRun,
    outputs: Sequence[Sequence[Path]],
    read_instead: ReadInstead | None,
    asked: Mapping[str, Any],
    site_name: str,
) -> int:
    """Check a site, write its files, print its result; returns the exit code.

    Parameters
    ----------
    site : Site
        As it was read, with every value.
    profiles : sequence of Standard
        Limit profiles, with the floor that was chosen.
    run : CheckRun
        Settings, command line and time.
    outputs : sequence of sequence of Path
        Places of the reports, by profile.
    read_instead : callable or None
        Gives the site with some cells replaced; None without ``--size``.
    asked : mapping
        Options of the command line, by their names.
    site_name : str
        Site in the command lines of next steps.
    """
    from netdesign.study.check_site import check_site

    is_sized = read_instead is not None
    is_alone = len(profiles) == 1 and not is_sized and not asked["as_json"]
    is_live = is_alone and sys.stdout.isatty()
    sized: list[Sized] = []
    with open_run(site, asked) as (runner, progress):
        if read_instead is None:
            on_row = _print_rows(site, progress) if is_live else None
            studies = check_site(site, profiles, run, runner, progress, on_row)
        else:
            studies, sized = _check_and_size(
                site, profiles, run, read_instead, runner, progress
            )
        if not asked["as_json"]:  # known before the reports are
            progress.clear()
            _print_summaries(studies, asked, has_rows=is_live)
        progress.enter("reports")
        files = render_outputs(outputs, studies, sized, asked, runner)
    failed = print_faults(runner.faults)
    write_files(files, overwrite=asked["force"], is_recorded=True)
    if asked["as_json"]:
        print_json(_write_documents(studies))
        return failed or find_exit_code(studies, asked["scopes"])
    _print_sizes(sized, studies)
    report_places(files, asked)
    if not asked["quiet"] and not is_sized:
        verdicts = frozenset(
            row.find_verdict(asked["scopes"]) for study in studies for row in study.rows
        )
        print_next_step(verdicts, site_name)
    return failed or find_exit_code(studies, asked["scopes"])


def _print_rows(site: Site, progress: RunProgress) -> OnRow:
    """Print the head of the matrix; the returned function prints a finished row."""
    from netdesign.edge.output import open_console
    from netdesign.report.terminal import Matrix
    from netdesign.report.what_if import title_pages
    from netdesign.report.words import Words

    words = Words(speak())
    matrix = Matrix([row.id for row in site.rows], open_console(), words)
    progress.clear()
    matrix.print_head(title_pages(site, words))

    def print_row(studies: Sequence[RowStudy]) -> None:
        progress.clear()
        matrix.print_row(studies[0])
        sys.stdout.flush()

    return print_row


def _write_documents(studies: Sequence[Study]) -> str:
    from netdesign.study.document import write_document

    if len(studies) == 1:
        return write_document(studies[0])
    documents = ",\n".join(write_document(study) for study in studies)
    return f'{{"schema": "netdesign.studies/1", "studies": [\n{documents}\n]}}'


def _print_summaries(
    studies: Sequence[Study], asked: Mapping[str, Any], *, has_rows: bool = False
) -> None:
    """Print the summary of each study, of several below the name of its profile."""
    from netdesign.edge.output import open_console, print_lines
    from netdesign.report.terminal import print_summary
    from netdesign.report.words import Words

    console, words = open_console(), Words(speak())
    shown = {"explain": asked["explain"], "scopes": asked["scopes"]}
    for study in studies:
        if len(studies) > 1:
            profile = words("show.label", label=study.profile.id, text="")
            print_lines((profile.rstrip(),), console)
        print_summary(study, console, speak(), **shown, has_rows=has_rows)
    sys.stdout.flush()


def _print_sizes(sized: Sequence[Sized], studies: Sequence[Study]) -> None:
    """Print the types that ``--size`` found for each profile, and their verdict."""
    from netdesign.edge.output import open_console, print_lines
    from netdesign.report.what_if import describe_overall, describe_sized
    from netdesign.report.words import Words

    words = Words(speak())
    lines: list[str] = []
    for (cells, what_if), study in zip(sized, studies, strict=False):  # none unasked
        lines.append(words("what_if.sized_for", profile=study.profile.id))
        texts = [describe_sized(cell, words) for cell in cells]
        lines += texts or [words("what_if.nothing")]
        if what_if is not None:
            lines.append(describe_overall(what_if, words))
        elif cells:
            lines.append(words("what_if.no_study"))
    print_lines(lines, open_console(), 2)


def plan_outputs(
    folder: Path | None, profiles: Sequence[str], asked: Mapping[str, Any]
) -> list[list[Path]]:
    """Places of the outputs by profile; each of several profiles has a folder.

    ``asked`` are the options of the command line. Without a folder there are no places.

    Raises
    ------
    OutputError
        Where a file is in the way, of what-if studies of ``--size``, too.
    """
    from netdesign.edge.output import require_free

    names = mark_names(
        [STUDY_FILE, *list_wanted(asked)],
        is_what_if=asked["instead"],
        is_part=asked["rows"],
    )
    outputs: list[list[Path]] = [[] for _ in profiles]
    if folder is not None:
        several = len(profiles) > 1
        places = [folder / profile if several else folder for profile in profiles]
        outputs = [[place / name for name in names] for place in places]
    paths = [path for group in outputs for path in group]
    sized = _mark_sized(paths) if asked["size"] else []
    require_free([*paths, *sized], overwrite=asked["force"])
    return outputs


def _mark_sized(paths: Sequence[Path]) -> list[Path]:
    """Places of the what-if study of ``--size`` beside the study's own."""
    return [path.with_name(f"{WHAT_IF_MARK}{path.name}") for path in paths]


def render_outputs(
    outputs: Sequence[Sequence[Path]],
    studies: Sequence[Study],
    sized: Sequence[Sized],
    asked: Mapping[str, Any],
    runner: Runner,
) -> dict[Path, bytes]:
    """Contents of all files; processes of the run render some of them."""
    from netdesign.report.files import render_files

    pairs = [*zip(studies, outputs, strict=True)]
    for (_, what_if), paths in zip(sized, outputs, strict=False):  # none unasked
        pairs += [(what_if, _mark_sized(paths))] if what_if else []
    plan = {path: study for study, paths in pairs for path in paths}
    return render_files(plan, choose_style(asked), runner.workers.pool)


def _check_and_size(
    site: Site,
    profiles: Sequence[Standard],
    run: CheckRun,
    read: ReadInstead,
    runner: Runner,
    watch: RunProgress,
) -> tuple[list[Study], list[Sized]]:
    """Studies of a site, and its smallest types with the study of all of them.

    ``read`` gives the site with some cells replaced.
    """
    from netdesign.study.cases import search_site
    from netdesign.study.check_site import check_site
    from netdesign.study.sizing import size_site

    solved = search_site(site, run, runner)
    studies = check_site(site, profiles, run, runner, watch, solved=solved)
    sized: list[Sized] = []
    for study, profile in zip(studies, profiles, strict=True):
        cells = size_site(site, solved, study, profile, run, read)
        instead = {cell.cell: cell.now for cell in cells if cell.now}
        if not instead:
            sized.append((cells, None))
            continue
        (what_if,) = check_site(read(instead), [profile], run, runner, watch)
        sized.append((cells, what_if))
    return studies, sized


def announce(site: Site, *, as_json: bool) -> None:
    """Print the planned checks, notes and questions."""
    from netdesign.study.cases import count_cases

    rows, cases = len(site.rows), count_cases(site)
    if as_json:
        plan = {
            "schema": "netdesign.plan/3",
            "net_rows": rows,
            "cases": cases,  # about
            "notes": [render(note, speak()) for note in site.notes],
            "questions": [render(question, speak()) for question in site.questions],
        }
        print_document(plan)
        return
    tell(say("plan.summary", file=site.file_name, rows=rows, cases=cases))
    for note in site.notes:
        tell(say("cli.note", text=note))
    for question in site.questions:
        tell(say("cli.question", text=question))
