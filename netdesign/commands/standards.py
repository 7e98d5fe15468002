"""Shows and validates the limit profiles."""

from __future__ import annotations

from pathlib import Path

import click


@click.group()
def standards() -> None:
    """Show the limit profiles.

    \b
    netdesign standards list
    netdesign standards show nf-p-95-304-style
    netdesign standards validate my-profile/
    """


@standards.command("list")
def list_profiles() -> None:
    """List the profiles that come with the program."""
    from netdesign.checks import list_standards, load_standard

    for name in list_standards():
        click.echo(f"{name}  {load_standard(name).title}")


@standards.command("show")
@click.argument("name", metavar="ID")
def show_profile(name: str) -> None:
    """Show every value of a profile with its status and source."""
    from netdesign.checks import load_standard

    profile = load_standard(name)
    click.echo(f"{profile.id}: {profile.title}, {profile.edition}")
    click.echo(f"sha256 {profile.sha256}\n\n{profile.what_it_is}")
    click.echo(f"{profile.what_it_is_not}\n")
    for entry in profile.values:
        click.echo(f"{entry.id} = {entry.value:g} {entry.unit}  [{entry.status}]")
        click.echo(f"    {entry.text}\n    clause {entry.clause}; {entry.source}")


@standards.command("validate")
@click.argument("folder", type=click.Path(path_type=Path))
def validate_profile(folder: Path) -> None:
    """Validate a profile folder; every fault is told."""
    from netdesign.checks import load_standard

    profile = load_standard(folder)
    click.echo(f"{profile.id}: {len(profile.values)} values, sha256 {profile.sha256}")
