"""``netdesign init``: an input workbook to fill in."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from netdesign.commands.language import tell
from netdesign.commands.options import language_option
from netdesign.commands.usage import UsageRefusal
from netdesign.words.message import say

if TYPE_CHECKING:
    from netdesign.words.catalogue import Language


_SUFFIX = ".xlsx"


@click.command()
@click.argument("site_file", type=click.Path(path_type=Path, dir_okay=False))
@click.option("--example", is_flag=True, help="Fill in the built-in example site.")
@language_option("Of headings, words and notes; all three are read.")
@click.option("--force", is_flag=True, help="Overwrite an existing file.")
def init(site_file: Path, *, example: bool, language: Language, force: bool) -> None:
    """Write an input workbook to fill in.

    \b
    netdesign init site.xlsx
    netdesign init chantier.xlsx --language fr
    netdesign init example.xlsx --example
    """
    from netdesign.edge.output import require_free
    from netdesign.site.template.workbook import write_site_workbook

    if site_file.suffix.lower() != _SUFFIX:
        raise UsageRefusal(say("usage.init_suffix", file=str(site_file)))
    require_free([site_file], overwrite=force)
    write_site_workbook(site_file, example=example, overwrite=force, language=language)
    tell(say("cli.wrote", path=str(site_file)), language, err=True)
