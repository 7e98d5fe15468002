"""Steps of a check once its site is read: solved, judged, written, printed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from netdesign.commands.check_outputs import begin_outputs, render_outputs
from netdesign.commands.faults import tell_faults
from netdesign.commands.next_steps import tell_next_steps
from netdesign.commands.running import find_exit_code, report_places
from netdesign.commands.sizing import check_and_size, tell_sized
from netdesign.commands.solving import open_run
from netdesign.edge.output import write_files
from netdesign.edge.streams import print_json

if TYPE_CHECKING:
    from netdesign.checks import Standard
    from netdesign.commands.check_outputs import Outputs
    from netdesign.report.view.whole import ReportView
    from netdesign.site.model import Site
    from netdesign.study.check_run import CheckRun
    from netdesign.study.records import Study
    from netdesign.study.sizing import ReadInstead
    from netdesign.words.catalogue import Language


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckTask:
    """A check that is asked for.

    Attributes
    ----------
    site : Site
        As it was read, with every value.
    profiles : sequence of Standard
        Limit profiles, with the floor that was chosen.
    run : CheckRun
        Settings, command line and time.
    executor : str
        Where cases are solved.
    outputs : Outputs
        Places, language, detail and template of the reports.
    read_instead : callable or None
        Gives the site with some cells replaced; None without ``--size``.
    cache, explain, as_json, quiet : bool
        The options of these names.
    """

    site: Site
    profiles: Sequence[Standard]
    run: CheckRun
    executor: str
    outputs: Outputs
    read_instead: ReadInstead | None
    cache: bool
    explain: bool
    as_json: bool
    quiet: bool

    @property
    def language(self) -> Language:
        """Language of the reports and of what is told."""
        return self.outputs.style.language


def carry_out(task: CheckTask, site_name: str, *, overwrite: bool) -> int:
    """Exit code of a check; its files are written, its result is printed.

    ``site_name`` is what the next commands are told to read.
    """
    with open_run(
        task.site,
        task.run,
        executor=task.executor,
        cache=task.cache,
        quiet=task.quiet,
        profiles=len(task.profiles) * (2 if task.read_instead else 1),
        language=task.language,
    ) as (runner, progress):
        studies, sized = check_and_size(
            *(task.site, task.profiles, task.run, task.read_instead),
            *(runner, progress),
        )
        progress.enter("reports")
        begun = begin_outputs(task.outputs, studies, runner)
        views = [] if task.as_json else _view_studies(studies, task.language)
        files = render_outputs(task.outputs, studies, sized, views, begun)
    lines = tell_sized(sized, studies, task.language)
    failed = tell_faults(runner.faults, task.language)
    write_files(files, overwrite=overwrite)
    if task.as_json:
        print_json(_write_documents(studies))
        return failed or find_exit_code(studies)
    _print_summaries(task, studies, views, lines)
    report_places([list(files)], task.language, quiet=task.quiet)
    if not task.quiet:
        verdicts = frozenset(row.verdict for study in studies for row in study.rows)
        is_sized = task.read_instead is not None
        tell_next_steps(verdicts, site_name, task.language, is_sized=is_sized)
    return failed or find_exit_code(studies)


def _view_studies(studies: Sequence[Study], language: Language) -> list[ReportView]:
    """Views of the studies, once for reports and terminal."""
    from netdesign.report.view.whole import build_view

    return [build_view(study, language) for study in studies]


def _write_documents(studies: Sequence[Study]) -> str:
    from netdesign.study.document import write_document

    if len(studies) == 1:
        return write_document(studies[0])
    documents = ",\n".join(write_document(study) for study in studies)
    return f'{{"schema": "netdesign.studies/1", "studies": [\n{documents}\n]}}'


def _print_summaries(
    task: CheckTask,
    studies: Sequence[Study],
    views: Sequence[ReportView],
    sized: Sequence[str],
) -> None:
    """Print what each study says, and lines of what ``--size`` found."""
    from netdesign.report.summary import build_summary
    from netdesign.report.terminal import open_console, print_lines, print_summary

    console = open_console()
    for study, view in zip(studies, views, strict=True):
        summary = build_summary(study, task.language, view, explain=task.explain)
        print_summary(summary, console)
    print_lines(tuple(sized), console)
