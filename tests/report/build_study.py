"""A study of three net rows, judged under given pulls: it passes, fails, is open.

Of each row some checks are kept, so that its reports are soon made. Names, notes and an
input are those of somebody who wants to harm a report.
"""

import math
import random
from dataclasses import MISSING, fields, replace
from functools import cache
from itertools import product

import numpy as np

from netdesign.checks.check import CasePoint
from netdesign.outcome import Outcome
from netdesign.site.model import InputEcho, Project
from netdesign.study.case_records import Drawing
from netdesign.study.records import (
    ModelFormRecord,
    ReliabilityRecord,
    RowStudy,
    Study,
    VariableRecord,
    VariantRecord,
)
from netdesign.words.catalogue import as_given
from netdesign.words.message import say
from tests.checks.given_pulls import study_row

FORMULA, SCRIPT, MENTION = "=1+1", "<script>alert(1)</script>", "@x"
KEPT = (
    *("foot_anchor.tendon", "foot_anchor.pull_out", "uphill_guy.rope"),
    *("downhill_anchor.pull_out", "post.compression", "geometry.inclination"),
    "downhill_guy.rope",
)
TESTED = {"test_count": 3, "pull_out": 270, "test_mean": 290}
ENDS = ((250.0, 450.0), (15.0, 45.0), (25.0, 35.0))  # of a case's numbers
REMARK = InputEcho(
    label=as_given("Remark"),
    unit="",
    text=f"{SCRIPT} {FORMULA}",
    value=FORMULA,
    cell="Nets!H5",
)


def build_study(*, samples: int = 3, rows: int = 3) -> Study:
    """Study of ``rows`` net rows with ``samples`` values of each quantity."""
    sound = judge_row(0.8, **TESTED)
    built = [
        build_row("Couloir 1", sound, samples),
        build_row(FORMULA, judge_row(2.0, **TESTED), samples, failed_case=True),
        build_row(f"Ridge {SCRIPT}", judge_row(0.7), samples, KEPT[:1] + KEPT[2:]),
    ][:rows]
    project = Project(
        name=f"Combe du Lac & cirque, lot 3 {MENTION}",
        number="2026-114",
        author="A. Moreau",
        revision="B",
        standard="nf-p-95-304",
    )
    provenance = replace(
        sound.provenance,
        started="2026-11-21T08:15:00+00:00",
        site_file="combe.xlsx",
        site_sha256="9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08",
    )
    return replace(
        sound,
        project=project,
        rows=built,
        provenance=provenance,
        notes=[as_given(f"Column {SCRIPT} was not read."), as_given(MENTION)],
    )


@cache
def judge_row(share: float, **tests: float) -> Study:
    """The row under a share of its pulls; without tests nothing holds in the ground."""
    return study_row(
        "nf-p-95-304-style",
        anchor={"kind": "rope anchor", "tendon": 520, **tests},
        foot=(20.0 * share, 18.0 * share),
        head=(5.0 * share, -22.0 * share),
        floor="guideline",
        gap=0.5,
    )


def build_row(
    name: str,
    judged: Study,
    samples: int,
    kept: tuple[str, ...] = KEPT,
    *,
    failed_case: bool = False,
) -> RowStudy:
    """Some checks of the judged row under another name, with many cases."""
    (row,) = judged.rows
    (case,) = row.cases
    values = (np.linspace(*one, samples).tolist() for one in ENDS)
    names = ("density_kg_m3", "friction_deg", "inclination_deg")
    points = [
        CasePoint(**dict(zip(names, one, strict=True))) for one in product(*values)
    ]
    cases = [replace(case, case=point) for point in points]
    if failed_case:
        numbers = (one.name for one in fields(case)[3:])
        cases[len(cases) // 2] = replace(
            cases[len(cases) // 2],
            outcome=Outcome.MAX_ITERATIONS,
            **(dict.fromkeys(numbers) | {"reason": as_given("60 iterations.")}),
        )
    checks = {one.id: one for one in row.checks}
    return replace(
        row,
        id=name,
        checks=[checks[one] for one in kept],
        cases=cases,
        inputs=[*row.inputs, REMARK],
        model_form=build_model_form(row),
        notes=[as_given(f"no gap is given {SCRIPT}")],
        conditions=[],
    )


def build_model_form(row: RowStudy) -> ModelFormRecord:
    """One variant with a force, one without."""
    return ModelFormRecord(
        case=row.cases[0].case,
        member="foot_anchor",
        force_kN=row.cases[0].foot_anchor_kN,
        utilisation=0.78,
        variants=[
            VariantRecord(creep_law="zwinger-2007", ratio=0.907),
            VariantRecord(
                creep_law="gagliardini-1997", ratio=None, reason=as_given("it shrinks")
            ),
        ],
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
