"""One net row: the task of its search, and the envelope that the search gives."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import product

from netdesign.checks.result import Band
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.envelope.extremes import (
    Extreme,
    describe_gap,
    find_extreme,
    find_extremes,
)
from netdesign.envelope.parameters import place_scene
from netdesign.envelope.ranges import Case, Ranges, build_case
from netdesign.envelope.run import CaseResult, CaseTask, build_task
from netdesign.search.maxima import Maxima, SearchSettings
from netdesign.search.surrogate import Point
from netdesign.solving.solve import Settings
from netdesign.structure.layout import SupportLayout
from netdesign.words.message import Message, say
from netdesign.words.names import name_member

# A confirmation is solved to this share of the accuracy, on finer meshes.
_CONFIRMED_SHARE = 0.5
_TIGHTEST = 1e-4  # what ``SolverSettings`` accepts


@dataclass(frozen=True, slots=True, kw_only=True)
class RowTask:
    """Task of a search: a scene, the ranges around it, settings.

    Attributes
    ----------
    scene : Scene
        Has all values that the ranges leave alone.
    ranges : Ranges
        Of the parameters that vary.
    layout : SupportLayout or None
        Support of the net; None follows the net's own tensions per metre.
    settings : SolverSettings
        Of every case.
    search : SearchSettings
        Of the end of the search.
    confirmed_by : Settings or None
        Of the second solve of governing cases; None leaves that out.
    build : callable or None
        Scene of a case, where the values of the ranges cannot be put into ``scene`` one
        by one.
    """

    scene: Scene
    ranges: Ranges
    layout: SupportLayout | None
    settings: SolverSettings
    search: SearchSettings
    confirmed_by: Settings | None
    build: Callable[[Case], Scene] | None = None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Confirmation:
    """A governing case solved again by another fidelity."""

    member: str
    screened: CaseResult
    confirmed: CaseResult

    @property
    def difference(self) -> float | None:
        """Confirmed over screened force, less 1 [-]; None without a result."""
        if not self.confirmed.is_converged:
            return None
        screened = self.screened.member_forces[self.member].value
        confirmed = self.confirmed.member_forces[self.member].value
        return confirmed / screened - 1.0 if screened > 0.0 else 0.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RowEnvelope:
    """End of a row's search. Forces in N per anchor, or N/m without a layout.

    Attributes
    ----------
    task : RowTask
        What was searched.
    members : tuple of str
        The quantities that are reported, in the order of ``maxima``.
    quantities : tuple of str
        All that were modelled: the members, and the signed forces behind them.
    results : tuple of CaseResult
        Every case, in the order of ``maxima.points``.
    maxima : Maxima
        Maxima, upper bounds, log and model.
    confirmations : tuple of Confirmation
        One for each member that carries a force.
    skipped, skips_tested : int
        Cases known without a solve because the snow stuck with less friction
        already, and how many of those were solved all the same as a test.
    """

    task: RowTask
    members: tuple[str, ...]
    quantities: tuple[str, ...]
    results: tuple[CaseResult, ...]
    maxima: Maxima
    confirmations: tuple[Confirmation, ...]
    skipped: int
    skips_tested: int

    @property
    def gap(self) -> Message | None:
        """Reason why the maxima do not cover every case; None if they do."""
        failed = describe_gap(self.results) or self._describe_unconfirmed()
        if failed or self.maxima.is_closed:
            return failed
        return say("envelope.may_exceed", count=len(self.results))

    def _describe_unconfirmed(self) -> Message | None:
        """Governing case that could not be solved again; None if all could."""
        for one in self.confirmations:
            if not one.confirmed.is_converged:
                return say(
                    "envelope.unconfirmed",
                    member=name_member(one.member),
                    reason=one.confirmed.reason or "",
                )
        return None

    def hidden(self, member: str) -> float:
        """How much larger a member's force may be between the cases [N]."""
        place = self.members.index(member)
        return max(0.0, self.maxima.upper_bound[place] - self.maxima.maximum[place])

    def force(self, member: str) -> Band:
        """Largest force of a member at the cases, with its numerical error.

        A confirmation that lies above the bound raises the upper end.
        """
        bands = [one.member_forces[member] for one in self.results if one.is_converged]
        confirmed = [
            one.confirmed.member_forces[member].high - self.hidden(member)
            for one in self.confirmations
            if one.confirmed.is_converged
        ]
        return Band(
            low=max(band.low for band in bands),
            value=max(band.value for band in bands),
            high=max([*(band.high for band in bands), *confirmed]),
        )

    def bound(self, member: str) -> Band:
        """Largest force of a member over the whole ranges, with everything unsure.

        The band's upper end adds what may hide between the cases.
        """
        force = self.force(member)
        return replace(force, high=force.high + self.hidden(member))

    def upper_bound(self, member: str) -> float:
        """Largest force with what may hide, without the numerical error [N]."""
        return self.force(member).value + self.hidden(member)

    def governing(self, member: str) -> CaseResult:
        """Case of a member's largest force; carries the coincident forces."""
        return find_extreme(member, self.results).governing

    @property
    def extremes(self) -> dict[str, Extreme]:
        """Largest forces by member, without what may hide between the cases."""
        found = find_extremes(self.results)
        return {
            member: replace(one, force=self.force(member))
            for member, one in found.items()
        }


def refine_settings(settings: SolverSettings) -> SolverSettings:
    """Settings of a confirmation: coarsest meshes left out, tighter accuracy.

    A screening ends on the second mesh or a little above; this starts on the third
    where there are enough, so that it ends on a finer one.
    """
    left_out = max(0, min(2, len(settings.levels) - 2))
    accuracy = max(_TIGHTEST, _CONFIRMED_SHARE * settings.accuracy)
    return replace(settings, accuracy=accuracy, levels=settings.levels[left_out:])


def build_point_task(
    task: RowTask, point: Point, settings: Settings | None = None
) -> CaseTask:
    """Task of a point of a row's ranges; the row's settings unless others are given."""
    values = task.ranges.place(point)
    return build_task(
        build_case(task.scene, values),
        task.build or (lambda _: place_scene(task.scene, values)),
        task.layout,
        settings or task.settings,
    )


def list_grid(counts: Sequence[int]) -> list[Point]:
    """All points of a grid with so many samples of each axis, at least two."""
    return list(product(*([k / (count - 1) for k in range(count)] for count in counts)))
