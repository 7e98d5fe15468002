"""Measured forces of a row beside its winters, as parts of the winter document."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from netdesign.site.model import Site
from netdesign.snowpack.series import HeightSeries
from netdesign.study.winter_row import explain_unused
from netdesign.units import celsius_from_kelvin, kilonewton_from_newton
from netdesign.winter.compared import Comparison, ComputedForce
from netdesign.words.catalogue import Language, render


def write_measured(
    site: Site,
    row_id: str,
    compared: Sequence[Comparison],
    series: HeightSeries,
    language: Language = "en",
) -> dict[str, Any]:
    """Parts ``measured`` and ``not_compared`` of a row of the winter document.

    Parameters
    ----------
    site : Site
        With what was measured.
    row_id : str
        Of the row.
    compared : sequence of Comparison
        Of the row.
    series : HeightSeries
        Of the station.
    language : str
        Of the sentences.
    """
    unused = explain_unused(site, row_id, compared)
    return {
        "measured": [_write_one(one, series) for one in compared if one.computed],
        "not_compared": [render(one, language) for one in unused],
    }


def _write_one(one: Comparison, series: HeightSeries) -> dict[str, Any]:
    """Readings, computed forces with their band, and how far they are apart."""
    return {
        "winter": one.winter,
        "member": one.member,
        "source": one.pulls.source,
        "days_compared": int(one.ratios.size),
        "computed_over_measured": one.mean_ratio,
        "scatter": one.scatter,
        "readings_in_band": one.inside,
        "temperature_amplitude_assumed": any(day.is_assumed for day in one.computed),
        "readings": [
            {"time": moment.isoformat(), "force_kN": kilonewton_from_newton(force)}
            for moment, force in zip(one.pulls.moments, one.pulls.forces, strict=True)
        ],
        "air_temperatures": [
            {"time": moment.isoformat(), "air_C": celsius_from_kelvin(kelvin)}
            for moment, kelvin in one.pulls.air_temperatures
        ],
        "computed": [_write_day(day, series) for day in one.computed],
    }


def _write_day(day: ComputedForce, series: HeightSeries) -> dict[str, Any]:
    return {
        "date": series.day(day.index).isoformat(),
        "force_kN": kilonewton_from_newton(day.force.value),
        "low_kN": kilonewton_from_newton(max(0.0, day.force.low - day.swing)),
        "high_kN": kilonewton_from_newton(day.force.high + day.swing),
        "rope_swing_kN": kilonewton_from_newton(day.swing),
        "temperature_amplitude_K": day.amplitude,
    }
