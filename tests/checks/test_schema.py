"""What the files of a profile may hold, and how the rest is refused."""

import math
import random
import re

import pytest

from netdesign.checks.schema import (
    FACTOR_IDS,
    LIMIT_UNITS,
    MODEL_UNITS,
    TABLE_COUNTS,
    VALUE_BOUNDS,
    ChoicesFile,
    DocumentFile,
    FactorsFile,
    LimitsFile,
    ModelFile,
    TablesFile,
    check_table,
    find_bounds,
)
from netdesign.outcome import StandardError
from netdesign.structure.members import MEMBER_MODES
from tests.each import each


def an_entry(**changes: object) -> dict[str, object]:
    entry = {
        "id": "action.snow",
        "clause": "-",
        "text": "Factor on snow.",
        "value": 1.5,
        "unit": "-",
        "status": "assumed",
        "source": "nowhere",
    }
    return entry | changes


def some_limits(low: float = 25.0, high: float = 35.0) -> list[dict[str, object]]:
    return [
        an_entry(id="geometry.inclination.min", value=low, unit="deg"),
        an_entry(id="geometry.inclination.max", value=high, unit="deg"),
    ]


def a_document(**changes: object) -> dict[str, object]:
    keys = (
        "title",
        "edition",
        "language",
        "transcribed_by",
        "checked_by",
        "what_it_is",
        "what_it_is_not",
    )
    named = {"id": "my-profile", "version": "1"}
    return named | dict.fromkeys(keys, "something") | changes


def refusal(shape, table) -> str:
    with pytest.raises(StandardError) as caught:
        check_table(shape, table, "my.toml")
    return str(caught.value)


def test_good_files_are_read():
    factors = check_table(FactorsFile, {"factor": [an_entry(value=2)]}, "f")
    assert factors.factor[0].value == 2.0
    limits = check_table(LimitsFile, {"limit": some_limits()}, "l")
    assert [entry.value for entry in limits.limit] == [25.0, 35.0]
    assert check_table(DocumentFile, a_document(), "d").id == "my-profile"


def test_profile_may_have_no_values_if_it_says_so():
    assert check_table(FactorsFile, {"factor": []}, "f").factor == []
    assert check_table(LimitsFile, {"limit": []}, "l").limit == []
    assert "'factor': is missing" in refusal(FactorsFile, {})


def test_every_mode_of_a_site_may_have_a_factor():
    assert {f"resistance.{mode}" for _, mode in MEMBER_MODES} <= set(FACTOR_IDS)


def test_an_unknown_key_further_in_is_refused_with_those_of_its_place():
    choice = {"name": "annex", "text": "An annex.", "factor": [an_entry(valeu=1)]}
    message = refusal(ChoicesFile, {"choice": [choice]})
    assert message.startswith("my.toml: ")
    assert "accepted are id, clause, text, value, unit, status, source" in message
    table = an_entry(id="correlation.tests.mean", over="tests")
    del table["value"]
    rows = [{"from": 1, "to": math.inf, "value": 1.4, "valeu": 1.4}]
    message = refusal(TablesFile, {"table": [table | {"rows": rows}]})
    assert message.endswith("'valeu': unknown key; accepted are from, to, value")


def test_smallest_positive_value_is_accepted():
    table = {"factor": [an_entry(value=5e-324, reason_beyond="A test.")]}
    assert check_table(FactorsFile, table, "f").factor[0].value == 5e-324


@each("value", [math.nextafter(1.0, 0.0), 0.37])
@each("blank", [{}, {"reason_beyond": " "}])
def test_a_factor_below_1_needs_more_than_a_blank_reason(value, blank):
    entry = an_entry(value=value) | blank
    choice = {"name": "annex", "text": "An annex.", "factor": [entry]}
    for told in (
        refusal(FactorsFile, {"factor": [entry]}),
        refusal(ChoicesFile, {"choice": [choice]}),
    ):
        assert f"action.snow = {value:g} lies beyond 1 to" in told
        assert "it needs 'reason_beyond'" in told


def some_correlations(last: float) -> dict[str, object]:
    table = an_entry(id="correlation.tests.least", over="tests")
    del table["value"]
    ends = [(1, 2, 1.4), (3, math.inf, last)]
    rows = [{"from": low, "to": high, "value": one} for low, high, one in ends]
    return table | {"rows": rows}


@pytest.mark.parametrize("value", [0.0, -0.9])
def test_no_reason_makes_a_factor_of_zero_or_less_acceptable(value):
    reason = {"reason_beyond": "Because."}
    entry = an_entry(value=value) | reason
    assert f"'value' = {value!r}" in refusal(FactorsFile, {"factor": [entry]})
    table = some_correlations(value) | reason
    assert f"'value' = {value!r}" in refusal(TablesFile, {"table": [table]})


@pytest.mark.parametrize("status", ["read", "secondary", "assumed", "user"])
def test_known_statuses_are_accepted(status):
    table = {"factor": [an_entry(status=status)]}
    assert check_table(FactorsFile, table, "f").factor[0].status == status


def without(key):
    return {name: value for name, value in an_entry().items() if name != key}


ENTRY = "my.toml: 'factor' entry 1"
WORDS = "'read', 'secondary', 'assumed' or 'user'"
KEYS = "accepted are id, clause, text, value, unit, status, source"
NO_VALUES = (0.0, -0.0, -1.5, math.nan, math.inf, -math.inf, "1.5", True, None)
LOW, HIGH = some_limits()


@each(
    "entries, told",
    [
        *(([without(key)], (f"{ENTRY} '{key}': is missing",)) for key in an_entry()),
        *(([an_entry(**{key: blank})], (f"'{key}' = {blank!r}: ",))
          for key in ("clause", "text", "source") for blank in ("", "   ")),
        *(([an_entry(value=x)], (ENTRY, f"'value' = {x!r}: ")) for x in NO_VALUES),
        *(([an_entry(status=x)], (f"'status' = {x!r}", WORDS))
          for x in ("placeholder", "Read", "")),
        *(([an_entry(id=x)], (f"'id' = {x!r}: must be one of action.snow, ",))
          for x in ("action.wind", "resistance.pullout", "resistance.")),
        ([an_entry(unit="deg")], ("'unit' = 'deg'",)),
        ([an_entry(), an_entry(value=1.0)], ("twice or more: action.snow",)),
        ([an_entry(), an_entry(valeu=1.5)], ("entry 2 'valeu': unknown key", KEYS)),
    ],
)  # fmt: skip
def test_an_entry_is_refused_at_its_place_with_what_is_accepted(entries, told):
    message = refusal(FactorsFile, {"factor": entries})
    assert all(part in message for part in told)


@each(
    "limits, told",
    [
        ([an_entry(unit="deg"), LOW, HIGH], "'id' = 'action.snow'"),
        ([LOW | {"unit": "rad"}, HIGH], "'unit' = 'rad'"),
        ([LOW, HIGH, LOW, HIGH], "whole file: each id may occur once; twice or more: "
         "geometry.inclination.max, geometry.inclination.min"),
        ([LOW], "whole file: geometry.inclination.min is only accepted with "
         "geometry.inclination.max"),
        (some_limits(35.0, 25.0), "geometry.inclination.min must be less than"),
        (some_limits(30.0, 30.0), "geometry.inclination.min must be less than"),
    ],
)  # fmt: skip
def test_limits_are_refused_with_what_is_accepted(limits, told):
    assert told in refusal(LimitsFile, {"limit": limits})


def test_an_unknown_key_of_a_file_is_refused():
    told = refusal(FactorsFile, {"factor": [], "factors": []})
    assert "'factors': unknown key; accepted are factor" in told
    of_load = refusal(DocumentFile, a_document(load={"flor": "none"}))
    assert re.search("'load' 'flor': unknown key; accepted are .*floor", of_load)


def test_a_table_in_the_place_of_a_text_is_shown():
    assert "'id' = {'a': 1}" in refusal(DocumentFile, a_document(id={"a": 1}))


@pytest.mark.parametrize("name", ["", "My profile", "../x", "-a"])
def test_id_of_a_document_is_a_plain_name(name):
    assert f"'id' = {name!r}" in refusal(DocumentFile, a_document(id=name))


def test_all_faults_of_a_file_are_told_at_once():
    entries = [an_entry(value=-1.0), an_entry(status="guess"), {"id": "action.snow"}]
    lines = refusal(FactorsFile, {"factor": entries}).splitlines()
    assert len(lines) == 2 + 6
    assert all(line.startswith("my.toml: 'factor' entry ") for line in lines)


@each("floor", ["margreth", "", "None", "GUIDELINE", 1, False])
def test_floor_that_nobody_knows_is_one_finding_with_place_and_words(floor):
    text = refusal(DocumentFile, a_document(load={"floor": floor}))
    assert text.count("\n") == 0
    assert text.startswith("my.toml: 'load' 'floor'")
    assert "'guideline' or 'none'" in text


IDS = sorted({*LIMIT_UNITS, *FACTOR_IDS, *MODEL_UNITS, *TABLE_COUNTS})


def test_every_id_of_a_profile_has_bounds_that_leave_room():
    bounds = {name: find_bounds(name) for name in IDS}
    assert {one for one in VALUE_BOUNDS if one != "resistance"} <= {*IDS}
    assert all(low < high for low, high in bounds.values())
    assert all(bounds[one][0] >= 1.0 for one in FACTOR_IDS)


def judge_alone(name, **changes):
    """What is said of one value, in the file that it belongs to; "" for nothing."""
    entry = an_entry(id=name, **changes)
    shape, key = FactorsFile, "factor"
    if name not in FACTOR_IDS:
        is_limit = name in LIMIT_UNITS
        shape, key = (LimitsFile, "limit") if is_limit else (ModelFile, "value")
        entry["unit"] = (LIMIT_UNITS | MODEL_UNITS)[name]
    try:
        check_table(shape, {key: [entry]}, "my.toml")
    except StandardError as error:  # its group or pair may lack the others, too
        return str(error)
    return ""


@each("name", [one for one in IDS if one not in TABLE_COUNTS])
def test_a_value_beyond_its_bounds_needs_a_reason(name):
    """Drawn far and near, on both sides: those of the review lie among them."""
    draw = random.Random(name)
    low, high = find_bounds(name)
    below = low * (draw.uniform(1e-6, 0.99) if low > 0.0 else 1.5)
    drawn = [high * draw.uniform(1.01, 100.0), math.nextafter(high, math.inf), below]
    for value in drawn:
        told = f"{name} = {value:g} lies beyond {low:g} to {high:g}"
        assert told in judge_alone(name, value=value)
        assert told not in judge_alone(name, value=value, reason_beyond="Our tests.")
    assert "lies beyond" not in judge_alone(name, value=draw.uniform(low, high))


@each("last", [3.5, 0.92])
def test_a_table_beyond_its_bounds_needs_a_reason(last):
    table = some_correlations(last)
    message = refusal(TablesFile, {"table": [table]})
    assert f"correlation.tests.least = {last} lies beyond 1 to 2" in message
    why = {"reason_beyond": "The annex."}
    read = check_table(TablesFile, {"table": [table | why]}, "t").table[0]
    assert read.reason_beyond == why["reason_beyond"]
    assert check_table(TablesFile, {"table": [some_correlations(1.0)]}, "t")
