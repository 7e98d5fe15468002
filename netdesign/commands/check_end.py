"""End of a check: what it writes and tells, calculated or told again from the store.

An end is kept under the name of all that decides it. A later run that is asked the same
gets the same bytes and the same words; only paths are its own.
"""

from __future__ import annotations

import json
import os
import sqlite3
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from netdesign.commands.running import find_exit_code
from netdesign.outcome import Verdict
from netdesign.report.terminal import Summary, dump_summary, restore_summary
from netdesign.words.message import Message, say

if TYPE_CHECKING:
    from netdesign.checks import Standard
    from netdesign.commands.check_outputs import Outputs
    from netdesign.report.view.whole import ReportView
    from netdesign.site.model import Site
    from netdesign.solving.finished_runs import FinishedRun
    from netdesign.study.check_run import CheckRun
    from netdesign.study.records import Study
    from netdesign.words.catalogue import Language

_DOCUMENT = "--json"  # among the files of a kept run; no file has this name
# They take fonts and settings of the machine, which no name of a run can hold.
_OF_THE_MACHINE = (".pdf", ".docx")


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckTask:
    """All that decides what a check writes and tells.

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
    size, explain, as_json : bool
        The options of these names.
    """

    site: Site
    profiles: Sequence[Standard]
    run: CheckRun
    executor: str
    outputs: Outputs
    size: bool
    explain: bool
    as_json: bool

    @property
    def language(self) -> Language:
        """Language of the reports and of what is told."""
        return self.outputs.style.language


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckEnd:
    """Files and words of a finished check.

    Attributes
    ----------
    started : str
        When it was calculated: ISO 8601, UTC.
    exit_code : int
        Of the worst verdict.
    verdicts : frozenset of Verdict
        Of all net rows.
    summaries : tuple of Summary
        One for each profile; none with ``--json``.
    sized : tuple of str
        Lines of what ``--size`` found.
    document : str
        What ``--json`` prints; "" without.
    files : mapping of Path to bytes
        Contents of all files.
    """

    started: str
    exit_code: int
    verdicts: frozenset[Verdict]
    summaries: tuple[Summary, ...] = ()
    sized: tuple[str, ...] = ()
    document: str = ""
    files: Mapping[Path, bytes]


def conclude(
    task: CheckTask,
    studies: Sequence[Study],
    views: Sequence[ReportView],
    sized: Sequence[str],
    files: Mapping[Path, bytes],
) -> CheckEnd:
    """End of a check that was calculated; ``views`` are those of the studies."""
    return CheckEnd(
        started=task.run.started,
        exit_code=find_exit_code(studies),
        verdicts=frozenset(row.verdict for study in studies for row in study.rows),
        summaries=() if task.as_json else _summarise(task, studies, views),
        sized=tuple(sized),
        document=_write_documents(studies) if task.as_json else "",
        files=files,
    )


def _summarise(
    task: CheckTask, studies: Sequence[Study], views: Sequence[ReportView]
) -> tuple[Summary, ...]:
    from netdesign.report.summary import build_summary

    return tuple(
        build_summary(study, task.language, view, explain=task.explain)
        for study, view in zip(studies, views, strict=True)
    )


def _write_documents(studies: Sequence[Study]) -> str:
    from netdesign.study.document import write_document

    if len(studies) == 1:
        return write_document(studies[0])
    documents = ",\n".join(write_document(study) for study in studies)
    return f'{{"schema": "netdesign.studies/1", "studies": [\n{documents}\n]}}'


def name_end(task: CheckTask) -> str:
    """Name under which the end of a check is kept; "" where it cannot be.

    The time is a part of it only where somebody chose it: an end that is told again
    says when it was calculated.
    """
    from netdesign.solving.finished_runs import name_run

    names = _name_files(task.outputs)
    if any(name.endswith(_OF_THE_MACHINE) for name in names):
        return ""
    is_chosen = bool(os.environ.get("SOURCE_DATE_EPOCH"))
    run = task.run if is_chosen else replace(task.run, started="")
    asked = [task.executor, task.size, task.explain, task.as_json]
    with suppress(TypeError):  # a site with a value of a new kind is checked every time
        profiles = list(task.profiles)
        return name_run(
            [task.site, profiles, run, task.outputs.style, *asked, [*names]]
        )
    return ""


def _name_files(outputs: Outputs) -> dict[str, Path]:
    """Places of all outputs by their names in the folder of the outputs."""
    groups = (*outputs.of_studies, *outputs.sized, outputs.together)
    folder = outputs.folder or Path()
    return {
        path.relative_to(folder).as_posix(): path for group in groups for path in group
    }


def find_end(
    task: CheckTask, name: str, tell: Callable[[Message], None]
) -> CheckEnd | None:
    """Kept end of that name; None if there is none, or it is damaged."""
    from netdesign.solving.finished_runs import find_run
    from netdesign.solving.store import find_store

    found = find_run(find_store(), name, tell)
    if found is None:
        return None
    with suppress(ValueError, KeyError, TypeError):
        return _restore(found, task)
    tell(say("store.run_damaged", path=str(find_store()), name=name[:12]))
    return None


def _restore(found: FinishedRun, task: CheckTask) -> CheckEnd:
    """End of a check from what the store has of it, with the places of this run.

    Raises
    ------
    ValueError, KeyError, TypeError
        If it is not what `keep_end` keeps.
    """
    told, contents = json.loads(found.text), dict(found.files)
    document = contents.pop(_DOCUMENT, b"").decode()
    places = _name_files(task.outputs)
    files = {places[key]: content for key, content in contents.items()}
    wanted = (*task.outputs.of_studies, task.outputs.together)
    is_whole = all(path in files for group in wanted for path in group)
    if not is_whole or task.as_json is not bool(document):
        raise ValueError("outputs are missing")
    return CheckEnd(
        started=str(told["started"]),
        exit_code=int(told["exit_code"]),
        verdicts=frozenset(map(Verdict, told["verdicts"])),
        summaries=tuple(map(restore_summary, told["summaries"])),
        sized=tuple(told["sized"]),
        document=document,
        files=files,
    )


def keep_end(
    task: CheckTask, name: str, end: CheckEnd, tell: Callable[[Message], None]
) -> None:
    """Keep the end of a check for later runs; say so where the store fails."""
    from netdesign.solving.finished_runs import FinishedRun, keep_run
    from netdesign.solving.store import find_store

    told = {
        "started": end.started,
        "exit_code": end.exit_code,
        "verdicts": sorted(end.verdicts),
        "summaries": [dump_summary(one) for one in end.summaries],
        "sized": end.sized,
    }
    names = {path: key for key, path in _name_files(task.outputs).items()}
    files = {names[path]: content for path, content in end.files.items()}
    if end.document:
        files[_DOCUMENT] = end.document.encode()
    try:
        run = FinishedRun(text=json.dumps(told), files=files)
        keep_run(find_store(), name, run)
    except (OSError, sqlite3.Error) as error:
        tell(say("store.failed", cause=str(error)))
