"""Everything of the page, computed one part after the other."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib.resources import files as find_files
from pathlib import Path

from netdesign.edge.causes import explain
from netdesign.edge.given_files import MAX_TOML_BYTES, read_bounded
from netdesign.evidence.validation.band import validate_structure
from netdesign.evidence.validation.page import (
    DOCUMENT_FILE,
    PAGE_FILE,
    Evidence,
    render_validation,
)
from netdesign.evidence.validation.structure import Structure, read_structures
from netdesign.evidence.verification.case import VerificationCase
from netdesign.evidence.verification.compaction import compare_contrasts, list_places
from netdesign.evidence.verification.exported import (
    list_files,
    solve_exported,
    write_scenes,
)
from netdesign.evidence.verification.pack import GROUPS, run_pack
from netdesign.outcome import ModelError
from netdesign.words.catalogue import Language
from netdesign.words.message import say

_OWN = "measured.toml"


def read_all(path: Path | None) -> tuple[Structure, ...]:
    """Structures of a file, if one is given, then those that come with the program.

    Parameters
    ----------
    path : Path or None
        Of an owner's file.

    Raises
    ------
    ModelError
        If the file cannot be read, or a field is missing, unknown or out of range.
    """
    own = read_structures(find_files(__package__).joinpath(_OWN).read_bytes())
    if path is None:
        return own
    try:
        return (*read_structures(read_bounded(path, MAX_TOML_BYTES)), *own)
    except (ModelError, OSError, ValueError) as error:
        told = say("text.at_place", place=str(path), text=explain(error))
        raise ModelError(told) from None


def list_pages() -> list[str]:
    """Names of the page's files, the page first; then those of the scenes."""
    return [PAGE_FILE, DOCUMENT_FILE, *list_files()]


def render_pages(evidence: Evidence, language: Language = "en") -> dict[str, bytes]:
    """Page, its document and the exported scenes, by the names of their files."""
    return render_validation(evidence, language) | write_scenes(solve_exported())


def count_parts(structures: Sequence[Structure]) -> int:
    """Parts that ``gather`` tells of."""
    return len(GROUPS) + len(structures)


def gather(
    structures: Sequence[Structure],
    advance: Callable[[int], None] | None = None,
    cases: Sequence[VerificationCase] | None = None,
) -> Evidence:
    """Run the pack, the settling of snow, and every structure.

    Parameters
    ----------
    structures : sequence of Structure
        As read.
    advance : callable, optional
        Told how many parts are done.
    cases : sequence of VerificationCase, optional
        Of the pack, where it has been run already.
    """
    cases = run_pack(advance) if cases is None else cases
    validations = []
    for done, structure in enumerate(structures, start=len(GROUPS) + 1):
        validations.append(validate_structure(structure))
        if advance:
            advance(done)
    return Evidence(
        cases=cases,
        places=list_places(),
        contrasts=compare_contrasts(),
        validations=validations,
    )
