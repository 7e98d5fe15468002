"""The page of ``netdesign validate``: measured forces in the bands of the model."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import asdict
from typing import Any

from netdesign import __version__
from netdesign.addons.evidence.table import NUMBER_TEXTS, RANGES, TEXTS, tabulate_items
from netdesign.addons.evidence.validation.bands import draw_bands, name_validated
from netdesign.addons.evidence.validation.structure import (
    Measurement,
    MemberBand,
    Structure,
    Validation,
    validate_structure,
)
from netdesign.report.blocks import Figure, Paragraph, Table, masthead, section
from netdesign.report.page.render import render_page
from netdesign.report.words import ENGLISH

PAGE_FILE, DOCUMENT_FILE = "validation.html", "validation.json"


def gather(
    structures: Sequence[Structure], on_done: Callable[[Validation], None] | None = None
) -> list[Validation]:
    """Every structure solved over what is not known of it.

    Parameters
    ----------
    structures : sequence of Structure
        As read.
    on_done : callable, optional
        Called with each as it ends.
    """
    found = []
    for structure in structures:
        found.append(validate_structure(structure))
        if on_done is not None:
            on_done(found[-1])
    return found


def render_validation(validations: Sequence[Validation]) -> dict[str, bytes]:
    """Page and document, by the names of their files.

    Parameters
    ----------
    validations : sequence of Validation
        As computed.
    """
    document = json.dumps(write_validations(validations), indent=1, allow_nan=False)
    return {
        PAGE_FILE: _render_page(validations).encode(),
        DOCUMENT_FILE: document.encode(),
    }


def _render_page(validations: Sequence[Validation]) -> str:
    compared = [pair for one in validations for pair in one.comparisons]
    lead = ENGLISH(
        "validation.lead",
        measured=len(compared),
        inside=sum(one.is_inside for one in compared),
        middle=sum(one.is_in_the_middle for one in compared),
    )
    blocks = (
        masthead(
            f"netdesign validate · {__version__}",
            ENGLISH("validation.heading"),
            Paragraph(text=lead, look="lead"),
        ),
        section(
            "structures",
            ENGLISH("validation.structures"),
            Paragraph(text=ENGLISH("validation.structures_text"), look="text"),
            Figure(
                svg=draw_bands(validations),
                caption=ENGLISH("validation.bands_caption"),
                id="plate-bands",
                look="plate",
            ),
            _tabulate(validations).shown("study"),
            look="page",
        ),
    )
    return render_page(blocks, ENGLISH("validation.title"), "en")


def _tabulate(validations: Sequence[Validation]) -> Table:
    """A line for each measured force and member that it may be."""
    columns = {
        "validation.structure": (TEXTS, lambda at: at[0].structure.title),
        "validation.measured": (TEXTS, lambda at: at[1].name),
        "kN": (NUMBER_TEXTS, lambda at: _show_measured(at[1])),
        "validation.mark": (TEXTS, lambda at: at[1].mark),
        "validation.member": (TEXTS, lambda at: name_validated(at[2].member)),
        "validation.band": (RANGES, lambda at: (at[2].low, at[2].high)),
        "validation.middle": (RANGES, lambda at: at[2].middle),
        "validation.value": (TEXTS, lambda at: _judge_band(*at)),
    }
    lines = [
        (one, pair.measured, band)
        for one in validations
        for pair in one.comparisons
        for band in pair.bands
    ]
    return tabulate_items("", columns, lines)


def _show_measured(measured: Measurement) -> str:
    uncertain = f" ± {measured.uncertainty:g}" if measured.uncertainty else ""
    return f"{measured.value:g}{uncertain}"


def _judge_band(one: Validation, measured: Measurement, band: MemberBand) -> str:
    if one.structure.is_known:
        misfit = 100.0 * (band.low / measured.value - 1.0)
        return ENGLISH("validation.misfit", misfit=misfit)
    share = 100.0 * band.share_below
    return ENGLISH(f"validation.{band.place(measured)}", share=share)


def write_validations(validations: Sequence[Validation]) -> dict[str, Any]:
    """Plain values of the page in the form ``netdesign.validation/1``."""
    return {
        "schema": "netdesign.validation/1",
        "version": __version__,
        "structures": [_write_structure(one) for one in validations],
    }


def _write_structure(one: Validation) -> dict[str, Any]:
    return {
        **asdict(one.structure),
        "is_known": one.structure.is_known,
        "solved": one.solved,
        "failed": one.failed,
        "reasons": list(one.reasons),
        "measured": [
            {
                **asdict(comparison.measured),
                "is_inside": comparison.is_inside,
                "is_in_the_middle": comparison.is_in_the_middle,
                "bands": [asdict(band) for band in comparison.bands],
            }
            for comparison in one.comparisons
        ],
    }
