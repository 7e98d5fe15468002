"""A net under a guideline's load: end pulls of a shallow elastic cable.

The guideline says how large the load is, not how hard a slack or tight net pulls on
its ends; here the net's own stiffness and slack say it, in closed form.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic

from netdesign.numerics.arrays import Number
from netdesign.numerics.either import (
    find_cosine,
    find_cube_root,
    find_root,
    find_sine,
    measure_length,
    require_all_positive,
    require_all_within,
    take_larger,
)

# Of Newton's method, from at most a third above the root; each doubles the digits.
_ROUNDS = 6


@dataclass(frozen=True, slots=True, kw_only=True)
class NetPull(Generic[Number]):
    """Pulls of the net, or of each of many, on its ends for each metre of width.

    Attributes
    ----------
    foot, head : tuple of float or ndarray, shape (2,)
        On the foot anchor and on the post head [N/m].
    chord_tension : float or ndarray
        Part of the tension along the chord, the same at both ends [N/m].
    """

    foot: tuple[Number, Number]
    head: tuple[Number, Number]
    chord_tension: Number

    @property
    def largest_tension(self) -> Number:
        """Largest tension of the net, at one of its ends [N/m]."""
        return take_larger(measure_length(*self.foot), measure_length(*self.head))


def compute_net_pull(
    resultant: tuple[Number, Number],
    *,
    inclination: Number,
    chord: Number,
    loaded_share: Number,
    stiffness: Number,
    slack: Number,
) -> NetPull[Number]:
    """End pulls of a shallow cable under a load spread evenly from the foot.

    Of many nets at once where arrays are given, of shapes that go together. Theory:
    guideline/THEORY.md, eqs. (G7) to (G9).

    Parameters
    ----------
    resultant : tuple of float or ndarray, shape (2,)
        Load on the net [N/m].
    inclination : float or ndarray
        Of the chord from the slope normal [rad].
    chord : float or ndarray
        Foot to head [m].
    loaded_share : float or ndarray
        Part of the chord that carries the load, from the foot [-].
    stiffness : float or ndarray
        ES [N/m].
    slack : float or ndarray
        Unstressed length over chord, less 1 [-].

    Returns
    -------
    NetPull
        Their sum is the load [N/m].

    Raises
    ------
    ModelError
        If the load does not press the net, or a number is out of its range.

    Verified by
    -----------
    tests/guideline/test_net_pull.py
    """
    require_all_positive("chord", chord, "m")
    require_all_within("loaded share", loaded_share, 0.05, 1.0)
    require_all_positive("stiffness", stiffness, "N/m")
    require_all_within("slack", slack, 0.0, 0.5)
    along = (find_sine(inclination), find_cosine(inclination))
    across = resultant[0] * along[1] - resultant[1] * along[0]
    require_all_positive("load across the net", across, "N/m")
    head_share = 0.5 * loaded_share
    tension = _find_chord_tension(across, loaded_share, stiffness, slack)
    return NetPull(
        foot=_combine(resultant, 1.0 - head_share, along, tension),
        head=_combine(resultant, head_share, along, -tension),
        chord_tension=tension,
    )


def _find_chord_tension(
    across: Number, loaded: Number, stiffness: Number, slack: Number
) -> Number:
    """Root of (G8): the length that the sag needs is slack and stretch.

    Times T^2 it is s T^2 + (1 + s) T^3 / ES = C, which rises and is convex: Newton's
    method falls onto the root from where one of the two parts alone is C.
    """
    head, foot = 0.5 * loaded, 1.0 - 0.5 * loaded
    # mean square of the shear force over the chord, in units of the load
    square = loaded * (foot**2 - foot * head + head**2) / 3.0 + (1 - loaded) * head**2
    needed = 0.5 * square * across**2
    stretch = (1.0 + slack) / stiffness
    tension = 1.0 / take_larger(
        find_root(slack / needed), find_cube_root(stretch / needed)
    )
    for _ in range(_ROUNDS):
        excess = tension**2 * (slack + stretch * tension) - needed
        slope = tension * (2.0 * slack + 3.0 * stretch * tension)
        tension = tension - excess / slope
    return tension


def _combine(
    load: tuple[Number, Number],
    share: Number,
    along: tuple[Number, Number],
    tension: Number,
) -> tuple[Number, Number]:
    return (load[0] * share + tension * along[0], load[1] * share + tension * along[1])
