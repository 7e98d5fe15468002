"""Swing of a net's pull by the day's wave of its own temperature.

Theory: winter/THEORY.md, section 6.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from netdesign.cable.net import Net
from netdesign.coupling.scene import Scene

EXPANSION = 1.2e-5  # of steel [1/K]
ASSUMED_AMPLITUDE = 5.0  # [K]; a clear day in spring, where no temperature is known
_DAY_RATE = 2.0 * math.pi / 86400.0  # [1/s]
_WINDOW = 1.0  # days before and after, whose temperatures count
# Fits of (Y8) to histories of uniform snow, 0.3 and more of D* / d as measured.
_HALVING, _BY_SLIP, _FREE_HALVING = 10.0, 2.0, 0.1


def find_half_time(scene: Scene) -> float:
    """Time in which snow takes back half of a sudden pull [s], eq. (Y8).

    Parameters
    ----------
    scene : Scene
        Net with the snow of a day.
    """
    ground, pack = scene.ground, scene.snowpack
    if ground.kind == "free":
        factor = _FREE_HALVING
    else:
        slip = ground.slip_length / pack.thickness
        factor = _HALVING / (1.0 + _BY_SLIP * math.sqrt(slip))
    return factor * scene.force_scale / _read_stiffness(scene) * scene.time_scale


def find_swing(scene: Scene, amplitude: float) -> float:
    """Amplitude of the pull on a net's ends through a day [N/m], eq. (Y9).

    Parameters
    ----------
    scene : Scene
        Net with the snow of a day.
    amplitude : float
        Of the day's wave of temperature [K].
    """
    turns = _DAY_RATE * find_half_time(scene) / math.log(2.0)
    at_once = _read_stiffness(scene) * EXPANSION * amplitude
    return at_once * turns / math.hypot(1.0, turns)


def find_amplitude(
    temperatures: Sequence[tuple[float, float]], day: float
) -> float | None:
    """Half the range of the temperatures near a day [K]; None of fewer than two.

    Parameters
    ----------
    temperatures : sequence of (float, float)
        Time [d] and temperature [K], in any order.
    day : float
        [d].
    """
    near = [kelvin for time, kelvin in temperatures if abs(time - day) <= _WINDOW]
    return (max(near) - min(near)) / 2.0 if len(near) > 1 else None


def _read_stiffness(scene: Scene) -> float:
    """ES [N/m]; a wall has no rope that could swing."""
    return scene.net.stiffness_per_m if isinstance(scene.net, Net) else 0.0
