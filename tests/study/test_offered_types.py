"""A type that is offered without a condition passes where the workbook has it."""

import copy
import random
from collections import Counter
from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.outcome import Verdict
from netdesign.site.reader import read_site
from netdesign.solving.runner import Runner
from netdesign.structure.members import EndMember, NetPart
from netdesign.study.check_site import solve_rows
from netdesign.study.judge import judge_site
from netdesign.words.message import say
from tests.old_example import load_example
from tests.site_lines import write_lines
from tests.small_site import RUN

PROFILE = load_standard("nf-p-95-304-style")
ROWS = ("R4", "R6", "R7")  # a bar; no test; a borehole that rises


class Nobody:
    def enter(self, key, words=None):
        """No phase is told."""

    report_wave = enter

    def count_piece(self):
        """Nor a check."""


def write_example(path, dice=None):
    """The example's three rows with few samples; dice draw types and grounds anew."""
    lines = copy.deepcopy(load_example())
    lines["Nets"] = [one for one in lines["Nets"] if one["id"] in ROWS]
    lines["Ends"] = [one for one in lines["Ends"] if one["row"] in ROWS]
    lines["Declared"] = []
    lines["Nets"][1] |= {"row_end": "", "neighbour": "", "gap": 0.0}
    lines["Ranges"][2]["high"] = lines["Ranges"][2]["low"]
    if dice:
        draw_types(lines, dice)
    write_lines(path, lines)
    return read_site(path)


def draw_types(lines, dice):
    """Strengths, grounds, bases and lives as an office may give them."""
    built = {
        str(value) for one in lines["Nets"] + lines["Ends"] for value in one.values()
    }
    for one in lines["Anchors"]:
        others = () if one["id"] in built else ("rock",)
        one["ground"] = dice.choice(("till", "till", "till", "", *others))
        one["protected_years"] = dice.choice((100, 100, 57))
        for key in ("tendon", "pull_out"):
            if key in one:
                one[key] = round(one[key] * dice.uniform(0.37, 1.9), 1)
        if "pull_out" in one:
            one["basis"] = dice.choice(("tested", "tested", "computed"))
    for one in (*lines["Ropes"], *lines["Posts"]):
        one["protected_years"] = dice.choice((80, 80, 41))
        key = "rope" if "rope" in one else "second_moment"
        one[key] = round(one[key] * dice.uniform(0.23, 1.3), 1)
    for one in lines["Nets"]:
        if dice.random() < 0.5:  # a bore so flat that mortar may run out of it
            one.pop("anchor_axes", None)
            one |= {"foot_axis": 2.3, "uphill_axis": 1.7}
        one["ground"] = dice.choice(("till", "till", ""))


def judge(site, rows, name):
    """Checks of one net row by their ids."""
    places = [place for place, row in enumerate(site.rows) if row.id == name]
    alone = replace(site, rows=tuple(site.rows[place] for place in places))
    study = judge_site(alone, [rows[place] for place in places], PROFILE, RUN)
    return {one.id: one for one in study.rows[0].checks}


def list_offers(checks):
    """Checks with the types of the workbook that are said to make them pass."""
    for name, check in checks.items():
        for change in check.changes:
            if change.quantity.key == "change.type_of_workbook":
                yield name, change.quantity.arguments["type"], change.note


def find_cell(row, check):
    """Cell that names the type of a member."""
    sheet = "Ends" if check.member in tuple(EndMember) else "Nets"
    labels = {echo.label: echo.cell for echo in row.inputs}
    return labels[say(f"column.{sheet}.{check.member}")]


def list_outcomes(path, site, rows):
    """Key of each offer's condition, with the verdict that the workbook then has."""
    for row in site.rows:
        built = judge(site, rows, row.id)
        for name, kind, note in list_offers(built):
            if note is not None and note.key == "change.solve_again":
                continue  # another force, which these solved cases do not tell
            if built[name].member in tuple(NetPart):
                assert note is not None
                continue
            again = read_site(path, instead={find_cell(row, built[name]): kind})
            verdict = judge(again, rows, row.id)[name].verdict
            yield note.key if note else "", verdict


@pytest.mark.long
def test_a_type_that_is_offered_passes_unless_its_own_resistance_is_unproven(tmp_path):
    """A condition is said where the workbook with it does not pass, only there."""
    dice, sites = random.Random(20261127), []
    for number in range(8):
        path = tmp_path / f"{number}.xlsx"
        sites.append((path, write_example(path, dice if number else None)))
    rows = solve_rows(sites[0][1], RUN, Runner(), Nobody()).rows
    found = [one for path, site in sites for one in list_outcomes(path, site, rows)]
    counts = Counter(found)
    assert set(counts) == {
        ("", Verdict.PASS),
        ("change.if_rest_proven", Verdict.NOT_PROVEN),
    }
    assert min(counts.values()) > 10
