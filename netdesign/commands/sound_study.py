"""A stored study that somebody hands on: refused where it cannot be true."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from netdesign.commands.stored_study import contradict_command, read_own_site
from netdesign.errors import NetDesignError, StudyError
from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message, say

if TYPE_CHECKING:
    from netdesign.checks import Standard
    from netdesign.site.model import Site
    from netdesign.study.records import Study

_SHOWN = 10  # contradictions; more help nobody


def require_sound(
    study: Study,
    study_file: Path,
    site_file: Path | None,
    standard: str | None,
    language: Language,
) -> None:
    """Refuse a study that cannot be true; say what it was not compared with.

    Parameters
    ----------
    study, study_file
        As read, and from where.
    site_file, standard
        Its site file and its limit profile, where somebody gives them; else they are
        looked for by their names.
    language
        Of what is said.

    Raises
    ------
    StudyError
        With the contradictions, or if a file that was given is not the study's.
    """
    from netdesign.study.document import compute_digest
    from netdesign.study.rejudge import rejudge

    site = _find_site(study, study_file, site_file, language)
    profile = _find_profile(study, study_file, standard, language)
    found = [say("stored.command", reason=one) for one in contradict_command(study)]
    found += rejudge(study, profile, site)
    if study.digest and study.digest != compute_digest(study):
        found.insert(0, say("stored.altered"))
    if found:
        more = say("stored.more", count=len(found) - _SHOWN)
        lines = (*found[:_SHOWN], *((more,) if found[_SHOWN:] else ()))
        raise StudyError(say("stored.contradicts", study=str(study_file), lines=lines))


def _find_site(
    study: Study, study_file: Path, site_file: Path | None, language: Language
) -> Site | None:
    """Site of the study, where its file is at hand; one that is given has to be it."""
    try:
        site = read_own_site(study, study_file, site_file)
    except NetDesignError as error:
        if site_file is not None:
            raise
        first = render(error.message, language).partition("\n")[0]
        _tell_uncompared(study_file, "stored.site_uncompared", first, language)
        return None
    if site.sha256 == study.provenance.site_sha256:
        return site
    if site_file is not None:
        raise StudyError(say("stored.not_the_site", file=str(site_file)))
    reason = say("stored.other_site")
    _tell_uncompared(study_file, "stored.site_uncompared", reason, language)
    return None


def _find_profile(
    study: Study, study_file: Path, standard: str | None, language: Language
) -> Standard | None:
    """Profile of the study, where it is at hand; one that is given has to be it."""
    from netdesign.study.record_provenance import load_own_profile

    try:
        profile = load_own_profile(study.profile, standard)
    except NetDesignError as error:
        if standard is not None:
            raise
        reason = error.message
        _tell_uncompared(study_file, "stored.profile_uncompared", reason, language)
        return None
    if profile.sha256 == study.profile.sha256:
        return profile
    if standard is not None:
        raise StudyError(say("stored.not_the_profile", profile=standard))
    reason = say("stored.other_profile")
    _tell_uncompared(study_file, "stored.profile_uncompared", reason, language)
    return None


def _tell_uncompared(
    study_file: Path, key: str, reason: Message | str, language: Language
) -> None:
    from netdesign.edge.given_files import make_printable

    told = say("text.at_place", place=str(study_file), text=say(key, reason=reason))
    click.echo(make_printable(render(told, language)), err=True)
