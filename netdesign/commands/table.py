"""``netdesign table``: the guideline's forces on the anchors, from office data."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.check import find_profiles
from netdesign.commands.config import ConfiguredCommand
from netdesign.commands.options import (
    DEFAULT_FOLDER,
    take_options,
)
from netdesign.commands.running import print_document, speak, tell
from netdesign.commands.site_input import (
    choose_rows,
    read_asked_site,
    require_source,
)
from netdesign.edge.output import STUDY_FILE
from netdesign.outcome import StudyError
from netdesign.words.message import say

if TYPE_CHECKING:
    from netdesign.site.model import Site
    from netdesign.study.records import Study


@click.command(cls=ConfiguredCommand)
@click.argument("site_file", required=False, type=click.Path(path_type=Path))
@take_options("table")
def table(site_file: Path | None, **asked: Any) -> None:
    """Show the guideline's forces on every anchor, without solving.

    Characteristic, inside each net row and at its end. Beside them stand the coupled
    forces of a study of the same site: that of --study, or one found beside the site
    or in netdesign-out.

    \b
    netdesign table site.xlsx
    netdesign table site.xlsx --study reports/study.json
    netdesign table site.xlsx --json
    """
    from netdesign.report.words import Words
    from netdesign.study.guideline_anchors import add_coupled, list_guideline_forces

    require_source(site_file, asked)
    site = choose_rows(read_asked_site(site_file, asked), asked["rows"])
    (profile,) = find_profiles([asked["standard"]] if asked["standard"] else [], site)
    rows = list_guideline_forces(site, profile)
    solved = _find_study(site, site_file, asked["study_file"])
    if solved is not None:
        rows = add_coupled(rows, {row.id: row.checks for row in solved.rows})
    words = Words(speak())
    if asked["as_json"]:
        from netdesign.report.terminal import write_anchor_table

        print_document(write_anchor_table(rows, words))
        return
    from netdesign.edge.output import open_console
    from netdesign.report.terminal import print_anchor_table

    for question in site.questions:
        tell(say("cli.question", text=question), err=True)
    print_anchor_table(rows, open_console(), words)


def _find_study(
    site: Site, site_file: Path | None, study_file: Path | None
) -> Study | None:
    """Study with the coupled forces of a site; None where no study is found.

    Raises
    ------
    StudyError
        If ``study_file`` is of another site, or of another version of the site.
    """
    from netdesign.edge.input_files import is_there
    from netdesign.study.document import load_study

    if study_file is not None:
        study = load_study(study_file)
        if study.provenance.site_sha256 != site.sha256:
            raise StudyError(say("table.other_site", study=str(study_file)))
        return study
    folder = site_file.absolute().parent if site_file else Path.cwd()
    for path in (folder / STUDY_FILE, folder / DEFAULT_FOLDER / STUDY_FILE):
        if not is_there(path):
            continue
        try:
            study = load_study(path)
        except StudyError:  # not the study that was asked for
            continue
        if study.provenance.site_sha256 == site.sha256:
            return study
        tell(say("cli.note", text=say("table.not_shown", study=str(path))), err=True)
    return None
