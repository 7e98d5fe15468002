"""``netdesign check``: a site against limit profiles, with its reports."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.config import ConfiguredCommand
from netdesign.commands.options import DEFAULT_FOLDER, take_options
from netdesign.commands.running import UsageRefusal, format_time, tell
from netdesign.commands.site_input import (
    choose_rows,
    read_asked_site,
    require_source,
)
from netdesign.outcome import StandardError
from netdesign.words.message import say

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from netdesign.checks import Standard
    from netdesign.site.model import Site


@click.command(cls=ConfiguredCommand)
@click.argument("site_file", required=False, type=click.Path(path_type=Path))
@take_options("check")
def check(site_file: Path | None, **asked: Any) -> None:
    """Check every anchor of a site and write the reports.

    \b
    netdesign check --example
    netdesign check site.xlsx --out reports --jobs 2
    netdesign check site.xlsx --annotate site-marked.xlsx --dry-run
    netdesign check site.csv --delimiter ";" --decimal-mark comma
    netdesign check site.xlsx --standard eurocode --standard my-profile/ --explain
    netdesign check site.xlsx --row R1 --row R3 --out some
    netdesign check site.xlsx --size --out sized
    netdesign check site.xlsx --what-if Rows.I9=3.0 --out what-if
    netdesign check site.xlsx --json > study.json

    The site is an xlsx, xlsm or csv file, or a folder of csv files. Defaults
    may stand in netdesign.toml beside it.
    """
    folder = asked["out"] or (None if asked["as_json"] else Path(DEFAULT_FOLDER))
    _refuse_contradictions(site_file, folder, asked)
    site = choose_rows(read_asked_site(site_file, asked), asked["rows"])

    # behind the reading: a faulty workbook is refused without a solver
    from netdesign.commands.check_run import announce, carry_out, plan_outputs
    from netdesign.coupling.scene import SolverSettings
    from netdesign.study.row_to_check import CheckRun

    profiles = find_profiles(asked["standards"], site)
    if asked["floor"]:
        profiles = [profile.overrule_floor(asked["floor"]) for profile in profiles]
    _describe_other_profile(asked["standards"], site)
    if asked["dry_run"]:
        announce(site, as_json=asked["as_json"])
        return
    run = CheckRun(
        settings=SolverSettings(accuracy=asked["accuracy"]),
        started=format_time(),
        has_reliability=asked["reliability"],
    )
    if not asked["quiet"]:
        for question in site.questions:
            tell(say("cli.question", text=question), err=True)
    outputs = plan_outputs(folder, [profile.id for profile in profiles], asked)

    def read_again(instead: Mapping[str, str]) -> Site:
        """Read the site again with other texts in some cells."""
        with_texts = {**asked, "annotate": None, "instead": instead}
        return choose_rows(read_asked_site(site_file, with_texts), asked["rows"])

    again = read_again if asked["size"] else None
    name = str(site_file or "--example")
    sys.exit(carry_out(site, profiles, run, outputs, again, asked, name))


def _refuse_contradictions(
    site_file: Path | None, folder: Path | None, asked: Mapping[str, Any]
) -> None:
    """Refuse options that contradict each other or have no effect.

    Raises
    ------
    UsageRefusal
        Of ``--size``, beside cells that are given, or where no study can be written.
    """
    require_source(site_file, asked)
    if asked["size"] and asked["instead"]:
        raise UsageRefusal(say("what_if.size_or_what_if"))
    if asked["size"] and (asked["dry_run"] or folder is None):
        raise UsageRefusal(say("what_if.size_needs_files"))


def _describe_other_profile(names: Sequence[str], site: Site) -> None:
    """Note that the command line overrules the profile that the site names."""
    named = site.project.standard
    if named and names and named not in names:
        other = say("standard.not_of_site", named=named, used=tuple(names))
        tell(say("cli.note", text=other), err=True)


def find_profiles(names: Sequence[str], site: Site) -> list[Standard]:
    """Profiles of the command line, else the profile of the site, else the default."""
    named = site.project.standard
    if names:
        return _load_profiles(names)
    if not named:
        from netdesign.checks import load_default

        return [load_default()]
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
