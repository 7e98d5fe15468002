"""Place of a support in its row: end effect and load across the section."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from netdesign.guards import require_positive, require_within

Position = Literal["intermediate", "edge"]


@dataclass(frozen=True, slots=True, kw_only=True)
class EndEffectRule:
    """Numbers of a guideline's end effect; all pure but ``isolated_gap`` [m].

    Attributes
    ----------
    constant, per_glide : float
        f_R = (constant + per_glide N) A / 2 [1/m].
    cap_constant, cap_per_glide : float
        f_R is at most cap_constant + cap_per_glide N [-].
    length : float
        The effect acts over length A / 2 [-].
    length_cap : float
        That length is at most this share of the net height [-].
    isolated_gap : float
        From this gap on the row's end counts as free: both caps hold [m].
    """

    constant: float
    per_glide: float
    cap_constant: float
    cap_per_glide: float
    length: float
    length_cap: float
    isolated_gap: float


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadedWidth:
    """Width of net that loads one support.

    Attributes
    ----------
    position : str
        "intermediate" or "edge".
    width : float
        Width under plain load that gives the same force [m].
    end_factor : float
        f_R; 0 for an intermediate support [-].
    end_length : float
        Length over which the end effect acts [m].
    """

    position: Position
    width: float
    end_factor: float = 0.0
    end_length: float = 0.0


def compute_edge_width(
    rule: EndEffectRule,
    *,
    post_spacing: float,
    net_height: float,
    gap: float,
    glide_factor: float,
) -> LoadedWidth:
    """Loaded width of the first or last support of a row.

    Half a bay, and the end effect as the width under plain load that brings the
    same force. Theory: structure/THEORY.md, eqs. (S9) and (S10).

    Parameters
    ----------
    rule : EndEffectRule
        Numbers of the guideline.
    post_spacing : float
        b [m].
    net_height : float
        D_K, normal to the slope [m].
    gap : float
        A, free distance to the next work in the row [m]; infinite for none.
    glide_factor : float
        N, at least 1 [-].

    Returns
    -------
    LoadedWidth
        Of the edge support [m].

    Raises
    ------
    ModelError
        If a number is out of its range.

    Verified by
    -----------
    checks/test_hand_calculations.py
    """
    require_positive("post spacing", post_spacing, "m")
    require_positive("net height", net_height, "m")
    require_within("glide factor", glide_factor, 1.0, 20.0)
    cap = rule.cap_constant + rule.cap_per_glide * glide_factor
    longest = rule.length_cap * net_height
    if gap >= rule.isolated_gap:  # also an infinite one
        factor, length = cap, longest
    else:
        require_within("gap to the next work", gap, 0.0, rule.isolated_gap, "m")
        slope = rule.constant + rule.per_glide * glide_factor
        factor = min(slope * gap / 2.0, cap)
        length = min(rule.length * gap / 2.0, longest)
    return LoadedWidth(
        position="edge",
        width=0.5 * post_spacing + factor * length,
        end_factor=factor,
        end_length=length,
    )


def find_governing_width(post_spacing: float, edge: LoadedWidth | None) -> LoadedWidth:
    """Larger of a whole bay and the edge's loaded width.

    Parameters
    ----------
    post_spacing : float
        b [m].
    edge : LoadedWidth or None
        Of the row's first or last support.
    """
    whole = LoadedWidth(position="intermediate", width=post_spacing)
    return edge if edge is not None and edge.width > whole.width else whole


def compute_lateral_factor(share: float) -> float:
    """Size of a force with its sideways part, over its size in the section.

    Parameters
    ----------
    share : float
        Of the force, that acts along the row, 0 to 1 [-].

    Returns
    -------
    float
        (S11), an upper bound [-].

    Raises
    ------
    ModelError
        If the share is out of its range.
    """
    require_within("lateral share", share, 0.0, 1.0)
    return math.hypot(1.0, share)
