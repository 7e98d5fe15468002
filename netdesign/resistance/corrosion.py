"""Loss of steel in the ground over a design life."""

from __future__ import annotations

from dataclasses import dataclass

from netdesign.outcome import ModelError
from netdesign.resistance.catalogue import Datum, interpolate, load_catalogue, pick
from netdesign.words.message import say

# Protections under which the steel itself corrodes, and is counted with what is left.
BARE = ("none", "sacrificial")


@dataclass(frozen=True, slots=True, kw_only=True)
class Wear:
    """Statements of an anchor type or rope type about its corrosion.

    Attributes
    ----------
    kind : str
        "bar", "micropile", "rope anchor", "rope", or "" where none is given.
    protection : str
        As in sheet Anchors; "" where none is given, and of a rope.
    soil : str
        Class of the ground by its corrosion; "" where none is given.
    protected_years : int or None
        Years for which somebody declares the protection; None where nobody does.
    outer, inner : float or None
        Diameters of bar or tube [m]; None where they are not given.
    """

    kind: str
    protection: str = ""
    soil: str = ""
    protected_years: int | None = None
    outer: float | None = None
    inner: float | None = None

    @property
    def is_bare(self) -> bool:
        """The steel itself corrodes, and there is a thickness to lose."""
        return self.protection in BARE and self.kind in ("bar", "micropile")


def find_loss(soil: str, years: int) -> Datum:
    """Loss of each exposed face, r_e, after some years [mm].

    Linear between the years of the table; resistance/THEORY.md, (R16).

    Raises
    ------
    ModelError
        If the table has no such ground, or ends before.

    Verified by
    -----------
    tests/verification/test_corrosion.py
    """
    table = load_catalogue()["corrosion"]
    losses = pick(say("catalogue.soil"), soil, table["loss_mm"])
    if not 0 <= years <= table["years"][-1]:
        raise ModelError(say("corrosion.beyond", years=years, most=table["years"][-1]))
    loss = interpolate([0, *table["years"]], [0.0, *losses], years)
    source = say("resistance_source.corrosion")
    return Datum(value=loss, status=table["status"], source=source)


def leave_area(outer: float, inner: float, loss: float) -> float:
    """Share of the steel's area that is left, A_eff / A [-]; 0 where none is.

    Parameters
    ----------
    outer, inner : float
        Diameters as built [m]; 0 for the inner one of a bar.
    loss : float
        r_e, of the outer face alone [m].

    Verified by
    -----------
    tests/verification/test_corrosion.py
    """
    left = max(outer - 2.0 * loss, inner)
    return (left**2 - inner**2) / (outer**2 - inner**2)
