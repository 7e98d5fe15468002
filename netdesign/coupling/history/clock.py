"""Time against creep time: warm snow does the same things sooner.

In snow of one temperature the fluidity only rescales time, so a history is computed
once in creep time and read on the clock of its temperatures afterwards.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.outcome import ModelError, require_positive
from netdesign.snow.creep_law import compute_fluidity
from netdesign.words.message import say

_PARTS = 8  # of each interval between two readings, for the integral


@dataclass(frozen=True, slots=True, kw_only=True)
class Clock:
    """Relation of time and creep time, both in seconds and piecewise linear.

    Creep time runs at the scene's fluidity; after the last reading the clock goes on
    as it did there.

    Attributes
    ----------
    times : tuple of float
        Ascending, from 0 [s].
    creep_times : tuple of float
        Of the same instants [s].
    last_rate : float
        Creep time per time after the last of them [-].
    """

    times: tuple[float, ...] = (0.0,)
    creep_times: tuple[float, ...] = (0.0,)
    last_rate: float = 1.0

    @classmethod
    def of_temperatures(
        cls, times: Floats, temperatures: Floats, fluidity: float
    ) -> Clock:
        """Clock of snow whose temperature was read.

        Parameters
        ----------
        times : ndarray, shape (n,)
            Ascending, from 0 [s].
        temperatures : ndarray, shape (n,)
            Of the snow, linear between readings [K].
        fluidity : float
            Of the scene, at which creep time runs [Pa^-3 s^-1].

        Raises
        ------
        ModelError
            If the times do not ascend from 0 or a temperature is out of range.
        """
        require_positive("fluidity", fluidity, "Pa^-3 s^-1")
        ascending = times.size > 0 and times[0] == 0.0 and (np.diff(times) > 0).all()
        if not ascending or temperatures.shape != times.shape:
            raise ModelError(
                say(
                    "history.temperatures",
                    readings=temperatures.size,
                    times=times.size,
                )
            )
        fine = np.interp(
            np.arange((times.size - 1) * _PARTS + 1) / _PARTS,
            np.arange(times.size),
            times,
        )
        kelvin = np.interp(fine, times, temperatures)
        rates = np.array([compute_fluidity(float(t)) for t in kelvin]) / fluidity
        steps = np.diff(fine) * (rates[1:] + rates[:-1]) / 2.0
        return cls(
            times=tuple(fine.tolist()),
            creep_times=tuple(np.append(0.0, np.cumsum(steps)).tolist()),
            last_rate=float(rates[-1]),
        )

    def to_creep_time(self, time: float) -> float:
        """Creep time of a time.

        Parameters
        ----------
        time : float
            [s].

        Returns
        -------
        float
            [s].
        """
        later = max(0.0, time - self.times[-1])
        known = float(np.interp(time, self.times, self.creep_times))
        return known + later * self.last_rate

    def to_time(self, creep_time: float) -> float:
        """Time of a creep time.

        Parameters
        ----------
        creep_time : float
            [s].

        Returns
        -------
        float
            [s].
        """
        later = max(0.0, creep_time - self.creep_times[-1])
        known = float(np.interp(creep_time, self.creep_times, self.times))
        return known + later / self.last_rate
