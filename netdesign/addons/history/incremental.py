"""The source paper's own cable: linearised increments of tension.

Kept as the record of the paper's method and to compare with; ``yielding`` has the exact
form. The paper leaves open how to find the nodes that slide. Here every node that
breaks its condition changes over; where that no longer helps, wrong sliders stop
first, then the worst offender starts. Theory: cable/THEORY.md, eqs (C18) to (C20).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from netdesign.addons.history.net_pulls import compute_tensions
from netdesign.numerics.arrays import Floats, Signs
from netdesign.outcome import Outcome, SolveError
from netdesign.words.message import say

Nodes = NDArray[np.intp]

_PATIENCE = 3  # rounds without fewer broken conditions before fewer nodes change
_ROUNDING = 1e-12  # breach of a condition, over its terms, that counts as none


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CableState:
    """The cable at one time.

    Attributes
    ----------
    final_lengths, unstressed_lengths : ndarray, shape (n + 1,)
        l_i and lo_i [m].
    tensions : ndarray, shape (n + 1,)
        T_i, the sum of the increments so far [N/m].
    """

    final_lengths: Floats
    unstressed_lengths: Floats
    tensions: Floats


def build_cable_state(
    final_lengths: Floats, unstressed_lengths: Floats, stiffness: float
) -> CableState:
    """State whose tensions are those of (C10): where a run of increments begins.

    Parameters
    ----------
    final_lengths, unstressed_lengths : ndarray, shape (n + 1,)
        l_i and lo_i [m].
    stiffness : float
        ES [N/m].

    Returns
    -------
    CableState
        With tensions in N/m.
    """
    return CableState(
        final_lengths=final_lengths,
        unstressed_lengths=unstressed_lengths,
        tensions=compute_tensions(final_lengths, unstressed_lengths, stiffness),
    )


def advance_increment(
    state: CableState,
    final_lengths: Floats,
    turning_angles: Floats,
    *,
    friction: float,
    stiffness: float,
    max_rounds: int = 1000,
) -> CableState:
    """One increment of the paper's cable, its Eqs 5 to 14.

    Parameters
    ----------
    state : CableState
        At time t.
    final_lengths : ndarray, shape (n + 1,)
        l_i at t + tau [m].
    turning_angles : ndarray, shape (n,)
        beta_i at t + tau, positive where the net presses [rad].
    friction : float
        Tan phi [-].
    stiffness : float
        ES [N/m].
    max_rounds : int
        Sets of sliding nodes that may be tried. A sliding stretch grows by about one
        node a round.

    Returns
    -------
    CableState
        At t + tau; exact sliding to first order in the increment.

    Raises
    ------
    SolveError
        If the sliding nodes are not found, or a segment would push: the increments have
        no rule for a slack net.

    Source
    ------
    The paper's section "The cable"; |R_t| for R_t in its Eqs 12 and 13.
    """
    increment = _linearise(state, final_lengths, turning_angles, friction, stiffness)
    signs = np.zeros(turning_angles.size, dtype=np.int8)
    fewest, patience = signs.size + 1, _PATIENCE
    for _ in range(max_rounds):
        tensions = _solve_tensions(increment, signs)
        revised = _revise_signs(increment, tensions, signs)
        changing: Nodes = np.flatnonzero(revised != signs)
        if changing.size == 0:
            return _end(increment, tensions)
        helps = changing.size < fewest
        patience = _PATIENCE if helps else patience - 1
        fewest = min(fewest, changing.size)
        if patience <= 0:
            changing = _choose_worst(_excess(increment, tensions), signs, changing)
        signs = signs.copy()
        signs[changing] = revised[changing]
    raise SolveError(Outcome.MAX_ITERATIONS, say("staggered.no_increment"))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Increment:
    """Coefficients of the linear equations of one increment."""

    final: Floats  # l_i at t + tau
    unstressed: Floats  # lo_i at t
    stuck: Floats  # tensions if nothing slides
    softening: Floats  # loss of tension per increase of lo
    across: Floats  # cos(beta / 2): R_t per difference of tensions
    grip: Floats  # tan(phi) sin(beta / 2): friction per sum of tensions


def _linearise(
    state: CableState,
    final: Floats,
    angles: Floats,
    friction: float,
    stiffness: float,
) -> _Increment:
    """Coefficients of (C18) and (C19)."""
    unstressed = state.unstressed_lengths
    lengthening = final - state.final_lengths
    return _Increment(
        final=final,
        unstressed=unstressed,
        stuck=state.tensions + stiffness / unstressed * lengthening,
        softening=stiffness * final / unstressed**2,
        across=np.cos(angles / 2.0),
        grip=friction * np.sin(np.maximum(angles, 0.0) / 2.0),
    )


def _solve_tensions(increment: _Increment, signs: Signs) -> Floats:
    """Tensions at t + tau, block by block between nodes that do not slide.

    In a block (C19) gives every tension as a multiple of the first, and (C20) that.
    """
    tensions = np.empty_like(increment.stuck)
    edges = np.flatnonzero(signs == 0) + 1
    ratios = _sliding_ratios(increment, signs)
    for block in np.split(np.arange(tensions.size), edges):
        multiples = np.cumprod(np.concatenate([[1.0], ratios[block[:-1]]]))
        softening = increment.softening[block]
        first = (increment.stuck[block] / softening).sum()
        tensions[block] = multiples * first / (multiples / softening).sum()
    return tensions


def _sliding_ratios(increment: _Increment, signs: Signs) -> Floats:
    """T_i / T_{i-1} of nodes that slide, (C19); 1 at the others, which do not ask."""
    grip = signs * increment.grip
    return (increment.across - grip) / (increment.across + grip)


def _revise_signs(increment: _Increment, tensions: Floats, signs: Signs) -> Signs:
    """Signs of the nodes under these tensions; ``signs`` where nothing changes."""
    lower, upper = tensions[:-1], tensions[1:]
    margin = _ROUNDING * increment.across * (np.abs(upper) + np.abs(lower))
    starts = (signs == 0) & (_excess(increment, tensions) > margin)
    slides = np.cumsum(_lengthening(increment, tensions))[:-1]
    stops = signs * slides < -_ROUNDING * increment.unstressed.sum()
    towards = np.where(upper < lower, 1, -1)
    return np.where(starts, towards, np.where(stops, 0, signs)).astype(np.int8)


def _choose_worst(excess: Floats, signs: Signs, broken: Nodes) -> Nodes:
    """All wrong sliders among the nodes that break a condition, else the worst node."""
    stopping: Nodes = broken[signs[broken] != 0]
    return stopping if stopping.size else broken[[np.argmax(excess[broken])]]


def _excess(increment: _Increment, tensions: Floats) -> Floats:
    """|R_t| - R_n tan(phi) at the nodes, shape (n,)."""
    lower, upper = tensions[:-1], tensions[1:]
    pull = increment.across * np.abs(upper - lower)
    return pull - increment.grip * (upper + lower)


def _lengthening(increment: _Increment, tensions: Floats) -> Floats:
    """Increments of lo that belong to these tensions, (C18), shape (n + 1,)."""
    return (increment.stuck - tensions) / increment.softening


def _end(increment: _Increment, tensions: Floats) -> CableState:
    unstressed = increment.unstressed + _lengthening(increment, tensions)
    if not (tensions.min() >= 0.0 and unstressed.min() > 0.0):
        raise SolveError(Outcome.OUT_OF_VALIDITY, say("staggered.no_increment"))
    return CableState(
        final_lengths=increment.final,
        unstressed_lengths=unstressed,
        tensions=tensions,
    )
