"""Governing snow, and the densities that the creep law is given for."""

from __future__ import annotations

from netdesign.site.model import NetRow, Site
from netdesign.snow.creep_law import ICE_DENSITY, CreepLaw
from netdesign.words.message import Message, say


def is_calibrated(law: CreepLaw, row: NetRow, density: float) -> bool:
    """The law is given for the density of a case [kg/m3], and of each layer."""
    return all(
        law.is_calibrated(one / ICE_DENSITY) for one in list_densities(row, density)
    )


def find_doubt(
    site: Site, row: NetRow, law: CreepLaw, *, density: float, largest: float
) -> Message | None:
    """Doubt that the creep law holds for a member's largest force; None without.

    The workbook may accept the law by its name.

    Parameters
    ----------
    density : float
        Of the governing case [kg/m3]: no other counts.
    largest : float
        Upper end of the force, any unit; without a force nothing rests on the law.
    """
    is_accepted = site.project.accepted_law == law.name
    if is_accepted or largest == 0.0 or is_calibrated(law, row, density):
        return None
    low, high = (bound * ICE_DENSITY for bound in law.calibrated)
    snow = list_densities(row, density)
    if len(snow) == 1:
        return say(
            "check.outside_law", density=snow[0], low=low, high=high, law=law.name
        )
    return say(
        "check.layers_outside_law",
        least=min(snow),
        largest=max(snow),
        low=low,
        high=high,
        law=law.name,
    )


def list_densities(row: NetRow, density: float) -> tuple[float, ...]:
    """Densities of the layers, or of uniform snow [kg/m3]."""
    return tuple(layer.density for layer in row.layers_at(density)) or (density,)
