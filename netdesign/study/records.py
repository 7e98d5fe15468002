"""The study as a document: one value that feeds every output.

All numbers of this module's values are in engineer's units (kN, degrees, m,
kg/m3), named in each field, exactly as the JSON document shows them.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar, Literal

from netdesign.calculation.steps import Step
from netdesign.checks.loader import StandardValue
from netdesign.checks.result import Proof
from netdesign.edge.json_text import (
    Items,
    JsonPart,
    join_items,
    join_members,
    list_fields,
    write_part,
)
from netdesign.outcome import Verdict, merge_verdicts
from netdesign.site.model import InputEcho, Project, ReplacedCell
from netdesign.study.case_records import (
    CasePoint,
    CaseRecord,
    EnvelopeRecord,
    ExtremeRecord,
    FloorRecord,
    ForceRecord,
    GuidelineRecord,
)
from netdesign.study.parts import PartRecord
from netdesign.study.support_records import (
    AnchorRecord,
    Drawing,
    HeadForce,
    HeldSidewaysRecord,
    PanelRecord,
    PullRecord,
)
from netdesign.words.message import Message, Text, say

if TYPE_CHECKING:
    from pandas import DataFrame


@dataclass(frozen=True, kw_only=True)
class VariantRecord:
    """One other creep law on one case."""

    creep_law: str
    slip_length_m: float | None  # of sliding ground: rematched where N was typed
    is_calibrated: bool  # the set is given for this snow
    foot_anchor_kN: float | None
    uphill_guy_kN: float | None
    post_kN: float | None
    ratio: float | None  # force of the governing member over that of the study's model
    reason: Text | None = None  # why there is none, or why nothing was solved


@dataclass(frozen=True, kw_only=True)
class ModelFormRecord:
    """Spread of a governing force over the other creep laws."""

    case: CasePoint
    member: str  # key of the governing force
    force_kN: float  # of the study's model
    low_ratio: float  # least and largest over all variants with a force, and 1
    high_ratio: float
    utilisation: float | None  # of the governing check
    utilisation_low: float | None  # of the same, in proportion
    utilisation_high: float | None
    numerical_low: float | None  # interval of the same check
    numerical_high: float | None
    solves: int  # that this took
    variants: Items[VariantRecord]


SCHEMA: Literal["netdesign.study/3"] = "netdesign.study/3"


@dataclass(frozen=True, kw_only=True)
class SpreadRecord:
    """One part of the interval of a utilisation."""

    source: Text  # "numerical error", "between the cases"
    low: float | None  # None where there is no number; ``note`` says why
    high: float | None
    note: Text | None = None


@dataclass(frozen=True, kw_only=True)
class ChangeRecord:
    """The smallest change of one quantity that flips a check."""

    quantity: Text  # "characteristic resistance", "post spacing", "type B", ...
    unit: str
    now: float | None
    bound: float | None  # None where no value flips the check
    sense: Literal["at least", "at most", "has"]
    note: Text | None = None


@dataclass(frozen=True, kw_only=True)
class SingleTestRecord:
    """One pull-out test."""

    cell: str  # "Tests!C2"
    load_kN: float  # largest that the anchor held
    is_held: bool | None  # False: it was pulled out; None: not said
    proof_load_kN: float | None  # that the test was to reach
    displacement_mm: float | None


@dataclass(frozen=True, kw_only=True)
class TestsRecord:
    """Pull-out tests of a type."""

    __test__: ClassVar = False  # for pytest

    count: int
    least_kN: float
    mean_kN: float
    singles: Items[SingleTestRecord]  # empty where each is not given
    proof_factor: float | None  # proof load over design force


@dataclass(frozen=True, kw_only=True)
class CheckRecord:
    """One check. Demand and resistance are design values.

    The three numbers are None where they do not exist: a geometry check has no force; a
    missing resistance gives no utilisation (and never a pass). ``steps`` is the whole
    calculation, from what is given and solved to the utilisation.
    Where nothing is left to resist the demand, ``is_unbounded`` says so: JSON has no
    infinite number, so ``utilisation`` is None there, too.
    """

    id: str  # e.g. "foot_anchor.tendon", "geometry.inclination"
    clause: str
    member: str
    mode: str
    demand_kN: float | None
    resistance_kN: float | None
    utilisation: float | None
    verdict: Verdict
    case: CasePoint | None
    reason: Text  # one sentence, always there
    governs: str = ""  # "coupled", "panel", "guideline"; "" of a check without a force
    load_case: str = ""  # of the guideline: "load_case_1" or "load_case_2"
    load_inclination_deg: float | None = None  # at which it is largest
    resistance_basis: str = ""  # "tested", "computed", "declared"
    resistance_type: str = ""  # id of the anchor, rope or post type
    resistance_cell: str = ""  # "Anchors!B4"
    resistance_years: int | None = None  # for which its steel lasts; None: not known
    resistance_derivation: Text | None = None  # how it follows from dimensions or tests
    tests: TestsRecord | None = None  # of a pull-out resistance that is from them
    steps: Items[Step] = field(default_factory=list)
    declared: Proof | None = None  # whatever the verdict
    spreads: Items[SpreadRecord] = field(default_factory=list)
    changes: Items[ChangeRecord] = field(default_factory=list)
    position: str = ""  # of its support: "intermediate" or "edge"; "" of geometry
    is_unbounded: bool = False  # utilisation beyond any number; the check fails

    @cached_property
    def known(self) -> dict[str, Step]:
        """Steps by their symbols."""
        return {step.symbol: step for step in self.steps}

    def read(self, symbol: str) -> float | None:
        """Value of a step, in its unit; None where it is missing."""
        step = self.known.get(symbol)
        return step.value if step else None

    def read_band(self, symbol: str) -> tuple[float | None, float | None]:
        """Low and high end of a step."""
        step = self.known.get(symbol)
        return (step.ends[0], step.ends[2]) if step else (None, None)

    @property
    def is_of_force(self) -> bool:
        """It compares a force that is known with a resistance."""
        return bool(self.governs)

    @property
    def is_by_panel(self) -> bool:
        """The force by the panel between posts is larger than that of the section."""
        by_panel = self.read_band(self.name_force("p"))[1] or 0.0
        return by_panel > (self.read_band(self.name_force("c"))[1] or 0.0)

    def name_force(self, load: str) -> str:
        """Symbol of a force on the support: of a base that slides, that across it.

        ``load`` is "c", "p" or "g": of section, panel, guideline. Without another load
        that of the section is E_k itself.
        """
        letter = "V" if "V_k" in self.known else "E"
        name = f"{letter}_{load}"
        is_alone = load == "c" and name not in self.known
        return f"{letter}_k" if is_alone else name

    @property
    def used(self) -> float | None:
        """Utilisation to sort and to show by [-]: infinite where it has no bound."""
        return math.inf if self.is_unbounded else self.utilisation

    @property
    def used_band(self) -> tuple[float | None, float | None]:
        """Utilisation at both ends of the demand, as `used` [-]."""
        if self.is_unbounded:
            return math.inf, math.inf
        return self.utilisation_band

    @property
    def utilisation_band(self) -> tuple[float | None, float | None]:
        """Utilisation at the low and at the high end of the demand [-]."""
        return self.read_band("μ")


@dataclass(frozen=True, kw_only=True)
class MonitoringRecord:
    """Measurements at one member; missing readings are None.

    ``model`` says where the model's forces on these dates stand, or what they need.
    """

    member: str
    source: str  # "Monitoring!A2"
    times_d: Items[float]  # since the first reading
    tensions_kN: Items[float | None]
    air_temperatures_C: Items[float | None]
    model: Text


@dataclass(frozen=True, kw_only=True)
class IndependentRecord:
    """One law that the drawn case must obey whatever the mesh."""

    name: str  # "global_balance", "end_direction", "capstan_ratio", ...
    value: float | None  # a share or a ratio [-]
    limit: float | None  # None where nothing bounds it
    is_met: bool


@dataclass(frozen=True, kw_only=True)
class VariableRecord:
    """One random variable of a limit state.

    Resistance and model factor are over their characteristic values.
    """

    name: str  # "snow_height", "density", ..., "model", "resistance"
    key: str  # of its unit: "height_vertical_m"; "" of a ratio
    distribution: str  # "gumbel", "lognormal", "normal"
    mean: float
    variation: float  # coefficient of variation [-]
    source: Text
    is_assumed: bool  # nobody typed it
    alpha_squared: float | None = None  # share in beta squared [-]
    at_design_point: float | None = None


@dataclass(frozen=True, kw_only=True)
class ReliabilityRecord:
    """Notional annual reliability of one check; no part of any verdict.

    Without a ``beta`` the ``reason`` says why.
    """

    check: str  # its id; "" where no check governs
    reason: Text | None
    variables: Items[VariableRecord] = field(default_factory=list)
    beta: float | None = None  # by sampling
    standard_error: float | None = None  # of the sampling
    beta_by_form: float | None = None
    beta_at_full: float | None = None  # of the same row at utilisation 1
    action_factor: float | None = None  # implied: force at the design point over E_k
    resistance_factor: float | None = None  # implied: R_k over that at the design point
    profile_action_factor: float | None = None
    profile_resistance_factor: float | None = None
    design_point: CasePoint | None = None
    force_ratio: float | None = None  # at the design point over E_k, solved again
    force_ratio_by_model: float | None = None  # the same before it was solved
    samples: int = 0
    solves: int = 0


def merge_rows(rows: Iterable[RowStudy], left_out: Sequence[str]) -> Verdict:
    """Verdict of a study: of all its net rows, those that were left out not proven."""
    missing = [Verdict.NOT_PROVEN] if left_out else []
    return merge_verdicts([*(row.verdict for row in rows), *missing])


def list_verdicts(
    checks: Sequence[CheckRecord], independent: Sequence[IndependentRecord]
) -> list[Verdict]:
    """Verdicts that make up that of a row; a law that is not met leaves it unproven."""
    unmet = [Verdict.NOT_PROVEN for law in independent if not law.is_met]
    return [*(check.verdict for check in checks), *unmet]


@dataclass(frozen=True, kw_only=True)
class RowStudy:
    """Everything about one net row."""

    LEAVES_OUT_NONE: ClassVar[tuple[str, ...]] = ("reliability",)  # nobody asked for it

    id: str
    verdict: Verdict
    checks: Items[CheckRecord]
    extremes: Items[ExtremeRecord]
    cases: Items[CaseRecord]
    inputs: Items[InputEcho]
    drawing: Drawing | None  # None when no case converged
    reasons: Items[Text]  # why the row is not proven, or what failed; may be empty
    unsaid: Items[Message] = field(default_factory=list)  # empty columns that decide
    questions: Items[Message] = field(default_factory=list)  # numbers hardly meant
    monitoring: Items[MonitoringRecord] = field(default_factory=list)
    anchors: Items[AnchorRecord] = field(default_factory=list)  # in the drawn case
    head: Items[HeadForce] = field(default_factory=list)  # in the drawn case
    pulls: Items[PullRecord] = field(default_factory=list)  # over all solved cases
    forces: Items[ForceRecord] = field(default_factory=list)  # that checks rest on
    guideline: GuidelineRecord | None = None
    floor: FloorRecord | None = None  # None under a profile without a floor
    notes: Items[Text] = field(default_factory=list)
    independent: Items[IndependentRecord] = field(default_factory=list)
    envelope: EnvelopeRecord | None = None  # None for a grid of cases
    panel: PanelRecord | None = None  # None: a metre of net times the post spacing
    held_sideways: HeldSidewaysRecord | None = None  # None where nothing holds it
    tilt: float = 0.0  # largest force along the slope at a post's base over that across
    model_form: ModelFormRecord | None = None  # None where nothing governs
    parts: Items[PartRecord] = field(default_factory=list)  # that it is built of
    reliability: ReliabilityRecord | None = None  # None where nobody asks for it

    @cached_property
    def written(self) -> JsonPart:
        """Itself in the document; a process that judges rows sends it along."""
        return write_part(self)


@dataclass(frozen=True, kw_only=True)
class ProfileRecord:
    """The limit profile that was used."""

    id: str
    title: str
    edition: str
    sha256: str
    values: Items[StandardValue]
    version: str = ""
    choice: str = ""  # set of factors in force; "" where the profile has none
    choice_text: str = ""  # what that set is
    floor: str = "guideline"  # what no demand lies below: or "none"
    shared_sum: str = "vector"  # of the pulls of two guys on one anchor
    is_floor_overruled: bool = False  # the profile itself takes the other one
    is_default: bool = False  # nobody named it
    proof_factor: float | None = None  # load of a test over the design force it proves
    not_checked: Items[str] = field(default_factory=list)  # topics that others check


@dataclass(frozen=True, kw_only=True)
class Provenance:
    """Origin of this study; enough to repeat it."""

    version: str
    started: str  # ISO 8601, UTC
    site_file: str
    site_sha256: str
    settings: dict[str, str]  # by key: "method", "creep_law", "accuracy", ...
    libraries: dict[str, str]


@dataclass(frozen=True, kw_only=True)
class Study:
    """One study of one site under one profile."""

    # Read by pydantic, for this class and all values in it.
    __pydantic_config__: ClassVar = {
        "extra": "forbid",
        "strict": True,
        "allow_inf_nan": False,
    }

    schema: Literal["netdesign.study/3"]
    verdict: Verdict
    what_if: Items[ReplacedCell] = field(default_factory=list)  # of no site as built
    left_out: Items[str] = field(default_factory=list)  # net rows that were not checked
    project: Project
    profile: ProfileRecord
    rows: Items[RowStudy]
    range_inputs: Items[InputEcho]
    notes: Items[Text]
    provenance: Provenance
    digest: str = ""  # SHA-256 of all the rest, as ``write_document`` puts it there

    @cached_property
    def written(self) -> JsonPart:
        """Document without its digest: page and document want both."""
        without = list_fields(self) | {"digest": ""}
        parts = {
            name: self.written_rows if name == "rows" else write_part(value)
            for name, value in without.items()
        }
        return join_members(parts)

    def to_frame(self) -> DataFrame:
        """Checks of all net rows as a table of pandas, one line each.

        Returns
        -------
        DataFrame
            ``row``, ``member``, ``mode``, ``position`` and ``type`` say which check;
            ``verdict``, ``utilisation`` with its ends ``utilisation_low`` and
            ``utilisation_high`` [-], ``demand_kN`` and ``resistance_kN`` what it gives,
            None where it is not known.
        """
        from pandas import DataFrame

        return DataFrame(
            [
                {
                    "row": row.id,
                    "member": one.member,
                    "mode": one.mode,
                    "position": one.position,
                    "type": one.resistance_type,
                    "verdict": one.verdict.value,
                    "utilisation": one.utilisation,
                    "utilisation_low": one.utilisation_band[0],
                    "utilisation_high": one.utilisation_band[1],
                    "demand_kN": one.demand_kN,
                    "resistance_kN": one.resistance_kN,
                }
                for row in self.rows
                for one in row.checks
            ]
        )

    @cached_property
    def written_rows(self) -> JsonPart:
        """Net rows in the document."""
        return join_items([row.written for row in self.rows])


def find_input(row: RowStudy, column: str) -> float | None:
    """Number of a column of sheet Nets, as understood; None where it is empty."""
    value = _find(row, column)
    return None if isinstance(value, str) else value


def find_word(row: RowStudy, column: str) -> str:
    """Word of a column of sheet Nets, by its key; "" where it is empty."""
    value = _find(row, column)
    return value if isinstance(value, str) else ""


def _find(row: RowStudy, column: str) -> float | str | None:
    label = say(f"column.Nets.{column}")
    return next((one.value for one in row.inputs if one.label == label), None)
