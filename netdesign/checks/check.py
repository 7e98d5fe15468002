"""A check: its calculation, its open points, and the verdict from both."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from typing import ClassVar, Literal

from netdesign.calculation.steps import Step, list_operands
from netdesign.checks.inputs import Proof
from netdesign.checks.rating import Open, OpenKind, Rating
from netdesign.edge.json_text import Items
from netdesign.outcome import SEVERITY, Verdict
from netdesign.words.catalogue import name
from netdesign.words.message import Message, Text, say


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
        pairs = ((field.name, getattr(self, field.name)) for field in fields(self))
        return {key: value for key, value in pairs if value is not None}


@dataclass(frozen=True, kw_only=True)
class Change:
    """The smallest change of one resistance that flips a check [kN]."""

    quantity: Text  # "characteristic resistance", "type B of the workbook"
    now: float | None
    bound: float
    sense: Literal["at least", "has"]
    note: Text | None = None


@dataclass(frozen=True, kw_only=True)
class SingleTest:
    """One pull-out test."""

    cell: str  # "Tests!C2"
    load_kN: float  # largest that the anchor held
    is_held: bool | None  # False: it was pulled out; None: not said
    proof_load_kN: float | None  # that the test was to reach
    displacement_mm: float | None


@dataclass(frozen=True, kw_only=True)
class TestSeries:
    """Pull-out tests of a type."""

    __test__: ClassVar = False  # for pytest

    count: int
    least_kN: float
    mean_kN: float
    singles: Items[SingleTest]  # empty where each is not given


@dataclass(frozen=True, kw_only=True)
class Check:
    """Check of a force against a resistance, or of a geometry.

    ``steps`` is the whole calculation of a utilisation, from what is given and solved;
    a check that compares no force has ``met`` and ``finding`` in its place. What
    follows from them is worked out here and nowhere else: demand, resistance,
    utilisation, verdict and its reason.
    """

    LEAVES_OUT_NONE: ClassVar[tuple[str, ...]] = ("eased",)  # all is given
    WRITTEN: ClassVar = (
        *("demand_kN", "resistance_kN", "utilisation"),
        *("utilisation_by_model", "utilisation_by_guideline"),
        *("verdict", "reason", "governs"),
    )  # also in the document, which is not read back from them

    id: str  # "foot_anchor.tendon", "foot_anchor.tendon.end", "geometry.inclination"
    clause: str
    member: str
    mode: str
    position: str = ""  # of its support: "intermediate", "second" or "edge"
    steps: Items[Step] = field(default_factory=list)
    # By its own comparison, of a check without a force; not proven of forces that are
    # information only.
    met: Verdict | None = None
    finding: Text | None = None  # sentence of that comparison
    open: Items[Open] = field(default_factory=list)
    case: CasePoint | None = None
    load_case: str = ""  # of the guideline: "load_case_1" or "load_case_2"
    load_inclination_deg: float | None = None  # of the net, where that is largest
    resistance_basis: str = ""  # "tested", "computed", "declared"
    resistance_type: str = ""  # id of the anchor, rope or post type
    resistance_cell: str = ""  # "Anchors!B4"
    resistance_derivation: Text | None = None  # how it follows from dimensions or tests
    tests: TestSeries | None = None  # of a pull-out resistance that is from them
    proof_limit_kN: float | None = None  # of a test's load, by the tendon that it pulls
    changes: Items[Change] = field(default_factory=list)
    # Low end of the utilisation at the best ends of what is assumed [-].
    eased: float | None = None

    @cached_property
    def step_of(self) -> dict[str, Step]:
        """Steps by their symbols."""
        return {step.symbol: step for step in self.steps}

    @cached_property
    def rating(self) -> Rating:
        """How far it is met."""
        low, high = self.read_band("μ")
        stated = self.met or Verdict.NOT_PROVEN
        if self.steps:
            stated = Verdict.NOT_PROVEN
        return Rating(
            low=low,
            high=high,
            open=self.open,
            demand=self.read_band("E_d")[1],
            met=None if self.steps and self.met is None else stated,
            eased=self.eased,
        )

    def read(self, symbol: str) -> float | None:
        """Value of a step, in its unit; None where it is missing."""
        step = self.step_of.get(symbol)
        return step.value if step else None

    def read_band(self, symbol: str) -> tuple[float | None, float | None]:
        """Low and high end of a step."""
        step = self.step_of.get(symbol)
        return (step.ends[0], step.ends[2]) if step else (None, None)

    @property
    def demand_kN(self) -> float | None:
        """Design force; None where it is not known, or no force enters."""
        return self.read("E_d")

    @property
    def resistance_kN(self) -> float | None:
        """Design resistance."""
        return self.read("R_d")

    @property
    def needed_kN(self) -> float | None:
        """Least characteristic resistance with which it passes; None if none does."""
        wanted = (x for x in self.changes if x.sense == "at least")
        return next((force.bound for force in wanted), None)

    @property
    def utilisation(self) -> float | None:
        """Demand over resistance [-]; None where it is not known, or has no bound."""
        return self.read("μ")

    @property
    def utilisation_band(self) -> tuple[float | None, float | None]:
        """Utilisation at the low and at the high end of the demand [-].

        The low end is that at the best ends of what is assumed.
        """
        return self.rating.band

    @property
    def eased_low(self) -> float | None:
        """Low end at the best ends of what is assumed [-]; None if no lower."""
        return self.rating.eased_low

    @property
    def utilisation_by_model(self) -> float | None:
        """Utilisation by the coupled calculation alone [-]; None where not known."""
        if "E_c" in self.step_of or not self.is_of_force:
            return self._rate("cpt")
        used = self.utilisation  # of a rope, which the guideline may have raised
        return None if used is None else used / (self.read("φ_g") or 1.0)

    @property
    def utilisation_by_guideline(self) -> float | None:
        """Utilisation by the guideline's load alone [-]; None where not known.

        That raises the pull of a border rope, which has no load of its own.
        """
        is_raised = "φ_g" in self.step_of and "E_c" not in self.step_of
        return self.utilisation if is_raised else self._rate("g")

    @property
    def exceeds_by_model(self) -> bool:
        """The coupled force is above the resistance, though it does not decide."""
        used = self.utilisation_by_model
        return self.is_by_guideline_alone and used is not None and used > 1.0

    def _rate(self, loads: str) -> float | None:
        """Utilisation by some of the loads on the support, by their letters [-]."""
        forces = (self.read(f"E_{load}") for load in loads)
        demands = [force for force in forces if force is not None]
        factor, design = map(self.read, ("γ_E", "R_d"))
        if not demands or factor is None or not design:
            return None
        return factor * max(demands) / design

    @property
    def is_unbounded(self) -> bool:
        """No resistance is left, so that the utilisation has no bound."""
        return self.rating.is_unbounded

    @property
    def used(self) -> float | None:
        """Utilisation to sort and to show by [-]: infinite where it has no bound."""
        return math.inf if self.is_unbounded else self.utilisation

    @property
    def used_band(self) -> tuple[float | None, float | None]:
        """Utilisation at both ends of the demand, as `used` [-]."""
        return (math.inf, math.inf) if self.is_unbounded else self.utilisation_band

    @cached_property
    def verdict(self) -> Verdict:
        """Verdict by the whole interval and all open points."""
        return self.rating.verdict

    @property
    def rank(self) -> tuple[int, bool, float]:
        """Place in an order: worst verdict first, then the largest utilisation.

        Of one verdict, what is information only comes last.
        """
        is_information = bool(self.steps) and self.met is not None
        used = 1.0 if self.used is None else -self.used
        return SEVERITY.index(self.verdict), is_information, used

    def has_open(self, *kinds: OpenKind) -> bool:
        """Whether some open point is of one of these kinds."""
        return any(point.kind in kinds for point in self.open)

    @property
    def declared(self) -> Proof | None:
        """Document that is said to prove the check; None without one."""
        return next((point.proof for point in self.open if point.proof), None)

    @property
    def open_reasons(self) -> tuple[Message, ...]:
        """What its numbers leave open, each once; its reason says them.

        None where no resistance is left, or where the comparison has its own sentence.
        """
        if self.is_unbounded or self._is_found:
            return ()
        messages = dict.fromkeys(self._open_messages)
        if not messages and self.rating.by_numbers is Verdict.NOT_PROVEN:
            return (self._tell_span(),)
        return tuple(messages)

    def _tell_span(self) -> Message:
        """Why its utilisation is on both sides of 1: what is assumed, or the error."""
        low, high = self.rating.low, self.rating.high
        if self.eased_low is None or low is None or high is None or low <= 1.0:
            return say("check.band_spans_resistance")
        return say("check.assumed_together", used=high, least=self.eased_low)

    @property
    def _open_messages(self) -> list[Message]:
        return [point.message for point in self.open if point.proof is None]

    @property
    def _is_found(self) -> bool:
        """The sentence of its own comparison is its reason."""
        is_open = self.rating.by_numbers is not Verdict.PASS or not self._open_messages
        return self.finding is not None and is_open

    def ease(self, least: float) -> Check:
        """Check that is used that much at the best ends of what is assumed [-]."""
        eased = self.rating.ease(least)
        if eased is self.rating:
            return self
        return replace(self, open=list(eased.open), eased=eased.eased)

    def with_open(self, kind: OpenKind, *messages: Message) -> Check:
        """Check with further open points of a kind."""
        points = [Open(kind=kind, message=message) for message in messages]
        return replace(self, open=[*self.open, *points])

    @property
    def is_of_force(self) -> bool:
        """Whether it compares a known force with a resistance."""
        return self._has_section or bool({"T_r", "T_b"} & self.step_of.keys())

    @property
    def _has_section(self) -> bool:
        return f"{self._letter}_s" in self.step_of

    @property
    def _letter(self) -> str:
        """Letter of the force on the support: of a base that slides, V across it."""
        return "V" if "V_k" in self.step_of else "E"

    def name_force(self, load: str) -> str:
        """Symbol of a force on the support: of a base that slides, that across it.

        ``load`` is "c", "p" or "g": of section, panel, guideline. Without another load
        that of the section is E_k itself.
        """
        symbol = f"{self._letter}_{load}"
        is_alone = load == "c" and symbol not in self.step_of
        return f"{self._letter}_k" if is_alone else symbol

    def _find_high(self, load: str) -> float:
        return self.read_band(self.name_force(load))[1] or 0.0

    @property
    def is_by_panel(self) -> bool:
        """The force by panel, or by post, guys and end guy, is above the section's."""
        return max(map(self._find_high, "pt")) > self._find_high("c")

    @property
    def is_by_guideline_alone(self) -> bool:
        """The profile lets the guideline's load decide, whatever the model says."""
        action = self.step_of.get(f"{self._letter}_k")
        coupled = f"{self._letter}_c"
        if action is None or not action.formula or coupled not in self.step_of:
            return False
        return coupled not in dict(list_operands(action.formula, 1))

    @property
    def governs(self) -> str:
        """Load of the force that decides.

        "coupled", "panel", "truss", "guideline" or "maker"; "" of no force. Solved
        forces count with their upper ends.
        """
        if not self.is_of_force:
            return ""
        least, stated = self._find_high("g"), self._find_high("m")
        solved = max(map(self._find_high, "cpt"))
        if self.is_by_guideline_alone:
            solved = 0.0
        if stated > max(least, solved):
            return "maker"
        if least and least >= solved:
            return "guideline"
        if self._find_high("t") > max(map(self._find_high, "cp")):
            return "truss"
        return "panel" if self.is_by_panel or not self._has_section else "coupled"

    @property
    def reason(self) -> Message:
        """Sentence on its verdict, with the load that governs."""
        loads = [load for load in "cptgm" if self.name_force(load) in self.step_of]
        is_alone = len(loads) < 2 or not self._has_section
        if is_alone or not any(map(self._find_high, loads)):
            return self.plain_reason
        load = say(f"load.{self.governs}", case=name("load_case", self.load_case))
        return say("load.reason", reason=self.plain_reason, load=load)

    @property
    def plain_reason(self) -> Message:
        """The reason without the load that governs."""
        reason = self._explain()
        if self.declared is None:
            return reason
        is_failed = self.verdict is Verdict.FAIL
        key = "check.fails_though_declared" if is_failed else "check.declared"
        return say(key, reason=reason, proof=self.declared.describe())

    def _explain(self) -> Message:
        """Explain the verdict by numbers and open points, without a proof elsewhere.

        Without digits, so that rounding cannot contradict it.
        """
        if self.is_unbounded:
            return next(x.message for x in self.open if x.kind is OpenKind.FAILS)
        if self.finding is not None and self._is_found:
            return self.finding
        reasons = self.open_reasons
        is_failed = self.rating.by_numbers is Verdict.FAIL
        if reasons:
            key = "check.fails_besides" if is_failed else "check.not_proven"
            return say(key, gaps=reasons)
        if is_failed:
            return say("check.fails")
        is_slack = self.read_band("E_k")[1] == 0.0
        return say("check.slack") if is_slack else say("check.passes")
