"""Panels as they are built, for a row whose own is not given in full.

The worst of a few panels counts, at the ends of what is built. Which of them is the
worst for which member: panel/THEORY.md, section 6.
"""

from __future__ import annotations

from netdesign.panel.inputs import Cut, Panel, Rope

SAGS = (0.03, 0.10)  # of ropes as built, over the span
STIFFNESSES = (3e6, 150e6)  # EA of border ropes [N]
# EA over the breaking force: ropes of strands, then spiral ropes of round wires.
OF_BREAKING = (25.0, 160.0)

Ends = tuple[float, float]  # least and largest value; equal where it is given

# Cut; which end of the sag of ridge rope and lower rope, of their EA; mid-anchors.
_WORST: tuple[tuple[Cut, int, int, int, int, bool], ...] = (
    # for the uphill guy
    ("uniform", 0, 1, 0, 0, False),
    ("uniform", 0, 1, 1, 0, False),
    ("uniform", 0, 1, 1, 1, False),
    ("uniform", 1, 1, 0, 0, False),
    ("uniform", 1, 1, 1, 0, False),
    ("upper", 0, 0, 1, 0, False),
    ("upper", 0, 1, 1, 0, False),
    ("upper", 0, 1, 1, 1, False),
    ("fitted", 0, 0, 1, 0, False),
    ("fitted", 0, 1, 1, 0, False),
    # for lower rope and ridge rope along the row
    ("fitted", 1, 0, 1, 1, False),
    ("fitted", 0, 1, 1, 1, False),
    ("fitted", 0, 1, 1, 1, True),
    # for foot anchor, post and downhill guy
    ("fitted", 1, 1, 1, 1, False),
    ("fitted", 1, 1, 1, 1, True),
)


def find_stiffness(stiffness: float | None, breaking: float | None) -> Ends:
    """Least and largest EA of a border rope [N].

    Parameters
    ----------
    stiffness, breaking : float or None
        EA and breaking force of its type [N]; None where not given.
    """
    if stiffness is not None:
        return stiffness, stiffness
    if breaking is None:
        return STIFFNESSES
    least, largest = STIFFNESSES
    low, high = (min(max(share * breaking, least), largest) for share in OF_BREAKING)
    return low, high


def list_panels(
    post_spacing: float,
    *,
    cut: Cut | None,
    sags: tuple[float | None, float | None],
    stiffnesses: tuple[Ends, Ends],
    has_mid_anchors: bool | None,
) -> tuple[Panel, ...]:
    """Panels of which the worst counts; one where everything is given.

    Parameters
    ----------
    post_spacing : float
        a [m].
    cut : str or None
        Of the net; None where it is not given.
    sags : tuple of float or None, shape (2,)
        Of ridge rope and lower rope, as built, over the span [-].
    stiffnesses : tuple of tuple of float, shape (2, 2)
        Least and largest EA of ridge rope and lower rope [N].
    has_mid_anchors : bool or None
        Of the lower rope. Not given beside anything that is given, both count.
    """
    is_all_assumed = cut is None and sags == (None, None)
    of_sags = [(one, one) if one is not None else SAGS for one in sags]
    found = {
        Panel(
            post_spacing=post_spacing,
            upper=Rope(stiffness=stiffnesses[0][stiff], sag=of_sags[0][ridge]),
            lower=Rope(stiffness=stiffnesses[1][soft], sag=of_sags[1][lower]),
            cut=cut or worst,
            has_mid_anchors=mid,
        ): None
        for worst, ridge, lower, stiff, soft, own in _WORST
        for mid in _list_mids(own, has_mid_anchors, is_all_assumed=is_all_assumed)
    }
    return tuple(found)


def _list_mids(
    own: bool, given: bool | None, *, is_all_assumed: bool
) -> tuple[bool, ...]:
    if given is not None:
        return (given,)
    return (own,) if is_all_assumed else (False, True)
