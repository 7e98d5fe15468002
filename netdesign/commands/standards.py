"""``netdesign standards``: list, show, validate and copy limit profiles."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.options import take_options
from netdesign.commands.running import tell
from netdesign.outcome import OutputError
from netdesign.words.catalogue import Language, render
from netdesign.words.catalogue import name as name_of
from netdesign.words.message import Message, say

if TYPE_CHECKING:
    from netdesign.checks import Standard


@click.group()
def standards() -> None:
    """Show the limit profiles, and start one of your own.

    \b
    netdesign standards list
    netdesign standards show nf-p-95-304-style
    netdesign standards copy eurocode my-profile/
    netdesign standards validate my-profile/
    """


@standards.command("list")
@take_options("standards_list")
def list_profiles(*, language: Language) -> None:
    """List the profiles that come with the program."""
    from netdesign.checks import list_standards, load_standard
    from netdesign.report.words import Words, show_own

    for name in list_standards():
        profile, words = load_standard(name), Words(language)
        title = show_own(words, f"{profile.title}, {profile.edition}")
        click.echo(f"{name:22} {title}")


@standards.command("show")
@click.argument("name", metavar="ID")
@take_options("standards_show")
def show_profile(name: str, *, language: Language) -> None:
    """Show every value of a profile with its status and source."""
    from netdesign.checks import load_standard
    from netdesign.report.words import Words, show_own

    profile, words = load_standard(name), Words(language)
    title = show_own(words, f"{profile.title}, {profile.edition}")
    tell(say("show.label", label=profile.id, text=title))
    tell(say("standard.version", version=profile.version, sha256=profile.sha256))
    if profile.choice:
        tell(say("standard.choice", choice=profile.choice))
        click.echo(show_own(words, profile.choice_text))
    tell(say(f"floor.profile_{profile.floor}"))
    tell(say("standard.shared_sum", sum=name_of("shared_sum", profile.shared_sum)))
    click.echo(f"\n{show_own(words, profile.what_it_is)}")
    click.echo(f"{show_own(words, profile.what_it_is_not)}\n")
    for entry in profile.listed:
        status = render(name_of("status", entry.status), language)
        click.echo(
            f"{entry.id} = {words.show_given(entry.value)} {entry.unit}  [{status}]"
        )
        source = show_own(words, entry.source)
        clause = render(
            say("standard.clause", clause=entry.clause, source=source), language
        )
        click.echo(f"    {show_own(words, entry.text)}\n    {clause}")
        if entry.reason_beyond:
            note = say("note.beyond", reason=entry.reason_beyond)
            click.echo(f"    {render(note, language)}")


@standards.command("validate")
@click.argument("folder", type=click.Path(path_type=Path))
@take_options("standards_validate")
def validate_profile(folder: Path, **_: Any) -> None:
    """Validate a profile folder; every fault is told."""
    from netdesign.checks import load_standard

    tell(_summarise(load_standard(folder)))


@standards.command("copy")
@click.argument("name", metavar="ID")
@click.argument("folder", type=click.Path(path_type=Path))
@take_options("standards_copy")
def copy_profile(name: str, folder: Path, **_: Any) -> None:
    """Copy a profile to edit; its id becomes the name of the folder."""
    from netdesign.checks import load_standard
    from netdesign.edge.input_files import find_resource
    from netdesign.edge.output import require_free, write_files

    profile = load_standard(name)
    source = find_resource("standards") / name
    if not source.is_dir():
        raise OutputError(say("standard.copy_by_id", name=name))
    own = folder.name.lower()
    if not re.fullmatch(r"[a-z0-9][a-z0-9._-]*", own):
        raise OutputError(say("standard.folder_name", folder=str(folder)))
    paths = [path for path in sorted(source.iterdir()) if path.is_file()]
    free = [folder / path.name for path in paths]
    require_free(free, overwrite=False, may_force=False)
    texts = {path.name: path.read_text(encoding="utf-8") for path in paths}
    texts["document.toml"] = texts["document.toml"].replace(
        f'id = "{profile.id}"', f'id = "{own}"', 1
    )
    files = {folder / name: text.encode("utf-8") for name, text in texts.items()}
    write_files(files, overwrite=False)
    tell(_summarise(load_standard(folder)))


def _summarise(profile: Standard) -> Message:
    return say(
        "standard.summary",
        id=profile.id,
        version=profile.version,
        values=len(profile.values),
        tables=len(profile.tables),
        sha256=profile.sha256,
    )
