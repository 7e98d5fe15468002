"""Reports of a stored study, without solving."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import click

from netdesign.commands.options import force_option, out_option
from netdesign.commands.report_options import list_wanted, report_options

DEFAULT_FOLDER = "netdesign-out"


@click.command()
@click.argument("study_file", type=click.Path(path_type=Path))
@out_option("Folder of the outputs.", default=DEFAULT_FOLDER, show_default=True)
@report_options
@force_option
def report(study_file: Path, *, out: Path, force: bool, **options: Any) -> None:
    """Render the reports of a stored study again, without solving.

    \b
    netdesign report netdesign-out/study.json --out again
    netdesign report netdesign-out/study.json --language fr --out rapport
    netdesign report netdesign-out/study.json --detail summary --no-excel --force
    """
    from netdesign.output import require_free, write_files
    from netdesign.report.files import ReportStyle, name_files, render_files
    from netdesign.report.words import VERDICTS
    from netdesign.study import load_study

    study = load_study(study_file)
    names = name_files(out, [study.profile.id], list_wanted(options))
    require_free(names[0], overwrite=force)
    files = render_files([study], names, ReportStyle(**options))
    write_files(files, overwrite=force)
    for path in names[0]:
        click.echo(f"wrote {path}", err=True)
    sys.exit(VERDICTS[study.verdict].exit_code)
