import json
import math
import random
import re
from dataclasses import replace

import pytest

from netdesign.checks import Proof
from netdesign.checks.check import Check
from netdesign.outcome import StudyError, Verdict
from netdesign.report.difference import compare_studies, write_difference
from netdesign.report.words import ENGLISH
from netdesign.study.document import read_document, write_document
from netdesign.study.records import RowStudy, Study
from netdesign.words.catalogue import LANGUAGES
from tests.alter_study import alter_leaf, list_leaves
from tests.each import each
from tests.report.build_study import (
    build_reliability,
    build_study,
)
from tests.turn import turn, turn_row

UNTOLD = (
    ("provenance", "started"),
    ("digest",),
)


def changes_of(old, new):
    return {(one.area, one.row, one.name(ENGLISH)): (one.old, one.new) for one in
            compare_studies(old, new)}  # fmt: skip


def test_a_study_does_not_differ_from_itself():
    study = build_study()
    later = replace(study.provenance, started="2027-01-01")
    assert compare_studies(study, replace(study, provenance=later)) == []


def test_verdicts_governing_checks_and_inputs_are_told():
    old = build_study()
    row = old.rows[0]
    worst = max(row.checks, key=lambda check: check.utilisation or 0.0)
    failed = turn(worst, Verdict.FAIL, utilisation=1.25)
    checks = [failed if check is worst else check for check in row.checks]
    inputs = [replace(row.inputs[0], value=99.0), *row.inputs[1:]]
    changed = replace(row, checks=checks, inputs=inputs)
    new = replace(old, rows=[changed, *old.rows[1:]])
    found = changes_of(old, new)
    assert found["verdict", row.id, "verdict"] == ("pass", "fail")
    before, after = found["governing", row.id, "utilisation"]
    assert (before, after) == (worst.utilisation, 1.25)
    name = f"{row.inputs[0].label} [{row.inputs[0].unit}]".removesuffix(" []")
    assert found["input", row.id, name] == (row.inputs[0].value, 99.0)
    assert {place[1] for place in found} == {row.id}


def test_rows_that_came_or_went_are_told_once():
    old, new = build_study(rows=3), build_study(rows=2)
    gone = old.rows[2]
    found = {place: change for place, change in changes_of(old, new).items()
             if place[1] == gone.id}  # fmt: skip
    assert found == {("verdict", gone.id, "net row"): (str(gone.verdict), None)}
    assert changes_of(new, old)["verdict", gone.id, "net row"][0] is None


def test_the_document_and_the_lines_show_the_same_values():
    old = build_study()
    new = replace(old, project=replace(old.project, revision=""))
    (change,) = compare_studies(old, new)
    assert str(change) == "revision: B -> none"
    assert write_difference([change]) == {
        "schema": "netdesign.diff/1",
        "changes": [
            {"area": "project", "row": "", "what": "revision", "old": "B", "new": ""}
        ],
    }


def test_what_is_gone_counts_as_turned_and_what_comes_and_passes_does_not():
    old = build_study()
    row = replace(old.rows[0], checks=old.rows[0].checks[1:])
    new = replace(old, rows=[row, *old.rows[1:]])
    assert any(change.is_turned for change in compare_studies(old, new))
    assert not any(change.is_turned for change in compare_studies(new, old))
    whole = replace(old, rows=old.rows[1:])
    assert compare_studies(old, whole)[0].is_turned
    assert not compare_studies(whole, old)[0].is_turned


def test_values_are_told_apart_however_close():
    old = build_study()
    extreme = replace(old.rows[0].member_forces[0], value_kN=100.0 + 1e-9)
    row = replace(old.rows[0], forces=[replace(extreme, value_kN=100.0)])
    close = replace(old.rows[0], forces=[extreme])
    before, after = (replace(old, rows=[one]) for one in (row, close))
    change, _ = compare_studies(before, after)
    assert str(change).endswith("100 -> 100.000000001")


def is_worked_out(name):
    """A written value that follows from others: the digest tells of it."""
    places = ((), ("rows",), ("rows", "checks"))
    kinds = (Study, RowStudy, Check)
    return any(
        name[: len(place)] == place and name[len(place)] in kind.WRITTEN
        for place, kind in zip(places, kinds, strict=True)
        if len(name) > len(place)
    )


@pytest.mark.long
def test_every_value_of_a_study_is_compared():
    """Whatever one leaf of the document is altered to: it is told, save two."""
    small = build_study(samples=2, rows=2)
    drawn = [
        replace(row, reliability=build_reliability(row.checks[0].id))
        for row in small.rows
    ]
    text = write_document(replace(small, rows=drawn))
    old = read_document(text)
    leaves = list_leaves(json.loads(text))
    draw = random.Random(17)
    some = {tuple(str(part) for part in path if not isinstance(part, int)): path
            for path in draw.sample(leaves, len(leaves))}  # fmt: skip
    assert len(some) > 100
    for name, path in some.items():
        document = json.loads(text)
        alter_leaf(document, path, draw)
        if name == ("schema",) or is_worked_out(name):
            continue
        try:
            new = read_document(json.dumps(document))
        except StudyError:  # a formula that is none of what stands before it
            continue
        changes = compare_studies(old, new)
        assert bool(changes) is (name not in UNTOLD), path
        assert any(c.is_turned for c in changes) >= (name[-1] == "verdict"), path


def test_a_pass_that_is_only_declared_now_comes_first_among_the_verdicts():
    old = build_study()
    row = old.rows[0]
    told = Proof(document="G-17", author="B. R.", date="", cell="D!B2")
    declared = turn(row.checks[3], Verdict.DECLARED, proof=told)
    checks = [*row.checks[:3], declared, *row.checks[4:]]
    changed = replace(row, checks=checks)
    new = replace(old, rows=[changed, *old.rows[1:]])
    lost = compare_studies(old, new)
    assert [(one.old, one.new) for one in lost[:2]] == [("pass", "declared")] * 2
    assert all(one.is_turned for one in lost[:2])
    gained = compare_studies(new, old)
    assert [(one.old, one.new) for one in gained[:2]] == [("declared", "pass")] * 2


def round_otherwise(part):
    """The same document with another last digit in every number."""
    if isinstance(part, dict):
        return {key: round_otherwise(one) for key, one in part.items()}
    if isinstance(part, list):
        return [round_otherwise(one) for one in part]
    return math.nextafter(part, math.inf) if isinstance(part, float) and part else part


def test_rounding_is_no_change():
    document = json.loads(write_document(build_study()))
    other = round_otherwise(document)
    assert other != document
    old, new = (read_document(json.dumps(one)) for one in (document, other))
    assert compare_studies(old, new) == []


def change_much():
    """Two studies with changes of every kind, and checks that came and went."""
    made = build_study()
    row = made.rows[0]
    old = replace(made, rows=[row, turn_row(made.rows[1], Verdict.PASS), made.rows[2]])
    fewer = replace(row, checks=row.checks[2:])
    checks = [
        replace(
            turn(one, Verdict.FAIL),
            resistance_basis={"tested": "computed"}.get(one.resistance_basis, "tested"),
        )
        for one in row.checks[:-1]
    ]
    inputs = [replace(one, value="free") for one in row.inputs]
    extremes = [replace(one, value_kN=37.1) for one in row.member_forces]
    turned = replace(row, checks=checks, inputs=inputs, forces=extremes)
    return replace(old, rows=[fewer, *old.rows[1:]]), replace(
        old, rows=[turned, turn_row(old.rows[2], Verdict.PASS)]
    )


@each("language", LANGUAGES)
@each("way", [1, -1])
def test_changes_are_told_in_words_and_differ_as_told(language, way):
    """Of a study; what is told in sum only has its place in the document."""
    changes = compare_studies(*change_much()[::way])
    told = [
        one.tell(language) for one in changes if one.area not in ("other", "profile")
    ]
    assert len(told) > 30
    for line in told:
        assert re.findall(r"(?!kN_)[a-z]{2,}_[a-z]+", line) == []
        before, after = line.split(": ")[-1].split(" -> ")
        assert before != after


def test_reordered_rows_are_told():
    old = build_study()
    (change,) = compare_studies(old, replace(old, rows=old.rows[::-1]))
    assert change.area == "other"
    assert str(change) == "2 values differ in all"


def turn_one(study, *, row, check, verdict, **given):
    """The same study with another verdict of one check."""
    rows = list(study.rows)
    checks = list(rows[row].checks)
    checks[check] = turn(checks[check], verdict, **given)
    rows[row] = replace(rows[row], checks=checks)
    return replace(study, rows=rows)


def test_lost_passes_stand_before_all_other_turns():
    old = build_study()
    fails = next(i for i, c in enumerate(old.rows[1].checks) if c.verdict == "fail")
    new = turn_one(old, row=1, check=fails, verdict=Verdict.NOT_PROVEN, utilisation=1)
    new = turn_one(new, row=2, check=0, verdict=Verdict.NOT_PROVEN)
    new = turn_one(new, row=2, check=2, verdict=Verdict.FAIL)
    turns = [(c.old, c.new) for c in compare_studies(old, new) if c.is_turned]
    lost, *worse, gained = turns
    assert (lost, gained) == (("pass", "not_proven"), ("fail", "not_proven"))
    assert worse == [("not_proven", "fail")] * 2  # check and row


@pytest.mark.parametrize("way", [1, -1])
def test_what_got_worse_stands_before_what_is_gone(way):
    """The verdict of the study is the first of all."""
    changes = compare_studies(*change_much()[::way])
    verdicts = [one for one in changes if one.area == "verdict"]
    assert changes[: len(verdicts)] == verdicts
    assert (verdicts[0].row, verdicts[0].name(ENGLISH)) == ("", "verdict")
    ways = [(one.old, one.new) for one in verdicts[1:]]
    gone = next(place for place, (_, new) in enumerate(ways) if new is None)
    worse = [k for k, (_, new) in enumerate(ways) if new in ("fail", "not_proven")]
    assert worse
    assert all(place < gone for place in worse)
