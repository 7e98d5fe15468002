"""Steps of a check once all is read: told from the store, or calculated and kept."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from netdesign.commands.check_end import (
    CheckEnd,
    CheckTask,
    conclude,
    find_end,
    keep_end,
    name_end,
)
from netdesign.commands.check_outputs import begin_outputs, render_outputs
from netdesign.commands.faults import tell_faults
from netdesign.commands.language import tell
from netdesign.commands.sizing import check_and_size, tell_sized
from netdesign.commands.solving import open_run
from netdesign.edge.output import write_files
from netdesign.words.message import Message, say

if TYPE_CHECKING:
    from collections.abc import Sequence

    from netdesign.report.view.whole import ReportView
    from netdesign.solving.runner import Runner
    from netdesign.study.records import Study
    from netdesign.study.sizing import ReadInstead
    from netdesign.words.catalogue import Language


def find_or_check(
    task: CheckTask, read: ReadInstead, *, cache: bool, quiet: bool, overwrite: bool
) -> CheckEnd:
    """End of a check, with its files written.

    ``read`` gives the site with some cells replaced; ``cache`` says whether the store
    may be used.
    """

    def speak(message: Message) -> None:
        tell(message, task.language, err=True)

    name = name_end(task) if cache else ""
    known = find_end(task, name, speak) if name else None
    if known is not None:
        write_files(known.files, overwrite=overwrite)
        if not quiet:
            speak(say("store.told", started=known.started))
        return known
    end, runner = _calculate(task, read, cache=cache, quiet=quiet)
    failed = tell_faults(runner.faults, task.language)
    write_files(end.files, overwrite=overwrite)
    # another run could end otherwise where this one lost a case
    is_sound = not (failed or runner.counts.lost)
    if name and is_sound and runner.store is not None:
        keep_end(task, name, end, speak)
    return replace(end, exit_code=failed or end.exit_code)


def _calculate(
    task: CheckTask, read: ReadInstead, *, cache: bool, quiet: bool
) -> tuple[CheckEnd, Runner]:
    """End of a check, and the runner that remembers what befell its cases."""
    with open_run(
        task.site,
        task.run,
        executor=task.executor,
        cache=cache,
        quiet=quiet,
        profiles=len(task.profiles) * (2 if task.size else 1),
        language=task.language,
    ) as (runner, progress):
        studies, sized = check_and_size(
            task.site,
            task.profiles,
            task.run,
            read if task.size else None,
            runner,
            progress,
        )
        progress.enter("reports")
        begun = begin_outputs(task.outputs, studies, runner)
        views = [] if task.as_json else _view_studies(studies, task.language)
        files = render_outputs(task.outputs, studies, sized, views, begun)
    lines = tell_sized(sized, studies, task.language)
    return conclude(task, studies, views, lines, files), runner


def _view_studies(studies: Sequence[Study], language: Language) -> list[ReportView]:
    """Views of the studies, once for reports and terminal."""
    from netdesign.report.view.whole import build_view

    return [build_view(study, language) for study in studies]
