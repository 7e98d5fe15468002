"""``netdesign --version``: the program, its core and the editions of its profiles.

Only light modules are imported: neither NumPy nor the reader of profiles.
"""

from __future__ import annotations

import tomllib

import click

from netdesign import __version__
from netdesign.core.library import name_core
from netdesign.edge.input_files import find_resource


def print_version(context: click.Context, _: click.Parameter, asked: bool) -> None:
    """Print version, core and profiles, and end."""
    if not asked or context.resilient_parsing:
        return
    click.echo(f"netdesign {__version__}\ncore     {name_core()}")
    for path in sorted(find_resource("standards").glob("*/document.toml")):
        profile = tomllib.loads(path.read_text(encoding="utf-8"))
        edition = f"version {profile['version']}, edition {profile['edition']}"
        click.echo(f"profile  {profile['id']}: {edition}")
    context.exit()
