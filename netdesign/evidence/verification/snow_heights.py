"""Settling models on the Weissfluhjoch: a reference series, and measured masses."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from importlib.resources import files

import numpy as np

from netdesign.evidence.verification.case import VerificationCase, largest_difference
from netdesign.numerics.arrays import Floats
from netdesign.snowpack.follow import MODELS, follow_heights
from netdesign.snowpack.hs2swe import HS2SWE
from netdesign.snowpack.pack import DayPack

_SOURCE = "Magnusson et al. (2025), test series of their code, 2016 to 2022"
_PRINTED = 1e-6  # digits of the series [kg/m2]
_ROUNDING = 1e-9  # [kg/m2]
# A model that is farther off than this does not know the snow it is used for [kg/m3].
_LARGEST_BIAS, _LARGEST_SPREAD = 45.0, 75.0


@dataclass(frozen=True, slots=True, kw_only=True)
class StationSeries:
    """Daily snow heights of a station, with what is known of their mass.

    Attributes
    ----------
    heights : ndarray, shape (n_days,)
        [m].
    measured, reference : ndarray, shape (n_days,)
        SWE of snow pits, NaN on days without one, and of the authors' HS2SWE [kg/m2].
    """

    heights: Floats
    measured: Floats
    reference: Floats


def read_weissfluhjoch() -> StationSeries:
    """Series of the Weissfluhjoch, 2540 m."""
    folder = files(__package__).joinpath("weissfluhjoch")
    text = folder.joinpath("series.csv").read_text(encoding="utf-8")
    lines = list(csv.DictReader(text.splitlines()))
    return StationSeries(
        heights=np.array([float(line["hs_cm"]) / 100.0 for line in lines]),
        measured=np.array([float(line["swe_observed_mm"] or "nan") for line in lines]),
        reference=np.array([float(line["swe_hs2swe_mm"]) for line in lines]),
    )


def measure_imbalance(packs: tuple[DayPack, ...]) -> float:
    """Largest mass that a day of a series loses or finds [kg/m2]."""
    masses = np.array([pack.mass for pack in packs])
    moved = np.array([pack.new_mass - pack.runoff for pack in packs])
    return float(np.abs(np.diff(masses) - moved[1:]).max())


def list_snow_heights() -> list[VerificationCase]:
    """HS2SWE against its reference; all models against pits and their own mass."""
    series = read_weissfluhjoch()
    heights = tuple(map(float, series.heights))
    followed = {name: follow_heights(heights, model) for name, model in MODELS.items()}
    reference = [pack.mass for pack in followed[HS2SWE.name]]
    cases = [
        VerificationCase(
            id="hs2swe-reference",
            kind="published",
            reference=f"{_SOURCE}: SWE, largest difference on 2191 days [kg/m2]",
            expected=0.0,
            got=largest_difference(reference, series.reference),
            tolerance=_PRINTED,
        )
    ]
    for name, packs in followed.items():
        cases += _compare_with_pits(name, packs, series)
        cases.append(
            VerificationCase(
                id=f"{name}-mass",
                kind="invariant",
                reference="mass of a day = that before + new snow - runoff [kg/m2]",
                expected=0.0,
                got=measure_imbalance(packs),
                tolerance=_ROUNDING,
            )
        )
    return cases


def _compare_with_pits(
    name: str, packs: tuple[DayPack, ...], series: StationSeries
) -> list[VerificationCase]:
    """Bias and spread of the mean density on the days of the pits."""
    pits = ~np.isnan(series.measured)
    masses = np.array([pack.mass for pack in packs])
    errors = (masses[pits] - series.measured[pits]) / series.heights[pits]
    figures = (
        ("bias", float(errors.mean()), _LARGEST_BIAS),
        ("rmse", float(np.sqrt((errors**2).mean())), _LARGEST_SPREAD),
    )
    return [
        VerificationCase(
            id=f"{name}-density-{figure}",
            kind="published",
            reference=f"{_SOURCE}: {pits.sum()} snow pits, mean density [kg/m3]",
            expected=0.0,
            got=got,
            tolerance=tolerance,
        )
        for figure, got, tolerance in figures
    ]
