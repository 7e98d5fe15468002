"""Remedies: resistance, type and post spacing with which a check passes.

Each is in exact proportion to the force; no case is solved for it.
"""

from __future__ import annotations

import math
from dataclasses import replace

from netdesign.checks import OpenKind
from netdesign.checks.check import Change
from netdesign.structure.row_position import LoadedWidth
from netdesign.study.judgement import MemberCheck
from netdesign.study.row_to_check import Basis
from netdesign.study.stronger_types import find_type_change
from netdesign.words.message import Message, say

CLOSE = 0.9  # utilisation from which a passing check gets its limits


def list_remedies(basis: Basis, one: MemberCheck) -> list[Change]:
    """Changes that flip a failing, unproven or close check."""
    is_of_ground = one.given.mode in ("sliding", "wedge") and one.given.dimensions
    is_of_head = one.given.mode == "direction"  # of which E_d sin δ is told
    if is_of_ground or is_of_head or not _is_worth_telling(basis, one):
        return []  # sliding goes with what presses the base; a ground is as it is
    changes = _list_resistance_remedies(basis, one)
    _, used = one.check.utilisation_band
    if used is None:
        return _annotate(one, changes)
    # ropes' forces are in no proportion to the spacing, and the maker's is as it is
    if not basis.row.panels and one.check.governs != "maker":
        spacing = basis.row.layout.post_spacing
        changes.append(find_spacing_remedy(spacing, one.width, used))
    return _annotate(one, changes)


def _annotate(one: MemberCheck, changes: list[Change]) -> list[Change]:
    """Changes with a note where they alone do not do.

    Another type has the condition of its own resistance.
    """
    if one.check.has_open(OpenKind.UNSOLVED):
        note = say("change.as_far_as_solved")
        return [replace(change, note=note) for change in changes]
    if one.check.has_open(OpenKind.RESISTANCE_IN_DOUBT):
        note = say("change.if_rest_proven")
        return [x if x.sense == "has" else replace(x, note=note) for x in changes]
    return changes


def _is_worth_telling(basis: Basis, one: MemberCheck) -> bool:
    """It has a force, and does not pass with much to spare."""
    demand, used = (one.check.read_band(symbol)[1] for symbol in ("E_d", "μ"))
    if not demand or basis.row.is_overtopped:
        return False
    return used is None or used >= CLOSE


def _list_resistance_remedies(basis: Basis, one: MemberCheck) -> list[Change]:
    """Characteristic resistance that is needed, and the type that has it."""
    standard, check = basis.standard, one.check
    demand, factor = check.read_band("E_d")[1], check.read("γ_R")
    note: Message | None = None
    if factor is None:  # nothing is given, and so no basis: suppose a test
        found = standard.find_resistance_factor(one.given.mode, "tested")
        factor = found.value_si if found else None
        note = say("change.on_basis_of_tests")
    if factor is None or demand is None:
        return []
    change = Change(
        quantity=say("change.characteristic_resistance"),
        unit="kN",
        now=check.read("R_k"),
        bound=math.ceil(demand * factor * 10.0 - 1e-9) / 10.0,
        sense="at least",
        note=note,
    )
    if one.force is not None and one.force.on.shared is not None:
        return [change]  # another rope has another stiffness, and so another force
    kind = find_type_change(basis, one.given, demand, one.pull)
    return [change, kind] if kind else [change]


def find_spacing_remedy(
    post_spacing: float, width: LoadedWidth, utilisation: float
) -> Change:
    """Largest post spacing at which a check passes: every force is in proportion."""
    is_edge = width.position == "edge"
    part = 0.5 if is_edge else 1.0
    left = width.width / utilisation
    if is_edge:
        left -= width.end_factor * width.end_length
    # the part of an end effect that begins at another support falls with the spacing
    reached = width.end_factor * width.share * post_spacing**2
    root = left**2 - 4.0 * part * reached
    widest = (left + math.sqrt(root)) / (2.0 * part) if left > 0.0 <= root else 0.0
    bound = math.floor(100.0 * widest + 1e-9) / 100.0
    return Change(
        quantity=say("change.post_spacing"),
        unit="m",
        now=post_spacing,
        bound=bound if bound > 0.0 else None,
        sense="at most",
        note=None if bound > 0.0 else say("change.end_effect_too_much"),
    )
