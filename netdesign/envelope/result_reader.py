"""From the results of a row to the quantities that a search follows, and back.

The search follows the signed forces of `signed_forces.py` beside the members. A post
pulls only where the net pulls its head away from the slope. So that direction is
bounded first, and in nearly all rows no post pulls. Theory: structure/THEORY.md, eq.
(S4a).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import chain
from typing import NamedTuple

import numpy as np

from netdesign.checks.inputs import Band
from netdesign.envelope.panel_forces import PANEL_QUANTITIES, POST_PULLS, PanelForces
from netdesign.envelope.rows import RowTask
from netdesign.envelope.run import CaseResult
from netdesign.envelope.signed_forces import (
    SIGNED,
    find_case_ways,
    gather_pulls,
    name_sources,
    read_signed,
)
from netdesign.numerics.arrays import Floats, Mask
from netdesign.search import surrogate
from netdesign.search.maxima import Maxima, SearchSettings, Watched
from netdesign.search.surrogate import fit_surrogate, supports_model
from netdesign.search.upper_bound import NOISE, Lattice, bound_quantities
from netdesign.structure.head import share_between_guys
from netdesign.structure.layout import SupportLayout
from netdesign.structure.members import GUYS, Member, RopeForce, name_in_panel

# Members that each of the forces of `_measure` loads; the last one of a shared anchor.
_LIFTED = (
    (Member.POST_FOOT,),
    (Member.DOWNHILL_GUY, Member.DOWNHILL_ANCHOR),
    (Member.UPHILL_GUY, Member.UPHILL_ANCHOR),
    (Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR),
)


def bound_lifted(
    layouts: Sequence[SupportLayout],
    points: Sequence[surrogate.Point],
    results: Sequence[CaseResult],
    settings: SearchSettings,
) -> Mapping[str, float]:
    """Upper bounds of foot and guys where some post may pull, by name [N].

    Parameters
    ----------
    layouts : sequence of SupportLayout
        That the net's support may have; without one there is no post.
    points, results : sequence of Point, of CaseResult
        Of a search: shares of the ranges, and what was solved there.
    settings : SearchSettings
        Of that search.

    Returns
    -------
    mapping of str to float
        Empty where no post pulls anywhere in the ranges, and where too few cases were
        solved for any bound.

    Verified by
    -----------
    tests/envelope/test_lift.py
    """
    solved = [
        (point, result)
        for point, result in zip(points, results, strict=True)
        if result.anchors and result.solution
    ]
    places = np.array([point for point, _ in solved])
    if not layouts or not solved or not supports_model(places):
        return {}
    values = _measure(layouts, [result for _, result in solved])
    tolerance = np.full(values.shape[1], settings.gap * np.abs(values[:, 1:]).max())
    tolerance[0] = settings.gap  # of a sine
    bound = partial(
        bound_quantities,
        fit_surrogate(places, values, NOISE * tolerance),
        values,
        best=np.maximum(values.max(axis=0), 0.0),
        tolerance=tolerance,
        deciding=(),
        lattice=Lattice(places.shape[1]),
        inflations=(),
    )
    if not bound(watched=(0,)).upper[0] > 0.0:
        return {}
    upper = bound(watched=range(values.shape[1])).upper.tolist()[1:]
    by_member = {
        str(member): force
        for members, force in zip(_LIFTED, upper, strict=False)
        for member in members
    }
    return by_member | {
        name_in_panel(member): force for member, force in by_member.items()
    }


def _measure(layouts: Sequence[SupportLayout], results: Sequence[CaseResult]) -> Floats:
    """Sine of the pull on the head out of the slope, and forces that follow it [N].

    Of each case the largest of section and panels, on any layout: the lift, (S4a), and
    the guys without the post, (S4b); where net and guy share an anchor, what both bring
    there. Shape: cases, forces.
    """
    pulls = gather_pulls(results, layouts[0].post_spacing)
    post, *guys = find_case_ways(layouts, results)
    x, y = pulls.head
    uphill, downhill = share_between_guys(pulls.head, *guys)
    forces = [
        y / np.where((x == 0.0) & (y == 0.0), 1.0, np.hypot(x, y)) + 0.0 * uphill,
        y / -post[1],
        downhill,
        uphill,
    ]
    if layouts[0].is_foot_shared:
        forces.append(pulls.beside_post + uphill)
    return np.stack([each.max(axis=(0, 2)) for each in forces], axis=1)


# A gap closer than this share of the numerical error is not worth a case.
_RESOLUTION = 0.5
# Share of its largest value from which a quantity is near it; as much makes a case a
# rival in a study.
_NEAR = 0.9
# Ropes are known to a tenth: a bound that is closer than this is worth no case.
_ROPES_SHARE = 0.02
_PANEL_GUYS = tuple(map(name_in_panel, GUYS))
_ALONG = (RopeForce.LOWER_ALONG, RopeForce.UPPER_ALONG)
_BY_PANEL = name_in_panel("")  # how the names of its quantities begin


class Reading(NamedTuple):
    """Some cases as a search follows them.

    Attributes
    ----------
    values, errors : ndarray, shape (cases, quantities)
        Forces and their numerical errors [N]; no numbers of a case that failed.
    lacks_panel : ndarray of bool, shape (cases,)
        No forces by the panel are known of a case that converged.
    """

    values: Floats
    errors: Floats
    lacks_panel: Mask


@dataclass(frozen=True, slots=True, kw_only=True)
class Quantities:
    """What a search follows of a row's results, and its bounds of members.

    Attributes
    ----------
    task : RowTask
        What is searched.
    sources : mapping of str to tuple of str
        Quantities by which each member is bounded: itself, or the signed forces behind
        it; none without any result that converged.
    signed : tuple of str
        All signed forces that are modelled.
    """

    task: RowTask
    sources: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    signed: tuple[str, ...] = ()

    @property
    def members(self) -> tuple[str, ...]:
        """Quantities of the results."""
        return tuple(self.sources)

    @property
    def names(self) -> tuple[str, ...]:
        """All that is modelled: members, then signed forces."""
        return (*self.members, *self.signed)

    def read(self, results: Sequence[CaseResult]) -> Reading:
        """Forces and errors of some cases; what is missing of a panel counts as 0."""
        both = np.full((2, len(results), len(self.names)), np.nan)
        none = Band(low=0.0, value=0.0, high=0.0)
        for place, result in enumerate(results):
            if result.is_converged:
                bands = [result.member_forces.get(name, none) for name in self.members]
                line = [(band.value, band.high - band.value) for band in bands]
                both[:, place, : len(bands)] = np.array(line).T
        if self.signed:
            signed = np.array(read_signed(results, self.task.layouts))
            both[..., len(self.members) :] = signed[..., : len(self.signed)]
        lacks = [self._lacks_panel(result) for result in results]
        return Reading(both[0], both[1], np.array(lacks))

    def _lacks_panel(self, result: CaseResult) -> bool:
        has_panel = isinstance(result.panel, PanelForces)
        return bool(self.task.panels) and result.is_converged and not has_panel

    def find_near(self, reading: Reading) -> set[int]:
        """Places of the cases that failed, or may come near the largest of a quantity.

        Errors count on the safe side: the upper end of a force against the largest
        lower end.
        """
        values, errors, lacks_panel = reading
        is_known = np.isfinite(values).all(axis=1) & ~lacks_panel
        if not self.members or not is_known.any():
            return set(range(len(values)))
        lower = (values - errors)[is_known].max(axis=0)
        is_far = values + errors < _NEAR * np.maximum(lower, 0.0)
        watched = [self.names.index(name) for name in self.watched]
        is_far = is_far[:, watched].all(axis=1) & is_known
        return set(np.flatnonzero(~is_far).tolist())

    @property
    def watched(self) -> tuple[str, ...]:
        """Quantities that a search has to bound, so that every member is bounded."""
        return tuple(dict.fromkeys(chain.from_iterable(self.sources.values())))

    def watch(self, readings: Sequence[Reading]) -> dict[int, Watched]:
        """Quantities to be bounded, by place, and how closely each; after some cases.

        Where a case lacks its panel, that is not searched any longer: the gap is told
        of the row.
        """
        values, errors = (
            np.concatenate([x[k] for x in readings])[:, : len(self.members)]
            for k in (0, 1)
        )
        largest = np.fmax.reduce(values, axis=0, initial=0.0)
        smallest = np.min(errors, axis=0, where=values > 0.0, initial=np.inf)
        forces = dict(zip(self.members, largest.tolist(), strict=True))
        closest = dict(zip(self.members, smallest.tolist(), strict=True))
        names = self.watched
        if any(reading.lacks_panel.any() for reading in readings):
            names = tuple(name for name in names if not name.startswith(_BY_PANEL))
        return {
            self.names.index(name): self._ask_for(name, forces, closest)
            for name in names
        }

    def _ask_for(
        self, name: str, forces: Mapping[str, float], errors: Mapping[str, float]
    ) -> Watched:
        """Half the numerical error of the members that a quantity stands for."""
        behind = [member for member, its in self.sources.items() if name in its]
        floor = min((forces[member] for member in behind), default=0.0)
        if name not in self.members and "guy" in name:
            guys = _PANEL_GUYS if name.startswith(_BY_PANEL) else GUYS
            behind += [member for member in self.members if member in guys]
        if name in tuple(RopeForce):
            closest = _ROPES_SHARE * forces[name]
            return Watched(
                resolution=closest,
                floor=floor,
                is_deciding=self.task.has_end and name in _ALONG,
            )
        known = (errors[x] for x in behind if math.isfinite(errors[x]))
        return Watched(resolution=_RESOLUTION * max(known, default=0.0), floor=floor)

    def bound_members(self, maxima: Maxima) -> Maxima:
        """Bounds of the members from those of the signed forces behind them."""
        if not self.signed or not maxima.upper_bound:
            return maxima
        upper = list(maxima.upper_bound)
        for place, (member, sources) in enumerate(self.sources.items()):
            if sources != (member,):
                allowed = [upper[self.names.index(name)] for name in sources]
                upper[place] = float(np.max([maxima.maximum[place], 0.0, *allowed]))
        return replace(maxima, upper_bound=tuple(upper))


def name_quantities(task: RowTask, results: Sequence[CaseResult]) -> Quantities:
    """Names of what a search follows, from the first case that converged.

    Members of the section, and all quantities of a panel, found or not. A post that
    pulls is bounded apart, by ``bound_lifted``.
    """
    converged = [result for result in results if result.is_converged]
    if not converged:
        return Quantities(task=task)
    first, layouts = converged[0], task.layouts
    section = [name for name in first.member_forces if name not in PANEL_QUANTITIES]
    every = (*section, *(PANEL_QUANTITIES if task.panels else ()))
    members = [name for name in every if name not in POST_PULLS]
    signed: tuple[str, ...] = ()
    sources: dict[str, tuple[str, ...]] = {}
    if layouts and np.isfinite(read_signed(converged, layouts)[0]).all():
        signed = SIGNED if task.panels else SIGNED[: len(SIGNED) // 2]
        is_shared = first.anchors is not None and first.anchors.is_foot_shared
        sources = {x: name_sources(x, is_shared=is_shared) for x in members}
    own = {member: sources.get(member) or (member,) for member in members}
    return Quantities(task=task, sources=own, signed=signed)
