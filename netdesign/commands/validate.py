"""``netdesign validate``: the program against truth and against measured structures."""

from __future__ import annotations

from pathlib import Path

import click

from netdesign.commands.options import (
    force_option,
    json_option,
    language_option,
    out_option,
    quiet_option,
)
from netdesign.commands.running import (
    place_outputs,
    print_document,
    write_outputs,
)
from netdesign.commands.usage import tell
from netdesign.words.catalogue import Language
from netdesign.words.message import say

_FAIL, _NOT_PROVEN = 1, 4


@click.command()
@click.argument(
    "structures", required=False, type=click.Path(path_type=Path), metavar="[FILE.toml]"
)
@out_option("Folder of the page and its document.", required=True)
@json_option("validation")
@force_option
@quiet_option
@language_option("Of page and messages.")
def validate(
    structures: Path | None,
    out: Path,
    *,
    as_json: bool,
    force: bool,
    quiet: bool,
    language: Language,
) -> None:
    """Write one page: verification, settling of snow, measured structures.

    With a file, its structures stand first: one whose inputs are all values gets a
    misfit, others a band. The form is that of the program's own,
    netdesign/evidence/validation/measured.toml. Exit code 1 if a case of the
    verification fails, 4 if a measured force lies outside its band.

    \b
    netdesign validate --out validation
    netdesign validate my-net.toml --out validation
    netdesign validate --out validation --json > validation.json
    """
    import sys

    from netdesign.edge.progress import show_progress
    from netdesign.evidence.validation.gather import (
        count_parts,
        gather,
        list_pages,
        read_all,
        render_pages,
    )
    from netdesign.evidence.validation.page import write_evidence

    places = place_outputs(out, list_pages(), overwrite=force)
    known = read_all(structures)
    parts = count_parts(known)
    with show_progress(parts, "parts", quiet=quiet, language=language) as advance:
        evidence = gather(known, advance)
    write_outputs(out, render_pages(evidence, language), overwrite=force)
    if as_json:
        print_document(write_evidence(evidence))
    if not quiet:
        tell(say("cli.wrote", path=str(places[0])), language, err=True)
    if not all(case.passes for case in evidence.cases):
        sys.exit(_FAIL)
    bands = [one for one in evidence.validations if not one.structure.is_known]
    if not all(c.is_inside for one in bands for c in one.comparisons):
        sys.exit(_NOT_PROVEN)
