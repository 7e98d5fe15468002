"""A study as a document: written, read, refused, and compared value by value."""

import hashlib
import json
import math
import pickle
import random
from dataclasses import replace

import pytest

from netdesign.checks.check import Check
from netdesign.edge.json_text import write_json
from netdesign.outcome import StudyError
from netdesign.study.document import (
    compare_values,
    compute_digest,
    hash_text,
    list_values,
    load_study,
    read_document,
    write_document,
)
from netdesign.words.message import say
from tests.each import each
from tests.report.build_study import build_study

BUILT = build_study(samples=2)
# A row that passes, one of whose cases has no result, and the same without a drawing.
ROW = replace(BUILT.rows[0], cases=BUILT.rows[1].cases)
STUDY = replace(BUILT, rows=[ROW, replace(ROW, id="R2", drawing=None)])
CHECK = ROW.checks[0]
FOUND = [check.finding is not None for check in ROW.checks].index(True)


@pytest.fixture
def document():
    return json.loads(write_document(STUDY))


def refuse(document):
    """Message with which the document is refused."""
    text = document if isinstance(document, str) else json.dumps(document)
    with pytest.raises(StudyError, match=r"a study of schema netdesign\.study/4") as e:
        read_document(text)
    return str(e.value)


def test_a_document_reads_back_as_the_same_study():
    back = read_document(write_document(STUDY))
    assert back == replace(STUDY, digest=compute_digest(STUDY))
    assert write_document(back) == write_document(STUDY)


def test_a_document_is_the_text_of_its_study_whoever_wrote_its_rows():
    """A row that another process wrote brings its text along; another one does not."""
    row = STUDY.rows[0]
    assert row.written
    sent = pickle.loads(pickle.dumps(row))
    other = replace(sent, notes=[say("text.as_given", text="été 2,5 \u202e")])
    for rows in ([row], [sent], [sent, other], []):
        study = replace(STUDY, rows=rows)
        digest = compute_digest(study)
        assert write_document(study) == write_json(replace(study, digest=digest))
        values = json.loads(write_json(study), parse_int=float)
        assert digest == hashlib.sha256(json.dumps(values).encode()).hexdigest()


def test_a_document_of_before_has_no_digest(document):
    del document["digest"]
    assert read_document(json.dumps(document)) == STUDY
    long = json.dumps(document) + " " * 2**21  # read by the quick validator
    assert read_document(long) == STUDY


@pytest.mark.parametrize("number", [math.nan, math.inf, -math.inf])
def test_what_is_no_number_is_never_written(number):
    check = replace(CHECK, steps=[replace(CHECK.steps[0], value=number)])
    study = replace(STUDY, rows=[replace(ROW, checks=[check])])
    with pytest.raises(ValueError, match="not JSON compliant"):
        write_document(study)


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity"])
def test_what_is_no_number_is_never_read(document, number):
    document["rows"][0]["checks"][0]["steps"][2]["value"] = float(number)
    text = json.dumps(document)
    assert number in text
    assert "rows.0.checks.0.steps.2.value: " in refuse(text)


def test_every_fault_up_to_the_first_of_a_list_is_named(document):
    document["remark"] = "x"
    document["rows"][0]["colour"] = "red"
    document["rows"][0]["checks"][0]["colour"] = "red"
    document["rows"][0]["checks"][0]["steps"][0]["colour"] = "red"
    document["rows"][0]["drawing"] = {"case": None}
    del document["notes"]
    document["rows"][0]["cases"][0]["outcome"] = "fine"
    document["rows"][0]["checks"][0]["load_inclination_deg"] = "33.3"
    message = refuse(document)
    for place in (
        "remark",
        "rows.0.colour",
        "rows.0.checks.0.colour",
        "rows.0.checks.0.steps.0.colour",
        "rows.0.drawing",
        "notes",
        "rows.0.cases.0.outcome",
        "rows.0.checks.0.load_inclination_deg",
    ):
        assert f"\n{place}" in message


@each("part", ["study", "row", "check"])
@each("key", Check.WRITTEN)
def test_what_is_written_beside_the_fields_and_altered_is_found(
    document, tmp_path, part, key
):
    """Also under a digest that was made anew, as by who alters it on purpose."""
    row = document["rows"][0]
    place = {"study": document, "row": row, "check": row["checks"][0]}[part]
    if key not in place:
        return
    place[key] = {"verdict": "fail", "reason": place.get("reason")}.get(key, 0.25)
    if key == "reason":
        place[key] = {"key": "check.fails", "arguments": {}}
    for digest in (document["digest"], hash_text(json.dumps(document))):
        document["digest"] = digest
        assert replace(read_document(json.dumps(document)), digest="") == STUDY
        path = tmp_path / "study.json"
        path.write_text(json.dumps(document), encoding="utf-8")
        with pytest.raises(StudyError, match="altered"):
            load_study(path)


@each("old", [1, 2, 3])
def test_a_study_of_an_earlier_schema_is_refused_with_what_to_do(document, old):
    document["schema"] = f"netdesign.study/{old}"
    with pytest.raises(StudyError, match="run 'netdesign check' on its site again"):
        read_document(json.dumps(document))


def test_a_message_without_its_text_or_arguments_is_refused(document):
    reason = document["rows"][0]["checks"][FOUND]["finding"]
    for key, arguments in (
        ("no.such_text", {}),
        ("text.as_given", {}),
        ("row.guy_in_snow", {"member": {"key": "no.such_text"}, "width": 1.0}),
        ("geometry.gap_pass", {"low": "wide", "most": 2.0}),
    ):
        reason.update(key=key, arguments=arguments)
        assert f"rows.0.checks.{FOUND}.finding" in refuse(document)


@each("text", ["", "{", "[]", "null", '"x"', "{}"])
def test_anything_else_is_refused(text):
    assert len(refuse(text).splitlines()) > 1


DRAW = random.Random(23)
NUMBERS = [DRAW.uniform(-1.0, 1.0) * 10.0 ** DRAW.uniform(0.0, 6.0) for _ in range(40)]


def count(old, new, **options):
    return len(compare_values(old, new, **options))


@each("number", NUMBERS)
def test_a_number_is_the_same_within_a_millionth(number):
    if abs(number) > 2.0:
        assert count({"force_kN": number}, {"force_kN": number * (1 + 9e-7)}) == 0
        assert count({"force_kN": number}, {"force_kN": number * (1 + 3e-6)}) == 1
    for digit, differs in ((2.0**-51, 0), (3e-12, 1)):
        last = number * (1.0 + digit)
        assert count({"force_kN": number}, {"force_kN": last}, is_exact=True) == differs


@pytest.mark.parametrize(
    ("key", "move", "expected"),
    [
        ("balance_residual", 9e-7, 0),
        ("balance_residual", 1.1e-6, 1),
        ("difference_percent", 9e-5, 0),  # each of two forces by a millionth
        ("difference_percent", 1.1e-4, 1),
    ],
)
def test_what_is_nearly_zero_has_an_absolute_tolerance(key, move, expected):
    assert count({key: 1e-13}, {key: 1e-13 + move}) == expected


@pytest.mark.parametrize(
    ("old", "new"), [(True, 1.0), (1.0, None), ("1.0", 1.0), ("pass", "fail")]
)
def test_values_of_other_kinds_are_never_the_same(old, new):
    assert count({"value": old}, {"value": new}) == 1


def test_members_stand_under_their_ids_and_their_order_counts():
    values = list_values(STUDY)
    assert values["rows.order"] == ", ".join(row.id for row in STUDY.rows)
    turned = replace(STUDY, rows=STUDY.rows[::-1])
    assert [one.place for one in compare_values(STUDY, turned)] == ["rows.order"]
