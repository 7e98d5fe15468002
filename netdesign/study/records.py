"""The study as a document: one value that feeds every output.

All numbers of this module's values are in engineer's units (kN, degrees, m,
kg/m3), named in each field, exactly as the JSON document shows them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import ClassVar, Literal

from netdesign.edge.json_text import list_fields
from netdesign.outcome import Outcome, Verdict
from netdesign.site.model import InputEcho, Project
from netdesign.words.text_field import Text

SCHEMA: Literal["netdesign.study/2"] = "netdesign.study/2"


@dataclass(frozen=True, kw_only=True)
class CasePoint:
    """One point of the ranges; what does not range beside the first three is None.

    The document leaves that out.
    """

    LEAVES_OUT_NONE: ClassVar[bool] = True

    density_kg_m3: float
    friction_deg: float
    inclination_deg: float
    thickness_m: float | None = None
    height_vertical_m: float | None = None
    upslope_length_m: float | None = None
    slack: float | None = None
    stiffness_kN_per_m: float | None = None
    slip_length_m: float | None = None
    glide_factor: float | None = None

    @property
    def values(self) -> dict[str, float]:
        """Values by their keys."""
        return list_fields(self)


@dataclass(frozen=True, kw_only=True)
class CaseRecord:
    """One solved case of a net row: per-anchor forces, characteristic."""

    case: CasePoint
    outcome: Outcome
    reason: Text | None  # None when converged
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
    upper_bound_kN: float | None = None  # None for a grid, which has no bound


@dataclass(frozen=True, kw_only=True)
class AxisRecord:
    """One quantity that ranges; unit in its key."""

    key: str  # "density_kg_m3"
    low: float
    high: float


@dataclass(frozen=True, kw_only=True)
class DriverRecord:
    """Answer of one force to one quantity that ranges."""

    key: str
    at_low_kN: float  # the others as in the governing case
    at_high_kN: float
    least_kN: float
    most_kN: float
    first_order: float  # Sobol index
    total: float


@dataclass(frozen=True, kw_only=True)
class FlipRecord:
    """A value at which a check flips, the others as in the governing case."""

    check: str  # id of the check
    key: str
    value: float


@dataclass(frozen=True, kw_only=True)
class LineRecord:
    """Force along one quantity through the governing case."""

    key: str
    values: list[float]
    force_kN: list[float]
    bound_kN: list[float]


@dataclass(frozen=True, kw_only=True)
class MapRecord:
    """Force over density and friction at one inclination; rows are frictions."""

    inclination_deg: float
    density_kg_m3: list[float]
    friction_deg: list[float]
    force_kN: list[list[float]]


@dataclass(frozen=True, kw_only=True)
class ConfirmationRecord:
    """The governing case solved again by another fidelity."""

    method: str
    screened_kN: float
    confirmed_kN: float | None
    difference_percent: float | None
    elements: int | None
    screened_elements: int
    reason: Text | None  # why there is no confirmation


@dataclass(frozen=True, kw_only=True)
class BoundRecord:
    """Largest value of one force anywhere in the ranges.

    Per anchor; per metre of width where the envelope says so.
    """

    quantity: str
    max_kN: float
    upper_bound_kN: float  # with what may hide between the cases
    case: dict[str, float]
    coincident_kN: dict[str, float]
    unexplained: float | None  # error of the Sobol indices: share of the variance
    drivers: list[DriverRecord]
    flips: list[FlipRecord]
    lines: list[LineRecord]
    maps: list[MapRecord]
    confirmation: ConfirmationRecord | None


@dataclass(frozen=True, kw_only=True)
class AdditionRecord:
    """One line of the densification log."""

    round: int
    reason: str
    quantity: str
    case: dict[str, float]
    predicted_kN: float | None
    claimed_kN: float | None  # one standard error of the prediction
    found_kN: float | None


@dataclass(frozen=True, kw_only=True)
class EnvelopeRecord:
    """Search for the largest forces of a net row, and what may hide."""

    axes: list[AxisRecord]
    is_per_metre: bool
    is_closed: bool  # every gap is within the one asked for
    gap_asked_percent: float
    certainty: float  # standard errors in an upper bound
    resolved_share: float  # narrower features may hide, as a share of a range
    cases: int
    skipped: int  # known without a solve, since the snow stuck with less friction
    skips_tested: int
    failed: int
    bounds: list[BoundRecord]
    log: list[AdditionRecord]


@dataclass(frozen=True, kw_only=True)
class SidewaysRecord:
    """Load along the row at the head, as one member has it: (S17), (S18)."""

    part: float  # c of a guy, w of the post [-]
    share: float  # of the pull on the head, along the row [-]
    pull_kN: float  # largest on a head, of a support inside a row
    splay_deg: float
    least_tension_kN: float | None  # of the guys at work; None in a guy


@dataclass(frozen=True, kw_only=True)
class ActionRecord:
    """Steps from the solved force of a support to its characteristic force."""

    solved_kN: float  # of a support inside a row, over the envelope
    post_spacing_m: float
    position: str  # "intermediate", or "edge": the first or last support
    loaded_width_m: float
    end_factor: float  # f_R, 0 inside a row
    end_length_m: float
    lateral_factor: float
    coupled_kN: float  # on this support: upper end, with what may hide
    other_width_m: float | None = None  # on the other side of a threshold close by
    floor_kN: float | None = None  # the guideline's, inside a row; None: no floor
    guideline_kN: float | None = None  # the same on this support
    floor_case: str = ""  # "load_case_1" or "load_case_2"
    floor_inclination_deg: float | None = None  # at which it is largest
    governs: str = "coupled"  # or "panel", "guideline": the largest of the three
    share: float = 1.0  # of the solved force, in this member or along the slope
    added_kN: float = 0.0  # by the load along the row at the head
    added_low_kN: float = 0.0
    added_high_kN: float = 0.0
    sideways: SidewaysRecord | None = None  # what ``added_kN`` follows from
    solved_low_kN: float | None = None  # ends of the band of ``solved_kN``;
    solved_high_kN: float | None = None  # the upper one with what may hide
    foot_part_kN: float | None = None  # of an anchor that carries net and uphill guy
    guy_part_kN: float | None = None
    panel_kN: float | None = None  # by the panel between posts, as ``solved_kN``
    panel_low_kN: float | None = None
    panel_support_kN: float | None = None  # as ``coupled_kN``
    along_kN: float = 0.0  # of it by the end guy, on the post at the row's end
    along_low_kN: float = 0.0
    along_high_kN: float = 0.0

    @property
    def governing(self) -> str:
        """Largest one of the three by their numbers, as ``governs`` has it."""
        largest = max(self.coupled_kN, self.panel_support_kN or 0.0)
        if self.guideline_kN and self.guideline_kN >= largest:
            return "guideline"
        return "panel" if self.is_by_panel else "coupled"

    @property
    def is_by_panel(self) -> bool:
        """The force by the panel between posts is larger than that of the section."""
        return (self.panel_support_kN or 0.0) > self.coupled_kN


@dataclass(frozen=True, kw_only=True)
class SpreadRecord:
    """One part of the interval of a utilisation."""

    source: Text  # "numerical error", "between the cases", "creep law zwinger-2007"
    low: float | None  # None where there is no number; ``note`` says why
    high: float | None
    in_verdict: bool
    note: Text | None = None


@dataclass(frozen=True, kw_only=True)
class ChangeRecord:
    """The smallest change of one quantity that flips a check, or where it flips."""

    quantity: Text  # "characteristic resistance", "post spacing", "density", ...
    unit: str
    now: float | None
    bound: float | None  # None where no value in reach flips the check
    sense: Literal["at least", "at most", "has"]
    solves: int  # coupled solves that it took; 0 for an exact proportion
    note: Text | None = None


@dataclass(frozen=True, kw_only=True)
class DeclarationRecord:
    """Place of a proof elsewhere, with its author and date."""

    document: str
    author: str
    date: str  # "" where none is given
    cell: str  # "Declared!B2"


@dataclass(frozen=True, kw_only=True)
class HoldRecord:
    """Limits of one single quantity, moved alone, beyond which a check turns.

    Of a check that passes: it holds from ``least`` to ``most``. Of one that does not:
    it would pass from ``least`` on, and up to ``most``. None where it does not turn
    on that side within the search. Values in the unit of ``quantity``, a key.
    """

    quantity: str  # "slack", "stiffness_kN_per_m", ...
    now: float
    least: float | None
    most: float | None
    low: float  # ends of the search
    high: float
    solves: int  # beyond those that other checks took
    note: Text | None = None


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
    reason: Text  # one sentence, always there
    action_kN: float | None = None  # characteristic action
    action_factor: float | None = None
    resistance_characteristic_kN: float | None = None
    resistance_factor: float | None = None
    resistance_basis: str = ""  # "tested", "computed", "declared"
    resistance_type: str = ""  # id of the anchor, rope or post type
    resistance_cell: str = ""  # "Anchors!B4"
    resistance_derivation: Text | None = None  # how it follows from dimensions or tests
    action: ActionRecord | None = None
    declared: DeclarationRecord | None = None  # whatever the verdict
    spreads: list[SpreadRecord] = field(default_factory=list)
    changes: list[ChangeRecord] = field(default_factory=list)
    holds: list[HoldRecord] = field(default_factory=list)
    position: str = ""  # of its support: "intermediate" or "edge"; "" of geometry

    @property
    def utilisation_band(self) -> tuple[float | None, float | None]:
        """Utilisation at the low and at the high end of the demand [-]."""
        low, high, resistance = (
            self.demand_low_kN,
            self.demand_high_kN,
            self.resistance_kN,
        )
        if not resistance or low is None or high is None:
            return None, None
        return low / resistance, high / resistance


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
    """Measurements at one member, and the model's history beside them.

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
    model_reason: Text | None


@dataclass(frozen=True, kw_only=True)
class AnchorRecord:
    """Force of the structure on the ground at one point, in the drawn case."""

    anchor: str  # "foot_anchor", "uphill_anchor", "downhill_anchor", "post_base"
    member: str  # what brings it: "net", "uphill_guy", "downhill_guy", "post"
    force_x_kN: float  # downslope
    force_y_kN: float  # out of the ground
    lateral_kN: float  # along the row, either way; share of the profile
    size_kN: float  # in the section
    direction_deg: float | None  # 0 downslope, 90 out of the ground; None if slack


@dataclass(frozen=True, kw_only=True)
class PullRecord:
    """Directions of the pulls on one anchor over all solved cases, and its axis.

    Counted from the slope surface, in the direction along the slope in which the anchor
    is pulled; 90 is straight out of the ground.
    """

    anchor: str
    position: str  # "intermediate", or "edge" of types of the row's end alone
    kind: str  # "bar", "micropile", "rope anchor", or "" where none is given
    least_deg: float
    largest_deg: float
    axis_deg: float
    is_axis_given: bool  # else the middle of the pulls
    angle_deg: float  # largest between pull and axis, with the part along the row


@dataclass(frozen=True, kw_only=True)
class HeadForce:
    """One force on the post head; those of a head sum up to zero."""

    member: str
    x_kN: float
    y_kN: float


@dataclass(frozen=True, kw_only=True)
class GuidelineCase:
    """One load case of the guideline on this row; characteristic, inside a row."""

    name: str  # "same_snow", "load_case_1", "load_case_2"
    density_kg_m3: float
    height_vertical_m: float
    creep_factor: float | None
    glide_factor: float | None
    rigid_kN_per_m: float | None  # S'_N on a rigid wall
    load_kN_per_m: float | None  # along the slope on the net, with the prism
    foot_anchor_kN: float | None
    uphill_guy_kN: float | None
    post_kN: float | None
    load_difference_percent: float | None  # of the coupled solve against this
    foot_difference_percent: float | None
    reason: Text | None = None


@dataclass(frozen=True, kw_only=True)
class GuidelineRecord:
    """Independent check of a row by the guideline's load model."""

    profile: str  # whose numbers
    sha256: str
    case: CasePoint  # of the coupled solve
    solved_load_kN_per_m: float  # along the slope on the net
    solved_foot_anchor_kN: float
    cases: list[GuidelineCase]
    sentence: Text  # why the two differ


@dataclass(frozen=True, kw_only=True)
class FloorForceRecord:
    """Largest force of the guideline's load in one member, inside the row."""

    member: str
    force_kN: float  # characteristic
    load_case: str  # "load_case_1" or "load_case_2"
    inclination_deg: float  # of the net, where the force is largest
    snow_thickness_m: float  # of the snow that is held, there as well
    slack: float
    stiffness_kN_per_m: float
    density_kg_m3: float
    height_vertical_m: float
    creep_factor: float
    glide_factor: float
    load_along_kN_per_m: float  # on the net, downslope, with the prism
    load_across_kN_per_m: float  # out of the ground
    chord_tension_kN_per_m: float


@dataclass(frozen=True, kw_only=True)
class FloorRecord:
    """Forces that no demand of a row lies below, by the guideline's load cases."""

    profile: str  # whose load model
    sha256: str
    forces: list[FloorForceRecord]  # empty where the floor is not available
    altitude_factor: float  # on the density of load case 1
    assumed: list[Text] = field(default_factory=list)  # of the row, for its load
    reason: Text | None = None  # why it is not


@dataclass(frozen=True, kw_only=True)
class GuidelineLoadRecord:
    """The guideline's load on a net, for each metre of width: (G1) to (G9)."""

    load_case: str  # "load_case_1" or "load_case_2"
    inclination_deg: float
    snow_thickness_m: float
    density_kg_m3: float
    height_vertical_m: float
    creep_factor: float
    glide_factor: float
    rigid_kN_per_m: float
    parallel_kN_per_m: float
    normal_kN_per_m: float
    prism_kN_per_m: float
    load_along_kN_per_m: float
    load_across_kN_per_m: float
    loaded_share: float  # of the chord, from the foot
    stiffness_kN_per_m: float
    slack: float
    chord_tension_kN_per_m: float


@dataclass(frozen=True, kw_only=True)
class StaticsRecord:
    """Way from the net's end pulls to the members of a support inside the row.

    (S1) to (S8). X along the slope from the net's foot, Y out of the ground.
    """

    brings: list[str]  # members that it loads most; "head_pull", "foot_least", ...
    case: CasePoint | None  # None under the guideline's load
    load: GuidelineLoadRecord | None
    foot_x_kN_per_m: float
    foot_y_kN_per_m: float
    foot_error_kN_per_m: float
    head_x_kN_per_m: float
    head_y_kN_per_m: float
    head_error_kN_per_m: float
    head_x_m: float
    head_y_m: float
    base_x_m: float
    uphill_x_m: float
    downhill_x_m: float
    foot_anchor_kN: float  # of the net alone
    uphill_guy_kN: float
    downhill_guy_kN: float
    post_kN: float
    post_base_kN: float  # across the plate
    is_by_panel: bool = False  # pulls are the means of a bay between two posts
    mid_foot_kN: float = 0.0  # of an anchor in mid-panel


@dataclass(frozen=True, kw_only=True)
class HeldSidewaysRecord:
    """Numbers of a row that the load along it follows from: (S15) to (S18)."""

    share: float
    splay_deg: float
    pull_low_kN: float  # largest pull on a head, over cases and floor
    pull_kN: float
    pull_high_kN: float
    solved_tension_kN: float  # least of the guys at work, low end over the cases
    hidden_tension_kN: float  # what may hide of it between the cases
    floor_tension_kN: float | None
    least_tension_kN: float
    uphill_part: float  # c of the uphill guy, and the inclination where it is largest
    uphill_at_deg: float
    downhill_part: float
    downhill_at_deg: float
    post_part: float  # w
    post_at_deg: float


@dataclass(frozen=True, kw_only=True)
class IndependentRecord:
    """One law that the drawn case must obey whatever the mesh."""

    name: str  # "global_balance", "end_direction", "capstan_ratio", ...
    value: float | None  # a share or a ratio [-]
    limit: float | None  # None where nothing bounds it
    is_met: bool


@dataclass(frozen=True, kw_only=True)
class RopeRecord:
    """A border rope: what it is, and its largest forces, upper ends.

    They are upper figures to a tenth, and information: no check rests on them alone.
    """

    rope: str  # "lower" or "upper"
    type: str  # id of sheet Ropes
    stiffness_kN: float  # EA
    sag: float  # as built, over the post spacing
    along_kN: float | None  # along the row; None where no case has a panel
    tension_kN: float | None
    breaking_kN: float | None  # None where none is given
    cell: str  # of the breaking force, else of the id


@dataclass(frozen=True, kw_only=True)
class PanelDrawing:
    """Panel of the drawn case: half of it, from a post to mid-panel.

    Axes of the section: X downslope from the net's foot, Y out of the ground.
    """

    case: CasePoint
    places_m: list[float]  # along the row, from beside the post to mid-panel
    post_head_m: tuple[float, float]
    lower_m: list[tuple[float, float]]
    upper_m: list[tuple[float, float]]
    mid_net_m: list[tuple[float, float]]  # foot to head, in mid-panel
    rope_places_m: list[float]  # those of the tensions, from the post on
    lower_tensions_kN: list[float]
    upper_tensions_kN: list[float]
    foot_kN: tuple[float, float]  # on the foot anchor beside a post, of a bay
    mid_foot_kN: tuple[float, float]
    head_kN: tuple[float, float]  # on a post head
    section_foot_kN: tuple[float, float]  # the same by the section
    section_head_kN: tuple[float, float]
    lower_along_kN: float
    upper_along_kN: float


@dataclass(frozen=True, kw_only=True)
class PanelRecord:
    """Panel between two posts of a row, inside it."""

    cut: str  # "uniform", "upper" or "fitted"
    has_mid_anchors: bool
    ropes: list[RopeRecord]
    extremes: list[ExtremeRecord]  # quantities "panel_foot_anchor", ...
    failed: int = 0  # solved cases without forces by the panel
    effective_height_m: float | None = None  # least in mid-panel, normal to the slope
    lift_m: float | None = None  # largest of the lower rope in mid-panel
    end_guy_deg: float | None = None  # angle to the row; None where none is given
    drawing: PanelDrawing | None = None  # None where the drawn case has no panel


def list_verdicts(
    checks: Sequence[CheckRecord], independent: Sequence[IndependentRecord]
) -> list[Verdict]:
    """Verdicts that make up that of a row; a law that is not met leaves it unproven."""
    unmet = [Verdict.NOT_PROVEN for law in independent if not law.is_met]
    return [*(check.verdict for check in checks), *unmet]


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
    reasons: list[Text]  # why the row is not proven, or what failed; may be empty
    monitoring: list[MonitoringRecord] = field(default_factory=list)
    anchors: list[AnchorRecord] = field(default_factory=list)  # in the drawn case
    head: list[HeadForce] = field(default_factory=list)  # in the drawn case
    pulls: list[PullRecord] = field(default_factory=list)  # over all solved cases
    guideline: GuidelineRecord | None = None
    floor: FloorRecord | None = None  # None under a profile without a floor
    notes: list[Text] = field(default_factory=list)
    independent: list[IndependentRecord] = field(default_factory=list)
    envelope: EnvelopeRecord | None = None  # None for a grid of cases
    panel: PanelRecord | None = None  # None: a metre of net times the post spacing
    statics: list[StaticsRecord] = field(default_factory=list)  # of governing cases
    held_sideways: HeldSidewaysRecord | None = None  # None where nothing holds it


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
    reason_below_one: str = ""  # why a factor may lie below 1


@dataclass(frozen=True, kw_only=True)
class ProfileRecord:
    """The limit profile that was used."""

    id: str
    title: str
    edition: str
    sha256: str
    values: list[ProfileValue]
    version: str = ""
    choice: str = ""  # set of factors in force; "" where the profile has none
    floor: str = "guideline"  # what no demand lies below: or "none"


@dataclass(frozen=True, kw_only=True)
class Provenance:
    """Origin of this study; enough to repeat it."""

    version: str
    command: str
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

    schema: Literal["netdesign.study/2"]
    verdict: Verdict
    project: Project
    profile: ProfileRecord
    rows: list[RowStudy]
    range_inputs: list[InputEcho]
    notes: list[Text]
    provenance: Provenance
    digest: str = ""  # SHA-256 of all the rest, as ``write_document`` puts it there
