"""From the results of a row to the quantities that a search follows, and back.

The search follows the signed forces of `signed_forces.py` beside the members. A post
pulls only where the net pulls its head away from the slope. So that direction is
bounded first, and in nearly all rows no post pulls. Theory: structure/THEORY.md, eq.
(S4a).
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from netdesign.envelope.panel_forces import PANEL_QUANTITIES, PanelForces
from netdesign.envelope.run import CaseResult
from netdesign.envelope.signed_forces import (
    choose_watched,
    gather_pulls,
    name_sources,
    read_signed,
    read_signed_errors,
    spread_ends,
)
from netdesign.numerics.arrays import Floats, measure_length
from netdesign.search import surrogate
from netdesign.search.maxima import Maxima, SearchSettings, Values, Watched
from netdesign.search.surrogate import fit_surrogate, supports_model
from netdesign.search.upper_bound import NOISE, bound_quantities, build_lattice
from netdesign.structure.head import resolve_loose
from netdesign.structure.layout import (
    SupportLayout,
)
from netdesign.structure.members import (
    GUYS,
    Member,
    RopeForce,
    name_in_panel,
)

# Tension of a post, by the section and by the panel between posts.
POST_PULLS: tuple[str, ...] = (Member.POST_FOOT, name_in_panel(Member.POST_FOOT))
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
        lattice=build_lattice(places.shape[1]),
        certainty=settings.certainty,
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
    ends = spread_ends(layouts, results)
    x, y = pulls.head
    uphill, downhill = resolve_loose(pulls.head, ends.head, ends.uphill, ends.downhill)
    post = measure_length(ends.base[0] - ends.head[0], ends.base[1] - ends.head[1])
    forces = [
        y / np.where((x == 0.0) & (y == 0.0), 1.0, np.hypot(x, y)) + 0.0 * uphill,
        y * post / ends.head[1],
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

ReadSigned = Callable[
    [Sequence[CaseResult], Sequence[SupportLayout]], list[dict[str, float] | None]
]


@dataclass(slots=True, kw_only=True)
class ResultReader:
    """Turns results into the quantities of a search, and its bounds into members'.

    Attributes
    ----------
    layouts : sequence of SupportLayout
        That the net's support may have; none follows the net's own tensions.
    has_panel : bool
        The row has a panel between its posts.
    has_end : bool
        Pulls of the panel's ropes along the row are checked.
    members, signed : tuple of str
        Quantities of the results, and the signed forces behind them.
    is_shared : bool
        Net and uphill guy end at one anchor.
    is_without_panel : bool
        Some case has no forces by its panel: they are not searched any longer, and
        count as 0 where they are missing. That gap is told of the row.
    errors, largest : dict of str to float
        Smallest numerical error and largest force of each member [N].
    """

    layouts: Sequence[SupportLayout]
    has_panel: bool = False
    has_end: bool = False
    members: tuple[str, ...] = ()
    signed: tuple[str, ...] = ()
    is_shared: bool = False
    is_without_panel: bool = False
    errors: dict[str, float] = field(default_factory=dict)
    largest: dict[str, float] = field(default_factory=dict)

    @property
    def quantities(self) -> tuple[str, ...]:
        """All that is modelled: members, then signed forces."""
        return (*self.members, *self.signed)

    def read(self, results: Sequence[CaseResult]) -> list[Values | None]:
        """Values of some cases; the first decide whether signed forces exist."""
        self._name_quantities(results)
        for result in results:
            for member, band in result.member_forces.items():
                before = self.largest.get(member, 0.0)
                self.largest[member] = max(before, band.value)
                if band.value > 0.0:
                    error = band.high - band.value
                    self.errors[member] = min(error, self.errors.get(member, error))
        self.is_without_panel |= any(map(self._lacks_panel, results))
        return self._read_values(results)

    def read_doubts(
        self, results: Sequence[CaseResult], rough: Collection[int]
    ) -> list[Values | None]:
        """Numerical errors of the rough cases, by their places; None of the others."""
        places = sorted(rough)
        errors = self._read_errors([results[place] for place in places])
        of_place = dict(zip(places, errors, strict=True))
        return [of_place.get(place) for place in range(len(results))]

    def find_near(self, results: Sequence[CaseResult]) -> set[int]:
        """Places of the cases that failed, or may come near the largest of a quantity.

        Errors count on the safe side: the upper end of a force against the largest
        lower end.
        """
        self._name_quantities(results)
        both = zip(self._read_values(results), self._read_errors(results), strict=True)
        by_place = {
            place: pair
            for place, pair in enumerate(both)
            if pair[0] and not self._lacks_panel(results[place])
        }
        if not by_place:
            return set(range(len(results)))
        values, errors = map(np.array, zip(*by_place.values(), strict=True))
        least = _NEAR * np.maximum(np.max(values - errors, axis=0), 0.0)
        is_near = (values + errors >= least)[:, list(self.watch())].any(axis=1)
        far = {place for place, near in zip(by_place, is_near, strict=True) if not near}
        return set(range(len(results))) - far

    def _lacks_panel(self, result: CaseResult) -> bool:
        has_panel = isinstance(result.panel, PanelForces)
        return self.has_panel and result.is_converged and not has_panel

    def _name_quantities(self, results: Sequence[CaseResult]) -> None:
        """Name what is modelled, from the first cases that converged."""
        converged = [result for result in results if result.is_converged]
        if self.members or not converged:
            return
        first = converged[0]
        behind = read_signed(converged, self.layouts) if self.layouts else [None]
        self.members = self._list_members(first)
        self.is_shared = first.anchors is not None and first.anchors.is_foot_shared
        if None not in behind:
            self.signed = self._list_signed(behind[0] or {})

    def _list_members(self, first: CaseResult) -> tuple[str, ...]:
        """Members of the section, and all quantities of a panel, found or not.

        A post that pulls is bounded apart, by ``bound_lifted``.
        """
        own = [name for name in first.member_forces if name not in PANEL_QUANTITIES]
        every = (*own, *(PANEL_QUANTITIES if self.has_panel else ()))
        return tuple(name for name in every if name not in POST_PULLS)

    def _list_signed(self, first: Mapping[str, float]) -> tuple[str, ...]:
        own = [name for name in first if not name.startswith(_BY_PANEL)]
        return (*own, *(map(name_in_panel, own) if self.has_panel else ()))

    def watch(self) -> dict[int, Watched]:
        """Quantities to be bounded, by place, and how closely each."""
        names = choose_watched(self.members, self.signed, is_shared=self.is_shared)
        if self.is_without_panel:
            names = tuple(name for name in names if not name.startswith(_BY_PANEL))
        return {self.quantities.index(name): self._ask_for(name) for name in names}

    def _ask_for(self, name: str) -> Watched:
        """Half the numerical error of the members that a quantity stands for."""
        behind = [
            member
            for member in self.members
            if name in (member, *name_sources(member, is_shared=self.is_shared))
        ]
        floor = min((self.largest.get(member, 0.0) for member in behind), default=0.0)
        if name not in self.members and "guy" in name:
            guys = _PANEL_GUYS if name.startswith(_BY_PANEL) else GUYS
            behind += [member for member in self.members if member in guys]
        if name in tuple(RopeForce):
            closest = _ROPES_SHARE * self.largest.get(name, 0.0)
            return Watched(
                resolution=closest,
                floor=floor,
                is_deciding=self.has_end and name in _ALONG,
            )
        errors = [self.errors[member] for member in behind if member in self.errors]
        return Watched(resolution=_RESOLUTION * max(errors, default=0.0), floor=floor)

    def bound_members(self, maxima: Maxima) -> Maxima:
        """Bounds of the members from those of the signed forces behind them."""
        if not self.signed or not maxima.upper_bound:
            return maxima
        upper = list(maxima.upper_bound)
        for place, member in enumerate(self.members):
            sources = name_sources(member, is_shared=self.is_shared)
            allowed = [upper[self.quantities.index(name)] for name in sources]
            if allowed:
                upper[place] = float(np.max([maxima.maximum[place], 0.0, *allowed]))
        return replace(maxima, upper_bound=tuple(upper))

    def _read_errors(self, results: Sequence[CaseResult]) -> list[Values | None]:
        """Numerical errors of what ``_read_values`` gives [N]."""
        errors = [
            {name: band.high - band.value for name, band in one.member_forces.items()}
            for one in results
        ]
        return self._line_up(errors, read_signed_errors, results)

    def _read_values(self, results: Sequence[CaseResult]) -> list[Values | None]:
        values = [
            {name: band.value for name, band in result.member_forces.items()}
            for result in results
        ]
        return self._line_up(values, read_signed, results)

    def _line_up(
        self,
        of_members: Sequence[Mapping[str, float]],
        read: ReadSigned,
        results: Sequence[CaseResult],
    ) -> list[Values | None]:
        """Members, then signed forces of each case; what is missing counts as 0.

        None of a case that failed.
        """
        of_signed: list[dict[str, float] | None] = [{}] * len(results)
        if self.signed and self.layouts:
            of_signed = read(results, self.layouts)
        return [
            (
                *(forces.get(member, 0.0) for member in self.members),
                *(signed.get(name, 0.0) for name in self.signed),
            )
            if signed is not None and result.is_converged
            else None
            for forces, signed, result in zip(
                of_members, of_signed, results, strict=True
            )
        ]
