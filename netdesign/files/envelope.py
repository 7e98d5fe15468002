"""The document of ``netdesign envelope --json``: forces per metre of net width."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, replace
from typing import Any

from netdesign import __version__
from netdesign.core.library import name_core
from netdesign.envelope.extremes import Extreme, find_extremes
from netdesign.envelope.rows import RowEnvelope, RowGrid
from netdesign.envelope.run import CaseResult
from netdesign.solving.runner import Counts
from netdesign.study.case_records import BoundRecord, EnvelopeRecord
from netdesign.study.record_envelope import record_envelope, show_case, show_coincident
from netdesign.units import kilonewton_from_newton
from netdesign.words.catalogue import Language, render
from netdesign.words.message import say

SCHEMA = "netdesign.envelope/1"
# Quantity of the document for each force that is followed.
QUANTITY_KEYS = {
    "foot": "foot_size_kN_per_m",
    "head": "head_size_kN_per_m",
    "rope": "tension_max_kN_per_m",
}


def write_envelope_document(
    envelope: RowEnvelope, counts: Counts, wall_s: float, language: Language = "en"
) -> tuple[dict[str, Any], EnvelopeRecord]:
    """Document and record of a searched envelope.

    Parameters
    ----------
    envelope : RowEnvelope
        Of the net's own tensions.
    counts : Counts
        Of the run.
    wall_s : float
        Time that the search took [s].
    language : str
        Of the reason.
    """
    record = record_envelope(envelope, tuple(QUANTITY_KEYS))
    document = {
        "schema": SCHEMA,
        "outcome": "not_proven" if envelope.gap else "bounded",
        "reason": render(envelope.gap or "", language),
        "ranges": {axis.key: [axis.low, axis.high] for axis in record.axes},
        "extremes": [
            _write_bound(envelope, bound, language) for bound in record.bounds
        ],
        "cases": {
            "solved": counts.solved,
            "reused": counts.reused,
            "skipped": record.skipped,
            "failed": record.failed,
            "asked": record.cases,
            "skips_tested": record.skips_tested,
        },
        "bound": {
            "gap_asked": envelope.task.search.gap,
            "certainty": record.certainty,
            "resolved_share": record.resolved_share,
            "rests_on": render(say("envelope.rests_on"), language),
        },
        "log": [_write_addition(asdict(one)) for one in record.log],
        "cost": {"wall_s": wall_s},
        "provenance": {
            "version": __version__,
            "core": name_core(),
            "creep_law": envelope.task.scene.creep_law.name,
            "settings": {"accuracy": envelope.task.settings.accuracy},
        },
    }
    return document, record


def write_grid_document(
    grid: RowGrid, counts: Counts, wall_s: float, language: Language = "en"
) -> dict[str, Any]:
    """Document of a grid of cases, which has no upper bound.

    Parameters
    ----------
    grid : RowGrid
        All cases.
    counts : Counts
        Of the run.
    wall_s : float
        Time that the cases took [s].
    language : str
        Of the reason.
    """
    results = grid.results
    reason = grid.gap
    extremes = find_extremes(results)
    return {
        "schema": SCHEMA,
        "outcome": "not_proven" if reason else "sampled",
        "reason": render(reason or "", language),
        "ranges": {
            key: [min(values), max(values)]
            for key, values in _list_values(results).items()
        },
        "extremes": [
            {
                "quantity": QUANTITY_KEYS[member],
                "max": kilonewton_from_newton(extreme.force.value),
                "upper_bound": None,  # a grid says nothing between its cases
                "low": kilonewton_from_newton(extreme.force.low),
                "high": kilonewton_from_newton(extreme.force.high),
                "case": show_case(extreme.governing.case.values),
                "coincident": _list_coincident(extreme),
            }
            for member, extreme in extremes.items()
        ],
        "cases": {
            "solved": counts.solved,
            "reused": counts.reused,
            "skipped": grid.skipped,
            "failed": sum(not result.is_converged for result in results),
            "asked": len(results),
        },
        "cost": {"wall_s": wall_s},
        "provenance": {"version": __version__, "core": name_core()},
    }


def _write_bound(
    envelope: RowEnvelope, bound: BoundRecord, language: Language
) -> dict[str, Any]:
    extreme = envelope.extremes[bound.quantity]
    band = extreme.widened
    confirmation = None
    if bound.confirmation is not None:
        told = render(bound.confirmation.reason or "", language)
        plain = asdict(replace(bound.confirmation, reason=None))
        confirmation = _per_metre(plain | {"reason": told})
    return {
        "quantity": QUANTITY_KEYS[bound.quantity],
        "max": bound.max_kN,
        "upper_bound": bound.upper_bound_kN,
        "gap": bound.upper_bound_kN / bound.max_kN - 1.0 if bound.max_kN else 0.0,
        "low": kilonewton_from_newton(band.low),
        "high": kilonewton_from_newton(band.high),
        "case": bound.case,
        "coincident": _list_coincident(extreme),
        "confirmation": confirmation,
        "sensitivity": {
            "unexplained": bound.unexplained,
            "drivers": [_per_metre(asdict(driver)) for driver in bound.drivers],
        },
    }


def _list_coincident(extreme: Extreme) -> dict[str, float]:
    found = show_coincident(extreme, tuple(QUANTITY_KEYS))
    return {QUANTITY_KEYS[other]: force for other, force in found.items()}


def _list_values(results: Sequence[CaseResult]) -> dict[str, list[float]]:
    cases = [show_case(result.case.values) for result in results]
    return {key: [case[key] for case in cases] for key in (cases[0] if cases else ())}


def _write_addition(one: dict[str, Any]) -> dict[str, Any]:
    return _per_metre(one | {"quantity": QUANTITY_KEYS.get(one["quantity"], "")})


def _per_metre(values: dict[str, Any]) -> dict[str, Any]:
    """Keys of a record whose forces are per metre of width."""
    return {
        f"{key}_per_m" if key.endswith("_kN") else key: value
        for key, value in values.items()
    }
