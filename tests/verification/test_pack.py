"""The pack that `netdesign verify` runs, and how its cases judge."""

import dataclasses
import json
import math

import pytest

from netdesign.addons.evidence.verification.case import (
    VerificationCase,
    load_cases,
    observe_order,
)
from netdesign.addons.evidence.verification.pack import run_pack, write_pack
from netdesign.words.catalogue import load_texts
from tests.each import each


def a_case(**changes):
    case = VerificationCase(
        id="one",
        kind="limit",
        reference="mirror",
        mark="here",
        expected=2.0,
        got=2.02,
        tolerance=0.02,
    )
    return dataclasses.replace(case, **changes)


def test_error_is_relative_and_absolute_where_zero_is_expected():
    assert a_case().error == pytest.approx(0.01, rel=1e-12)
    assert a_case(expected=0.0, got=-0.3).error == pytest.approx(0.3, rel=1e-12)


@each(
    "changes, passes",
    [
        ({}, True),
        ({"got": 2.0 + 0.04 * (1 + 1e-9)}, False),
        ({"got": math.nan}, False),
        ({"got": math.inf}, False),
        ({"expected": math.nan}, False),
        ({"least_order": 2.0}, False),
        ({"least_order": 2.0, "order": 2.0}, True),
        ({"least_order": 2.0, "order": 1.999}, False),
        ({"least_order": 2.0, "order": math.nan}, False),
    ],
)
def test_verdict(changes, passes):
    assert a_case(**changes).passes is passes


def test_order_of_a_power():
    sizes = [1.0, 0.5, 0.25]
    assert observe_order(sizes, [s**3 for s in sizes]) == pytest.approx(3, rel=1e-12)


def test_whole_pack_passes_and_can_be_written():
    done = []
    cases = run_pack(done.append)
    failing = [(case.id, case.error, case.order) for case in cases if not case.passes]
    assert failing == []
    assert done == list(range(1, len(done) + 1))
    names = [case.id for case in cases]
    assert sorted(names) == sorted(load_cases())  # each once, and none is left out
    told = {key[10:] for key in load_texts("en") if key[:10] == "reference."}
    assert {case.reference for case in cases} == told
    document = json.loads(json.dumps(write_pack(cases), allow_nan=False))
    assert document["schema"] == "netdesign.verification/1"
    assert len(document["cases"]) == len(cases)
    assert all(case["pass"] for case in document["cases"])
    kinds = {case["kind"] for case in document["cases"]}
    assert kinds == {
        *("closed form", "manufactured", "invariant", "limit"),
        *("cross model", "published"),
    }
