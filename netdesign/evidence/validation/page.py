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
from netdesign.report.page.render import build_environment, load_style, mark_safe
from netdesign.snow.creep_law import BOUTILLIER_2004, ZWINGER_2007

PAGE_FILE, DOCUMENT_FILE = "validation.html", "validation.json"
_FRACTION = {"no-slip": "rough", "free": "freely gliding"}
# What an expected value is: computed here, by a code of others, or from a publication.
_HERE, _RECALLED, _READ = "computed here", "recalled", "read in a source"
_MARKS = {
    "closed form": _HERE,
    "manufactured": _HERE,
    "invariant": _HERE,
    "limit": _HERE,
    "cross model": "computed by another code",
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
    """Origin of a case's expected value, in the words of the page."""
    if case.kind == "published":
        return _RECALLED if case.id.startswith(_RECALLED_CASES) else _READ
    return _HERE if case.id.startswith(_OWN_CASES) else _MARKS[case.kind]


def render_validation(evidence: Evidence) -> dict[str, bytes]:
    """Page and document, by the names of their files.

    Parameters
    ----------
    evidence : Evidence
        As computed.
    """
    return {
        PAGE_FILE: _render_page(evidence).encode(),
        DOCUMENT_FILE: write_validation(evidence).encode(),
    }


def write_validation(evidence: Evidence) -> str:
    """Document ``netdesign.validation/1`` as JSON."""
    return json.dumps(write_evidence(evidence), indent=1, allow_nan=False)


def _render_page(evidence: Evidence) -> str:
    compared = [c for one in evidence.validations for c in one.comparisons]
    is_measured = bool(evidence.validations)
    return (
        build_environment()
        .get_template("validation.html")
        .render(
            css=load_style("report.css", "study.css"),
            version=__version__,
            errors=mark_safe(draw_errors(evidence.cases)),
            compaction=mark_safe(draw_compaction(evidence.places)),
            bands=mark_safe(draw_bands(evidence.validations)) if is_measured else "",
            cases=[_show_case(case) for case in evidence.cases],
            passed=sum(case.passes for case in evidence.cases),
            quoted=_quote(),
            growth={key: f"{one:.0f}" for key, one in list_growth().items()},
            models=MODELS,
            softness=[_show_softness(place) for place in _pick(evidence.places)],
            contrasts=[_show_contrast(one) for one in evidence.contrasts],
            structures=[_show_structure(one) for one in evidence.validations],
            inside=sum(one.is_inside for one in compared),
            middle_of_five=sum(one.is_in_the_middle for one in compared),
            measured=len(compared),
            codes=_list_codes(),
        )
    )


def _quote() -> dict[str, str]:
    """Viscosity at one place by two of the laws, over the middle of the models."""
    density, stress = PLACE
    middle = find_middle(density)
    found = {
        key: compute_viscosity(law, density, stress)
        for key, law in (("own", BOUTILLIER_2004), ("stiffest", ZWINGER_2007))
    }
    return {
        "density": f"{density:g}",
        "stress": f"{stress / 1e3:g}",
        "value": f"{found['own']:.2g}",
        **{key: f"{value / middle:.1f}" for key, value in found.items()},
    }


def _show_case(case: VerificationCase) -> dict[str, str]:
    return {
        "id": case.id,
        "kind": case.kind,
        "reference": case.reference,
        "mark": mark_expected(case),
        "expected": f"{case.expected:.5g}",
        "got": f"{case.got:.5g}",
        "error": f"{case.error:.1e}",
        "tolerance": f"{case.tolerance:.1e}",
        "order": "" if case.order is None else f"{case.order:.2f}",
        "result": "✓" if case.passes else "✗ fails",
    }


def _pick(places: Sequence[Place]) -> list[Place]:
    return [place for place in places if place.density % 100.0 == 50.0]


def _show_softness(place: Place) -> dict[str, Any]:
    return {
        "density": f"{place.density:g}",
        "stress": f"{place.stress / 1e3:g}",
        "middle": f"{find_middle(place.density):.2g}",
        "laws": [
            {"viscosity": f"{value:.2g}", "softness": _show_ratio(place.softness[name])}
            for name, value in place.laws.items()
        ],
    }


def _show_ratio(value: float) -> str:
    return f"{value:.0f}" if value >= 10.0 else f"{value:.2g}"


def _list_codes() -> dict[str, dict[str, Any]]:
    """Other codes by their names, with recipe and results."""
    codes: dict[str, dict[str, Any]] = {}
    for one in load_results():
        code = codes.setdefault(one.code, {"recipe": one.recipe, "scenes": []})
        code["scenes"].append(one.scene)
    return codes


def _show_contrast(one: Contrast) -> dict[str, str]:
    (foot, head), (other_foot, other_head) = one.own, one.other
    uniform_foot, uniform_head = one.uniform
    return {
        "ground": _FRACTION[one.ground],
        "own": f"{foot / 1e3:.1f} / {head / 1e3:.1f}",
        "other": f"{other_foot / 1e3:.1f} / {other_head / 1e3:.1f}",
        "uniform": f"{uniform_foot / 1e3:.1f} / {uniform_head / 1e3:.1f}",
        "change": f"{100 * (other_foot / foot - 1):+.0f} / "
        f"{100 * (other_head / head - 1):+.0f}",
    }


def _show_structure(one: Validation) -> dict[str, Any]:
    structure = one.structure
    return {
        "title": structure.title,
        "source": structure.source,
        "note": structure.note,
        "is_known": structure.is_known,
        "cases": one.solved,
        "failed": one.failed,
        "reasons": one.reasons,
        "rows": [
            row for comparison in one.comparisons for row in _list_rows(comparison, one)
        ],
        "inputs": _list_inputs(structure),
        "open": structure.open,
    }


def _list_rows(comparison: Comparison, one: Validation) -> list[dict[str, str]]:
    measured = comparison.measured
    uncertain = f" ± {measured.uncertainty:g}" if measured.uncertainty else ""
    rows = []
    for band in comparison.bands:
        if one.structure.is_known:
            misfit = 100.0 * (band.low / measured.value - 1.0)
            said = f"misfit {misfit:+.1f} %"
        else:
            share = f"{100 * band.share_below:.0f} % of the cases lie below"
            said = f"{band.place(measured)} the band; {share}"
        rows.append(
            {
                "name": measured.name,
                "measured": f"{measured.value:g}{uncertain}",
                "mark": "read in a source"
                if measured.mark == "read"
                else measured.mark,
                "member": band.member.replace("_", " "),
                "band": f"{band.low:.0f} to {band.high:.0f}",
                "middle": f"{band.middle[0]:.0f} to {band.middle[1]:.0f}",
                "error": f"{100 * band.errors:.1f}",
                "said": said,
                "note": measured.note,
            }
        )
    return rows


def _list_inputs(structure: Structure) -> list[dict[str, str]]:
    return [
        {
            "name": name,
            "range": f"{span.low:g}"
            if span.is_known
            else f"{span.low:g} to {span.high:g}",
            "mark": span.mark,
            "reason": span.reason,
        }
        for name, span in structure.inputs.items()
    ]


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
