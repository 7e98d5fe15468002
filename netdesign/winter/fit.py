"""Fit of a row to the forces measured in a season, and what it is good for.

Theory: winter/THEORY.md, section 7.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from netdesign.checks.result import Band
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.numerics.arrays import Floats
from netdesign.outcome import ModelError
from netdesign.snowpack.pack import DayPack
from netdesign.structure.members import Member
from netdesign.winter.day import DaySolver, RowDay, WinterRow, build_day_scene
from netdesign.winter.fit_inputs import (
    LEAST_DAYS,
    FitReading,
    Noise,
    build_covariance,
    choose_readings,
    list_parameters,
    vary_day,
    vary_row,
)
from netdesign.winter.gauss_newton import Fit, Parameter, Response, fit_gauss_newton
from netdesign.winter.measured import MeasuredPulls, find_swing
from netdesign.winter.season import RowWinters, StationPacks

# The same three meshes for every state: their error of some 0.4 % is in all of them,
# and differences are smooth.
FIT_SETTINGS = SolverSettings(accuracy=2e-3, levels=MESH_LEVELS[:3])
REFUSED = 2.0  # misfit over the noise: a model that misses by more is wrong
# Part of the prior's deviation that is left: above it data hardly told anything.
UNCONSTRAINED = 0.7
BAND = 0.90  # of the force
_QUANTILE = 1.6449  # of a normal distribution: 5 % lie above
_MEMBERS = (Member.FOOT_ANCHOR, Member.UPHILL_GUY, Member.DOWNHILL_GUY, Member.POST)
_LEAST_SHARE = 0.01  # of the largest reading: forces below it count as so much

FitEnding = Literal["fitted", "misfit", "far", "unsettled", "failed", "few"]
ForceCase = Literal["governing", "design"]


@dataclass(frozen=True, slots=True, kw_only=True)
class ForceBand:
    """Force of one member in one case, before and after a fit.

    Attributes
    ----------
    case : str
        ``governing`` day of the winter, or ``design`` case of the row.
    member : str
        As in ``RowDay.member_forces``.
    before, after : Band or None
        Characteristic force with its 90 % band, per anchor [N]; no ``after`` where the
        fit is refused.
    deviation_before, deviation_after : float or None
        Of the logarithm of the force [-].
    """

    case: ForceCase
    member: str
    before: Band
    deviation_before: float
    after: Band | None = None
    deviation_after: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SeasonFit:
    """Fit of one row to one season.

    Attributes
    ----------
    winter : str
        As "1999/2000".
    ending : str
        ``fitted``, or why nothing follows: ``misfit`` above the noise, a parameter
        ``far`` from its prior, ``unsettled``, ``failed`` solve, ``few`` readings.
    readings : tuple of FitReading
        Those that were taken.
    noise : Noise
        As stated.
    left_out : tuple of int
        Places of the days that have no force in the row as designed.
    known : frozenset of str
        Parameters that were surveyed.
    parameters : tuple of Parameter
        Those that were fitted, with their priors.
    fit : Fit or None
        None of few readings.
    computed : tuple of float
        Force of each reading at the posterior [N].
    deviations : tuple of float
        Of the logarithm of each reading by the noise [-].
    rms : float
        Of the logarithm of measured over computed [-]; NaN where nothing was computed.
    misfit : float
        The same over the noise, eq. (Y15) [-]; NaN likewise.
    governing : int or None
        Place of the governing day.
    forces : tuple of ForceBand
        What the fit is for.
    """

    winter: str
    ending: FitEnding
    readings: tuple[FitReading, ...]
    noise: Noise
    left_out: tuple[int, ...] = ()
    known: frozenset[str] = frozenset()
    parameters: tuple[Parameter, ...] = ()
    fit: Fit | None = None
    computed: tuple[float, ...] = ()
    deviations: tuple[float, ...] = ()
    rms: float = math.nan
    misfit: float = math.nan
    governing: int | None = None
    forces: tuple[ForceBand, ...] = field(default=())

    @property
    def is_fitted(self) -> bool:
        """The posterior holds, and so do the bands after the fit."""
        return self.ending == "fitted"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FitTask:
    """All that a fit needs.

    Attributes
    ----------
    winter : str
        Its name.
    solver : DaySolver
        Of the row as designed; ``FIT_SETTINGS`` unless a test has coarser ones.
    days : mapping of int to RowDay
        Prepared days of the readings, and the governing one.
    readings : tuple of FitReading
        What was measured.
    noise : Noise
        As stated.
    known : frozenset of str
        Parameters that were surveyed.
    governing : int or None
        Place of the governing day.
    design : RowDay or None
        Snow of the design case, which no parameter of the snow changes.
    """

    winter: str
    solver: DaySolver
    days: Mapping[int, RowDay]
    readings: tuple[FitReading, ...]
    noise: Noise
    known: frozenset[str] = frozenset()
    governing: int | None = None
    design: RowDay | None = None

    @property
    def row(self) -> WinterRow:
        """Row as designed."""
        return self.solver.row


def fit_season(task: FitTask) -> SeasonFit:
    """Fit of a row, refused where its misfit exceeds twice the noise.

    Parameters
    ----------
    task : FitTask
        Days, readings, noise.

    Notes
    -----
    Days that have no force in the row as designed are left out, and named.
    """
    task, left_out, targets = _keep_solved(task)
    begun = SeasonFit(
        winter=task.winter,
        ending="few",
        readings=task.readings,
        left_out=left_out,
        noise=task.noise,
        known=task.known,
        governing=task.governing,
    )
    if len({one.index for one in task.readings}) < LEAST_DAYS:
        return begun
    noise = build_covariance(task.readings, task.noise, list_swings(task))
    measured = np.log([one.force for one in task.readings])
    thickest = max(day.thickness for day in task.days.values())
    parameters = list_parameters(task.row, task.known, thickest)
    respond = _respond_to(task, parameters, targets)
    fit = fit_gauss_newton(respond, measured, noise, parameters)
    return _judge(begun, fit, parameters, measured, noise, targets)


def list_swings(task: FitTask) -> dict[int, float]:
    """Swing of a support's force by the day's rope temperature [N], eq. (Y9), by day.

    Parameters
    ----------
    task : FitTask
        Row as designed, its days.
    """
    layout = task.row.layout
    width = layout.post_spacing if layout else 1.0
    return {
        index: width * find_swing(build_day_scene(task.row.scene, day), task.noise.rope)
        for index, day in task.days.items()
    }


def _respond_to(
    task: FitTask,
    parameters: Sequence[Parameter],
    targets: Sequence[tuple[ForceCase, Member]],
) -> Response:
    """Logarithms of the forces of readings and targets, NaN where there are none."""
    places = {"governing": task.governing, "design": _DESIGN}
    wanted = [(one.index, one.member) for one in task.readings]
    wanted += [(places[case] or 0, member) for case, member in targets]
    least = _LEAST_SHARE * max(one.force for one in task.readings)

    def respond(values: Floats) -> Floats:
        named = {one.name: float(x) for one, x in zip(parameters, values, strict=True)}
        forces = _solve(task, named)
        found = [forces.get(index, {}).get(member) for index, member in wanted]
        return np.array(
            [math.nan if one is None else math.log(max(one, least)) for one in found]
        )

    return respond


_DESIGN = -1  # place of the design case among the days


def _solve(
    task: FitTask, values: Mapping[str, float]
) -> dict[int, Mapping[str, float]]:
    """Member forces of each day [N]; none of a day that failed or lost its layers."""
    try:
        row = vary_row(task.row, values)
    except ModelError:  # such a net lies on the ground
        return {}
    days = [vary_day(day, task.row, values) for day in task.days.values()]
    if task.design:
        days.append(replace(task.design, index=_DESIGN))
    solved = replace(task.solver, row=row).solve(days)
    return {
        after.index: {name: band.value for name, band in after.member_forces.items()}
        for before, after in zip(days, solved, strict=True)
        if after.ending == "solved" and len(after.layers) == len(before.layers)
    }


def _keep_solved(
    task: FitTask,
) -> tuple[FitTask, tuple[int, ...], list[tuple[ForceCase, Member]]]:
    """Task with the days that have a force as designed; those left out; targets."""
    forces = _solve(task, {})
    kept = {index: day for index, day in task.days.items() if index in forces}
    readings = tuple(one for one in task.readings if one.index in kept)
    left_out = tuple(index for index in task.days if index not in kept)
    governing = task.governing if task.governing in kept else None
    design = task.design if _DESIGN in forces else None
    task = replace(
        task, days=kept, readings=readings, governing=governing, design=design
    )
    return task, left_out, _list_targets(task, forces)


def _list_targets(
    task: FitTask, forces: Mapping[int, Mapping[str, float]]
) -> list[tuple[ForceCase, Member]]:
    """Members whose force is asked for: those that carry some as designed."""
    cases: list[tuple[ForceCase, int | None]] = [("governing", task.governing)]
    if task.design:
        cases.append(("design", _DESIGN))
    found = []
    for case, index in cases:
        known = forces.get(index, {}) if index is not None else {}
        least = 10.0 * _LEAST_SHARE * max(known.values(), default=0.0)
        found += [(case, m) for m in _MEMBERS if known.get(m, 0.0) > least]
    return found


def _judge(
    begun: SeasonFit,
    fit: Fit,
    parameters: tuple[Parameter, ...],
    measured: Floats,
    noise: Floats,
    targets: Sequence[tuple[ForceCase, Member]],
) -> SeasonFit:
    n = measured.size
    residuals = measured - fit.posterior.response[:n]
    misfit = math.sqrt(residuals @ np.linalg.inv(noise) @ residuals / n)
    is_far = any(map(Parameter.is_far, parameters, map(float, fit.posterior.values)))
    ending: FitEnding = "fitted"
    if not (fit.prior.is_known and fit.posterior.is_known):
        ending = "failed"
    elif not misfit <= REFUSED:
        ending = "misfit"
    elif is_far:
        ending = "far"
    elif not fit.is_settled:
        ending = "unsettled"
    ended = replace(
        begun,
        ending=ending,
        parameters=parameters,
        fit=fit,
        computed=tuple(map(float, np.exp(fit.posterior.response[:n]))),
        deviations=tuple(map(float, np.sqrt(np.diag(noise)))),
        rms=float(np.sqrt(np.mean(residuals**2))),
        misfit=misfit,
    )
    if not fit.prior.is_known:
        return ended
    forces = [_bound(fit, n + k, *one, ended) for k, one in enumerate(targets)]
    return replace(ended, forces=tuple(forces))


def _bound(
    fit: Fit, place: int, case: ForceCase, member: Member, ended: SeasonFit
) -> ForceBand:
    """Band of one target before and after, eq. (Y16)."""
    variances = np.diag([one.deviation**2 for one in ended.parameters])
    slopes = fit.prior.slopes[place]
    before = math.sqrt(slopes @ variances @ slopes)
    force = ForceBand(
        case=case,
        member=member,
        before=_spread(fit.prior.response[place], before),
        deviation_before=before,
    )
    if not ended.is_fitted:
        return force
    slopes = fit.posterior.slopes[place]
    after = math.sqrt(slopes @ fit.covariance @ slopes)
    return replace(
        force,
        after=_spread(fit.posterior.response[place], after),
        deviation_after=after,
    )


def _spread(logarithm: float, deviation: float) -> Band:
    reach = _QUANTILE * deviation
    low, value, high = np.exp([logarithm - reach, logarithm, logarithm + reach])
    return Band(low=float(low), value=float(value), high=float(high))


def list_unconstrained(fitted: SeasonFit) -> tuple[str, ...]:
    """Parameters of which the readings told hardly anything.

    Parameters
    ----------
    fitted : SeasonFit
        Any; none of a fit that failed.
    """
    if fitted.fit is None or not fitted.fit.posterior.is_known:
        return ()
    left = fitted.fit.deviations
    return tuple(
        one.name
        for one, deviation in zip(fitted.parameters, left, strict=True)
        if deviation > UNCONSTRAINED * one.deviation
    )


# Thickest snow of a reading over the net's height: one deviation of the height factor
# is left for snow that was higher than at the station.
_ROOM = 0.92


def choose_fit(
    result: RowWinters,
    station: StationPacks,
    measured: Sequence[MeasuredPulls],
    solver: DaySolver,
    *,
    noise: Noise,
    known: Collection[str] = (),
    design_density: float | None = None,
) -> FitTask:
    """Fit of the winter with most readings.

    Parameters
    ----------
    result : RowWinters
        Of the row, solved.
    station : StationPacks
        By the settling model of the result.
    measured : sequence of MeasuredPulls
        Of the row, at least one.
    solver : DaySolver
        Of the row; its accuracy gives way to that of fits.
    noise : Noise
        As stated.
    known : collection of str
        Parameters that were surveyed.
    design_density : float, optional
        Density of the design case, snow of the row's own thickness [kg/m3].
    """
    winters = station.packs[result.model]
    readings = {
        name: choose_readings(measured, station.series, _list_days(packs, solver))
        for name, packs in winters.items()
    }
    winter = max(readings, key=lambda name: len(readings[name]), default="")
    packs = winters.get(winter, {})
    governing, is_uniform = _find_governing(result, winter)
    taken = readings.get(winter, ())
    if is_uniform:  # its layers failed: no reading is held against uniform snow
        taken = tuple(one for one in taken if one.index != governing)
    days = _prepare(taken, governing, packs, solver)
    if is_uniform and governing is not None:
        days[governing] = replace(days[governing], layers=())
    return FitTask(
        winter=winter,
        solver=replace(solver, settings=FIT_SETTINGS),
        days=days,
        readings=taken,
        noise=noise,
        known=frozenset(known),
        governing=governing,
        design=_build_design(solver, design_density),
    )


def _list_days(packs: Mapping[int, DayPack], solver: DaySolver) -> list[RowDay]:
    """Days whose snow leaves some room below the head."""
    most = _ROOM * solver.row.scene.net.height_normal
    days = solver.prepare(packs, layered=False)
    return [day for day in days if day.thickness <= most]


def _prepare(
    readings: Sequence[FitReading],
    governing: int | None,
    packs: Mapping[int, DayPack],
    solver: DaySolver,
) -> dict[int, RowDay]:
    wanted = {one.index for one in readings}
    wanted |= {governing} if governing is not None else set()
    days = solver.prepare({k: packs[k] for k in sorted(wanted)}, layered=True)
    return {day.index: day for day in days}


def _find_governing(result: RowWinters, winter: str) -> tuple[int | None, bool]:
    """Place of the governing day, and whether it was solved as uniform snow."""
    for season in result.seasons:
        if season.name == winter and season.governing is not None:
            return season.governing.index, not season.governing.layers
    maxima = [one.index for one in result.maxima if one.winter == winter]
    return maxima[0] if maxima else None, True


def _build_design(solver: DaySolver, density: float | None) -> RowDay | None:
    if density is None:
        return None
    thickness = solver.row.scene.snowpack.thickness
    return RowDay(index=-1, thickness=thickness, density=density, ending="open")
