"""``netdesign paper``: the source paper's study on one page.

It speaks English only: it is for whoever develops or examines the program.
"""

from __future__ import annotations

import os
from pathlib import Path

import click

from netdesign.commands.options import (
    force_option,
    jobs_option,
    out_option,
    quiet_option,
)

_NOT_PROVEN = 4


@click.command()
@out_option("Folder of the page, drawings and tables.", required=True)
@force_option
@jobs_option()
@quiet_option
def paper(out: Path, *, force: bool, jobs: int | None, quiet: bool) -> None:
    """Reproduce the source paper's study: histories, meshes, plateaus.

    \b
    netdesign paper --out paper
    """
    import sys

    from netdesign.edge.output import require_free, write_files
    from netdesign.edge.progress import show_progress
    from netdesign.evidence.paper.cases import PaperSettings, list_cases
    from netdesign.evidence.paper.page import PAGE_FILE, render_paper
    from netdesign.evidence.paper.study import run_study

    settings = PaperSettings()
    require_free([out / PAGE_FILE], overwrite=force)
    with show_progress(len(list_cases(settings)), "runs", quiet=quiet) as on_done:
        study = run_study(settings, jobs=jobs or os.cpu_count() or 1, on_done=on_done)
    files = {out / name: content for name, content in render_paper(study).items()}
    write_files(files, overwrite=force)
    if not quiet:
        click.echo(f"wrote {out / PAGE_FILE} and {len(files) - 1} more", err=True)
    if any(run.failure for run in study.runs.values()):
        sys.exit(_NOT_PROVEN)
