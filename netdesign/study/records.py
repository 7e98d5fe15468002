"""The study as a document: one value that feeds every output.

All numbers of this module's values are in engineer's units (kN, degrees, m,
kg/m3), named in each field, exactly as the JSON document shows them.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar, Literal

from netdesign.checks.check import CasePoint, Check
from netdesign.checks.rating import OpenKind
from netdesign.checks.schema import StandardValue
from netdesign.edge.json_text import (
    Items,
    hash_values,
    join_items,
    join_members,
    list_fields,
    write_json,
)
from netdesign.outcome import Verdict, merge_verdicts
from netdesign.site.model import InputEcho, Project, ReplacedCell
from netdesign.structure.members import REPORTED_MEMBERS
from netdesign.study import frames
from netdesign.study.case_records import (
    CaseRecord,
    Drawing,
    EndGuyRecord,
    FloorRecord,
    GuidelineRecord,
    HeldSidewaysRecord,
    LargestForce,
    PartRecord,
    PullRecord,
)
from netdesign.study.conditions import Condition, merge_conditions
from netdesign.study.scopes import (
    AssumedRecord,
    Scope,
    ScopeRecord,
    merge_scopes,
    sum_up_row,
    sum_up_study,
)
from netdesign.words.message import Text, say

if TYPE_CHECKING:
    from pandas import DataFrame


@dataclass(frozen=True, kw_only=True)
class VariantRecord:
    """One other creep law on one case."""

    creep_law: str
    ratio: float | None  # force of the governing member over that of the study's model
    reason: Text | None = None  # why there is none, or why nothing was solved


@dataclass(frozen=True, kw_only=True)
class ModelFormRecord:
    """Spread of a governing force over the other creep laws."""

    case: CasePoint
    member: str  # key of the governing force
    force_kN: float  # of the study's model
    utilisation: float | None  # of the governing check
    variants: Items[VariantRecord]

    @property
    def ratios(self) -> tuple[float, float]:
        """Least and largest force of all laws over that of the study's model [-]."""
        ratios = [
            variant.ratio for variant in self.variants if variant.ratio is not None
        ]
        return min([1.0, *ratios]), max([1.0, *ratios])


SCHEMA: Literal["netdesign.study/4"] = "netdesign.study/4"


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
    is_assumed: bool  # not typed
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


@dataclass(frozen=True, kw_only=True)
class OpenPoint:
    """Reason why checks of a row are not proven, once for all of them.

    ``needs_kN`` is the least characteristic resistance that they need [kN]; None where
    none is missing.
    """

    LEAVES_OUT_NONE: ClassVar[bool] = True

    kind: OpenKind
    text: Text
    needs_kN: float | None = None


@dataclass(frozen=True, kw_only=True, repr=False)
class RowStudy:
    """Everything about one net row."""

    LEAVES_OUT_NONE: ClassVar[tuple[str, ...]] = ("reliability",)  # an option
    WRITTEN: ClassVar = ("verdict", "scopes", "open")

    id: str
    checks: Items[Check]
    forces: Items[LargestForce]  # of members first, then of panel and ropes
    cases: Items[CaseRecord]
    inputs: Items[InputEcho]
    drawing: Drawing | None  # None when no case converged
    assumed: Items[AssumedRecord] = field(default_factory=list)  # of empty columns
    pulls: Items[PullRecord] = field(default_factory=list)  # over all solved cases
    guideline: GuidelineRecord | None = None
    floor: FloorRecord | None = None  # None under a profile without a floor
    notes: Items[Text] = field(default_factory=list)
    held_sideways: HeldSidewaysRecord | None = None  # None where nothing holds it
    end_guy: EndGuyRecord | None = None  # None without one, or where nothing holds it
    model_form: ModelFormRecord | None = None  # None where nothing governs
    parts: Items[PartRecord] = field(default_factory=list)  # anchors by type
    conditions: Items[Condition] = field(default_factory=list)  # beside the numbers
    reliability: ReliabilityRecord | None = None  # None without --reliability

    @cached_property
    def verdict(self) -> Verdict:
        """Of all its checks."""
        return merge_verdicts(check.verdict for check in self.checks)

    @cached_property
    def scopes(self) -> dict[Scope, ScopeRecord]:
        """Verdicts of anchors, structure and siting, each of its own checks alone."""
        return sum_up_row(self.checks, assumed=len(self.assumed))

    def find_verdict(self, scopes: Collection[str] = ()) -> Verdict:
        """Verdict of some scopes; of the whole row where none is named."""
        return merge_scopes(self.scopes, scopes) if scopes else self.verdict

    def __repr__(self) -> str:
        """Id and verdict."""
        return f"<RowStudy {self.id!r:.60}: {self.verdict.value}>"

    @cached_property
    def open(self) -> list[OpenPoint]:
        """Open points of the checks that are not proven, each reason once."""
        points: dict[tuple[OpenKind, str], OpenPoint] = {}
        for check in self.checks:
            if check.verdict is not Verdict.NOT_PROVEN:
                continue
            for reason in check.open:
                key = (reason.kind, str(reason.message))
                point = points.setdefault(
                    key, OpenPoint(kind=reason.kind, text=reason.message)
                )
                if reason.kind is OpenKind.RESISTANCE_MISSING:
                    needs = max(point.needs_kN or 0.0, check.needed_kN or 0.0) or None
                    points[key] = replace(point, needs_kN=needs)
        return list(points.values())

    @property
    def member_forces(self) -> list[LargestForce]:
        """Largest forces of post, guys and foot anchor by the section."""
        return [force for force in self.forces if force.quantity in REPORTED_MEMBERS]

    @cached_property
    def written(self) -> str:
        """JSON text of the row in the document, made where the row is judged."""
        return write_json(self)


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
    has_maker_floor: bool = True  # nor below an anchor force that the maker states
    is_by_guideline: bool = False  # its load decides even where it is the smaller
    is_default: bool = False  # not named by the user
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


@dataclass(frozen=True, kw_only=True, repr=False)
class Study:
    """One study of one site under one profile."""

    # Read by pydantic, for this class and all values in it.
    __pydantic_config__: ClassVar = {
        "extra": "forbid",
        "strict": True,
        "allow_inf_nan": False,
    }

    WRITTEN: ClassVar = ("verdict", "scopes", "conditions")

    schema: Literal["netdesign.study/4"]
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
    def verdict(self) -> Verdict:
        """Of all its net rows; those that were left out are not proven."""
        missing = [Verdict.NOT_PROVEN] if self.left_out else []
        return merge_verdicts([*(row.verdict for row in self.rows), *missing])

    def find_verdict(self, scopes: Collection[str] = ()) -> Verdict:
        """Verdict of some scopes; of the whole study where none is named."""
        return merge_scopes(self.scopes, scopes) if scopes else self.verdict

    @cached_property
    def scopes(self) -> dict[Scope, ScopeRecord]:
        """Verdicts of anchors, structure and siting of all net rows."""
        of_rows = {row.id: row.scopes for row in self.rows}
        return sum_up_study(of_rows, is_part=bool(self.left_out))

    @cached_property
    def conditions(self) -> list[Condition]:
        """What has to hold beside the numbers, each once for all net rows."""
        return merge_conditions(
            condition for row in self.rows for condition in row.conditions
        )

    @cached_property
    def written(self) -> str:
        """JSON text of the study without its digest."""
        without = list_fields(self) | {"digest": ""}
        parts = {
            name: self.written_rows if name == "rows" else write_json(value)
            for name, value in without.items()
        }
        return join_members(parts)

    @cached_property
    def own_digest(self) -> str:
        """SHA-256 of the study without its digest."""
        return hash_values(self.written)

    def __repr__(self) -> str:
        """Name, number of net rows, verdict, profile."""
        return frames.write_repr(self)

    def _repr_html_(self) -> str:
        """Table for notebooks."""
        return frames.write_html(self)

    @cached_property
    def anchors(self) -> DataFrame:
        """Check that decides each anchor, by net row and position along it.

        Columns ``row``, ``anchor``, ``position``, ``E_k_kN``, ``E_d_kN``, ``R_d_kN``,
        ``utilisation`` [-], ``verdict``, ``assumed`` (what the row leaves empty and is
        searched), ``missing`` (what is open).
        """
        return frames.list_anchors(self)

    @cached_property
    def open(self) -> DataFrame:
        """What is not proven: ``row``, ``kind``, ``text``, ``needs_kN``."""
        return frames.list_open(self)

    @cached_property
    def forces(self) -> DataFrame:
        """Largest forces with their cases: ``row``, ``force``, ``value_kN``, ..."""
        return frames.list_forces(self)

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
        return frames.list_checks(self)

    @cached_property
    def written_rows(self) -> str:
        """Net rows in the document."""
        return join_items([row.written for row in self.rows])


_TABLES = ("rows", "net_types", "project")  # with columns of a net row


def find_input(row: RowStudy, column: str) -> float | None:
    """Number of a column of a net row, as understood; None where it is empty."""
    labels = [say(f"column.{table}.{column}") for table in _TABLES]
    texts = (echo.value for echo in row.inputs if echo.label in labels)
    value = next((text for text in texts if text != ""), None)
    return None if isinstance(value, str) else value
