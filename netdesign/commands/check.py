"""``netdesign check``: a site against limit profiles, with its reports."""

from __future__ import annotations

import os
import sys
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click

from netdesign.commands.check_outputs import plan_outputs
from netdesign.commands.config import ConfiguredCommand
from netdesign.commands.dry_run import announce
from netdesign.commands.idle import refuse_delimiter, refuse_jobs
from netdesign.commands.language import tell
from netdesign.commands.options import (
    accuracy_option,
    force_option,
    json_option,
    out_option,
    quiet_option,
)
from netdesign.commands.report import DEFAULT_FOLDER
from netdesign.commands.report_options import report_options
from netdesign.commands.running import own_command, tell_time
from netdesign.commands.site_input import (
    open_site,
    require_effect,
    site_options,
    temporary_example,
)
from netdesign.commands.sizing import require_one, what_if_options
from netdesign.commands.solving import solving_options
from netdesign.commands.usage import UsageRefusal
from netdesign.errors import StandardError
from netdesign.words.message import say

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from netdesign.checks import Standard
    from netdesign.checks.schema import Floor
    from netdesign.report.view.whole import Detail
    from netdesign.site.model import Site
    from netdesign.words.catalogue import Language

DEFAULT_STANDARD = "nf-p-95-304-style"


@click.command(cls=ConfiguredCommand)
@click.argument("site_file", required=False, type=click.Path(path_type=Path))
@click.option("--example", is_flag=True, help="Use the built-in example site.")
@site_options
@click.option(
    "--standard",
    "standards",
    multiple=True,
    metavar="ID",
    help=f"Limit profile, or a folder with one; repeatable [{DEFAULT_STANDARD}].",
)
@accuracy_option("Relative error allowed in every end force of the net.", default=0.01)
@click.option(
    "--method",
    type=click.Choice(["steady", "transient"]),
    default="steady",
    show_default=True,
    help="Steady states; transient confirms governing cases by their histories.",
)
@click.option(
    "--floor",
    type=click.Choice(["guideline", "none"]),
    help="What no demand lies below [the limit profile's]; told on the first page.",
)
@what_if_options
@solving_options
@out_option(f"Folder of the outputs [{DEFAULT_FOLDER}; with --json none].")
@report_options
@click.option("--explain", is_flag=True, help="Print what would flip each check.")
@json_option("study")
@click.option("--dry-run", is_flag=True, help="Read and count only; write nothing.")
@force_option
@quiet_option
def check(
    site_file: Path | None,
    *,
    example: bool,
    standards: tuple[str, ...],
    accuracy: float,
    method: Literal["steady", "transient"],
    floor: Floor | None,
    size: bool,
    instead: dict[str, str],
    jobs: int | None,
    executor: str,
    cache: bool,
    out: Path | None,
    language: Language,
    detail: Detail,
    html: bool,
    excel: bool,
    csv: bool,
    pdf: bool,
    docx: bool,
    template: Path | None,
    explain: bool,
    as_json: bool,
    dry_run: bool,
    force: bool,
    quiet: bool,
    **reading: Any,
) -> None:
    """Check every anchor of a site and write the reports.

    \b
    netdesign check --example
    netdesign check site.xlsx --out reports --jobs 2
    netdesign check site.xlsx --annotate site-marked.xlsx --dry-run
    netdesign check site.csv --delimiter ";" --decimal-mark comma
    netdesign check site.xlsx --standard eurocode --standard my-profile/ --explain
    netdesign check site.xlsx --size --out sized
    netdesign check site.xlsx --what-if Nets.P8=A40 --out what-if
    netdesign check site.xlsx --json > study.json

    The site is an xlsx, xlsm, ods or csv file, or a folder of csv files. Defaults
    may stand in netdesign.toml beside it, or in variables such as
    NETDESIGN_CHECK_JOBS.
    """
    if example == (site_file is not None):
        raise UsageRefusal(say("usage.site_or_example"))
    refuse_delimiter(site_file, language=language)
    refuse_jobs(executor, language)
    folder = out or (None if as_json else Path(DEFAULT_FOLDER))
    require_one(instead, size=size, has_folder=folder is not None, dry_run=dry_run)
    reading |= {"overwrite": force, "language": language}
    site = _read_site(site_file, instead, **reading)

    # behind the reading: a faulty workbook is refused without a solver
    from netdesign.commands.check_steps import CheckTask, carry_out
    from netdesign.coupling.scene import SolverSettings
    from netdesign.study.check_run import CheckRun

    profiles = _choose_profiles(standards, site, floor)
    _tell_other_profile(standards, site, language)
    run = CheckRun(
        settings=SolverSettings(accuracy=accuracy),
        method=method,
        jobs=jobs or os.cpu_count() or 1,
        command=own_command(),
        started=tell_time(),
    )
    if dry_run:
        count = len(profiles)
        sys.exit(announce(site, run, count, as_json=as_json, language=language))
    if not quiet:
        for question in site.questions:
            tell(say("cli.question", text=question), language, err=True)
    outputs = plan_outputs(
        folder,
        [profile.id for profile in profiles],
        {"html": html, "excel": excel, "csv": csv, "pdf": pdf, "docx": docx},
        {"language": language, "detail": detail, "template": template},
        size=size,
        is_what_if=instead,
        overwrite=force,
    )
    read = partial(_read_site, site_file, **reading | {"annotate": None})
    task = CheckTask(
        site=site,
        profiles=profiles,
        run=run,
        executor=executor,
        outputs=outputs,
        read_instead=read if size else None,
        cache=cache,
        explain=explain,
        as_json=as_json,
        quiet=quiet,
    )
    sys.exit(carry_out(task, str(site_file or "--example"), overwrite=force))


def _read_site(
    site_file: Path | None, instead: Mapping[str, str], **reading: Any
) -> Site:
    """Site from a file; the example goes through a real workbook too."""
    if site_file is None:
        with temporary_example() as path:
            return _read_site(path, instead, **reading)
    site = open_site(site_file, instead=instead, **reading)
    bare = reading | {"annotate": None}
    require_effect(instead, lambda cells: open_site(site_file, instead=cells, **bare))
    return site


def _choose_profiles(
    names: Sequence[str], site: Site, floor: Floor | None
) -> list[Standard]:
    """Profiles, with the floor that was chosen for them, if any was."""
    profiles = _find_profiles(names, site)
    return [one.overrule_floor(floor) for one in profiles] if floor else profiles


def _tell_other_profile(names: Sequence[str], site: Site, language: Language) -> None:
    """Note that the command line overrules the profile that the site names."""
    named = site.project.standard
    if named and names and named not in names:
        other = say("standard.not_of_site", named=named, used=tuple(names))
        tell(say("cli.note", text=other), language, err=True)


def _find_profiles(names: Sequence[str], site: Site) -> list[Standard]:
    """Profiles of the command line, else that of the site, else the default."""
    named = site.project.standard
    if names:
        return _load_profiles(names)
    if not named:
        (profile,) = _load_profiles((DEFAULT_STANDARD,))
        return [replace(profile, is_default=True)]
    try:
        return _load_profiles((named,))
    except StandardError as error:
        place = site.project_cells["standard"].replace("!", " › ")
        raise StandardError(
            say(
                "standard.in_site",
                file=site.file_name,
                place=place,
                fault=error.message,
            )
        ) from None


def _load_profiles(names: Sequence[str]) -> list[Standard]:
    from netdesign.checks import load_standard

    profiles = [load_standard(name) for name in names]
    if len({profile.id for profile in profiles}) < len(profiles):
        raise UsageRefusal(say("usage.same_profiles"))
    return profiles
