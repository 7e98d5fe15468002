"""Readings that a fit takes of a season, and how uncertain they are.

Theory: winter/THEORY.md, section 7.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.outcome import require_positive, require_within
from netdesign.snowpack.series import HeightSeries
from netdesign.winter.day import RowDay
from netdesign.winter.measured import MeasuredPulls
from netdesign.winter.rope_temperature import ASSUMED_AMPLITUDE

DAYS_APART = 5  # readings of neighbouring days are one another's copies: one in so many
MOST_DAYS = 17
LEAST_DAYS = 5  # fewer say nothing of the misfit (assumed)
# Days of thinner snow, over the thickest of them, and weaker readings of a member,
# over its largest, are not taken: small forces are all noise (assumed).
THICK_SHARE = 0.5
STRONG_SHARE = 0.1


@dataclass(frozen=True, slots=True, kw_only=True)
class Noise:
    """Deviations of a reading from a chain that is right (defaults assumed).

    Attributes
    ----------
    reading : float
        Of each reading on its own, over the force [-].
    cell : float
        Of all readings of one member in common, over the force: its load cell [-].
    rope : float
        Amplitude of the day's wave of rope temperature [K].
    """

    reading: float = 0.05
    cell: float = 0.05
    rope: float = ASSUMED_AMPLITUDE

    def __post_init__(self) -> None:
        """Refuse noise that no load cell has, and none at all.

        Raises
        ------
        ModelError
            If it is so.
        """
        require_positive("noise of a reading", self.reading)
        require_within("noise of a reading", self.reading, 1e-6, 0.5)
        require_within("common error of a cell", self.cell, 0.0, 0.5)
        require_within("wave of rope temperature", self.rope, 0.0, 30.0, "K")


@dataclass(frozen=True, slots=True, kw_only=True)
class FitReading:
    """Force measured at one member on one day.

    Attributes
    ----------
    index : int
        Place of the day in the series of heights.
    member : str
        As in ``RowDay.member_forces``.
    force : float
        Mean of the day, per anchor [N].
    """

    index: int
    member: str
    force: float


def choose_readings(
    measured: Sequence[MeasuredPulls], series: HeightSeries, days: Sequence[RowDay]
) -> tuple[FitReading, ...]:
    """Readings of a few days of one winter, far enough apart to count each for itself.

    Parameters
    ----------
    measured : sequence of MeasuredPulls
        One for each member.
    series : HeightSeries
        Of the station.
    days : sequence of RowDay
        Of the winter, prepared, ascending; those that are not ``open`` are left out.
    """
    strong = _list_strong(measured, series)
    usable = [day for day in days if day.is_open and day.index in strong]
    thickest = max((day.thickness for day in usable), default=0.0)
    thick = [d.index for d in usable if d.thickness >= THICK_SHARE * thickest]
    if not thick:
        return ()
    spacing = max(DAYS_APART, -(-(thick[-1] - thick[0]) // (MOST_DAYS - 1)))
    chosen: list[int] = []
    for index in thick:
        if not chosen or index - chosen[-1] >= spacing:
            chosen.append(index)
    return tuple(reading for index in chosen for reading in strong[index])


def build_covariance(
    readings: Sequence[FitReading], noise: Noise, swings: Mapping[int, float]
) -> Floats:
    """Covariance of the logarithms of readings, eq. (Y11), (n_readings, n_readings).

    Parameters
    ----------
    readings : sequence of FitReading
        At least one.
    noise : Noise
        Its parts.
    swings : mapping of int to float
        Swing of a support's force by the day's rope temperature [N], by day.
    """
    forces = np.array([one.force for one in readings])
    members = np.array([one.member for one in readings])
    swing = np.array([swings[one.index] for one in readings])
    alone = noise.reading**2 + (swing / forces) ** 2 / 2.0  # of a wave, at any hour
    is_same = members[:, None] == members[None, :]
    return np.asarray(np.diag(alone) + noise.cell**2 * is_same)


def _list_strong(
    measured: Sequence[MeasuredPulls], series: HeightSeries
) -> dict[int, list[FitReading]]:
    """Daily means by their day, of each member those that are not small."""
    found: dict[int, list[FitReading]] = {}
    for one in measured:
        means = one.average_days(series)
        least = STRONG_SHARE * max(means.values(), default=0.0)
        for index, force in means.items():
            if force > least:
                reading = FitReading(index=index, member=one.member, force=force)
                found.setdefault(index, []).append(reading)
    return found
