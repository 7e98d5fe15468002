"""Reports of a stored study, without solving."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import click

from netdesign.commands.language import tell
from netdesign.commands.options import force_option, out_option
from netdesign.commands.report_options import choose_style, list_wanted, report_options
from netdesign.commands.running import find_exit_code
from netdesign.commands.sizing import mark_names
from netdesign.commands.sound_study import require_sound
from netdesign.commands.stored_study import origin_options
from netdesign.words.catalogue import Language
from netdesign.words.message import say

DEFAULT_FOLDER = "netdesign-out"


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
    require_sound(study, study_file, site_file, standard, language)
    files = render_files([study], names, style)
    write_files(files, overwrite=force)
    for path in names[0]:
        tell(say("cli.wrote", path=str(path)), language, err=True)
    sys.exit(find_exit_code([study]))
