"""One row to be checked, and one member of it, judged."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from netdesign.checks import (
    CheckResult,
    Standard,
)
from netdesign.envelope.extremes import Extreme
from netdesign.envelope.ranges import Ranges
from netdesign.envelope.rows import RowEnvelope, RowGrid
from netdesign.guideline.floor import Floor, FloorEnd
from netdesign.site.model import NetRow, Resistance, Site
from netdesign.snow.creep_law import CreepLaw
from netdesign.structure.row_position import LoadedWidth
from netdesign.study.demand import Demand
from netdesign.study.probe import Probe
from netdesign.words.message import Message


@dataclass(frozen=True, slots=True, kw_only=True)
class RowCheck:
    """One net row under one profile.

    ``find_floor`` gives the guideline's load over ranges in which something may be
    moved, ``bound_floor`` two ends of it, or None where these are not known; ``probe``
    is None where nothing beyond the solved cases is to be solved;
    ``on_check`` is called after each check of a force.
    """

    site: Site
    row: NetRow
    solved: RowGrid | RowEnvelope
    standard: Standard
    law: CreepLaw
    find_floor: Callable[[Ranges], Floor | None]
    bound_floor: Callable[[Ranges], tuple[FloorEnd, FloorEnd] | None]
    probe: Probe | None
    on_check: Callable[[], None] = lambda: None


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberCheck:
    """One member of one support in one mode, judged.

    ``extreme``, the larger of section and panel, and ``demand`` are None where no case
    was solved; ``gap`` says why the
    demand is not known as a whole, ``doubt`` why the creep law may not hold for the
    governing snow; both are None if all is well.
    """

    given: Resistance
    width: LoadedWidth
    extreme: Extreme | None
    demand: Demand | None
    gap: Message | None
    doubt: Message | None
    result: CheckResult

    @property
    def is_by_panel(self) -> bool:
        """The force by the panel between posts is larger than that of the section."""
        return self.demand is not None and self.demand.largest is not self.demand.solved

    @property
    def name(self) -> tuple[str, str]:
        """Member and mode."""
        return self.given.member, self.given.mode

    @property
    def use(self) -> float | None:
        """Utilisation for each N on a member inside the row [1/N].

        None without a resistance.
        """
        result, demand = self.result, self.demand
        if demand is None or not (result.action_factor and result.design_resistance):
            return None
        return demand.on_support * result.action_factor / result.design_resistance

    @property
    def ratio(self) -> float:
        """Upper end of the utilisation [-]; below 0 without one."""
        used = self.result.utilisation
        return used.high if used else -1.0


def is_worst(one: MemberCheck, judged: Sequence[MemberCheck]) -> bool:
    """No other support uses the member more."""
    rivals = [other for other in judged if other.name == one.name]
    return one is max(rivals, key=lambda other: other.ratio)
