"""Type approval of a net: the document that proves its structure within its limits."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class StatedValue:
    """A number of an approval or of its maker, with its cell; SI."""

    value: float
    cell: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Approval:
    """Limits of a type approval, and what the maker states beside them.

    A limit that it does not state is None: it proves nothing then. So is a force.

    Attributes
    ----------
    document, cell : str
        What approves the net, and where that stands; "" where only the maker's forces
        are given.
    height : StatedValue or None
        Largest D_K, normal to the slope [m].
    glide_factor : StatedValue or None
        Largest N [-].
    altitude_factor : StatedValue or None
        Largest f_c [-].
    spacing : StatedValue or None
        Largest distance of the posts [m].
    foot_force, uphill_force, downhill_force : StatedValue or None
        Characteristic force on the anchor, as the maker states it [N].
    """

    document: str = ""
    cell: str = ""
    height: StatedValue | None = None
    glide_factor: StatedValue | None = None
    altitude_factor: StatedValue | None = None
    spacing: StatedValue | None = None
    foot_force: StatedValue | None = None
    uphill_force: StatedValue | None = None
    downhill_force: StatedValue | None = None
