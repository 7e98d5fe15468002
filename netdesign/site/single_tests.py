"""Single pull-out tests of sheet Tests: number, least and mean by type and ground."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from statistics import fmean

from netdesign.resistance.pull_out import SingleTest
from netdesign.site.cells.findings import Finding
from netdesign.site.lines import refuse_unknown_ids
from netdesign.site.readings import Reading, Row, refuse, refuse_beside
from netdesign.site.type_resistances import TEST_COLUMNS
from netdesign.words.message import say


def count_in_tests(
    lines: Sequence[Row], tests: Sequence[Row], findings: list[Finding]
) -> list[Row]:
    """Lines of sheet Anchors with the tests of their type and ground.

    A type without a ground of its own gets a line for each in which it was tested.

    Parameters
    ----------
    lines : sequence of Row
        Of sheet Anchors.
    tests : sequence of Row
        Of sheet Tests.
    findings : list of Finding
        Appended to: a type that is not there, a ground that it does not have, tests
        beside others.
    """
    places = {line["id"].word: line["id"].place for line in lines}
    refuse_unknown_ids((test["type"] for test in tests), places, findings)
    by_place: dict[tuple[str, str], list[Row]] = {}
    for test in tests:
        if test["force"].state == "given":
            key = (test["type"].word, test["ground"].word)
            by_place.setdefault(key, []).append(test)
    found: list[Row] = []
    for line in lines:
        found += _count(line, by_place, findings)
    for (name, _), left in by_place.items():
        if name in places:
            ground = left[0]["ground"]
            if ground.word:
                rule = say("tests.no_line", type=name)
                refuse(ground, rule, say("tests.line_wanted"), findings)
            else:
                wanted = say("tests.ground_wanted")
                refuse(left[0]["type"], say("tests.no_ground"), wanted, findings)
    return found


def _count(
    line: Row, by_place: dict[tuple[str, str], list[Row]], findings: list[Finding]
) -> list[Row]:
    """Lines that a line becomes; the tests that it takes leave the table."""
    name, own = line["id"].word, line["ground"].word
    if own or (name, "") in by_place:
        tests = by_place.pop((name, own), None)
        if tests:
            _refuse_beside(line, tests[0]["force"], findings)
        return [_fill_in(line, tests, line["ground"]) if tests else line]
    keys = [key for key in by_place if key[0] == name]
    if not keys:
        return [line]
    tested = [by_place.pop(key) for key in keys]
    _refuse_beside(line, tested[0][0]["force"], findings)
    return [_fill_in(line, tests, tests[0]["ground"]) for tests in tested]


def _refuse_beside(line: Row, test: Reading, findings: list[Finding]) -> None:
    """Refuse tests of a type that has its number of tests on its own sheet."""
    if line["test_count"].state == "given":
        refuse_beside(test, line["test_count"], findings)


def _fill_in(line: Row, tests: Sequence[Row], ground: Reading) -> Row:
    """Line with number, least and mean of its tests, and their ground."""
    forces = [test["force"].number for test in tests]
    first = tests[0]["force"]
    how = say("tests.counted", count=len(tests), place=first.place)
    numbers = (float(len(forces)), min(forces), fmean(forces))
    counted: Mapping[str, Reading] = {
        key: replace(
            line[key],
            state="given",
            value=value,
            derivation=how,
            cell=first.cell,
        )
        for key, value in zip(TEST_COLUMNS, numbers, strict=True)
        if line[key].state == "blank"
    }
    if "test_count" in counted:
        singles = tuple(map(read_single, tests))
        counted = {
            **counted,
            "test_count": replace(counted["test_count"], singles=singles),
        }
    field = line["ground"].field
    return {**line, **counted, "ground": replace(ground, field=field)}


def read_single(test: Row) -> SingleTest:
    """One test; what is not said of its result stays open."""
    words = {"held": True, "pulled out": False}
    return SingleTest(
        load=test["force"].si,
        is_held=words.get(test["result"].word),
        proof_load=test["proof_load"].given_si,
        displacement=test["displacement"].given_si,
        source=test["force"].place,
    )
