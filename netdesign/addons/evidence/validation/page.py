"""Page of `netdesign validate`: the model's bands, and what was measured in them."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from dataclasses import asdict
from typing import Any

from netdesign import __version__
from netdesign.addons.charts import draw_decades, draw_rectangle
from netdesign.addons.evidence.table import NUMBER_TEXTS, RANGES, TEXTS, tabulate_items
from netdesign.addons.evidence.validation.structure import (
    Measurement,
    MemberBand,
    Structure,
    Validation,
    validate_structure,
)
from netdesign.report.blocks import Figure, Paragraph, Table, masthead, section
from netdesign.report.drawing.plain_svg import (
    ACCENT,
    GREY,
    PALE,
    TEXT_PT,
    WIDTH,
    Chart,
    Frame,
    measure_words,
)
from netdesign.report.page.render import render_page
from netdesign.report.words import ENGLISH, show_member
from netdesign.words.catalogue import load_texts

_LINE = 13.0  # of a list [pt]
_BELOW = 32.0  # a list: its ticks, the name of its axis [pt]
_FEEBLE = 1.0  # least force of the axis [kN]: a slack guy has none


def draw_bands(validations: Sequence[Validation]) -> str:
    """Bands of the model and what was measured, one bar a member."""
    bars: list[tuple[str, MemberBand | None, float]] = []
    for validation in validations:
        bars.append((validation.structure.title, None, 0.0))
        bars += [
            (
                f"{pair.measured.name}: {name_validated(band.member)}",
                band,
                pair.measured.value,
            )
            for pair in validation.comparisons
            for band in pair.bands
        ]
    largest = max(value for _, band, x in bars if band for value in (band.high, x))
    left = max(measure_words(name, TEXT_PT) for name, band, _ in bars if band) + 10.0
    frame = Frame(
        left=left,
        top=2.0,
        width=WIDTH - left - 4.0,
        height=_LINE * len(bars),
        x_low=math.log10(_FEEBLE / 1.3),
        x_high=math.log10(1.3 * largest),
        y_low=len(bars),
        y_high=0.0,
    )
    chart = Chart(language="en")
    for place, (name, band, value) in enumerate(bars):
        y = frame.y(place + 0.5)
        if band is None:
            chart.text(2.0, y + TEXT_PT / 3, name, bold=True)
            continue
        chart.text(frame.left - 6.0, y + TEXT_PT / 3, name, anchor="end")
        _draw_bar(chart, frame, y, band, value)
    return _end(chart, frame)


def _draw_bar(
    chart: Chart, frame: Frame, y: float, band: MemberBand, value: float
) -> None:
    """Band of a member, its middle, and what was measured."""
    for ends, color in (((band.low, band.high), PALE), (band.middle, GREY)):
        left, right = (frame.x(math.log10(max(end, _FEEBLE))) for end in ends)
        draw_rectangle(chart, left, y - 3.5, max(right - left, 0.5), 7.0, color)
    x = frame.x(math.log10(max(value, _FEEBLE)))
    chart.line(((x, y - 5.5), (x, y + 5.5)), stroke=ACCENT, width=2.2)


def _end(chart: Chart, frame: Frame) -> str:
    chart.axes(frame, x_ticks=False, y_ticks=False)
    draw_decades(chart, frame, across=True)
    bottom = frame.top + frame.height
    middle, axis = frame.left + frame.width / 2.0, ENGLISH("validation.bands_axis")
    chart.text(middle, bottom + _BELOW - 6.0, axis, anchor="middle")
    return chart.write(bottom + _BELOW, ENGLISH("validation.bands_title"))


def name_validated(member: str) -> str:
    """Member of the model that a measured value may be."""
    key = f"validation_member.{member}"
    return ENGLISH(key) if key in load_texts("en") else show_member(ENGLISH, member)


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
    validations = []
    for structure in structures:
        validations.append(validate_structure(structure))
        if on_done is not None:
            on_done(validations[-1])
    return validations


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
    compared = [pair for validation in validations for pair in validation.comparisons]
    lead = ENGLISH(
        "validation.lead",
        measured=len(compared),
        inside=sum(pair.is_inside for pair in compared),
        middle=sum(pair.is_in_the_middle for pair in compared),
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
        "validation.value": (TEXTS, lambda at: _judge_band(at[1], at[2])),
    }
    lines = [
        (validation, pair.measured, band)
        for validation in validations
        for pair in validation.comparisons
        for band in pair.bands
    ]
    return tabulate_items("", columns, lines)


def _show_measured(measured: Measurement) -> str:
    uncertain = f" ± {measured.uncertainty:g}" if measured.uncertainty else ""
    return f"{measured.value:g}{uncertain}"


def _judge_band(measured: Measurement, band: MemberBand) -> str:
    share = 100.0 * band.share_below
    return ENGLISH(f"validation.{band.place(measured)}", share=share)


def write_validations(validations: Sequence[Validation]) -> dict[str, Any]:
    """Plain values of the page in the form ``netdesign.validation/1``."""
    return {
        "schema": "netdesign.validation/1",
        "version": __version__,
        "structures": [_write_structure(validation) for validation in validations],
    }


def _write_structure(validation: Validation) -> dict[str, Any]:
    return {
        **asdict(validation.structure),
        "solved": validation.solved,
        "failed": validation.failed,
        "reasons": list(validation.reasons),
        "measured": [
            {
                **asdict(comparison.measured),
                "is_inside": comparison.is_inside,
                "is_in_the_middle": comparison.is_in_the_middle,
                "bands": [asdict(band) for band in comparison.bands],
            }
            for comparison in validation.comparisons
        ],
    }
