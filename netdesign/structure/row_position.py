"""Place of a support in its row: end effect, load across, distance of anchors."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.outcome import require_positive, require_within
from netdesign.structure.members import EndMember, Member
from netdesign.structure.splay import Place

Position = Literal["intermediate", "second", "edge"]

# A gap that lies this close to a threshold, as a share of it, counts as either side.
NEAR_THRESHOLD = 0.1


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
        "intermediate", "second" (beside an end) or "edge".
    width : float
        Width under plain load that gives the same force [m].
    end_factor : float
        f_R; 0 for an intermediate support [-].
    end_length : float
        Length over which the end effect acts [m].
    share : float
        Part of a bay by which end effects load it that begin at another support, over
        f_R [-].
    beside : float
        The same of the next support, away from the end, of one at or beside it [-].
    other_width : float or None
        Width on the other side of a threshold that the gap lies close to; at most
        ``width``. None away from a threshold [m].
    """

    position: Position
    width: float
    end_factor: float = 0.0
    end_length: float = 0.0
    share: float = 0.0
    beside: float = 0.0
    other_width: float | None = None


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
    same force. Close to the gap from which on the end counts as free, both sides are
    worked out and the wider one is taken. Theory: structure/THEORY.md, eqs. (S9) and
    (S10).

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
    if gap != math.inf:
        require_within("gap to the next work", gap, 0.0, math.inf, "m")
    gaps = [gap] if gap <= rule.isolated_gap * (1.0 + NEAR_THRESHOLD) else []
    if gap >= rule.isolated_gap * (1.0 - NEAR_THRESHOLD):
        gaps.append(math.inf)  # the end counts as free
    effects = [_find_end_effect(rule, net_height, each, glide_factor) for each in gaps]
    widths = [0.5 * post_spacing + factor * length for factor, length in effects]
    width, (factor, length) = max(zip(widths, effects, strict=True))
    return LoadedWidth(
        position="edge",
        width=width,
        end_factor=factor,
        end_length=length,
        other_width=min(widths) if len(widths) > 1 else None,
    )


def _find_end_effect(
    rule: EndEffectRule, net_height: float, gap: float, glide_factor: float
) -> tuple[float, float]:
    """f_R and its length beside a gap, which may be infinite [-], [m]."""
    cap = rule.cap_constant + rule.cap_per_glide * glide_factor
    slope = rule.constant + rule.per_glide * glide_factor
    longest = rule.length_cap * net_height
    return min(slope * gap / 2.0, cap), min(rule.length * gap / 2.0, longest)


def share_end_effect(reach: float, support: int) -> float:
    """Part s_j of a bay by which an end effect loads a support, over f_R [-].

    Each strip of net hangs between its two posts, by the lever rule. Theory:
    structure/THEORY.md, eq. (S10a).

    Parameters
    ----------
    reach : float
        l_R / b, length of the end effect over the post spacing [-].
    support : int
        0 is the one at the end, 1 the next one, and so on.

    Verified by
    -----------
    tests/verification/test_second_support.py
    """
    begins = reach - (support - 1)
    if support == 0 or begins > 1.0:
        beyond = min(max(begins - 1.0, 0.0), 1.0)
        return (0.5 if support else 0.0) + beyond - beyond**2 / 2.0
    return max(begins, 0.0) ** 2 / 2.0


def list_supports(
    post_spacing: float, edge: LoadedWidth | None, post_count: int | None = None
) -> tuple[LoadedWidth, ...]:
    """Supports of a row that differ in their load: inside, beside the end, at the end.

    Both ends have the same effect, and one of them may reach the other's supports. Of a
    number of posts that is not given the worst of two, three and four counts.

    Parameters
    ----------
    post_spacing : float
        b [m].
    edge : LoadedWidth or None
        Of the row's first or last support; None where the row has no end.
    post_count : int or None
        Posts of the row, at least 2; None where their number is not given.
    """
    inside = LoadedWidth(position="intermediate", width=post_spacing)
    if edge is None:
        return (inside,)
    reach = edge.end_length / post_spacing
    last = (post_count or 2) - 1
    other, bay = share_end_effect(reach, last), edge.end_factor * post_spacing
    beside = 0.0
    if last > 1 or post_count is None:
        beside = share_end_effect(reach, 1)
        beside += share_end_effect(reach, max(last, 2) - 1)
    wide = replace(
        edge,
        width=edge.width + bay * other,
        share=other,
        beside=beside,
        other_width=edge.other_width and edge.other_width + bay * other,
    )
    if not beside:
        return inside, wide
    third = beside  # in a row of four the next one stands beside an end, too
    if post_count is not None and post_count != 4:
        third = sum(share_end_effect(reach, post) for post in (2, last - 2) if post > 1)
    second = replace(
        edge,
        position="second",
        width=post_spacing + bay * beside,
        share=beside,
        beside=third,
        other_width=None,
    )
    return inside, second, wide


_LONG = 60.0  # of an anchor whose length is not given [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class Bore:
    """Drilled anchor: where it starts, which way it goes, and how far.

    Attributes
    ----------
    start : tuple of float, shape (3,)
        On the ground, (x, y, z): downslope, normal to the slope, along the row [m].
    direction : tuple of float, shape (3,)
        Into the ground, of length 1 [-].
    length : float or None
        Drilled [m]; None where it is not given: then it goes on.
    """

    start: Place
    direction: Place
    length: float | None


def measure_distances(first: Sequence[Bore], second: Sequence[Bore]) -> Floats:
    """Least distances of anchors, each a straight line of its length [m].

    Of a pair it lies between two points inside both, or at an end of one of them.
    Theory: structure/THEORY.md, eq. (S21).

    Returns
    -------
    ndarray, shape (n, m)
        Of each of the ``n`` first anchors from each of the ``m`` second ones.

    Verified by
    -----------
    tests/verification/test_anchor_distance.py
    """
    (start, way, length), (other, turned, reach) = map(_stack, (first, second))
    apart, length = start[:, None] - other, length[:, None]
    cosine = way @ turned.T
    along = np.einsum("ijk,ik->ij", apart, way)
    beside = np.einsum("ijk,jk->ij", apart, turned)
    sine = 1.0 - cosine**2
    is_skew = sine > 1e-12
    inside = (cosine * beside - along) / np.where(is_skew, sine, np.inf)
    least = np.full(cosine.shape, np.inf)
    for on_first, on_second in (
        (inside, beside + inside * cosine),
        (0.0, beside),
        (length, beside + length * cosine),
        (-along, 0.0),
        (reach * cosine - along, reach),
    ):
        s = np.clip(on_first, 0.0, length)[..., None]
        t = np.clip(on_second, 0.0, reach)[..., None]
        gap = apart + s * way[:, None] - t * turned
        least = np.minimum(least, np.linalg.norm(gap, axis=-1))
    return least


def _stack(bores: Sequence[Bore]) -> tuple[Floats, Floats, Floats]:
    """Starts and directions, shape (n, 3), and lengths of anchors [m]."""
    starts = np.array([bore.start for bore in bores])
    directions = np.array([bore.direction for bore in bores])
    lengths = [_LONG if bore.length is None else bore.length for bore in bores]
    return starts, directions, np.array(lengths)


def measure_in_row(bores: Sequence[Bore]) -> Floats:
    """Least distances of the anchors of a row, shape (n, n); infinite of itself [m]."""
    apart = measure_distances(bores, bores)
    np.fill_diagonal(apart, np.inf)
    return apart


def measure_to_row_above(bores: Sequence[Bore], upslope: float) -> Floats:
    """Least distances to the anchors of a row above that is built alike [m].

    Nobody knows how the two rows stand along each other: seen along the row, where
    distances are least. Theory: structure/THEORY.md, eq. (S21).

    Parameters
    ----------
    bores : sequence of Bore
        Anchors of the row; the row above has them as well.
    upslope : float
        Distance of the row above, along the slope [m].

    Returns
    -------
    ndarray, shape (n, n)
        Of each anchor of the row from each one of the row above.

    Verified by
    -----------
    tests/verification/test_anchor_distance.py
    """
    here = list(map(_flatten, bores))
    above = [
        replace(bore, start=(bore.start[0] - upslope, *bore.start[1:])) for bore in here
    ]
    return measure_distances(here, above)


def find_nearest(distances: Floats) -> tuple[int, int]:
    """Places of the two anchors that are nearest; a millionth [m] is rounding.

    Of equal distances the first counts.
    """
    first, second = np.unravel_index(distances.round(6).argmin(), distances.shape)
    return int(first), int(second)


def _flatten(bore: Bore) -> Bore:
    """Anchor as it is seen along the row."""
    (x, y, _), (along, out, _) = bore.start, bore.direction
    seen = math.hypot(along, out)
    direction = (along / seen, out / seen, 0.0) if seen else (0.0, -1.0, 0.0)
    length = None if bore.length is None else bore.length * seen
    return Bore(start=(x, y, 0.0), direction=direction, length=length)


def find_dip(axis: float, slope: float, anchor: str) -> float:
    """Dip of an anchor below the horizontal; structure/THEORY.md, eq. (S14a).

    Parameters
    ----------
    axis : float
        As `measure_pull` counts it; of a lateral anchor from the row's line [rad].
    slope : float
        Slope angle [rad].
    anchor : str
        Which anchor it is.

    Returns
    -------
    float
        Negative of a borehole that rises from its mouth [rad].

    Verified by
    -----------
    tests/verification/test_anchor_dip.py
    """
    if anchor == EndMember.LATERAL_ANCHOR:
        return math.asin(math.sin(axis) * math.cos(slope))
    if anchor != Member.DOWNHILL_ANCHOR:
        return axis - slope
    dip = axis + slope
    return min(dip, math.pi - dip)  # one beyond the vertical leans upslope


def find_axis_at_dip(dip: float, slope: float, anchor: str) -> float:
    """Axis of a bore with a dip below the horizontal, as `find_dip` has it [rad].

    The flattest axis of a lateral anchor on a slope too steep for any: straight down.

    Parameters
    ----------
    dip : float
        Below the horizontal [rad].
    slope, anchor : float, str
        As there.

    Verified by
    -----------
    tests/verification/test_anchor_dip.py
    """
    if anchor == EndMember.LATERAL_ANCHOR:
        return math.asin(min(1.0, math.sin(dip) / math.cos(slope)))
    return dip - slope if anchor == Member.DOWNHILL_ANCHOR else dip + slope


def measure_fall(way: Place, slope: float) -> float:
    """Sine of the dip of a bore below the horizontal; structure/THEORY.md, (S14c).

    Parameters
    ----------
    way : tuple of float, shape (3,)
        Into the ground, of length 1: downslope, normal to the slope, along the row.
    slope : float
        Slope angle [rad].
    """
    return way[0] * math.sin(slope) - way[1] * math.cos(slope)


def measure_angle(first: Place, second: Place) -> float:
    """Angle between two directions of length 1 [rad]."""
    return 2.0 * math.asin(min(1.0, 0.5 * math.dist(first, second)))


def turn_down(way: Place, slope: float, dip: float) -> Place:
    """Way into the ground, turned down where its bore is too flat.

    Theory: structure/THEORY.md, eq. (S14c).

    Parameters
    ----------
    way : tuple of float, shape (3,)
        As `measure_fall` has it.
    slope : float
        Slope angle [rad].
    dip : float
        That the bore has at least [rad].

    Returns
    -------
    tuple of float, shape (3,)
        Of length 1.

    Verified by
    -----------
    tests/verification/test_anchor_dip.py
    """
    fall = measure_fall(way, slope)
    if fall >= math.sin(dip):
        return way
    down = (math.sin(slope), -math.cos(slope), 0.0)
    level = _shorten([a - fall * b for a, b in zip(way, down, strict=True)])
    flat, steep = math.cos(dip), math.sin(dip)
    return _shorten([flat * a + steep * b for a, b in zip(level, down, strict=True)])


def _shorten(way: Sequence[float]) -> Place:
    """Unit vector along ``way``."""
    length = math.hypot(*way)
    x, y, z = (part / length for part in way)
    return x, y, z
