"""Bounds of cases that may take over once something is moved, before they are solved.

Cases of one row grow alike when a quantity of all of them is moved, and the more so
when they differ in friction alone. By how much they do not was measured on 177 searches
of 67 rows; each bound has about twice that, or more: assumed.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from netdesign.envelope.ranges import Case
from netdesign.study.target import Move, Target

# Growth of a case's utilisation beyond that of another one, in logarithms: for each of
# the moved quantity, of any case and of one that differs in friction alone. At most
# 0.57 and 0.2 of thickness were seen (1,023 and 664 pairs), 0.09 and 0.04 of density.
_DRIFTS = {"thickness": (1.0, 0.35), "density": (0.3, 0.3)}
_STILL = 0.01  # for no way at all
# Utilisation of a case between two others of less and of more friction, over the larger
# one of these: at most 1.0007 in 520 cases.
_BETWEEN = 1.002


def bound_rival(
    target: Target, case: Case, move: Move, used: Mapping[Case, float]
) -> float:
    """Utilisation of a case that a move leaves it below [-]; infinite if not known.

    Parameters
    ----------
    target : Target
        The check.
    case : Case
        Solved as things are.
    move : Move
        Thickness or density; of others nothing is known.
    used : mapping of Case to float
        Utilisations so far with what is moved.

    Verified by
    -----------
    tests/study/test_rivals.py
    """
    now = target.find_value(case, move.name)
    if move.name not in _DRIFTS or not now:
        return math.inf
    way = abs(math.log(move.value / now))
    bounds = [math.inf]
    for other, found in used.items():
        if target.find_value(other, move.name) == now:
            drift = _DRIFTS[move.name][differ_in_friction_alone(case, other)]
            grown = math.exp(drift * way + _STILL)
            bounds.append(found * grown * _compare(target, case, other))
    return min(*bounds, _bound_between(case, used))


def put_outer_first(cases: Sequence[Case]) -> list[Case]:
    """Cases in their order, but first the first one and those at the ends of a line.

    Of each line along friction; they bound what lies between them.
    """
    lines: dict[Case, list[Case]] = {}
    for one in sorted(cases, key=lambda case: case.friction_angle):
        lines.setdefault(_leave_friction(one), []).append(one)
    outer = {one for line in lines.values() for one in (line[0], line[-1])}
    return sorted(cases, key=lambda one: one not in outer and one is not cases[0])


def differ_in_friction_alone(one: Case, other: Case) -> bool:
    """Two cases are equal in all else."""
    return _leave_friction(one) == _leave_friction(other)


def _compare(target: Target, case: Case, other: Case) -> float:
    """Utilisation of a case over that of another one, as things are [-]."""
    own = target.compare(other)
    return target.compare(case) / own if own > 0.0 else math.inf


def _bound_between(case: Case, used: Mapping[Case, float]) -> float:
    """Bound by cases of less and of more friction, else the same."""
    line = {
        one.friction_angle: found
        for one, found in used.items()
        if differ_in_friction_alone(one, case)
    }
    less = [angle for angle in line if angle < case.friction_angle]
    more = [angle for angle in line if angle > case.friction_angle]
    if not less or not more:
        return math.inf
    return _BETWEEN * max(line[max(less)], line[min(more)])


def _leave_friction(case: Case) -> Case:
    return replace(case, friction_angle=0.0)
