"""``netdesign paper``: the source paper's study on one page."""

from __future__ import annotations

import os
from pathlib import Path

import click

from netdesign.commands.options import (
    force_option,
    jobs_option,
    language_option,
    out_option,
    quiet_option,
)
from netdesign.commands.running import place_outputs, write_outputs
from netdesign.commands.usage import tell
from netdesign.words.catalogue import Language
from netdesign.words.message import say

_NOT_PROVEN = 4


@click.command()
@out_option("Folder of the page, drawings and tables.", required=True)
@force_option
@jobs_option()
@quiet_option
@language_option("Of page and messages.")
def paper(
    out: Path, *, force: bool, jobs: int | None, quiet: bool, language: Language
) -> None:
    """Reproduce the source paper's study: histories, meshes, plateaus.

    \b
    netdesign paper --out paper
    """
    import sys

    from netdesign.edge.progress import show_progress
    from netdesign.evidence.paper.cases import PaperSettings, list_cases
    from netdesign.evidence.paper.page import PAGE_FILE, render_paper
    from netdesign.evidence.paper.runs import run_study

    settings = PaperSettings()
    (page,) = place_outputs(out, [PAGE_FILE], overwrite=force)
    count = len(list_cases(settings))
    with show_progress(count, "runs", quiet=quiet, language=language) as on_done:
        study = run_study(settings, jobs=jobs or os.cpu_count() or 1, on_done=on_done)
    files = write_outputs(out, render_paper(study, language), overwrite=force)
    if not quiet:
        told = say("paper.wrote", path=str(page), count=len(files) - 1)
        tell(told, language, err=True)
    if any(run.failure for run in study.runs.values()):
        sys.exit(_NOT_PROVEN)
