"""Steel of anchors and guys: bars, wire ropes and their ends."""

from __future__ import annotations

import math

from netdesign.guards import require_within


def compute_bar_resistance(diameter: float, strength: float) -> float:
    """Tension resistance of a steel bar; resistance/THEORY.md, eq. (R3).

    Parameters
    ----------
    diameter : float
        Of the round area that carries, after any loss by corrosion [m].
    strength : float
        Characteristic 0.2 % proof strength or yield strength [Pa].

    Returns
    -------
    float
        A f [N].

    Raises
    ------
    ModelError
        If a number is out of its range.
    """
    require_within("bar diameter", diameter, 0.005, 0.2, "m")
    require_within("steel strength", strength, 1e8, 2.5e9, "Pa")
    return math.pi / 4.0 * diameter**2 * strength


def compute_rope_resistance(
    *, diameter: float, grade: float, breaking_factor: float, termination: float
) -> float:
    """Breaking force of a wire rope with its ends; resistance/THEORY.md, eq. (R4).

    Parameters
    ----------
    diameter : float
        Nominal [m].
    grade : float
        Strength R_r of the wires [Pa].
    breaking_factor : float
        K of the construction [-].
    termination : float
        Loss factor k_e of the weaker end [-].

    Returns
    -------
    float
        K d^2 R_r k_e [N].

    Raises
    ------
    ModelError
        If a number is out of its range.
    """
    require_within("rope diameter", diameter, 0.004, 0.1, "m")
    require_within("rope grade", grade, 1e9, 2.5e9, "Pa")
    require_within("breaking factor", breaking_factor, 0.1, 0.7)
    require_within("termination factor", termination, 0.1, 1.0)
    return breaking_factor * diameter**2 * grade * termination
