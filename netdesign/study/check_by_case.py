"""One check as a function of a solved case: a limit state follows it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

from netdesign.envelope.ranges import Case, Ranges
from netdesign.envelope.run import CaseResult
from netdesign.site.model import NetRow

TRIED_DENSITIES = (150.0, 600.0)  # [kg/m3], of snow that a search may try


@dataclass(frozen=True, slots=True, kw_only=True)
class Push:
    """A rope's pull along the row that adds to a force, by the guy of its end.

    Attributes
    ----------
    force, rope : str
        What it adds to, and whose pull it is.
    ratio : float
        Of what it adds to the rope's pull [-].
    """

    force: str
    rope: str
    ratio: float


@dataclass(frozen=True, kw_only=True)
class CheckByCase:
    """One check as a function of a solved case.

    Attributes
    ----------
    row, ranges : NetRow, Ranges
        What is checked, and over what.
    member : str
        Whose force.
    scale : float
        Utilisation for each N of the upper end of the solved force [1/N].
    added, rise : float
        Utilisation by what is added to the largest force [-], and what that grows by
        for each such force more. Another force brings it: it is taken to stay where
        the member's falls, and to grow as the member's does.
    beside : tuple of (str, float)
        Another force of the same member, by the section or by the panel between posts,
        with its ``scale``: the larger utilisation counts.
    governing : Case
        Case of the largest force.
    results : sequence of CaseResult
        Of the whole grid, or of the search.
    widen : callable
        Load of the support over some ranges of the row, in any unit: the end effect
        grows with the glide factor, the force along a base with the tilt of its post.
    push : Push or None
        What a rope adds to one of the forces.
    """

    row: NetRow
    ranges: Ranges
    member: str
    scale: float
    governing: Case
    results: Sequence[CaseResult]
    widen: Callable[[Ranges], float] = lambda _: 1.0
    added: float = 0.0
    rise: float = 0.0
    beside: tuple[tuple[str, float], ...] = ()
    push: Push | None = None

    @cached_property
    def largest(self) -> float:
        """Largest force of the member over the solved cases [N]."""
        return max(self.force(one) for one in self.results if self.has_result(one))

    @cached_property
    def _names(self) -> tuple[str, ...]:
        """Names of all forces that the check follows."""
        beside = tuple(name for name, _ in self.beside)
        rope = (self.push.rope,) if self.push is not None else ()
        return (self.member, *beside, *rope)

    def has_result(self, result: CaseResult) -> bool:
        """All forces are known that the check follows."""
        return all(name in result.member_forces for name in self._names)

    def force(self, result: CaseResult) -> float:
        """Upper end of the member's force in a case [N]."""
        return self._read(result, self.member)

    def _read(self, result: CaseResult, name: str) -> float:
        """Upper end of a force in a case, with what a rope adds to it [N]."""
        force, push = result.member_forces[name].high, self.push
        if push is None or push.force != name:
            return force
        return force + push.ratio * result.member_forces[push.rope].high

    def utilisation(self, result: CaseResult) -> float | None:
        """Upper end of the utilisation in a case [-]; None if it has no result."""
        if not self.has_result(result):
            return None
        used = self.use(self.force(result))
        for name, scale in self.beside:
            used = max(used, scale * self._read(result, name) + self.added)
        return used

    def use(self, force: float) -> float:
        """Utilisation by a force of the member [-]."""
        added = self.added
        if self.rise and self.largest:
            added += self.rise * max(0.0, force / self.largest - 1.0)
        return self.scale * force + added
