"""``netdesign diff``: changes between two studies."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from netdesign.commands.language import tell
from netdesign.commands.options import json_option, language_option
from netdesign.commands.sound_study import require_sound
from netdesign.words.catalogue import Language
from netdesign.words.message import say

if TYPE_CHECKING:
    from netdesign.report.difference import Change

_TURNED = 1


@click.command()
@click.argument("old", type=click.Path(path_type=Path))
@click.argument("new", type=click.Path(path_type=Path))
@json_option("changes")
@language_option()
def diff(old: Path, new: Path, *, as_json: bool, language: Language) -> None:
    """Show what changed from one study to another: verdicts, checks, inputs.

    Verdicts that got worse come first. Exit code 1 if a verdict turned: of the study,
    of a net row or of any check in it. A study that contradicts itself, its site file
    or its limit profile is refused, as by `netdesign report`.

    \b
    netdesign diff rev-a/study.json rev-b/study.json
    netdesign diff rev-a/study.json rev-b/study.json --json
    """
    from netdesign.report.difference import compare_studies, write_difference
    from netdesign.study.document import load_study

    before, after = load_study(old), load_study(new)
    for study, path in ((before, old), (after, new)):
        require_sound(study, path, None, None, language)
    changes = compare_studies(before, after)
    if as_json:
        click.echo(
            json.dumps(write_difference(changes, language), indent=1, allow_nan=False)
        )
    else:
        _show(changes, language)
    sys.exit(_TURNED if any(change.is_turned for change in changes) else 0)


def _show(changes: Sequence[Change], language: Language) -> None:
    from netdesign.report.difference import name_area

    area = ""
    for change in changes:
        if change.area != area:
            area = change.area
            click.echo(name_area(area, language))
        click.echo(f"  {change.tell(language)}")
    if not changes:
        tell(say("diff.same"), language)
