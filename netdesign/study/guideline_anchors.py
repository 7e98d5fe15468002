"""Forces of the guideline's load on every anchor of a net row, before any solve.

They follow from an office's own data; what it has no number for ranges. Theory:
guideline/THEORY.md, (G10); the way to each anchor is that of a check.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import ClassVar

from netdesign.checks import Check, Standard
from netdesign.envelope.ranges import Interval
from netdesign.site.model import NetRow, Site
from netdesign.structure.members import END_ANCHORS, Member
from netdesign.structure.row_position import LoadedWidth
from netdesign.structure.splay import weigh_splay
from netdesign.study.anchor_pulls import ANCHORS
from netdesign.study.case_records import HeldSidewaysRecord
from netdesign.study.guideline_load import (
    RowEffects,
    find_effects,
    find_row_floors,
    list_assumed,
    record_floor,
)
from netdesign.study.load_along_row import (
    find_splay,
    place_over,
    weigh_places,
)
from netdesign.study.member_force import RowForces, find_guideline_force
from netdesign.study.row_to_check import list_layouts, list_variants
from netdesign.units import degree_from_radian, kilonewton_from_newton
from netdesign.words.message import Message, say

# Modes in which a check has the whole force of an anchor.
_OF_FORCE = ("pull_out", "tendon")


@dataclass(frozen=True, kw_only=True)
class AnchorForce:
    """Characteristic forces on one anchor of one support.

    Attributes
    ----------
    anchor, position : str
        Of the support: "intermediate", "second" or "edge".
    guideline_kN : float or None
        By the guideline's load [kN]; None where its model knows none.
    coupled_kN : float or None
        Largest of section, panel and truss of a stored study [kN].
    """

    WRITTEN: ClassVar = ("ratio",)

    anchor: str
    position: str
    guideline_kN: float | None
    coupled_kN: float | None = None

    @property
    def ratio(self) -> float | None:
        """Coupled force over that of the guideline [-]."""
        if self.coupled_kN is None or not self.guideline_kN:
            return None
        return self.coupled_kN / self.guideline_kN


@dataclass(frozen=True, kw_only=True)
class RowAnchors:
    """Forces on the anchors of one net row.

    Attributes
    ----------
    id : str
        Of the row.
    anchors : list of AnchorForce
        Of each position those of the support, then those of the row's end.
    reason : Message or None
        Why the guideline's forces are not available.
    notes : list of Message
        What is taken for granted, or not in the forces.
    """

    id: str
    anchors: list[AnchorForce]
    reason: Message | None = None
    notes: list[Message]

    def find(self, anchor: str, *positions: str) -> AnchorForce | None:
        """Anchor with the largest forces at some positions; None without any."""
        matching = [
            force
            for force in self.anchors
            if force.anchor == anchor and force.position in positions
        ]
        if not matching:
            return None
        pairs = ((force.guideline_kN, force.coupled_kN) for force in matching)
        guideline, coupled = (
            max((force for force in forces if force is not None), default=None)
            for forces in zip(*pairs, strict=True)
        )
        return replace(matching[0], guideline_kN=guideline, coupled_kN=coupled)


def list_guideline_forces(site: Site, standard: Standard) -> list[RowAnchors]:
    """Forces on the anchors of every net row by the guideline's load.

    Parameters
    ----------
    site : Site
        As it was read.
    standard : Standard
        Limit profile, with end effect, load along the row and dimensioning form.

    Verified by
    -----------
    tests/study/test_guideline_anchors.py
    """
    if standard.floor == "none":  # that says what a demand is, not what the load is
        standard = standard.overrule_floor("guideline")
    return [find_row_anchors(site, row, standard) for row in site.rows]


def find_row_anchors(site: Site, row: NetRow, standard: Standard) -> RowAnchors:
    """Forces on the anchors of a net row by the guideline's load, as listed above.

    Where the statics are assumed, the largest force at all corners counts.
    """
    effects = find_effects(row, standard, site.at_row(row).ranges)
    variants = _list_variants(site, row, standard, effects)
    reason = variants if isinstance(variants, Message) else None
    known = [] if isinstance(variants, Message) else variants
    by_support = product(effects.supports, ANCHORS)
    forces = [
        AnchorForce(
            anchor=anchor,
            position=width.position,
            guideline_kN=_find_largest(known, anchor, width),
        )
        for width, anchor in by_support
    ]
    if effects.supports[-1].position == "edge":
        forces += [
            AnchorForce(anchor=anchor, position="edge", guideline_kN=None)
            for anchor in END_ANCHORS
        ]
    notes = _list_notes(row, [forces.held for forces in known])
    return RowAnchors(id=row.id, anchors=forces, reason=reason, notes=notes)


def _list_variants(
    site: Site, row: NetRow, standard: Standard, effects: RowEffects
) -> list[RowForces] | Message:
    """Forces of a row at each corner of its statics, or why it has none.

    The end guy has no part in them.
    """
    ranges = site.at_row(row).ranges
    floors = find_row_floors(row, ranges, standard, list_layouts(row))
    apart = {(variant.layout, variant.guys): variant for variant in list_variants(row)}
    variants = []
    for variant in apart.values():
        floor = floors[variant.layout]
        if floor is None or floor.head is None:
            return (floor.reason if floor else None) or say("check.no_case_solved")
        pull = kilonewton_from_newton(floor.head.pull)
        span, share = ranges["inclination"], effects.lateral_share
        at_corner = RowForces(
            site=site,
            row=variant,
            standard=standard,
            effects=effects,
            largest={},
            floor=record_floor(floor),
            held=_hold_sideways(variant, span, pull, share),
            tilt=0.0,
        )
        variants.append(at_corner)
    return variants


def _find_largest(
    variants: Sequence[RowForces], anchor: Member, width: LoadedWidth
) -> float | None:
    """Largest force on an anchor of a support at any corner of the statics [kN]."""
    if anchor == Member.FOOT_ANCHOR:  # no statics change it, unless a guy ends there
        shared = [each for each in variants if each.row.layout.is_foot_shared]
        variants = shared or variants[:1]
    forces = (find_guideline_force(each, anchor, width) for each in variants)
    return max((force for force in forces if force is not None), default=None)


def _list_notes(
    row: NetRow, held: Sequence[HeldSidewaysRecord | Message]
) -> list[Message]:
    """Notes on what is taken for granted, and on a load along the row that is not held.

    A single guy on each side holds none; where the number is assumed, two guys hold it.
    """
    lacks = [each for each in held if isinstance(each, Message)]
    shown = tuple(
        say("table.assumed_one", name=assumed.name, text=assumed.text)
        for assumed in row.assumed
        if assumed.is_range and assumed.key in _IN_LOADS
    )
    notes = list_assumed(row)
    notes += [say("table.assumed", ranges=shown)] if shown else []
    return notes + (lacks[:1] if len(lacks) == len(held) else [])


# What is assumed of a row that the guideline's forces on its anchors depend on.
_IN_LOADS = (
    *("slack", "net_stiffness", "post_tilt", "uphill_anchor_distance"),
    *("downhill_anchor_distance", "guy_count", "guy_splay"),
)


def _hold_sideways(
    row: NetRow, span: Interval, pull: float, share: float
) -> HeldSidewaysRecord | Message:
    splay, places = find_splay(row), place_over(row, span)
    if isinstance(splay, Message):
        return splay
    if not all(map(weigh_splay, places)):
        return say("support.not_held_sideways")
    return HeldSidewaysRecord(
        share=share,
        splay_deg=degree_from_radian(splay),
        pull_low_kN=pull,
        pull_kN=pull,
        pull_high_kN=pull,
        floor_pull_kN=pull,
        **weigh_places(places),
    )


def add_coupled(
    rows: Sequence[RowAnchors], solved: Mapping[str, Sequence[Check]]
) -> list[RowAnchors]:
    """Rows with the coupled forces of a study of the same site beside the guideline's.

    Parameters
    ----------
    rows : sequence of RowAnchors
        By the guideline's load.
    solved : mapping of str to sequence of Check
        Checks of the study by the id of the row; one without any stays as it is.
    """
    return [
        replace(
            row,
            anchors=[
                replace(force, coupled_kN=find_coupled(checks, force))
                for force in row.anchors
            ],
        )
        for row in rows
        for checks in [solved.get(row.id, ())]
    ]


def find_coupled(checks: Sequence[Check], force: AnchorForce) -> float | None:
    """Largest of section, panel and truss, or of a rope, by an anchor's check [kN]."""
    whole = next(
        (
            check
            for check in checks
            if (check.member, check.position) == (force.anchor, force.position)
            and check.mode in _OF_FORCE
        ),
        None,
    )
    if whole is None:
        return None
    symbols = ("E_c", "E_p", "E_t", *(() if "E_g" in whole.step_of else ("E_k",)))
    solved = (whole.read(symbol) for symbol in symbols)
    return max((each for each in solved if each is not None), default=None)
