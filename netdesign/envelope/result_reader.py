"""From the results of a row to the quantities that a search follows, and back."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from netdesign.envelope.run import CaseResult
from netdesign.envelope.signed import (
    choose_watched,
    name_sources,
    read_signed,
    read_signed_errors,
)
from netdesign.search.maxima import Maxima, Values, Watched
from netdesign.structure.layout import SupportLayout
from netdesign.structure.members import Member

# A gap closer than this share of the numerical error is not worth a case.
_RESOLUTION = 0.5
# Share of its largest value from which a quantity is near it; as much makes a case a
# rival in a study.
_NEAR = 0.9
_GUYS = (Member.UPHILL_GUY, Member.DOWNHILL_GUY)


@dataclass(slots=True, kw_only=True)
class ResultReader:
    """Turns results into the quantities of a search, and its bounds into members'.

    Attributes
    ----------
    layout : SupportLayout or None
        Support of the net; None follows the net's own tensions.
    members, signed : tuple of str
        Quantities of the results, and the signed forces behind them.
    is_shared : bool
        Net and uphill guy end at one anchor.
    errors, largest : dict of str to float
        Smallest numerical error and largest force of each member [N].
    """

    layout: SupportLayout | None
    members: tuple[str, ...] = ()
    signed: tuple[str, ...] = ()
    is_shared: bool = False
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
                known = self.largest.get(member, 0.0)
                self.largest[member] = max(known, band.value)
                if band.value > 0.0:
                    error = band.high - band.value
                    self.errors[member] = min(error, self.errors.get(member, error))
        return [self._read_one(result) for result in results]

    def read_doubts(
        self, results: Sequence[CaseResult], rough: Collection[int]
    ) -> list[Values | None]:
        """Numerical errors of the rough cases, by their places; None of the others."""
        return [
            self._read_errors(result) if place in rough else None
            for place, result in enumerate(results)
        ]

    def find_near(self, results: Sequence[CaseResult]) -> set[int]:
        """Places of the cases that failed, or may come near the largest of a quantity.

        Errors count on the safe side: the upper end of a force against the largest
        lower end.
        """
        self._name_quantities(results)
        known = {
            place: (value, self._read_errors(results[place]))
            for place, value in enumerate(map(self._read_one, results))
            if value is not None
        }
        if not known:
            return set(range(len(results)))
        values, errors = (np.array(one) for one in zip(*known.values(), strict=True))
        least = _NEAR * np.maximum(np.max(values - errors, axis=0), 0.0)
        is_near = (values + errors >= least)[:, list(self.watch())].any(axis=1)
        far = {place for place, near in zip(known, is_near, strict=True) if not near}
        return set(range(len(results))) - far

    def _name_quantities(self, results: Sequence[CaseResult]) -> None:
        """Name what is modelled, from the first cases that converged."""
        converged = [result for result in results if result.is_converged]
        if self.members or not converged:
            return
        first, behind = converged[0], [self._find_signed(one) for one in converged]
        self.members = tuple(first.member_forces)
        self.is_shared = first.anchors is not None and first.anchors.is_foot_shared
        if all(one is not None for one in behind):
            self.signed = tuple(behind[0] or ())

    def watch(self) -> dict[int, Watched]:
        """Quantities to be bounded, by place, and how closely each."""
        names = choose_watched(self.members, self.signed, is_shared=self.is_shared)
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
            behind += [member for member in self.members if member in _GUYS]
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
                upper[place] = max(maxima.maximum[place], 0.0, *allowed)
        return replace(maxima, upper_bound=tuple(upper))

    def _find_signed(self, result: CaseResult) -> dict[str, float] | None:
        return None if self.layout is None else read_signed(result, self.layout)

    def _read_errors(self, result: CaseResult) -> Values | None:
        """Numerical errors of what ``_read_one`` gives [N]."""
        bands = result.member_forces.values()
        own = tuple(band.high - band.value for band in bands)
        if not self.signed or self.layout is None:
            return own
        signed = read_signed_errors(result, self.layout)
        return None if signed is None else (*own, *signed.values())

    def _read_one(self, result: CaseResult) -> Values | None:
        if not result.is_converged:
            return None
        forces = tuple(band.value for band in result.member_forces.values())
        if not self.signed:
            return forces
        signed = self._find_signed(result)
        return None if signed is None else (*forces, *signed.values())
