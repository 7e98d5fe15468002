"""Pull-out of a grouted anchor: from tests, or from the bond of grout and ground."""

from __future__ import annotations

import math
from dataclasses import dataclass

from netdesign.outcome import require_count, require_positive, require_within
from netdesign.resistance.catalogue import find_steel_bond


@dataclass(frozen=True, slots=True, kw_only=True)
class SingleTest:
    """One anchor that was pulled.

    Attributes
    ----------
    load : float
        Largest load that it held [N]; a lower bound of its resistance where the test
        stopped before it gave way.
    is_held : bool or None
        It held that load to the end; False: it was pulled out; None: not said.
    proof_load : float or None
        Load that the test was to reach [N]; None where none is given.
    displacement : float or None
        Of its head at the largest load [m]; None where none is given.
    source : str
        Cell of the load.
    """

    load: float
    is_held: bool | None = None
    proof_load: float | None = None
    displacement: float | None = None
    source: str = ""

    def __post_init__(self) -> None:
        """Refuse a load that is none."""
        require_positive("load of a test", self.load, "N")


@dataclass(frozen=True, slots=True, kw_only=True)
class PullOutTests:
    """Pull-out tests on the site.

    Attributes
    ----------
    count : int
        Number of tests.
    least, mean : float
        Least and mean of the tested resistances [N].
    singles : tuple of SingleTest
        Each test; empty where only number, least and mean are given.
    """

    count: int
    least: float
    mean: float
    singles: tuple[SingleTest, ...] = ()

    def __post_init__(self) -> None:
        """Refuse what no series of tests can give."""
        require_count("number of tests", self.count)
        require_positive("least tested resistance", self.least, "N")
        require_within("least tested resistance", self.least, 0.0, self.mean, "N")


_LOOSE = 1.0  # of the ground at the mouth of a bore: frost, loose ground [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class Bond:
    """Bonded length of an anchor, whose pull-out resistance is worked out.

    Attributes
    ----------
    length, free : float
        Bonded, and without a bond between it and the mouth of the bore [m].
    steel : float or None
        Least diameter that its bar may have [m]; None of a rope, which tests prove.
    """

    length: float
    free: float
    steel: float | None

    def find_counted(self, longest: float) -> float:
        """Length that counts [m]; resistance/THEORY.md, eq. (R33).

        Parameters
        ----------
        longest : float
            l_max of the profile [m].
        """
        lost = max(_LOOSE - self.free, 0.0)
        return min(max(self.length - lost, 0.0), longest)


def compute_steel_bond(diameter: float, length: float) -> float:
    """Design resistance of a ribbed bar in its grout [N]; eq. (R34).

    Parameters
    ----------
    diameter, length : float
        Of the bar, and of the bond that counts [m].
    """
    return math.pi * diameter * length * find_steel_bond().value * 1e6


def limit_proof_load(proof: float, ultimate: float) -> float:
    """Largest load of a test that its tendon allows; resistance/THEORY.md, (R32).

    Parameters
    ----------
    proof, ultimate : float
        Characteristic 0.1 % proof force and tensile strength of the tendon,
        P_t0.1k and P_tk [N]; the first where the second is not known.

    Returns
    -------
    float
        min(0.95 P_t0.1k, 0.80 P_tk) [N].
    """
    return min(0.95 * proof, 0.80 * ultimate)


def compute_pull_out_from_bond(
    *,
    drill_diameter: float,
    bond_length: float,
    bond_stress: float,
    enlargement: float = 1.0,
) -> float:
    """Pull-out resistance of a grouted length; resistance/THEORY.md, eq. (R2).

    Parameters
    ----------
    drill_diameter, bond_length : float
        Of the hole, and along it [m].
    bond_stress : float
        Ultimate, between grout and ground [Pa].
    enlargement : float
        Grouted over drilled diameter [-]; 1 for grout under gravity.

    Returns
    -------
    float
        pi d L tau [N]; ultimate: correlation and partial factors come on top.

    Raises
    ------
    ModelError
        If a number is out of its range.
    """
    require_within("drill diameter", drill_diameter, 0.02, 0.5, "m")
    require_within("bond length", bond_length, 0.5, 30.0, "m")
    require_positive("bond stress", bond_stress, "Pa")
    require_within("enlargement", enlargement, 1.0, 2.0)
    return math.pi * drill_diameter * enlargement * bond_length * bond_stress
