"""``netdesign map``: questions that a workbook leaves open, in a file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.idle import refuse_delimiter
from netdesign.commands.language import tell
from netdesign.commands.options import force_option, language_option
from netdesign.commands.site_input import build_text_format, text_options
from netdesign.words.message import say

if TYPE_CHECKING:
    from netdesign.words.catalogue import Language


@click.command(name="map")
@click.argument("site_file", type=click.Path(path_type=Path))
@text_options
@language_option("Of the comments in the file.")
@force_option
def map_headings(
    site_file: Path, *, language: Language, force: bool, **reading: Any
) -> None:
    """Write SITE.map.toml: which headings mean what, to be answered.

    \b
    netdesign map site.xlsx
    netdesign map chantier.xlsx --language fr
    netdesign map site.xlsx --force      again, with the answers given so far

    Every question mark in the file asks for an answer: a heading of the workbook with
    its unit, or "ignore". Later runs read the file beside the workbook by themselves.
    """
    from netdesign.edge.output import require_free, write_files
    from netdesign.site.mapping import name_map
    from netdesign.site.questions import write_questions

    refuse_delimiter(site_file, language=language)
    place = name_map(site_file)
    require_free([place], overwrite=force)
    text, missing = write_questions(site_file, build_text_format(**reading), language)
    write_files({place: text.encode()}, overwrite=force)
    tell(say("cli.wrote", path=str(place)), language, err=True)
    if missing:
        tell(say("map.missing", count=missing), language, err=True)
    else:
        tell(say("map.complete"), language, err=True)
