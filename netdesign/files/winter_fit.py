"""The fit of a row in the winter document: plain values, for JSON and for the page."""

from __future__ import annotations

import math
from typing import Any

from netdesign.checks.result import Band
from netdesign.snowpack.series import HeightSeries
from netdesign.units import degree_from_radian, kilonewton_from_newton
from netdesign.winter.fit import (
    BAND,
    REFUSED,
    UNCONSTRAINED,
    ForceBand,
    SeasonFit,
    list_unconstrained,
)
from netdesign.winter.fit_inputs import LOGARITHMIC, show_value
from netdesign.winter.gauss_newton import Parameter
from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message, say

_UNITS = {"slip_length": "m", "friction_angle": "deg"}  # the others are pure numbers


def write_fit(
    fitted: SeasonFit, series: HeightSeries, language: Language
) -> dict[str, Any]:
    """Entry ``fit`` of a row.

    Parameters
    ----------
    fitted : SeasonFit
        Of the row.
    series : HeightSeries
        Of the station: dates.
    language : str
        Of its sentences.
    """
    noise, governing = fitted.noise, fitted.governing
    return {
        "outcome": fitted.ending,
        "why": render(_explain(fitted), language),
        "winter": fitted.winter,
        "days": len({one.index for one in fitted.readings}),
        "readings": len(fitted.readings),
        "days_left_out": [series.day(one).isoformat() for one in fitted.left_out],
        "rounds": fitted.fit.rounds if fitted.fit else 0,
        "noise": {
            "reading": noise.reading,
            "cell": noise.cell,
            "rope_K": noise.rope,
        },
        "rms": _known(fitted.rms),
        "misfit": _known(fitted.misfit),
        "misfit_refused": REFUSED,
        "unconstrained_above": UNCONSTRAINED,
        "band": BAND,
        "known": sorted(fitted.known),
        "parameters": _write_parameters(fitted),
        "correlations": _write_correlations(fitted),
        "residuals": _write_residuals(fitted, series),
        "governing_date": (
            series.day(governing).isoformat() if governing is not None else None
        ),
        "forces": [_write_force(one) for one in fitted.forces],
    }


def _explain(fitted: SeasonFit) -> Message:
    """Sentence on how well it fits, or why nothing follows of it."""
    if fitted.ending == "few":
        return say("fit.few", days=len({one.index for one in fitted.readings}))
    if fitted.ending == "misfit":
        return say("fit.misfit", rms=fitted.rms, ratio=fitted.misfit, most=REFUSED)
    if fitted.ending == "far":
        return say("fit.far", names=tuple(_name(one) for one in _list_far(fitted)))
    if fitted.ending == "unsettled":
        return say("fit.unsettled", rounds=fitted.fit.rounds if fitted.fit else 0)
    if fitted.ending == "failed":
        return say("fit.failed")
    return say("fit.fitted", rms=fitted.rms, ratio=fitted.misfit)


def _name(parameter: str) -> Message:
    return say(f"fit_parameter.{parameter}")


def _list_far(fitted: SeasonFit) -> list[str]:
    values = fitted.fit.posterior.values if fitted.fit else ()
    pairs = zip(fitted.parameters, map(float, values), strict=True)
    return [one.name for one, value in pairs if one.is_far(value)]


def _write_parameters(fitted: SeasonFit) -> list[dict[str, Any]]:
    if fitted.fit is None:
        return []
    loose = list_unconstrained(fitted)
    left, values = fitted.fit.deviations, fitted.fit.posterior.values
    return [
        {
            "name": one.name,
            "unit": _UNITS.get(one.name, ""),
            "deviation_of": "logarithm" if one.name in LOGARITHMIC else "value",
            "prior": _in_unit(one.name, show_value(one.name, one.mean)),
            "prior_deviation": _in_unit(one.name, one.deviation),
            **_write_posterior(fitted, one, float(value), float(deviation)),
            "is_constrained": fitted.is_fitted and one.name not in loose,
        }
        for one, value, deviation in zip(fitted.parameters, values, left, strict=True)
    ]


def _write_posterior(
    fitted: SeasonFit, one: Parameter, value: float, deviation: float
) -> dict[str, Any]:
    """Value after the fit; none of a fit that is refused, wherever it stopped."""
    if not fitted.is_fitted:
        return {"posterior": None, "posterior_deviation": None, "is_at_end": False}
    return {
        "posterior": _in_unit(one.name, show_value(one.name, value)),
        "posterior_deviation": _known(_in_unit(one.name, deviation)),
        "is_at_end": one.is_at_end(value),
    }


def _in_unit(name: str, value: float) -> float:
    """Value or deviation in the unit that is shown; of a logarithm as it is."""
    return degree_from_radian(value) if _UNITS.get(name) == "deg" else value


def _write_correlations(fitted: SeasonFit) -> list[list[float]]:
    if fitted.fit is None or not fitted.is_fitted:
        return []
    return [[round(float(x), 4) for x in line] for line in fitted.fit.correlations]


def _write_residuals(fitted: SeasonFit, series: HeightSeries) -> list[dict[str, Any]]:
    return [
        {
            "date": series.day(reading.index).isoformat(),
            "member": str(reading.member),
            "measured_kN": kilonewton_from_newton(reading.force),
            "computed_kN": kilonewton_from_newton(force),
            "residual": math.log(reading.force / force),
            "deviation": deviation,
        }
        for reading, force, deviation in zip(
            fitted.readings, fitted.computed, fitted.deviations, strict=False
        )
        if math.isfinite(force)
    ]


def _write_force(force: ForceBand) -> dict[str, Any]:
    return {
        "case": force.case,
        "member": str(force.member),
        "before_kN": _write_band(force.before),
        "before_deviation": force.deviation_before,
        "after_kN": _write_band(force.after) if force.after else None,
        "after_deviation": force.deviation_after,
    }


def _write_band(band: Band) -> dict[str, float]:
    return {
        "low": kilonewton_from_newton(band.low),
        "value": kilonewton_from_newton(band.value),
        "high": kilonewton_from_newton(band.high),
    }


def _known(value: float) -> float | None:
    return value if math.isfinite(value) else None
