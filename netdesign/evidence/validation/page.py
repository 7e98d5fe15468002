"""The page of ``netdesign validate``: verification, settling, measured structures."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from netdesign import __version__
from netdesign.evidence.validation.band import Comparison, Validation
from netdesign.evidence.validation.pictures import (
    draw_bands,
    draw_compaction,
    draw_errors,
    name_validated,
)
from netdesign.evidence.validation.structure import Structure
from netdesign.evidence.verification.another_code import load_results
from netdesign.evidence.verification.case import VerificationCase
from netdesign.evidence.verification.compaction import (
    MODELS,
    PLACE,
    Contrast,
    Place,
    compute_viscosity,
    find_middle,
    list_growth,
)
from netdesign.evidence.verification.pack import write_pack
from netdesign.evidence.verification.verification_table import name_kind
from netdesign.report.page.render import build_environment, load_style, mark_safe
from netdesign.report.words import Words, show_own
from netdesign.snow.creep_law import BOUTILLIER_2004, ZWINGER_2007
from netdesign.words.catalogue import Language
from netdesign.words.message import say

PAGE_FILE, DOCUMENT_FILE = "validation.html", "validation.json"
_GROUNDS = {"no-slip": "validation.no_slip", "free": "validation.free"}
_LAYERS = {"first": 0.8, "second": 1.0, "third": 1.2}  # of the layered scene [m]
# What an expected value is: computed here, by a code of others, or from a publication.
_HERE, _RECALLED, _READ = "here", "recalled", "read"
_MARKS = {
    "closed form": _HERE,
    "manufactured": _HERE,
    "invariant": _HERE,
    "limit": _HERE,
    "cross model": "code",
}
_RECALLED_CASES = ("guideline-",)  # of kind "published", but nobody had the page
# Of kind "cross model", but both models are solved here.
_OWN_CASES = (
    *("paper-increments", "two-elements", "history-", "staggered-"),
    *("panel-in-space", "plan-in-space"),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Evidence:
    """Everything that the page shows."""

    cases: Sequence[VerificationCase]
    places: Sequence[Place]
    contrasts: Sequence[Contrast]
    validations: Sequence[Validation]


def mark_expected(case: VerificationCase) -> str:
    """Origin of a case's expected value: a text ``validation_mark`` of this key."""
    if case.kind == "published":
        return _RECALLED if case.id.startswith(_RECALLED_CASES) else _READ
    return _HERE if case.id.startswith(_OWN_CASES) else _MARKS[case.kind]


def render_validation(
    evidence: Evidence, language: Language = "en"
) -> dict[str, bytes]:
    """Page and document, by the names of their files.

    Parameters
    ----------
    evidence : Evidence
        As computed.
    language : str
        Of the page.
    """
    return {
        PAGE_FILE: _render_page(evidence, Words(language)).encode(),
        DOCUMENT_FILE: write_validation(evidence).encode(),
    }


def write_validation(evidence: Evidence) -> str:
    """Document ``netdesign.validation/1`` as JSON."""
    return json.dumps(write_evidence(evidence), indent=1, allow_nan=False)


def _render_page(evidence: Evidence, words: Words) -> str:
    compared = [c for one in evidence.validations for c in one.comparisons]
    is_measured = bool(evidence.validations)
    return (
        build_environment(words.language)
        .get_template("validation.html")
        .render(
            css=load_style("report.css", "study.css"),
            language=words.language,
            version=__version__,
            errors=mark_safe(draw_errors(evidence.cases, words)),
            compaction=mark_safe(draw_compaction(evidence.places, words)),
            bands=mark_safe(draw_bands(evidence.validations, words))
            if is_measured
            else "",
            cases=[_show_case(case, words) for case in evidence.cases],
            passed=sum(case.passes for case in evidence.cases),
            quoted=_quote(words),
            growth={key: f"{one:.0f}" for key, one in list_growth().items()},
            models=_list_models(words),
            layers=say("validation.layers", **_LAYERS),
            softness=[_show_softness(place, words) for place in _pick(evidence.places)],
            contrasts=[_show_contrast(one, words) for one in evidence.contrasts],
            structures=[_show_structure(one, words) for one in evidence.validations],
            inside=sum(one.is_inside for one in compared),
            middle_of_five=sum(one.is_in_the_middle for one in compared),
            measured=len(compared),
            codes=_list_codes(words),
        )
    )


def _quote(words: Words) -> dict[str, str]:
    """Viscosity at one place by two of the laws, over the middle of the models."""
    density, stress = PLACE
    middle = find_middle(density)
    found = {
        key: compute_viscosity(law, density, stress)
        for key, law in (("own", BOUTILLIER_2004), ("stiffest", ZWINGER_2007))
    }
    return {
        "density": words.write(f"{density:g}"),
        "stress": words.write(f"{stress / 1e3:g}"),
        "value": words.write(f"{found['own']:.2g}"),
        **{key: words.write(f"{value / middle:.1f}") for key, value in found.items()},
    }


def _show_case(case: VerificationCase, words: Words) -> dict[str, str]:
    order = "" if case.order is None else words.write(f"{case.order:.2f}")
    return {
        "id": case.id,
        "kind": name_kind(case.kind, words),
        "reference": show_own(words, case.reference),
        "mark": words(f"validation_mark.{mark_expected(case)}"),
        "expected": words.write(f"{case.expected:.5g}"),
        "got": words.write(f"{case.got:.5g}"),
        "error": words.write(f"{case.error:.1e}"),
        "tolerance": words.write(f"{case.tolerance:.1e}"),
        "order": order,
        "result": "✓" if case.passes else words("validation.fails"),
    }


def _pick(places: Sequence[Place]) -> list[Place]:
    return [place for place in places if place.density % 100.0 == 50.0]


def _show_softness(place: Place, words: Words) -> dict[str, Any]:
    return {
        "density": words.write(f"{place.density:g}"),
        "stress": words.write(f"{place.stress / 1e3:g}"),
        "middle": words.write(f"{find_middle(place.density):.2g}"),
        "laws": [
            {
                "viscosity": words.write(f"{value:.2g}"),
                "softness": words.write(_show_ratio(place.softness[name])),
            }
            for name, value in place.laws.items()
        ],
    }


def _show_ratio(value: float) -> str:
    return f"{value:.0f}" if value >= 10.0 else f"{value:.2g}"


def _list_models(words: Words) -> str:
    """Models of settling, each with its source and mark."""
    mark = words("validation_mark.read")
    return words.join(
        f"{one.name} ({show_own(words, one.source)}, {mark})" for one in MODELS
    )


def _list_codes(words: Words) -> list[str]:
    """Other codes, each with its scenes and its recipe."""
    codes: dict[tuple[str, str], list[str]] = {}
    for one in load_results():
        codes.setdefault((one.code, one.recipe), []).append(one.scene)
    return [
        words(
            "validation.code",
            name=show_own(words, name),
            scenes=", ".join(scenes),
            recipe=show_own(words, recipe),
        )
        for (name, recipe), scenes in codes.items()
    ]


def _show_contrast(one: Contrast, words: Words) -> dict[str, str]:
    (foot, head), (other_foot, other_head) = one.own, one.other
    uniform_foot, uniform_head = one.uniform
    return {
        "ground": words(_GROUNDS[one.ground]),
        "own": words.write(f"{foot / 1e3:.1f} / {head / 1e3:.1f}"),
        "other": words.write(f"{other_foot / 1e3:.1f} / {other_head / 1e3:.1f}"),
        "uniform": words.write(f"{uniform_foot / 1e3:.1f} / {uniform_head / 1e3:.1f}"),
        "change": f"{100 * (other_foot / foot - 1):+.0f} / "
        f"{100 * (other_head / head - 1):+.0f}",
    }


def _show_structure(one: Validation, words: Words) -> dict[str, Any]:
    structure = one.structure
    counts: dict[str, Any] = {"count": one.solved}
    if one.failed:
        counts |= {"failed": one.failed, "reasons": tuple(map(str, one.reasons))}
    return {
        "title": show_own(words, structure.title),
        "source": show_own(words, structure.source),
        "note": _tell(structure.note, words),
        "is_known": structure.is_known,
        "told": words(
            "validation.cases_failed" if one.failed else "validation.cases", **counts
        ),
        "rows": [
            row
            for comparison in one.comparisons
            for row in _list_rows(comparison, one, words)
        ],
        "inputs": _list_inputs(structure, words),
        "open": [show_own(words, text) for text in structure.open],
    }


def _list_rows(
    comparison: Comparison, one: Validation, words: Words
) -> list[dict[str, str]]:
    measured = comparison.measured
    uncertain = (
        words.write(f" ± {measured.uncertainty:g}") if measured.uncertainty else ""
    )
    rows = []
    for band in comparison.bands:
        if one.structure.is_known:
            misfit = 100.0 * (band.low / measured.value - 1.0)
            said = words("validation.misfit", misfit=misfit)
        else:
            share = 100.0 * band.share_below
            said = words(f"validation.{band.place(measured)}", share=share)
        rows.append(
            {
                "name": show_own(words, measured.name),
                "measured": words.write(f"{measured.value:g}") + uncertain,
                "mark": words(f"validation_mark.{measured.mark}"),
                "member": name_validated(band.member, words),
                "band": _show_range(band.low, band.high, words),
                "middle": _show_range(*band.middle, words),
                "error": words.write(f"{100 * band.errors:.1f}"),
                "said": said,
                "note": _tell(measured.note, words),
            }
        )
    return rows


def _list_inputs(structure: Structure, words: Words) -> list[dict[str, str]]:
    return [
        {
            "name": words(f"validation_input.{name}"),
            "range": words.show_given(span.low)
            if span.is_known
            else words(
                "show.band",
                low=words.show_given(span.low),
                high=words.show_given(span.high),
            ),
            "mark": words(f"validation_mark.{span.mark}"),
            "reason": _tell(span.reason, words),
        }
        for name, span in structure.inputs.items()
    ]


def _show_range(low: float, high: float, words: Words) -> str:
    return words("show.band", low=f"{low:.0f}", high=f"{high:.0f}")


def _tell(text: str, words: Words) -> str:
    """Text of a structure, which may have none."""
    return show_own(words, text) if text else ""


def write_evidence(evidence: Evidence) -> dict[str, Any]:
    """Plain values of the page in the form ``netdesign.validation/1``."""
    return {
        "schema": "netdesign.validation/1",
        "version": __version__,
        "verification": write_pack(list(evidence.cases))["cases"],
        "compaction": [
            {
                "density_kg_m3": place.density,
                "stress_Pa": place.stress,
                "laws_Pa_s": place.laws,
                "models_Pa_s": {
                    name: list(ends) for name, ends in place.models.items()
                },
            }
            for place in evidence.places
        ],
        "contrasts": [
            {
                "ground": one.ground,
                "own_N_m": list(one.own),
                "other_N_m": list(one.other),
                "uniform_N_m": list(one.uniform),
            }
            for one in evidence.contrasts
        ],
        "structures": [_write_structure(one) for one in evidence.validations],
    }


def _write_structure(one: Validation) -> dict[str, Any]:
    return {
        "id": one.structure.id,
        "kind": one.structure.kind,
        "source": one.structure.source,
        "is_known": one.structure.is_known,
        "solved": one.solved,
        "failed": one.failed,
        "reasons": list(one.reasons),
        "open": list(one.structure.open),
        "inputs": {
            name: {"low": span.low, "high": span.high, "mark": span.mark}
            for name, span in one.structure.inputs.items()
        },
        "measured": [
            {
                "name": comparison.measured.name,
                "value": comparison.measured.value,
                "uncertainty": comparison.measured.uncertainty,
                "mark": comparison.measured.mark,
                "is_inside": comparison.is_inside,
                "is_in_the_middle": comparison.is_in_the_middle,
                "bands": [
                    {
                        "member": band.member,
                        "low": band.low,
                        "high": band.high,
                        "middle": list(band.middle),
                        "share_below": band.share_below,
                        "numerical_error": band.errors,
                    }
                    for band in comparison.bands
                ],
            }
            for comparison in one.comparisons
        ],
    }
