"""Options and steps of ``check`` for what-if studies: cells replaced, types found."""

from __future__ import annotations

import shlex
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.usage import UsageRefusal, ValueRefusal
from netdesign.edge.output import WHAT_IF_MARK
from netdesign.words.message import say

if TYPE_CHECKING:
    from netdesign.checks import Standard
    from netdesign.report.files import ReportStyle
    from netdesign.site.model import Site
    from netdesign.solving.runner import Runner
    from netdesign.study.check_run import CheckRun
    from netdesign.study.check_site import SolvedSite, Watch
    from netdesign.study.records import Study
    from netdesign.study.sizing import ReadInstead, SizedCell
    from netdesign.words.catalogue import Language

_SIZE = "--size"


def what_if_options(command: Any) -> Any:
    """Add ``--what-if`` and ``--size``."""
    for option in (
        click.option(
            _SIZE,
            "size",
            is_flag=True,
            help="Find the smallest types of the workbook that mend it, and write "
            "what-if studies with them beside the others.",
        ),
        click.option(
            "--what-if",
            "instead",
            multiple=True,
            metavar="CELL=TEXT",
            callback=read_instead,
            help="Read TEXT in a cell, as Nets.P8=A40; repeatable. The outputs are "
            "marked: not the site as built.",
        ),
    ):
        command = option(command)
    return command


def read_instead(
    context: click.Context | None,
    option: click.Parameter | None,
    texts: Sequence[str],
) -> dict[str, str]:
    """Texts by place, of ``CELL=TEXT``.

    Raises
    ------
    ValueRefusal
        If one has another form, or a cell comes twice.
    """
    from netdesign.site.replaced import split_replacement

    instead: dict[str, str] = {}
    for text in texts:
        found = split_replacement(text)
        if found is None:
            raise ValueRefusal(say("what_if.form", text=text), context, option)
        if found[0] in instead:
            raise ValueRefusal(say("what_if.twice", cell=found[0]), context, option)
        instead[found[0]] = found[1]
    return instead


def require_one(
    instead: Mapping[str, str], *, size: bool, has_folder: bool, dry_run: bool
) -> None:
    """Refuse options that contradict ``--size``.

    Raises
    ------
    UsageRefusal
        Beside cells that are given, or where no study can be written.
    """
    if size and instead:
        raise UsageRefusal(say("what_if.size_or_what_if"))
    if size and (dry_run or not has_folder):
        raise UsageRefusal(say("what_if.size_needs_files"))


def mark_names(names: Sequence[str], *, is_what_if: object) -> list[str]:
    """Names of outputs; those of a what-if say so."""
    return [f"{WHAT_IF_MARK}{name}" if is_what_if else name for name in names]


@dataclass(frozen=True, slots=True, kw_only=True)
class Sized:
    """Smallest types under one profile; no study where nothing is replaced."""

    cells: Sequence[SizedCell]
    study: Study | None


def check_and_size(
    site: Site,
    profiles: Sequence[Standard],
    run: CheckRun,
    read: ReadInstead | None,
    runner: Runner,
    watch: Watch,
) -> tuple[list[Study], list[Sized]]:
    """Studies of a site by profiles, and its smallest types where ``read`` is given."""
    from netdesign.study.check_site import check_site, judge_solved, solve_rows

    if read is None:
        return check_site(site, profiles, run, runner, watch), []
    solved = solve_rows(site, run, runner, watch)
    studies = judge_solved(solved, profiles, run, runner, watch)
    return studies, _size(solved, studies, profiles, run, read, runner, watch)


def _size(
    solved: SolvedSite,
    studies: Sequence[Study],
    profiles: Sequence[Standard],
    run: CheckRun,
    read: ReadInstead,
    runner: Runner,
    watch: Watch,
) -> list[Sized]:
    """Smallest types for each profile, and the study of the site with all of them.

    ``read`` gives the site with some cells replaced.
    """
    from netdesign.study.check_site import judge_solved, solve_rows
    from netdesign.study.sizing import size_site

    sized = []
    for study, profile in zip(studies, profiles, strict=True):
        cells = size_site(solved, study, profile, run, read)
        instead = {one.cell: one.now for one in cells if one.now and not one.is_asked}
        if not instead:
            sized.append(Sized(cells=cells, study=None))
            continue
        site = read(instead)
        own_run = replace(run, command=write_command(run.command, instead))
        again = solve_rows(site, own_run, runner, watch, solved)
        (what_if,) = judge_solved(again, [profile], own_run, runner, watch)
        sized.append(Sized(cells=cells, study=what_if))
    return sized


def write_command(command: str, instead: Mapping[str, str]) -> str:
    """Command that makes a what-if study again, from the one that sized it."""
    from netdesign.site.replaced import write_replacement

    words = [word for word in shlex.split(command) if word != _SIZE]
    for cell, text in instead.items():
        words += ["--what-if", write_replacement(cell, text)]
    return shlex.join(words)


def mark_paths(names: Sequence[Sequence[Path]]) -> list[list[Path]]:
    """Places of what-if outputs beside those of each study."""
    return [
        [path.with_name(f"{WHAT_IF_MARK}{path.name}") for path in group]
        for group in names
    ]


def render_sized(
    sized: Sequence[Sized], names: Sequence[Sequence[Path]], style: ReportStyle
) -> dict[Path, bytes]:
    """Contents of the what-if outputs, of those profiles that have any."""
    from netdesign.report.files import render_files

    found = [
        (one.study, group) for one, group in zip(sized, names, strict=True) if one.study
    ]
    return render_files(
        [study for study, _ in found], [group for _, group in found], style
    )


def tell_sized(
    sized: Sequence[Sized], studies: Sequence[Study], language: Language
) -> list[str]:
    """Lines of what was found for each profile, and what those what-if studies say."""
    from netdesign.report.view.what_if import list_sized, tell_overall
    from netdesign.report.words import Words

    words = Words(language)
    lines: list[str] = []
    for one, built in zip(sized, studies, strict=False):  # none, if not asked for
        lines.append(words("what_if.sized_for", profile=built.profile.id))
        lines += list_sized(one.cells, words) or [words("what_if.nothing")]
        if one.study is not None:
            lines.append(tell_overall(one.study, words))
        elif any(cell.is_asked for cell in one.cells):
            lines.append(words("what_if.no_study_asked"))
        elif one.cells:
            lines.append(words("what_if.no_study"))
    return lines
