"""A snowpack followed from day to day by one of the settling models."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from netdesign.addons.winter.settling.delta_snow import DELTA_SNOW, DELTA_SNOW_AGEING
from netdesign.addons.winter.settling.hs2swe import HS2SWE
from netdesign.addons.winter.settling.pack import BARE, DayPack, build_first_layer


class SettlingModel(Protocol):
    """Rule that takes a snowpack from one day to the next."""

    @property
    def name(self) -> str:
        """Name of the model and its constants."""

    @property
    def source(self) -> str:
        """Publication of the constants."""

    def step(self, before: DayPack, height: float) -> DayPack:
        """Snowpack a day later.

        Parameters
        ----------
        before : DayPack
            Of yesterday.
        height : float
            Observed today [m], above 0.
        """


# The first is the default: addons/winter/settling/THEORY.md, section 3.
MODELS: dict[str, SettlingModel] = {
    model.name: model for model in (DELTA_SNOW_AGEING, HS2SWE, DELTA_SNOW)
}


def follow_heights(
    heights: Sequence[float],
    model: SettlingModel = DELTA_SNOW_AGEING,
    first_density: float | None = None,
) -> tuple[DayPack, ...]:
    """Snowpack of each day of a series.

    Parameters
    ----------
    heights : sequence of float
        Observed snow height of each day [m], no gap, none below 0.
    model : SettlingModel, optional
        Settling model with its constants; by default the first of ``MODELS``.
    first_density : float, optional
        Density of the snow that lies on the first day [kg/m3]; by default new snow.
    """
    packs: list[DayPack] = []
    before = BARE
    for height in heights:
        if height <= 0.0:
            before = DayPack(
                heights=BARE.heights,
                masses=BARE.masses,
                ages=BARE.ages,
                runoff=before.mass,
            )
        elif not packs and first_density is not None:
            before = build_first_layer(height, first_density)
        else:
            before = model.step(before, height)
        packs.append(before)
    return tuple(packs)
