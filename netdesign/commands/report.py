"""Reports of a stored study, without solving."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.language import tell
from netdesign.commands.options import force_option, out_option
from netdesign.commands.report_options import choose_style, list_wanted, report_options
from netdesign.commands.running import find_exit_code
from netdesign.commands.sizing import mark_names
from netdesign.commands.stored_study import (
    contradict_command,
    origin_options,
    read_own_site,
)
from netdesign.errors import NetDesignError, StudyError
from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message, say

if TYPE_CHECKING:
    from netdesign.checks import Standard
    from netdesign.site.model import Site
    from netdesign.study.records import Study

DEFAULT_FOLDER = "netdesign-out"
_SHOWN = 10  # contradictions; more help nobody


@click.command()
@click.argument("study_file", type=click.Path(path_type=Path))
@out_option("Folder of the outputs.", default=DEFAULT_FOLDER, show_default=True)
@origin_options
@report_options
@force_option
def report(
    study_file: Path,
    *,
    out: Path,
    site_file: Path | None,
    standard: str | None,
    force: bool,
    **options: Any,
) -> None:
    """Render the reports of a stored study again, without solving.

    A study that contradicts itself, its site file or its limit profile is refused. Only
    `netdesign verify --study` shows that its forces are those of the site.

    \b
    netdesign report netdesign-out/study.json --out again
    netdesign report netdesign-out/study.json --language fr --out rapport
    netdesign report netdesign-out/study.json --detail summary --no-excel --force
    """
    from netdesign.edge.output import require_free, write_files
    from netdesign.report.files import name_files, render_files
    from netdesign.study.document import load_study

    study = load_study(study_file)
    language: Language = options["language"]
    wanted = mark_names(list_wanted(options), is_what_if=study.what_if)
    names = name_files(out, [study.profile.id], wanted)
    style = choose_style(options)
    require_free(names[0], overwrite=force)
    _require_sound(study, study_file, site_file, standard, language)
    files = render_files([study], names, style)
    write_files(files, overwrite=force)
    for path in names[0]:
        tell(say("cli.wrote", path=str(path)), language, err=True)
    sys.exit(find_exit_code([study]))


def _require_sound(
    study: Study,
    study_file: Path,
    site_file: Path | None,
    standard: str | None,
    language: Language,
) -> None:
    """Refuse a study that cannot be true; say what it was not compared with.

    Raises
    ------
    StudyError
        With the contradictions, or if a file that was given is not the study's.
    """
    from netdesign.study.audit import audit_study
    from netdesign.study.document import compute_digest

    site = _find_site(study, study_file, site_file, language)
    profile = _find_profile(study, standard, language)
    found = [say("stored.command", reason=one) for one in contradict_command(study)]
    found += audit_study(study, profile, site)
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
        reason = render(error.message, language).partition("\n")[0]
        _tell_uncompared("stored.site_uncompared", reason, language)
        return None
    if site.sha256 == study.provenance.site_sha256:
        return site
    if site_file is not None:
        raise StudyError(say("stored.not_the_site", file=str(site_file)))
    _tell_uncompared("stored.site_uncompared", say("stored.other_site"), language)
    return None


def _find_profile(
    study: Study, standard: str | None, language: Language
) -> Standard | None:
    """Profile of the study, where it is at hand; one that is given has to be it."""
    from netdesign.study.record_provenance import load_own_profile

    try:
        profile = load_own_profile(study.profile, standard)
    except NetDesignError as error:
        if standard is not None:
            raise
        _tell_uncompared("stored.profile_uncompared", error.message, language)
        return None
    if profile.sha256 == study.profile.sha256:
        return profile
    if standard is not None:
        raise StudyError(say("stored.not_the_profile", profile=standard))
    reason = say("stored.other_profile")
    _tell_uncompared("stored.profile_uncompared", reason, language)
    return None


def _tell_uncompared(key: str, reason: Message | str, language: Language) -> None:
    from netdesign.edge.given_files import make_printable

    text = render(say(key, reason=reason), language)
    click.echo(make_printable(text), err=True)
