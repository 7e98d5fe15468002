"""Layers of a day's snowpack, joined to the few that a scene can carry.

Theory: winter/THEORY.md, section 1.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from netdesign.snow.snowpack import Layer

LEAST_DENSITY = 100.0  # [kg/m3]; the default creep law is refused below 89
THINNEST_SHARE = 0.06  # of the thickness
MOST_LAYERS = 4


def merge_layers(
    thicknesses: Sequence[float],
    densities: Sequence[float],
    most: int = MOST_LAYERS,
) -> tuple[Layer, ...]:
    """Layers from the ground up with neighbours joined; thickness and mass are kept.

    First layers that are too light join the one below, then thin ones the neighbour
    most like them, then the pair that matters least, eq. (Y2).

    Parameters
    ----------
    thicknesses : sequence of float
        Normal to the slope [m], from the ground up, at least one.
    densities : sequence of float
        [kg/m3].
    most : int
        Number of layers that may be left.
    """
    layers = [
        Layer(thickness=float(d), density=float(rho))
        for d, rho in zip(thicknesses, densities, strict=True)
    ]
    thin = THINNEST_SHARE * sum(layer.thickness for layer in layers)
    while len(layers) > 1:
        place = _find_light(layers)
        if place is None:
            place = _find_thin(layers, thin)
        if place is None and len(layers) > most:
            place = min(range(len(layers) - 1), key=lambda k: _weigh(layers, k))
        if place is None:
            break
        layers[place : place + 2] = [_join(layers[place], layers[place + 1])]
    return tuple(layers)


def _find_light(layers: list[Layer]) -> int | None:
    """Lower one of the pair that takes the lightest layer, if that is too light."""
    place = min(range(len(layers)), key=lambda k: layers[k].density)
    return None if layers[place].density >= LEAST_DENSITY else max(place - 1, 0)


def _find_thin(layers: list[Layer], thin: float) -> int | None:
    """Lower one of the pair that takes the thinnest layer, if that is too thin."""
    place = min(range(len(layers)), key=lambda k: layers[k].thickness)
    if layers[place].thickness >= thin:
        return None
    pairs = [k for k in (place - 1, place) if 0 <= k < len(layers) - 1]
    return min(pairs, key=lambda k: _compare(layers, k))


def _weigh(layers: list[Layer], place: int) -> float:
    """Cost of joining a layer with the next, eq. (Y2) [m]."""
    low, high = layers[place].thickness, layers[place + 1].thickness
    return low * high / (low + high) * _compare(layers, place) ** 2


def _compare(layers: list[Layer], place: int) -> float:
    return abs(math.log(layers[place].density / layers[place + 1].density))


def _join(low: Layer, high: Layer) -> Layer:
    thickness = low.thickness + high.thickness
    mass = low.thickness * low.density + high.thickness * high.density
    return Layer(thickness=thickness, density=mass / thickness)
