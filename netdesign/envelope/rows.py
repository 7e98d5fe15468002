"""One net row: the task of its search, and the envelope that the search gives."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.envelope.extremes import Extreme, describe_gap, find_extremes
from netdesign.envelope.panel_forces import POST_PULLS
from netdesign.envelope.ranges import Case, Ranges, build_case, place_scene
from netdesign.envelope.run import CaseResult, CaseTask, build_task
from netdesign.panel.inputs import Panel
from netdesign.search.maxima import Maxima, SearchSettings
from netdesign.search.surrogate import Point
from netdesign.solving.solve import Settings
from netdesign.structure.layout import SupportLayout
from netdesign.words.catalogue import name_member
from netdesign.words.message import Message, say

# A confirmation is solved to this share of the accuracy, on finer meshes.
_CONFIRMED_SHARE = 0.5
_TIGHTEST = 1e-4  # what ``SolverSettings`` accepts
# A case can hide a larger force on one layout where the largest of all is near that.
LARGE = 0.9


@dataclass(frozen=True, slots=True, kw_only=True)
class RowTask:
    """Task of a search: a scene, the ranges around it, settings.

    Attributes
    ----------
    scene : Scene
        Has all values that the ranges leave alone.
    ranges : Ranges
        Of the parameters that vary.
    layouts : tuple of SupportLayout
        That the net's support may have, several where something of it is assumed: the
        worst counts. Without any the net's own tensions are followed, per metre.
    settings : SolverSettings
        Of every case.
    search : SearchSettings
        Of the end of the search.
    confirmed_by : Settings or None
        Of the second solve of governing cases; None leaves that out.
    build : callable or None
        Scene of a case, where the values of the ranges cannot be put into ``scene`` one
        by one.
    panels : tuple of Panel
        Between the posts; their largest forces are searched beside those of the
        section.
    has_end : bool
        The pulls of its ropes along the row are checked, where the row ends.
    """

    scene: Scene
    ranges: Ranges
    layouts: tuple[SupportLayout, ...]
    settings: SolverSettings
    search: SearchSettings
    confirmed_by: Settings | None
    build: Callable[[Case], Scene] | None = None
    panels: tuple[Panel, ...] = ()
    has_end: bool = False


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Confirmation:
    """A governing case solved again by another fidelity."""

    member: str
    screened: CaseResult
    confirmed: CaseResult

    @property
    def difference(self) -> float | None:
        """Confirmed over screened force, less 1 [-]; None without a result."""
        if self.member not in self.confirmed.member_forces:
            return None
        screened = self.screened.member_forces[self.member].value
        confirmed = self.confirmed.member_forces[self.member].value
        return confirmed / screened - 1.0 if screened > 0.0 else 0.0


@dataclass(frozen=True, kw_only=True, eq=False)
class RowEnvelope:
    """End of a row's search. Forces in N per anchor, or N/m without a layout.

    Attributes
    ----------
    task : RowTask
        What was searched.
    members : tuple of str
        The quantities that are reported, in the order of ``maxima``.
    results : tuple of CaseResult
        Every case, in the order of ``maxima.points``.
    maxima : Maxima
        Maxima, upper bounds and model.
    confirmations : tuple of Confirmation
        One for each member that carries a force.
    skipped : int
        Cases known without a solve because the snow stuck with less friction already.
    lifted : mapping of str to float
        Upper bounds of the members where some post may pull; empty where none does.
    """

    task: RowTask
    members: tuple[str, ...]
    results: tuple[CaseResult, ...]
    maxima: Maxima
    confirmations: tuple[Confirmation, ...]
    skipped: int
    lifted: Mapping[str, float] = field(default_factory=dict)

    @property
    def gap(self) -> Message | None:
        """Reason why the maxima do not cover every case; None if they do."""
        failed = describe_gap(self.results) or self._describe_unconfirmed()
        if failed or self.maxima.is_closed:
            return failed
        return say("envelope.may_exceed", count=len(self.results))

    def _describe_unconfirmed(self) -> Message | None:
        """Governing case that could not be solved again; None if all could."""
        for confirmation in self.confirmations:
            if confirmation.member not in confirmation.confirmed.member_forces:
                return say(
                    "envelope.unconfirmed",
                    member=name_member(confirmation.member),
                    reason=confirmation.confirmed.lack or "",
                )
        return None

    @cached_property
    def extremes(self) -> dict[str, Extreme]:
        """Largest forces by member; a confirmation above the bound raises its end."""
        extremes = find_extremes(self.results)
        return {member: self._bound(extreme) for member, extreme in extremes.items()}

    def on_layout(self, layout: SupportLayout) -> RowEnvelope:
        """The envelope on one layout: of the task, or between those.

        No case is solved for it. Its bounds follow from those of the largest over all
        layouts: envelope/THEORY.md, (E3).
        """
        if len(self.task.layouts) < 2:
            return self
        results = tuple(result.on_layout(layout) for result in self.results)
        return replace(
            self,
            task=replace(self.task, layouts=(layout,)),
            results=results,
            maxima=self._bound_on_layout(results),
            confirmations=tuple(
                replace(
                    confirmation,
                    screened=confirmation.screened.on_layout(layout),
                    confirmed=confirmation.confirmed.on_layout(layout),
                )
                for confirmation in self.confirmations
            ),
        )

    def _bound_on_layout(self, results: Sequence[CaseResult]) -> Maxima:
        """Maxima of the members on one layout, whose cases are given."""
        maximum, upper = list(self.maxima.maximum), list(self.maxima.upper_bound)
        for place, member in enumerate(self.members if upper else ()):
            pairs = [
                (result.member_forces[member].value, all_.member_forces[member].value)
                for result, all_ in zip(results, self.results, strict=True)
                if member in result.member_forces
            ]
            own = max((force for force, _ in pairs), default=0.0)
            shares = [
                force / all_
                for force, all_ in pairs
                if all_ > 0.0 and all_ >= LARGE * own
            ]
            upper[place] = max(own, max(shares, default=1.0) * upper[place])
            maximum[place] = own
        return replace(self.maxima, maximum=tuple(maximum), upper_bound=tuple(upper))

    def _bound(self, extreme: Extreme) -> Extreme:
        member, hidden = extreme.member, 0.0
        if member not in POST_PULLS:
            place = self.members.index(member)
            gap = self.maxima.upper_bound[place] - self.maxima.maximum[place]
            hidden = 0.0 if gap <= 0.0 else gap  # what is no number stays none
        if math.isinf(hidden):  # not searched, since some case has no panel: a gap
            hidden = 0.0
        if member in self.lifted:
            hidden = max(hidden, self.lifted[member] - extreme.force.value)
        confirmed = [
            confirmation.confirmed.member_forces[member].high - hidden
            for confirmation in self.confirmations
            if member in confirmation.confirmed.member_forces
        ]
        force = replace(extreme.force, high=max([extreme.force.high, *confirmed]))
        return replace(extreme, force=force, hidden=hidden)


def build_search(
    scene: Scene,
    ranges: Ranges,
    accuracy: float,
    layouts: tuple[SupportLayout, ...] = (),
    *,
    is_confirmed: bool = False,
) -> RowTask:
    """Task of a scene alone, whose bounds are as close as its cases are accurate.

    Its governing cases are solved again where they are to be confirmed.
    """
    settings = SolverSettings(accuracy=accuracy)
    return RowTask(
        scene=scene,
        ranges=ranges,
        layouts=layouts,
        settings=settings,
        search=SearchSettings(gap=accuracy),
        confirmed_by=refine_settings(settings) if is_confirmed else None,
    )


def refine_settings(settings: SolverSettings) -> SolverSettings:
    """Settings of a confirmation: coarsest meshes left out, tighter accuracy.

    A screening ends on the second mesh or a little above; this starts on the third
    where there are enough, so that it ends on a finer one.
    """
    left_out = max(0, min(2, len(settings.levels) - 2))
    accuracy = max(_TIGHTEST, _CONFIRMED_SHARE * settings.accuracy)
    return replace(settings, accuracy=accuracy, levels=settings.levels[left_out:])


def roughen_settings(settings: SolverSettings) -> SolverSettings:
    """Settings of a first look at a case: the two coarsest meshes, whatever they say.

    They end their rounds as those of the row do. Where two meshes are as accurate as
    the row asks for, the results are equal, bit by bit.
    """
    return replace(settings, levels=settings.levels[:2])


def build_point_task(
    task: RowTask, point: Point, settings: Settings | None = None
) -> CaseTask:
    """Task of a point of a row's ranges; the row's settings unless others are given."""
    values = task.ranges.place(point)
    return build_task(
        build_case(task.scene, values),
        task.build or (lambda _: place_scene(task.scene, values)),
        task.layouts,
        settings or task.settings,
        task.panels,
    )
