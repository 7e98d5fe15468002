"""Conditions: what nobody typed and no number can say, once for all rows."""

import random
from dataclasses import replace

import pytest

from netdesign.checks.rating import OpenKind
from netdesign.outcome import Verdict
from netdesign.study.conditions import Condition, merge_conditions
from netdesign.words.message import say
from tests.study.test_chain import NF, judge, solved

__all__ = ["solved"]


def state(study):
    return {one.key: one for one in study.rows[0].conditions}


def test_only_what_no_cell_says_is_left_as_a_condition(solved):
    study, _ = judge(solved)
    left = {"snow_height", "glide_factor", "axes"}
    assert set(state(study)) - left == {
        "cover",
        "edge",
        "apart",
        "protected",
        "rectangular",
        "hangs_free",
    }
    assert study.conditions == study.rows[0].conditions


@pytest.mark.parametrize(
    ("wear", "key"),
    [
        ({"protection": ""}, "protected"),
        ({"protection": "none", "kind": "bar", "soil": ""}, "natural_ground"),
    ],
)
def test_steel_that_nobody_protects_has_a_condition_and_is_proven(solved, wear, key):
    given = solved[0].rows[0].resistances
    worn = tuple(
        replace(one, wear=replace(one.wear, outer=0.05, inner=0.0, **wear))
        if one.wear
        else one
        for one in given
    )
    study, checks = judge(solved, resistances=worn, end_resistances=None)
    assert key in state(study)
    assert not checks["uphill_anchor.tendon"].open
    left_out = replace(NF, not_checked=("corrosion",))
    study, _ = judge(solved, left_out, resistances=worn, end_resistances=None)
    assert key not in state(study)


def test_ground_that_nobody_names_is_a_condition(solved):
    study, checks = judge(solved, ground_type="")
    assert state(study)["ground"].who == "ground"
    assert checks["foot_anchor.pull_out"].verdict is Verdict.PASS


def test_of_several_rows_the_number_of_the_worst_counts():
    draw = random.Random(5)
    values = [draw.uniform(0.5, 9.0) for _ in range(7)]
    for key, pick in (("cover", min), ("edge", max), ("gap", min), ("apart", max)):
        stated = [
            Condition(
                key=key,
                who="site",
                message=say(f"condition.{key}_of", value=value),
                value=value,
                rows=[f"R{number}"],
            )
            for number, value in enumerate(values)
        ]
        (found,) = merge_conditions(draw.sample(stated, len(stated)))
        assert found.value == pick(values) == found.message.arguments["value"]
        assert sorted(found.rows) == [f"R{number}" for number in range(7)]


MISSING = ("pull_out", "tendon", "rope", "compression", "bearing", "mesh")


@pytest.mark.parametrize("seed", range(6))
def test_a_missing_resistance_leaves_its_own_check_open_and_no_other(solved, seed):
    draw = random.Random(seed)
    row, before = solved[0].rows[0], judge(solved)[1]
    member, mode = draw.choice(
        [(x.member, x.mode) for x in row.resistances if x.mode in MISSING and x.value]
    )

    def drop(found):
        return found and tuple(
            replace(one, value=None, tests=None, basis="")
            if (one.member, one.mode) == (member, mode)
            else one
            for one in found
        )

    changes = {
        key: drop(getattr(row, key)) for key in ("resistances", "end_resistances")
    }
    after = judge(solved, **changes)[1]
    assert after.keys() == before.keys()
    for name, check in after.items():
        is_own = (check.member, check.mode) == (member, mode)
        if check.mode != "connection":  # a usual link is as strong as its rope
            kept = before[name]
            assert (check.verdict is kept.verdict) or is_own, name
        if is_own:
            assert check.verdict is Verdict.NOT_PROVEN
            assert [x.kind for x in check.open] == [OpenKind.RESISTANCE_MISSING]
            assert check.demand_kN == pytest.approx(before[name].demand_kN)


def test_a_length_that_is_enough_is_never_rounded_down(solved):
    study, _ = judge(solved)
    shown = [state(study)[key] for key in ("cover", "edge", "snow_height")]
    for one in shown:
        told = one.message.arguments["value"]
        assert one.value - 1e-6 <= told <= one.value + 0.1, one.key
