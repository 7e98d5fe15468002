"""Stored study that somebody hands on: its origin; refused where it cannot be true."""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.site_input import reopen_site, temporary_example
from netdesign.commands.usage import speak, tell
from netdesign.outcome import NetDesignError, StudyError
from netdesign.words.catalogue import render
from netdesign.words.message import Message, say

if TYPE_CHECKING:
    from netdesign.checks import Standard
    from netdesign.site.model import Site
    from netdesign.study.records import Study

NO_COMMAND = "netdesign check"  # of a study that no command line made


def read_own_site(study: Study, study_file: Path, site_file: Path | None) -> Site:
    """Site of a study: as given, by its name, or the built-in example.

    Raises
    ------
    StudyError
        If there is none.
    """
    from netdesign.edge.given_files import is_there

    values = _parse_command(study.provenance.command) or {}
    name = Path(study.provenance.site_file).name  # never a path out of these folders
    folder = study_file.absolute().parent
    near = [one / name for one in (folder, folder.parent)]
    if site_file is not None:
        return reopen_site(site_file, values)
    found = next((one for one in near if name and is_there(one)), None)
    if found is not None:
        return reopen_site(found, values)
    if not values.get("example"):
        raise StudyError(
            say("stored.no_site", study=str(study_file), site=f"{name!r:.60}")
        )
    with temporary_example() as path:
        return reopen_site(path, {"instead": values.get("instead")})


def contradict_command(study: Study) -> Iterator[Message]:
    """Contradictions between a study and the command that it says it was made by."""
    from netdesign.edge.given_files import make_printable

    made = study.provenance
    if made.command == NO_COMMAND:
        return
    values = _parse_command(made.command)
    if values is None:
        yield say("stored.no_command", command=f"{made.command!r:.120}")
        return
    named = "example.xlsx" if values.get("example") else values.get("site_file")
    if Path(named or "").name != make_printable(Path(made.site_file).name):
        yield say(
            "stored.reads_other",
            given=f"{named!r:.60}",
            stored=f"{made.site_file!r:.60}",
        )
    accuracy, method = values.get("accuracy"), values.get("method")
    if accuracy is not None and not _is_number(accuracy, made.settings.get("accuracy")):
        yield say("stored.asks_accuracy", given=f"{accuracy!r:.20}")
    if method is not None and method != made.settings.get("method"):
        yield say("stored.asks_method", given=f"{method!r:.20}")
    standards = values.get("standards") or ()
    if standards and not any(_may_be(one, study.profile.id) for one in standards):
        yield say("stored.asks_profile", given=f"{standards[0]!r:.60}")


def _parse_command(command: str) -> dict[str, Any] | None:
    """Options of a ``netdesign check`` as they were typed; None if it is none."""
    group = click.get_current_context().find_root().command
    check = group.commands.get("check") if isinstance(group, click.Group) else None
    try:
        program, *words = shlex.split(command)
        place = words.index("check")
        if program != "netdesign" or check is None:
            return None
        with click.Context(check, **group.context_settings) as context:
            parser = check.make_parser(context)
            values, left, _ = parser.parse_args(words[place + 1 :])
    except (ValueError, click.UsageError):
        return None
    return values if not left else None


def _is_number(text: str, setting: str | None) -> bool:
    try:
        return float(text) == float(setting or "")
    except ValueError:
        return False


def _may_be(standard: str, profile: str) -> bool:
    """A word is the profile's id, or may be a folder, inside which the id stands."""
    from netdesign.checks import list_standards

    return standard == profile or standard not in list_standards()


_SHOWN = 10  # contradictions; more help nobody


def require_sound(
    study: Study,
    study_file: Path,
    site_file: Path | None = None,
    standard: str | None = None,
) -> None:
    """Refuse a study that cannot be true; say what it was not compared with.

    Parameters
    ----------
    study, study_file
        As read, and from where.
    site_file, standard
        Its site file and its limit profile, where somebody gives them; else they are
        looked for by their names.

    Raises
    ------
    StudyError
        With the contradictions, or if a file that was given is not the study's.
    """
    from netdesign.study.document import compute_digest
    from netdesign.study.rejudge import rejudge

    site = _find_site(study, study_file, site_file)
    profile = _find_profile(study, study_file, standard)
    found = [say("stored.command", reason=one) for one in contradict_command(study)]
    found += rejudge(study, profile, site)
    if study.digest and study.digest != compute_digest(study):
        found.insert(0, say("stored.altered"))
    if found:
        more = say("stored.more", count=len(found) - _SHOWN)
        lines = (*found[:_SHOWN], *((more,) if found[_SHOWN:] else ()))
        raise StudyError(say("stored.contradicts", study=str(study_file), lines=lines))


def _find_site(study: Study, study_file: Path, site_file: Path | None) -> Site | None:
    """Site of the study, where its file is at hand; one that is given has to be it."""
    try:
        site = read_own_site(study, study_file, site_file)
    except NetDesignError as error:
        if site_file is not None:
            raise
        first = render(error.message, speak()).partition("\n")[0]
        _describe_uncompared(study_file, "stored.site_uncompared", first)
        return None
    if site.sha256 == study.provenance.site_sha256:
        return site
    if site_file is not None:
        raise StudyError(say("stored.not_the_site", file=str(site_file)))
    reason = say("stored.other_site")
    _describe_uncompared(study_file, "stored.site_uncompared", reason)
    return None


def _find_profile(
    study: Study, study_file: Path, standard: str | None
) -> Standard | None:
    """Profile of the study, where it is at hand; one that is given has to be it."""
    from netdesign.study.record_provenance import load_own_profile

    try:
        profile = load_own_profile(study.profile, standard)
    except NetDesignError as error:
        if standard is not None:
            raise
        reason = error.message
        _describe_uncompared(study_file, "stored.profile_uncompared", reason)
        return None
    if profile.sha256 == study.profile.sha256:
        return profile
    if standard is not None:
        raise StudyError(say("stored.not_the_profile", profile=standard))
    reason = say("stored.other_profile")
    _describe_uncompared(study_file, "stored.profile_uncompared", reason)
    return None


def _describe_uncompared(study_file: Path, key: str, reason: Message | str) -> None:
    told = say("text.at_place", place=str(study_file), text=say(key, reason=reason))
    tell(told, err=True)
