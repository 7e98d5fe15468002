"""The winter document: plain values of all rows' winters, for JSON and for the page."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from netdesign.addons.winter.day import ASSUMED_FACTOR, RowDay, WinterRow
from netdesign.addons.winter.heights import HeightSeries
from netdesign.addons.winter.maxima import AnnualMaximum
from netdesign.addons.winter.measured import (
    Comparison,
    compare_row,
    explain_unused,
)
from netdesign.addons.winter.season import (
    RowWinters,
    Season,
    list_complete,
)
from netdesign.addons.winter.settling import DayPack
from netdesign.addons.winter.statistics import (
    RETURN_PERIODS,
    TAILS,
    Gumbel,
    LimitedGumbel,
    Sample,
    fit_gumbel,
)
from netdesign.addons.winter.winter_sheet import StationWinter
from netdesign.site.model import Site
from netdesign.units import (
    celsius_from_kelvin,
    degree_from_radian,
    kilonewton_from_newton,
    kilonewton_if_known,
)
from netdesign.words.message import Message, say


def _write_measured(row: RowWinters, run: WinterRun) -> dict[str, Any]:
    """Parts ``measured`` and ``not_compared`` of a row."""
    series = run.winter.series
    compared = compare_row(run.site, row, series)
    unused = explain_unused(run.site, row.row.id, compared)
    return {
        "measured": [
            _write_compared(comparison, series)
            for comparison in compared
            if comparison.computed
        ],
        "not_compared": [str(message) for message in unused],
    }


def _write_compared(comparison: Comparison, series: HeightSeries) -> dict[str, Any]:
    """Readings, computed forces with their band, and how far they are apart."""
    return {
        "winter": comparison.winter,
        "member": comparison.series.member,
        "source": comparison.series.source,
        "temperature_amplitude_assumed": any(
            day.is_assumed for day in comparison.computed
        ),
        "readings": [
            {"time": moment.isoformat(), "force_kN": kilonewton_from_newton(force)}
            for moment, force in comparison.pulls
        ],
        "air_temperatures": [
            {"time": moment.isoformat(), "air_C": celsius_from_kelvin(kelvin)}
            for moment, kelvin in comparison.air
        ],
        "computed": [
            {
                "date": series.day(day.index).isoformat(),
                "force_kN": kilonewton_from_newton(day.force.value),
                "low_kN": kilonewton_from_newton(max(0.0, day.force.low - day.swing)),
                "high_kN": kilonewton_from_newton(day.force.high + day.swing),
            }
            for day in comparison.computed
        ],
    }


SCHEMA = "netdesign.winter/1"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WinterRun:
    """Winters of a site as they were solved.

    Attributes
    ----------
    site : Site
        Where the rows stand.
    winter : StationWinter
        What was measured.
    rows : sequence of RowWinters
        Of each row.
    is_smoothed : bool
        Heights are medians of three days.
    accuracy : float
        Of each solve [-].
    """

    site: Site
    winter: StationWinter
    rows: Sequence[RowWinters]
    is_smoothed: bool
    accuracy: float


def write_winter_document(run: WinterRun) -> dict[str, Any]:
    """Document of all rows; its sentences are English.

    Parameters
    ----------
    run : WinterRun
        What was solved.
    """
    station, series = run.winter, run.winter.series
    density = run.site.ranges["density"]
    return {
        "schema": SCHEMA,
        "site": {"file": run.site.file_name, "name": run.site.project.name},
        "station": {
            "name": station.station,
            "file": station.file or run.site.file_name,
            "altitude_m": station.altitude,
            "height_factor": station.height_factor or ASSUMED_FACTOR,
            "height_factor_given": station.height_factor is not None,
            "first_day": series.first_day.isoformat(),
            "last_day": series.days[-1].isoformat(),
            "is_smoothed": run.is_smoothed,
        },
        "model": run.rows[0].model if run.rows else "",
        "accuracy": run.accuracy,
        "check_density_kg_m3": [density.low, density.high],
        "ranges_sheet": str(say("sheet.project")),
        "notes": [str(note) for note in station.notes],
        "air_temperatures_C": _write_temperatures(station),
        "rows": [_write_row(row, run) | _write_measured(row, run) for row in run.rows],
    }


def _write_temperatures(station: StationWinter) -> dict[str, float]:
    """Daily air temperature of the station by its date, where it is known."""
    series = station.series
    return {
        day.isoformat(): round(celsius_from_kelvin(kelvin), 2)
        for day, kelvin in zip(series.days, series.air_temperatures, strict=False)
        if kelvin is not None
    }


def _write_row(result: RowWinters, run: WinterRun) -> dict[str, Any]:
    row = result.row
    scene, net = row.scene, row.scene.net
    packs = result.station.packs[result.model]
    seasons = {season.name: season for season in result.seasons}
    complete = list_complete(run.winter.series)
    proven = [maximum.foot for maximum in result.maxima if maximum.is_proven]
    winters = [
        _write_winter(maximum, packs[maximum.winter], seasons.get(maximum.winter), run)
        | {
            "complete": maximum.winter in complete,
            "is_below_largest": (maximum.bound or math.inf) <= max(proven, default=0.0),
            "models": {
                name: _write_uniform(other)
                for name, group in result.others.items()
                for other in group
                if other.winter == maximum.winter
            },
        }
        for maximum in result.maxima
    ]
    for winter, maximum in zip(winters, result.maxima, strict=True):
        winter["why"] = str(_explain(winter, maximum))
    return {
        "id": row.id,
        "height_factor": row.height_factor,
        "height_factor_given": run.winter.find_factor(row.id) is not None,
        "slope_deg": degree_from_radian(scene.snowpack.slope_angle),
        "net_height_m": net.height_normal,
        "inclination_deg": degree_from_radian(net.inclination),
        "friction_deg": degree_from_radian(getattr(net, "friction_angle", 0.0) or 0.0),
        "ground": scene.ground.kind,
        "slip_length_m": scene.ground.slip_length,
        "winters": winters,
        "statistics": _write_statistics(result.sample.fit),
        "statistics_notes": [str(note) for note in _note_sample(result.sample)],
        "equivalent_density": _write_range(result, run),
        "snow_heights": _write_heights(row, winters, run),
        "fit": None,  # of the schema: forces are no longer fitted
    }


def _write_winter(
    maximum: AnnualMaximum,
    packs: Mapping[int, DayPack],
    season: Season | None,
    run: WinterRun,
) -> dict[str, Any]:
    series = run.winter.series
    highest = max(packs, key=lambda k: packs[k].height)
    foot, head = (maximum.foot, maximum.head) if maximum.has_pull else (None, None)
    curve: Sequence[RowDay] = season.curve if season else ()
    if season:
        head = max((day.head.value for day in curve if day.head), default=None)
    governing, index = season.governing if season else None, maximum.index
    if governing:
        foot, index = governing.pull, governing.index
    pack = None if index is None else packs[index]
    failed = sum(day.pull is None for day in curve)
    return {
        "name": maximum.winter,
        "outcome": maximum.ending.replace(" ", "_"),
        "is_proven": maximum.is_proven,
        "basis": "layers" if governing and governing.layers else "uniform",
        "height_max_m": packs[highest].height,
        "height_max_date": series.day(highest).isoformat(),
        "height_max_density_kg_m3": packs[highest].density,
        "swe_max_kg_m2": max(pack.mass for pack in packs.values()),
        "governing_date": series.day(index).isoformat() if index is not None else None,
        "governing_height_m": pack.height if pack else None,
        "governing_density_kg_m3": pack.density if pack else None,
        "foot_peak_kN_per_m": kilonewton_if_known(foot),
        "head_peak_kN_per_m": kilonewton_if_known(head),
        "members_peak_kN": _largest_members(curve),
        "foot_at_height_max_kN_per_m": kilonewton_if_known(
            season.highest.pull if season else None
        ),
        "equivalent_density_kg_m3": (season or maximum).equivalent_density,
        "days_above_90_percent": season.high_days if season else None,
        "days_without_force": failed if season else None,
        "curve": [_write_day(day, packs, run) for day in curve],
    } | _write_uniform(maximum)


def _write_uniform(maximum: AnnualMaximum) -> dict[str, Any]:
    """Annual maximum of uniform snow, or its bound."""
    pull = maximum.foot if maximum.has_pull else None
    return {
        "uniform_peak_kN_per_m": kilonewton_if_known(pull),
        "uniform_at_most_kN_per_m": kilonewton_if_known(maximum.bound),
        "uniform_equivalent_density_kg_m3": maximum.equivalent_density,
    }


def _write_day(
    day: RowDay, packs: Mapping[int, DayPack], run: WinterRun
) -> dict[str, Any]:
    return {
        "date": run.winter.series.day(day.index).isoformat(),
        "outcome": day.ending,
        "reason": str(day.reason or ""),
        "swe_kg_m2": packs[day.index].mass,
        "thickness_m": day.thickness,
        "density_kg_m3": day.density,
        "foot_kN_per_m": kilonewton_if_known(day.pull),
        "head_kN_per_m": kilonewton_if_known(day.head.value if day.head else None),
        "error_kN_per_m": kilonewton_if_known(
            (day.foot.high - day.foot.low) / 2.0 if day.foot else None
        ),
        "members_kN": {
            name: kilonewton_from_newton(band.value)
            for name, band in day.member_forces.items()
        },
        "layers": [
            {"thickness_m": layer.thickness, "density_kg_m3": layer.density}
            for layer in day.layers
        ],
    }


def _largest_members(curve: Sequence[RowDay]) -> dict[str, float]:
    """Largest force of each member over a curve [kN]."""
    largest: dict[str, float] = {}
    for day in curve:
        for name, band in day.member_forces.items():
            force = kilonewton_from_newton(band.value)
            largest[name] = max(force, largest.get(name, 0.0))
    return largest


def _write_statistics(fit: Gumbel | LimitedGumbel | None) -> dict[str, Any] | None:
    if fit is None:
        return None
    limit = fit.limit if isinstance(fit, LimitedGumbel) else None
    return {
        "distribution": _LIMITED if limit else "Gumbel, by moments",
        "winters": fit.count,
        "limit_kN_per_m": kilonewton_if_known(limit),
        "mean_kN_per_m": kilonewton_from_newton(fit.mean),
        "variation": fit.variation,
        "return_values": [_write_value(period, fit) for period in RETURN_PERIODS],
    }


_LIMITED = "Gumbel, by maximum likelihood above a limit"


def _note_sample(sample: Sample) -> Iterator[Message]:
    """Sentences on winters that count by a bound, or not at all."""
    if sample.lack:
        yield sample.lack
        return
    if isinstance(sample.fit, LimitedGumbel):
        yield say(
            "winter_sample.limited",
            bounded=len(sample.bounds),
            count=sample.fit.count,
            below=sample.fit.below,
            limit=kilonewton_from_newton(sample.fit.limit),
        )
    if sample.left_out:
        yield say("winter_sample.left_out", winters=tuple(sample.left_out))


def _write_value(period: float, fit: Gumbel | LimitedGumbel) -> dict[str, Any]:
    """Return value with the ends of 5 and 95 %, and what heavier tails would make."""
    value, error = fit.find_return_value(period)
    low, high = fit.find_interval(period)
    tails: list[dict[str, float]] = []
    if isinstance(fit, Gumbel):
        for shape in TAILS:
            foot, end = map(kilonewton_from_newton, fit.find_tail(period, shape))
            tails.append({"shape": shape, "foot_kN_per_m": foot, "high_kN_per_m": end})
    return {
        "period_a": period,
        "foot_kN_per_m": kilonewton_from_newton(value),
        "standard_error_kN_per_m": kilonewton_from_newton(error),
        "low_kN_per_m": kilonewton_from_newton(low),
        "high_kN_per_m": kilonewton_from_newton(high),
        "tails": tails,
    }


def _write_range(result: RowWinters, run: WinterRun) -> dict[str, Any] | None:
    """Range of density that the winters give, and the sentence that justifies it."""
    ends = result.density_range
    if ends is None:
        return None
    text = say(
        "winter.justification",
        low=ends[0],
        high=ends[1],
        count=len(result.maxima),
        station=_name_source(run),
        first=run.winter.series.first_day.isoformat(),
        last=run.winter.series.days[-1].isoformat(),
        models=(result.model, *result.others),
        row=result.row.id,
    )
    return {"low_kg_m3": ends[0], "high_kg_m3": ends[1], "justification": str(text)}


RELIABILITY_PERIOD = 1000.0  # [a], near the indices of a notional reliability


def _write_heights(
    row: WinterRow, winters: Sequence[Mapping[str, Any]], run: WinterRun
) -> str | None:
    """Annual maxima of the snow height at a row, as sheet Uncertainty takes them."""
    heights = [
        row.height_factor * winter["height_max_m"]
        for winter in winters
        if winter["complete"]
    ]
    fit = fit_gumbel(heights)
    if fit is None or fit.deviation == 0.0:
        return None
    variation = fit.find_predictive_variation(RELIABILITY_PERIOD)
    typed = next(net_row for net_row in run.site.rows if net_row.id == row.id)
    ratio = fit.mean * math.cos(typed.slope_angle) / typed.snow_thickness
    text = say(
        "winter.heights",
        row=row.id,
        count=fit.count,
        station=_name_source(run),
        variation=variation,
        ratio=ratio,
        sheet=say("sheet.Uncertainty"),
    )
    return str(text)


def _name_source(run: WinterRun) -> str:
    """Station and file of the heights; the site's file only where no name is known."""
    named = [name for name in (run.winter.station, run.winter.file) if name]
    return ", ".join(named) or run.site.file_name


def _explain(winter: Mapping[str, Any], maximum: AnnualMaximum) -> Message:
    """Reason why that day governs, or why no maximum is proven."""
    if maximum.ending == "overtopped":
        return say("winter.why_overtopped")
    if maximum.ending == "doubtful":
        reason, bound = maximum.reason or "-", winter["uniform_at_most_kN_per_m"]
        if bound is None:
            return say("winter.why_doubtful", reason=reason)
        return say("winter.why_bounded", reason=reason, bound=bound)
    if winter["governing_date"] is None:
        return say("winter.why_no_snow")
    share = winter["governing_height_m"] / winter["height_max_m"]
    key = "winter.why_ripe" if share < _NEARLY_HIGHEST else "winter.why_high"
    if winter["basis"] == "uniform":  # it pulls more, whether ripe or not
        key = "winter.why_uniform"
    return say(
        key,
        share=share,
        density=winter["governing_density_kg_m3"],
        before=winter["height_max_density_kg_m3"],
        day=winter["governing_date"],
        highest=winter["height_max_date"],
    )


_NEARLY_HIGHEST = 0.98
