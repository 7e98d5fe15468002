"""What is to be done: few lines, each once for all rows, with the worst number."""

import random
from dataclasses import replace

import pytest

from netdesign.checks.rating import Open, OpenKind
from netdesign.outcome import Verdict
from netdesign.study.to_do import MOST_LINES, WHO, list_to_do
from netdesign.words.message import say
from tests.report.build_study import build_study

KINDS = [one for one in OpenKind if one is not OpenKind.PROVEN_ELSEWHERE]


def draw_study(seed):
    """Study of some rows whose checks have drawn open points."""
    rng, study = random.Random(seed), build_study()
    rows = []
    for number in range(rng.randint(1, 12)):
        row = rng.choice(study.rows)
        checks = [
            replace(one, open=[*one.open, *draw_points(rng)]) for one in row.checks
        ]
        rows.append(replace(row, id=f"N{number}", checks=checks))
    return replace(study, rows=rows)


def draw_points(rng):
    if rng.random() < 0.8:
        return []
    message = say("text.as_given", text=f"reason {rng.randint(1, 15)}")
    return [Open(kind=rng.choice(KINDS), message=message)]


@pytest.mark.parametrize("seed", range(20))
def test_few_lines_name_every_row_that_does_not_pass(seed):
    study = draw_study(seed)
    lines = list_to_do(study)
    assert len(lines) <= MOST_LINES
    assert {one.who for one in lines} <= set(WHO)
    named = {row for one in lines for row in one.rows}
    assert named == {row.id for row in study.rows if row.verdict is not Verdict.PASS}
    assert len({(one.who, str(one.text)) for one in lines}) == len(lines)


def test_a_line_has_the_number_of_the_worst_row():
    study = build_study()
    failing = study.rows[1]
    (worst,) = list_to_do(replace(study, rows=[failing]))[:1]
    both = [replace(failing, id="N1"), replace(study.rows[0], id="N2"), failing]
    line, *_ = list_to_do(replace(study, rows=both))
    assert line.text.arguments["what"] == worst.text
    assert line.text.arguments["row"] == "N1"
    assert line.rows == ("N1", failing.id)


@pytest.mark.parametrize("bound", [None, 17.3, 1240.9])
def test_a_missing_resistance_says_how_much_is_needed(bound):
    study = build_study()
    row = study.rows[2]
    (check,) = [one for one in row.checks if one.has_open(OpenKind.RESISTANCE_MISSING)]
    (change, *others) = check.changes
    least = replace(change, sense="at least", bound=bound)
    changed = replace(check, changes=[*([least] if bound else []), *others])
    checks = [changed if one is check else one for one in row.checks]
    lines = list_to_do(replace(study, rows=[replace(row, checks=checks)]))
    needed = [one.text for one in lines if one.text.key == "to_do.needs"]
    of = [each for one in needed for each in one.arguments["of"]]
    assert [one.arguments.get("least") for one in of] == [bound]


def test_what_forces_and_other_checks_say_alike_is_said_once():
    study, reason = build_study(), say("envelope.may_exceed", count=339)
    row = study.rows[0]
    point = Open(kind=OpenKind.UNSOLVED, message=reason)
    checks = [replace(one, open=[point]) for one in row.checks]
    assert len({one.is_of_force for one in checks}) == 2
    (line,) = list_to_do(replace(study, rows=[replace(row, checks=checks)]))
    assert line.text == reason
