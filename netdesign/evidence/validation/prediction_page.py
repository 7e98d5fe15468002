"""Form for an owner, the letter that goes with it, and the page of a prediction."""

from __future__ import annotations

from collections.abc import Sequence

from netdesign import __version__
from netdesign.evidence.table import NUMBER_TEXTS, RANGES, TEXTS, tabulate_items
from netdesign.evidence.validation.measured_file import SCHEMA
from netdesign.evidence.validation.pictures import name_validated
from netdesign.evidence.validation.prediction import Hit, Prediction
from netdesign.evidence.validation.structure import NET_INPUTS
from netdesign.report.blocks import CODE, Block, Paragraph, Piece, masthead, section
from netdesign.report.page.render import render_page
from netdesign.report.words import MISSING, Words
from netdesign.words.catalogue import Language

FORM_FILE, LETTER_FILE = "form.toml", "letter.txt"
PREDICTION_FILE, PAGE_FILE = "prediction.json", "prediction.html"
COMPARISON_FILE = "comparison.html"
_FORCES = ("foot_anchor", "uphill_guy", "post")  # of the form
# Ranges of the form, by the names of its inputs: an example to be typed over.
_EXAMPLE = {
    "slope_deg": (35.0, 37.0),
    "net_height_m": (3.0, 3.1),
    "filled": (0.7, 0.9),
    "density_kg_m3": (300.0, 400.0),
    "upslope_length_m": (14.0, 16.0),
    "glide_factor": (1.3, 1.9),
    "inclination_deg": (27.0, 29.0),
    "friction_deg": (20.0, 40.0),
    "slack": (0.03, 0.06),
    "stiffness_kN_per_m": (8000.0, 12000.0),
    "post_spacing_m": (3.5, 3.5),
    "uphill_anchor_ratio": (1.0, 1.1),
}


def write_form(language: Language) -> dict[str, bytes]:
    """Form to be filled in and letter to the owner, by the names of their files."""
    words = Words(language)
    lines = [
        f"# {words('prediction.form_title')}",
        f"# {words('prediction.form_ranges')}",
        f'schema = "{SCHEMA}"',
        "",
        "[[structure]]",
        'id = "my-net"',
        f'title = "{words("prediction.form_name")}"',
        'kind = "net"',
        f'source = "{words("prediction.form_source")}"',
        "",
        f"# {words('prediction.form_forces')}",
    ]
    for member in _FORCES:
        name = name_validated(member, words)
        lines += ["[[structure.measured]]", f'name = "{name}"']
        lines.append(f'members = ["{member}"]')
    lines += ["", "[structure.inputs]"]
    for key in NET_INPUTS:
        low, high = _EXAMPLE[key]
        span = f'{{ low = {low}, high = {high}, mark = "measured" }}'
        lines.append(f"{key} = {span}  # {words(f'validation_input.{key}')}")
    letter = words("prediction.letter", form=FORM_FILE, file=PREDICTION_FILE)
    return {
        FORM_FILE: "\n".join((*lines, "")).encode(),
        LETTER_FILE: f"{letter.strip()}\n".encode(),
    }


def render_prediction(prediction: Prediction, language: Language) -> bytes:
    """Page of a prediction: its digest, and the band of every member."""
    words = Words(language)
    columns = {
        "validation.member": (TEXTS, lambda one: name_validated(one.member, words)),
        "prediction.middle": (NUMBER_TEXTS, lambda one: _show(one.middle, words)),
        "prediction.band": (RANGES, lambda one: (one.low, one.high)),
    }
    blocks = [_begin(prediction, words("prediction.heading"), words)]
    for number, one in enumerate(prediction.structures, 1):
        caption = words("prediction.cases", solved=one.solved, failed=one.failed)
        table = tabulate_items(caption, columns, one.members, words)
        blocks.append(section(f"structure-{number}", one.title, table.shown("study")))
    return _render(blocks, words)


def render_comparison(
    prediction: Prediction, hits: Sequence[Hit], language: Language
) -> bytes:
    """Page of measured forces beside what was predicted."""
    words = Words(language)
    inside = sum(one.is_inside for one in hits)
    columns = {
        "validation.measured": (TEXTS, lambda one: _name(one, words)),
        "validation.member": (
            TEXTS,
            lambda one: name_validated(one.predicted.member, words),
        ),
        "prediction.value": (
            NUMBER_TEXTS,
            lambda one: _show(one.measured.value, words),
        ),
        "prediction.middle": (
            NUMBER_TEXTS,
            lambda one: _show(one.predicted.middle, words),
        ),
        "prediction.band": (
            RANGES,
            lambda one: (one.predicted.low, one.predicted.high),
        ),
        "prediction.ratio": (NUMBER_TEXTS, lambda one: _show_ratio(one, words)),
        "prediction.inside": (
            TEXTS,
            lambda one: words("validation.yes" if one.is_inside else "validation.no"),
        ),
    }
    told = words("prediction.result", inside=inside, count=len(hits))
    table = tabulate_items(told, columns, hits, words).shown("study")
    first = _begin(prediction, words("prediction.compared"), words)
    return _render(
        [first, section("comparison", words("prediction.forces"), table)], words
    )


def _begin(prediction: Prediction, heading: str, words: Words) -> Block:
    lead = words("prediction.lead", made=prediction.day)
    digest = (Piece("SHA-256 "), Piece(prediction.digest, CODE))
    return masthead(
        f"netdesign validate · {__version__}",
        heading,
        Paragraph(text=lead, look="lead"),
        Paragraph(text=digest, look="text"),
    )


def _render(blocks: Sequence[Block], words: Words) -> bytes:
    return render_page(blocks, words("prediction.heading"), words.language).encode()


def _name(one: Hit, words: Words) -> str:
    return words("show.label", label=one.structure, text=one.measured.name)


def _show(force: float, words: Words) -> str:
    return words.show_number("max_kN", force)


def _show_ratio(one: Hit, words: Words) -> str:
    return MISSING if one.ratio is None else words.show_fixed(one.ratio, 2)
