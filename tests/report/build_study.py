"""A realistic study by hand: one row that passes, one that fails, one unproven."""

import math
import random
from dataclasses import MISSING, fields, replace
from itertools import product

import numpy as np

from netdesign.calculation.quantity import Kind, Quantity, leaf
from netdesign.calculation.steps import list_steps
from netdesign.checks import StandardValue
from netdesign.checks.check import CasePoint, Change, Check
from netdesign.checks.forces import (
    MemberLoad,
    bring_to_support,
    place_end_support,
    rate,
    take_largest,
)
from netdesign.checks.rating import Open, OpenKind
from netdesign.outcome import Outcome, Verdict
from netdesign.site.model import InputEcho, Project
from netdesign.study.case_records import (
    CaseRecord,
    Drawing,
    FloorForceRecord,
    FloorRecord,
    GuidelineCase,
    GuidelineRecord,
    HeldSidewaysRecord,
    LargestForce,
    PullRecord,
)
from netdesign.study.records import (
    SCHEMA,
    ModelFormRecord,
    ProfileRecord,
    Provenance,
    ReliabilityRecord,
    RowStudy,
    Study,
    VariableRecord,
    VariantRecord,
)
from netdesign.words.catalogue import as_given
from netdesign.words.message import Message, say

FORMULA, SCRIPT, MENTION = "=1+1", "<script>alert(1)</script>", "@x"
MEMBERS = ("foot_anchor", "uphill_guy", "downhill_guy", "post")
ACTION_FACTOR, RESISTANCE_FACTOR = 1.5, 1.35
ERROR = 0.004  # of every force


def build_study(*, samples: int = 3, rows: int = 3) -> Study:
    """Study of ``rows`` net rows with ``samples`` values of each quantity."""
    built = [
        build_row("Couloir 1", samples, scale=0.6),
        build_row(FORMULA, samples, scale=0.72, failed_case=True),
        build_row(f"Ridge {SCRIPT}", samples, scale=0.62, missing_resistance=True),
    ][:rows]
    return Study(
        schema=SCHEMA,
        project=Project(
            name=f"Combe du Lac & cirque, lot 3 {MENTION}",
            number="2026-114",
            author="A. Moreau",
            checker="",
            revision="B",
            standard="nf-p-95-304",
        ),
        profile=build_profile(),
        rows=built,
        range_inputs=[
            _echo(_end("low", "density"), "kg/m3", "250", 250.0, "Ranges!B2"),
            _echo(_end("high", "density"), "kg/m3", "450", 450.0, "Ranges!C2"),
            _echo(_end("low", "friction_angle"), "°", "", 15.0, "default"),
        ],
        notes=[
            as_given(f"Sheet Nets: column {SCRIPT} was not understood."),
            as_given(MENTION),
        ],
        provenance=Provenance(
            version="0.1.0",
            started="2026-11-21T08:15:00+00:00",
            site_file="combe.xlsx",
            site_sha256="9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08",
            settings={"accuracy": "0.01", "method": "steady", "jobs": "2"},
            libraries={"numpy": "2.4.0", "scipy": "1.17.0"},
        ),
    )


def build_profile() -> ProfileRecord:
    """Limit profile with confirmed and assumed values."""
    names = ("id", "clause", "text", "value", "status")
    rows = [
        ("factor.action", "5.2", "Partial factor of snow pressure", 1.5, "assumed"),
        ("factor.tendon", "6.1", "Partial factor of a tendon", 1.35, "assumed"),
        ("factor.pull_out", "6.3", "Partial factor of a tested anchor", 1.4, "user"),
        ("inclination.low", "4.4", "Smallest inclination of the net", 25.0, "read"),
        ("inclination.high", "4.4", "Largest inclination of the net", 35.0, "read"),
    ]
    return ProfileRecord(
        id="nf-p-95-304",
        title="NF P 95-304 style profile",
        edition="1992",
        sha256="b1946ac92492d2347c6235b4d2611184d5b6b5e8b0e2a5a3a2b0a6f0a3d5c1e2",
        values=[
            StandardValue(
                **dict(zip(names, row, strict=True)),
                unit="°" if row[0].startswith("inclination") else "-",
                source="secondary literature, see NOTES.md",
            )
            for row in rows
        ],
    )


def build_row(
    name: str,
    samples: int,
    *,
    scale: float,
    failed_case: bool = False,
    missing_resistance: bool = False,
) -> RowStudy:
    """One net row; ``scale`` moves its forces against fixed resistances."""
    densities, frictions, inclinations = (
        np.linspace(low, high, samples).tolist()
        for low, high in ((250, 450), (15, 45), (25, 35))
    )
    points = [
        CasePoint(density_kg_m3=d, friction_deg=f, inclination_deg=i)
        for d, f, i in product(densities, frictions, inclinations)
    ]
    failing = len(points) // 2 if failed_case else None
    cases = [
        build_case(point, scale, fails=place == failing)
        for place, point in enumerate(points)
    ]
    extremes = [build_extreme(member, cases) for member in MEMBERS]
    slack = replace(extremes[2], value_kN=0.0, low_kN=0.0, high_kN=0.0)
    checks = [
        build_check("foot_anchor", "tendon", extremes[0], 520.0),
        build_check("foot_anchor", "pull_out", extremes[0], 480.0),
        build_check("uphill_guy", "rope", extremes[1], 300.0),
        build_check(
            "downhill_anchor",
            "pull_out",
            extremes[2],
            None if missing_resistance else 150.0,
        ),
        build_check("post", "compression", extremes[3], 420.0),
        Check(
            id="geometry.inclination",
            clause="4.4",
            member="net",
            mode="inclination",
            met=Verdict.PASS,
            finding=as_given("25° to 35° lies within 25° to 35°."),
        ),
        Check(
            id="downhill_guy.rope",
            clause="6.1",
            member="downhill_guy",
            mode="rope",
            case=slack.case,
            steps=list_steps(rate_force(slack, 180.0)),
        ),
    ]
    floor = fill(
        FloorForceRecord,
        member=MEMBERS[0],
        force_kN=0.4 * extremes[0].value_kN / 1.1,
        load_case="load_case_1",
    )
    return RowStudy(
        id=name,
        checks=checks,
        forces=extremes,
        cases=cases,
        inputs=[
            _echo(say("column.Nets.slope_angle"), "°", "40", 40.0, "Nets!B5"),
            _echo(say("column.Nets.snow_height"), "m", "5,22 ", 5.22, "Nets!C5"),
            _echo(say("column.Nets.ground_law"), "", "rough", "no-slip", "Nets!D5"),
            _echo(as_given("Remark"), "", f"{SCRIPT} {FORMULA}", FORMULA, "Nets!H5"),
            _echo(say("column.Nets.slack"), "%", "", 2.0, "default"),
        ],
        drawing=replace(build_section(random.Random(3)), case=extremes[0].case),
        guideline=build_guideline(extremes[0]),
        model_form=build_model_form(extremes[0]),
        floor=FloorRecord(profile="swiss-guideline-2007", forces=[floor]),
        notes=[as_given(f"no gap is given {SCRIPT}")],
        pulls=[
            fill(PullRecord, anchor="foot_anchor", position="intermediate", kind="bar")
        ],
        held_sideways=fill(HeldSidewaysRecord),
    )


def fill(kind, /, **given):
    """Record of a kind; numbers that are neither given nor known are drawn."""
    draw = random.Random(kind.__name__)
    for one in fields(kind):
        number = round(draw.uniform(1.1, 9.7), 7)
        drawn = {"float": number, "int": draw.randrange(2, 90), "bool": True}
        type_ = one.type.partition(" ")[0]
        if one.name not in given and one.default in (MISSING, None, 0):
            given |= {one.name: drawn[type_]} if type_ in drawn else {}
    return kind(**given)


def build_guideline(extreme: LargestForce) -> GuidelineRecord:
    """One load case with numbers, one without."""
    nothing = dict.fromkeys(("glide_factor", "load_kN_per_m", "foot_anchor_kN"))
    told = as_given(f"the support fails {SCRIPT}")
    return fill(
        GuidelineRecord,
        case=extreme.case,
        solved_foot_anchor_kN=extreme.value_kN,
        cases=[
            fill(GuidelineCase, name="same_snow"),
            fill(GuidelineCase, name="load_case_2", reason=told, **nothing),
        ],
        sentence=as_given(f"They differ because {SCRIPT}."),
    )


def build_model_form(extreme: LargestForce) -> ModelFormRecord:
    """One variant with a force, one without."""
    told = as_given(f"it shrinks {SCRIPT}")
    return ModelFormRecord(
        case=extreme.case,
        member="foot_anchor",
        force_kN=extreme.value_kN,
        utilisation=0.78,
        variants=[
            VariantRecord(creep_law="zwinger-2007", ratio=0.907),
            VariantRecord(creep_law="gagliardini-1997", ratio=None, reason=told),
        ],
    )


def build_reliability(check: str) -> ReliabilityRecord:
    """Notional reliability of one check, by a made-up analysis."""
    typed, assumed = say("source.typed", text="fit"), say("source.reference_case")
    names = {"snow_height": "height_vertical_m", "model": "", "resistance": ""}
    return fill(
        ReliabilityRecord,
        check=check,
        reason=None,
        variables=[
            fill(
                VariableRecord,
                name=name,
                key=key,
                distribution="gumbel" if key else "lognormal",
                source=typed if name == "model" else assumed,
                is_assumed=name != "model",
            )
            for name, key in names.items()
        ],
        design_point=fill(CasePoint),
    )


def force(member: str, point: CasePoint, scale: float) -> float:
    """Made-up force law [kN], rising with density, dented by friction."""
    share = {"foot_anchor": 1.0, "uphill_guy": 0.55, "downhill_guy": 0.12, "post": 0.7}
    lean = math.radians(point.inclination_deg)
    dent = 1 + 0.04 * math.cos(4 * math.radians(point.friction_deg))
    weight = (point.density_kg_m3 / 450) ** 1.4
    return 300 * scale * share[member] * weight * dent * (1 + 0.3 * math.sin(lean))


def build_case(point: CasePoint, scale: float, *, fails: bool) -> CaseRecord:
    """Case with a result, or without one."""
    forces = {f"{member}_kN": force(member, point, scale) for member in MEMBERS}
    errors = {
        "error_percent": 100 * ERROR * point.density_kg_m3 / 450,
        "balance_residual": 3.1e-10 * point.friction_deg,
    }
    known = forces | errors
    return CaseRecord(
        case=point,
        outcome=Outcome.MAX_ITERATIONS if fails else Outcome.CONVERGED,
        reason=as_given("60 iterations, residual 2e-3.") if fails else None,
        **(dict.fromkeys(known) if fails else known),
    )


def build_extreme(member: str, cases: list[CaseRecord]) -> LargestForce:
    """Largest force of ``member`` over the cases that have a result."""
    solved = [case for case in cases if case.outcome is Outcome.CONVERGED]
    worst = max(solved, key=lambda case: getattr(case, f"{member}_kN"))
    largest = getattr(worst, f"{member}_kN")
    return LargestForce(
        quantity=member,
        value_kN=largest,
        low_kN=largest * (1 - ERROR),
        high_kN=largest * (1 + ERROR),
        bound_kN=largest,
        case=worst.case,
    )


def build_check(
    member: str, mode: str, extreme: LargestForce, characteristic: float | None
) -> Check:
    """Force check; without ``characteristic`` resistance it is not proven."""
    used = rate_force(extreme, characteristic)
    lack = as_given("No resistance is given in Anchors!E7.")
    missing = Open(kind=OpenKind.RESISTANCE_MISSING, message=lack)
    return Check(
        id=f"{member}.{mode}",
        clause="6.3 (2)",
        member=member,
        mode=mode,
        case=extreme.case,
        open=[missing] if characteristic is None else [],
        resistance_basis="" if characteristic is None else "tested",
        resistance_type="GEWI 28" if member != "post" else "HEA 160",
        resistance_cell="Anchors!E7",
        resistance_derivation=as_given(f"π · 90 mm {SCRIPT}")
        if mode == "pull_out"
        else None,
        load_case="load_case_1",
        load_inclination_deg=35.0,
        steps=list_steps(used),
        changes=[
            Change(
                quantity=say("change.type_of_workbook", type=FORMULA),
                unit="kN",
                now=characteristic,
                bound=900.0,
                sense="has",
            ),
            Change(
                quantity=say("change.type_of_workbook", type="HEB 200"),
                unit="kN",
                now=characteristic,
                bound=812.3,
                sense="has",
                note=say("change.as_far_as_solved"),
            ),
        ],
    )


def rate_force(extreme: LargestForce, characteristic: float | None) -> Quantity:
    """Utilisation of a force on the first support of a row, step by step."""
    spacing = leaf("b", 4.0, "m", "Nets!L5")
    support = place_end_support(
        spacing,
        leaf("f_R", 1.6, "-", "end.constant", kind=Kind.PROFILE),
        leaf("Δl", 1.5, "m", "end.constant", kind=Kind.PROFILE),
    )
    largest, low, high = (
        force / 1.1 for force in (extreme.value_kN, extreme.low_kN, extreme.high_kN)
    )
    solved = leaf(
        *("E_s", largest, "kN", extreme.quantity), kind=Kind.SOLVED, band=(low, high)
    )
    floor = leaf("E_g0", 0.4 * largest, "kN", "floor", kind=Kind.SOLVED)
    plain = MemberLoad()
    force = take_largest(
        "E_k",
        bring_to_support("E_c", solved, plain, support),
        bring_to_support("E_g", floor, plain, support),
    )
    return rate(
        force,
        leaf("γ_E", ACTION_FACTOR, "-", "factor.action", kind=Kind.PROFILE),
        leaf("R_k", characteristic, "kN", "Anchors!E7"),
        leaf("γ_R", RESISTANCE_FACTOR, "-", "factor.tendon", kind=Kind.PROFILE),
    )


def build_section(rng: random.Random) -> Drawing:
    """Section of any proportions that a layout allows."""
    height = rng.uniform(0.9, 6.2)
    lean = math.radians(rng.uniform(0.0, 40.0))
    head = (height * math.tan(lean), height)
    base = head[0] - height * math.tan(math.radians(rng.uniform(-30.0, 45.0)))
    uphill = rng.choice([0.0, rng.uniform(0.2, 3.0) * height])
    downhill = base + rng.choice([0.0, rng.uniform(0.2, 3.0) * height])
    shares = np.linspace(0.0, 1.0, 25)
    sag = rng.uniform(0.0, 0.15) * height * 4 * shares * (1 - shares)
    thickness = height * rng.uniform(0.5, 1.0)
    net = [(head[0] * s + f, head[1] * s) for s, f in zip(shares, sag, strict=True)]
    points = {
        "foot_anchor": (0.0, 0.0),
        "uphill_anchor": (-uphill, 0.0),
        "downhill_anchor": (downhill, 0.0),
        "post": (base, 0.0),
    }
    return Drawing(
        case=CasePoint(
            density_kg_m3=412.0, friction_deg=17.3, inclination_deg=math.degrees(lean)
        ),
        slope_deg=rng.uniform(22.0, 62.0),
        snow_thickness_m=thickness,
        net_m=[(float(x), float(y)) for x, y in net],
        head_m=head,
        post_base_m=points["post"],
        uphill_anchor_m=points["uphill_anchor"],
        downhill_anchor_m=points["downhill_anchor"],
    )


def _end(end: str, quantity: str) -> Message:
    return say(f"column.{end}_end", name=say(f"column.quantities.{quantity}"))


def _echo(
    label: Message, unit: str, text: str, value: float | str, cell: str
) -> InputEcho:
    return InputEcho(label=label, unit=unit, text=text, value=value, cell=cell)
