"""Solves a stored study again from its own inputs, and lists the differences."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from netdesign.commands.site_input import temporary_example
from netdesign.outcome import StudyError
from netdesign.words.message import Message, say

if TYPE_CHECKING:
    from netdesign.checks import Standard
    from netdesign.site.model import Site
    from netdesign.study.document import Difference
    from netdesign.study.records import Study

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

    run = build_run(study, asked.get("jobs") or os.cpu_count() or 1)
    solving = {"jobs": run.jobs, "executor": "", "cache": False, "quiet": False}
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
