"""``netdesign standards``: list, show, validate and copy limit profiles."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

import click

from netdesign.errors import OutputError

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
def list_profiles() -> None:
    """List the profiles that come with the program."""
    from netdesign.checks import list_standards, load_standard

    for name in list_standards():
        click.echo(f"{name:22} {load_standard(name).title}")


@standards.command("show")
@click.argument("name", metavar="ID")
def show_profile(name: str) -> None:
    """Show every value of a profile with its status and source."""
    from netdesign.checks import load_standard

    profile = load_standard(name)
    click.echo(f"{profile.id}: {profile.title}, {profile.edition}")
    click.echo(f"version {profile.version}, sha256 {profile.sha256}")
    if profile.choice:
        click.echo(f"choice {profile.choice} (choices.toml)")
    click.echo(f"\n{profile.what_it_is}\n{profile.what_it_is_not}\n")
    for entry in profile.listed:
        click.echo(f"{entry.id} = {entry.value:g} {entry.unit}  [{entry.status}]")
        click.echo(f"    {entry.text}\n    clause {entry.clause}; {entry.source}")


@standards.command("validate")
@click.argument("folder", type=click.Path(path_type=Path))
def validate_profile(folder: Path) -> None:
    """Validate a profile folder; every fault is told."""
    from netdesign.checks import load_standard

    click.echo(_summarise(load_standard(folder)))


@standards.command("copy")
@click.argument("name", metavar="ID")
@click.argument("folder", type=click.Path(path_type=Path))
def copy_profile(name: str, folder: Path) -> None:
    """Copy a profile to edit; its id becomes the name of the folder."""
    from netdesign.checks import load_standard
    from netdesign.edge.output import require_free, write_files
    from netdesign.edge.resources import find_resource

    profile = load_standard(name)
    source = find_resource("standards") / name
    if not source.is_dir():
        raise OutputError(f"{name}: only a profile of the program can be copied by id")
    own = folder.name.lower()
    if not re.fullmatch(r"[a-z0-9][a-z0-9._-]*", own):
        raise OutputError(
            f"{folder}: the name of the folder becomes the profile's id: letters, "
            "digits, dots and dashes, starting with a letter or digit"
        )
    paths = [path for path in sorted(source.iterdir()) if path.is_file()]
    free = [folder / path.name for path in paths]
    require_free(free, overwrite=False, may_force=False)
    texts = {path.name: path.read_text(encoding="utf-8") for path in paths}
    texts["document.toml"] = texts["document.toml"].replace(
        f'id = "{profile.id}"', f'id = "{own}"', 1
    )
    files = {folder / name: text.encode("utf-8") for name, text in texts.items()}
    write_files(files, overwrite=False)
    click.echo(_summarise(load_standard(folder)))


def _summarise(profile: Standard) -> str:
    return (
        f"{profile.id}: version {profile.version}, {len(profile.values)} values, "
        f"{len(profile.tables)} tables, sha256 {profile.sha256}"
    )
