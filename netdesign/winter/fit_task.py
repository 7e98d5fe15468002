"""Task of a fit: the winter of a row, its days, its cases."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

from netdesign.snowpack.pack import DayPack
from netdesign.winter.day import DaySolver, RowDay
from netdesign.winter.fit import FIT_SETTINGS, FitTask
from netdesign.winter.fit_readings import FitReading, Noise, choose_readings
from netdesign.winter.measured import MeasuredPulls
from netdesign.winter.row_winters import RowWinters, StationPacks

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
