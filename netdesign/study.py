"""The study as a document: one value that feeds every output.

All numbers of this module's values are in engineer's units (kN, degrees, m,
kg/m3), named in each field, exactly as the JSON document shows them.
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field
from typing import ClassVar, Literal

from netdesign.errors import StudyError
from netdesign.outcome import Outcome, Verdict
from netdesign.site.model import InputEcho, Project

SCHEMA: Literal["netdesign.study/1"] = "netdesign.study/1"


@dataclass(frozen=True, kw_only=True)
class CasePoint:
    """One point of the ranges."""

    density_kg_m3: float
    friction_deg: float
    inclination_deg: float


@dataclass(frozen=True, kw_only=True)
class CaseRecord:
    """One solved case of a net row: per-anchor forces, characteristic."""

    case: CasePoint
    outcome: Outcome
    reason: str  # "" when converged
    foot_anchor_kN: float | None
    uphill_guy_kN: float | None
    downhill_guy_kN: float | None
    post_kN: float | None
    error_percent: float | None  # estimated, of the worst of the four
    balance_residual: float | None  # relative to the weight
    is_calibrated: bool = True  # the creep law is given for this density


@dataclass(frozen=True, kw_only=True)
class ExtremeRecord:
    """Largest value of one member force over all cases, characteristic."""

    quantity: str  # "foot_anchor", "uphill_guy", "downhill_guy", "post"
    max_kN: float
    low_kN: float  # band: numerical error
    high_kN: float
    case: CasePoint
    coincident_kN: dict[str, float]  # the other members in that case


@dataclass(frozen=True, kw_only=True)
class CheckRecord:
    """One check. Demand and resistance are design values.

    The six numbers are None where they do not exist: a geometry check has no
    force; a missing resistance gives no utilisation (and never a pass).
    """

    id: str  # e.g. "foot_anchor.tendon", "geometry.inclination"
    clause: str
    member: str
    mode: str
    demand_kN: float | None
    demand_low_kN: float | None
    demand_high_kN: float | None
    resistance_kN: float | None
    utilisation: float | None
    verdict: Verdict
    case: CasePoint | None
    reason: str  # one sentence, always there
    action_kN: float | None = None  # characteristic action
    action_factor: float | None = None
    resistance_characteristic_kN: float | None = None
    resistance_factor: float | None = None
    resistance_basis: str = ""  # "tested", "computed", "declared"
    resistance_type: str = ""  # id of the anchor, rope or post type
    resistance_cell: str = ""  # "Anchors!B4"


@dataclass(frozen=True, kw_only=True)
class Arrow:
    """A force drawn at a point of the section; per anchor."""

    member: str
    x_m: float
    y_m: float
    force_x_kN: float  # what the structure does to the ground
    force_y_kN: float


@dataclass(frozen=True, kw_only=True)
class Drawing:
    """Section of the governing case, in the slope's axes [m]."""

    case: CasePoint
    slope_deg: float
    snow_thickness_m: float
    net_m: list[tuple[float, float]]  # foot to head, under load
    sticks: list[bool]  # per net point: the snow sticks there
    mesh_edges_m: list[tuple[float, float, float, float]]
    head_m: tuple[float, float]
    post_base_m: tuple[float, float]
    uphill_anchor_m: tuple[float, float]
    downhill_anchor_m: tuple[float, float]
    arrows: list[Arrow]


@dataclass(frozen=True, kw_only=True)
class MonitoringRecord:
    """What was measured at one member, and the model's history beside it.

    Missing readings are None; without a history its lists are empty and
    ``model_reason`` says why.
    """

    member: str
    source: str  # "Monitoring!A2"
    times_d: list[float]  # since the first reading
    tensions_kN: list[float | None]
    air_temperatures_C: list[float | None]
    model_times_d: list[float]
    model_kN: list[float]
    model_start: str
    model_reason: str


@dataclass(frozen=True, kw_only=True)
class RowStudy:
    """Everything about one net row."""

    id: str
    verdict: Verdict
    checks: list[CheckRecord]
    extremes: list[ExtremeRecord]
    cases: list[CaseRecord]
    inputs: list[InputEcho]
    drawing: Drawing | None  # None when no case converged
    reasons: list[str]  # why the row is not proven, or what failed; may be empty
    monitoring: list[MonitoringRecord] = field(default_factory=list)


@dataclass(frozen=True, kw_only=True)
class ProfileValue:
    """One value of the limit profile, with where it comes from."""

    id: str
    clause: str
    text: str
    value: float
    unit: str
    status: str  # "read", "secondary", "assumed", "user"
    source: str


@dataclass(frozen=True, kw_only=True)
class ProfileRecord:
    """The limit profile that was used."""

    id: str
    title: str
    edition: str
    sha256: str
    values: list[ProfileValue]


@dataclass(frozen=True, kw_only=True)
class Provenance:
    """How this study was made; enough to repeat it."""

    version: str
    command: str
    started: str  # ISO 8601, UTC
    site_file: str
    site_sha256: str
    settings: dict[str, str]
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

    schema: Literal["netdesign.study/1"]
    verdict: Verdict
    project: Project
    profile: ProfileRecord
    rows: list[RowStudy]
    range_inputs: list[InputEcho]
    notes: list[str]
    provenance: Provenance


def write_document(study: Study) -> str:
    """JSON text of a study; numbers in full, keys in the order of the fields."""
    return json.dumps(asdict(study), indent=1, ensure_ascii=False, allow_nan=False)


def read_document(text: str) -> Study:
    """Study from its JSON text.

    Raises
    ------
    StudyError
        Naming every key that is missing, unknown or of the wrong kind.
    """
    from pydantic import TypeAdapter, ValidationError

    try:
        return TypeAdapter(Study).validate_json(text)
    except ValidationError as error:
        faults = "\n".join(
            f"{'.'.join(str(part) for part in fault['loc']) or 'document'}: "
            f"{fault['msg']}"
            for fault in error.errors()
        )
        raise StudyError(f"not a study of schema {SCHEMA}:\n{faults}") from None
