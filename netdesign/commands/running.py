"""Runs a command: sentences, progress of solves, faults, files, exit codes."""

from __future__ import annotations

import json
import os
import shlex
import sys
from collections.abc import (
    Callable,
    Collection,
    Iterable,
    Iterator,
    Mapping,
    Sequence,
    Set,
)
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.edge.input_files import make_printable
from netdesign.edge.output import print_json
from netdesign.outcome import (
    EXIT_CODE,
    EXIT_CODES,
    Fault,
    Verdict,
    merge_verdicts,
)
from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message, say

if TYPE_CHECKING:
    from netdesign.edge.progress import Phase, RunProgress
    from netdesign.site.model import Site
    from netdesign.solving.runner import Runner
    from netdesign.study.records import Study


def speak() -> Language:
    """Language of the running command; English outside of commands."""
    context = click.get_current_context(silent=True)
    language: Language = context.params.get("language", "en") if context else "en"
    return language


def tell(
    message: Message | str, language: Language | None = None, *, err: bool = False
) -> None:
    """Print a message in the language of the command, or in ``language``.

    Control characters in the message are made visible.
    """
    click.echo(make_printable(render(message, language or speak())), err=err)


class UsageRefusal(click.UsageError):
    """A command line that is refused, with a message."""

    def __init__(self, message: Message | str) -> None:
        super().__init__(str(message), click.get_current_context(silent=True))


class ValueRefusal(click.BadParameter):
    """A value of an option that is refused, with a message."""

    def __init__(
        self,
        message: Message,
        ctx: click.Context | None = None,
        param: click.Parameter | None = None,
    ) -> None:
        super().__init__(str(message), ctx, param)


def find_exit_code(studies: Sequence[Study], scopes: Sequence[str] = ()) -> int:
    """Exit code of the worst verdict; a what-if that passes proves nothing: 4.

    Of some ``scopes`` alone where they are named.
    """
    verdict = merge_verdicts(study.find_verdict(scopes) for study in studies)
    if verdict is not Verdict.FAIL and any(study.what_if for study in studies):
        verdict = Verdict.NOT_PROVEN
    return EXIT_CODES[verdict]


def own_command() -> str:
    """Command line as typed."""
    return make_printable(shlex.join(["netdesign", *sys.argv[1:]]))


def format_time() -> str:
    """Time of the run, or SOURCE_DATE_EPOCH for reproducible outputs."""
    from datetime import UTC, datetime

    epoch = os.environ.get("SOURCE_DATE_EPOCH")
    try:
        time = datetime.fromtimestamp(int(epoch), UTC) if epoch else datetime.now(UTC)
    except (ValueError, OverflowError, OSError):
        raise UsageRefusal(say("usage.epoch", epoch=epoch or "")) from None
    return time.isoformat(timespec="seconds")


def print_document(document: Mapping[str, Any]) -> None:
    """Print a document as JSON."""
    print_json(json.dumps(document, indent=1, allow_nan=False))


def require_places(
    folder: Path | None, names: Iterable[str], asked: Mapping[str, Any]
) -> None:
    """Refuse, before any work, files in the way of outputs; no folder, no refusal.

    Raises
    ------
    OutputError
        Where something is there.
    """
    from netdesign.edge.output import require_free

    paths = [folder / name for name in names] if folder else []
    require_free(paths, overwrite=asked["force"])


def write_outputs(
    folder: Path, contents: Mapping[str, bytes], asked: Mapping[str, Any]
) -> None:
    """Write files by their names or paths, and print where they are.

    ``asked`` are options of the command line: force, quiet, as_json.

    Raises
    ------
    OutputError
        Where a file is in the way, or cannot be written.
    """
    from netdesign.edge.output import write_files

    files = {folder / name: content for name, content in contents.items()}
    write_files(files, overwrite=asked["force"])
    report_places(files, asked)


def report_places(paths: Iterable[Path], asked: Mapping[str, Any]) -> None:
    """Print where outputs were written, by folder; nothing with ``--quiet``."""
    is_silent = asked.get("quiet") or asked.get("as_json")
    by_folder: dict[Path, list[Path]] = {}
    for path in [] if is_silent else paths:
        by_folder.setdefault(path.parent, []).append(path)
    for folder, files in by_folder.items():
        names = tuple(path.name for path in files)
        message = say("cli.wrote_files", folder=str(folder), files=names)
        tell(
            say("cli.wrote", path=str(files[0])) if len(files) == 1 else message,
            err=True,
        )


def follow(
    count: int, what: str, asked: Mapping[str, Any]
) -> AbstractContextManager[Callable[[object], None] | None]:
    """Progress through phases; nothing is shown with ``--quiet``."""
    from netdesign.edge.progress import show_progress

    return show_progress(count, what, quiet=bool(asked.get("quiet")), language=speak())


def open_run(
    site: Site, asked: Mapping[str, Any]
) -> AbstractContextManager[tuple[Runner, RunProgress]]:
    """Open workers, store and progress for the check of a site."""
    from netdesign.study.cases import list_phases

    return open_phases(list_phases(site), asked)


@contextmanager
def open_phases(
    phases: Sequence[Phase], asked: Mapping[str, Any]
) -> Iterator[tuple[Runner, RunProgress]]:
    """Open workers, store and progress for some phases.

    ``asked`` are options of the command line: jobs, executor, cache, quiet.
    """
    from netdesign.edge.progress import show_phases
    from netdesign.solving.runner import open_runner
    from netdesign.solving.store import find_store

    language = speak()
    with (
        open_runner(
            executor=asked["executor"],
            processes=asked["jobs"] or os.cpu_count() or 1,
            store=find_store() if asked["cache"] else None,
            tell=lambda message: tell(message, language, err=True),
            expected=sum(phase.cases for phase in phases),
        ) as runner,
        show_phases(phases, quiet=asked["quiet"], language=language) as progress,
    ):
        runner.on_ask, runner.on_done = progress.ask, progress.count_case
        yield runner, progress


_SHOWN = 20  # cases of a fault
TRACEBACK = "NETDESIGN_TRACEBACK"  # variable that asks for the traceback


def print_faults(faults: Mapping[Fault, Collection[str]]) -> int:
    """Print each fault with its cases and their net rows on stderr.

    Parameters
    ----------
    faults : mapping of Fault to collection of str
        Faults, and the ids of the net rows that they concern.

    Returns
    -------
    int
        Exit code; 0 without any fault.
    """
    alike: dict[str, dict[Fault, Collection[str]]] = {}
    for fault, rows in faults.items():
        alike.setdefault(str(fault), {})[fault] = rows
    for cases in alike.values():
        _describe_alike(cases)
    if not faults:
        return 0
    if not os.environ.get(TRACEBACK):
        tell(say("cli.fault_trace", variable=TRACEBACK), err=True)
    return EXIT_CODE


def _describe_alike(faults: Mapping[Fault, Collection[str]]) -> None:
    """Print equal faults: their text once, their cases, the first traceback."""
    first = next(iter(faults))
    lines: list[Message | str] = [say("cli.fault", fault=str(first))]
    cases = [
        _name_case(tuple(sorted(rows)), fault.case)
        for fault, rows in faults.items()
        if fault.case
    ]
    lines += cases[:_SHOWN]
    if cases[_SHOWN:]:
        lines.append(say("cli.fault_cases", count=len(cases) - _SHOWN))
    if os.environ.get(TRACEBACK):
        lines.append(first.trace)
    tell(say("text.lines", lines=tuple(lines)), err=True)


def _name_case(rows: tuple[str, ...], case: str) -> Message:
    if not rows:
        return say("cli.fault_case", case=case)
    key = "cli.fault_rows" if len(rows) > 1 else "cli.fault_row"
    return say(key, rows=rows, case=case)


def print_next_step(verdicts: Set[Verdict], site: str) -> None:
    """Print how smaller or stronger types are found, where a row fails.

    ``verdicts`` are those of all rows, ``site`` is what was checked, as on the command
    line.
    """
    from netdesign.edge.output import open_console, print_lines

    if Verdict.FAIL in verdicts:
        command = shlex.join(["netdesign", "check", site, "--size"])
        hint = render(say("next.size", command=command), speak())
        print_lines([make_printable(hint)], open_console(err=True), 2)
