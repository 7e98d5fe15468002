"""A type that is offered without a condition passes where the workbook has it."""

import random
from collections import Counter
from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.outcome import Verdict
from netdesign.site.columns.office import load_columns
from netdesign.site.reader import read_site
from netdesign.structure.members import NetPart
from netdesign.study.judge import judge_site
from tests.make import find_cell, load_rows, write_site
from tests.small_site import RUN
from tests.study.test_sizing import solve

PROFILE = load_standard("nf-p-95-304-style")
ROWS = ("R4", "R6", "R7")  # a bar; no test; free ground
AT_END = dict.fromkeys(("lateral_anchor", "end_guy_anchor"), "end_anchor")


def write_example(path, dice=None):
    """Three rows; dice draw types and grounds anew."""
    tables = load_rows(ROWS, leans=False)
    tables["declared"] = []
    if dice:
        draw_types(tables, dice)
    return read_site(write_site(path, tables))


def draw_types(tables, dice):
    """Strengths, grounds and proofs as an office may give them."""
    lines = tables["rows"] + tables["net_types"]
    built = {str(value) for one in lines for value in one.values()}
    for one in tables["anchor_types"]:
        others = () if one["id"] in built else ("rock",)
        one["ground"] = dice.choice(("till", "till", "till", "", *others))
        one["protection"] = dice.choice(("cover", "cover", "none"))
        share = dice.uniform(0.37, 1.9)
        for key in ("pull_out", "test_mean"):
            if key in one:
                one[key] = round(one[key] * share, 1)
        one["tendon"] = round(one["tendon"] * dice.uniform(0.37, 1.9), 1)
        if "pull_out" in one and dice.random() < 0.4:
            one["proven"] = "calculated"
            for key in ("test_count", "test_mean"):
                one.pop(key, None)
    if dice.random() < 0.5:  # bores so flat that mortar may run out of them
        for one in tables["anchor_types"]:
            one["dip"] = 5.0
    for one in (*tables["ropes"], *tables["posts"]):
        key = "rope" if "rope" in one else "second_moment"
        one[key] = round(one[key] * dice.uniform(0.23, 1.3), 1)
    for one in tables["rows"]:
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


def name_cell(site, row, check):
    """Cell that names the type of a member, in the row or in its net type."""
    place = [one.id for one in site.rows].index(row.id)
    key = AT_END.get(check.member, check.member)
    of_rows = {one.field.key for one in load_columns("rows")}
    if key in of_rows:
        return find_cell("rows", key, place)
    return find_cell("net_types", key, int(row.id[1:]) - 1)


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
            again = read_site(path, instead={name_cell(site, row, built[name]): kind})
            verdict = judge(again, rows, row.id)[name].verdict
            yield note.key if note else "", verdict


@pytest.mark.long
def test_a_type_that_is_offered_passes_unless_its_own_resistance_is_unproven(tmp_path):
    """A condition is said where the workbook with it does not pass, only there."""
    dice, sites = random.Random(20261127), []
    for number in range(8):
        path = tmp_path / f"{number}.xlsx"
        sites.append((path, write_example(path, dice if number else None)))
    rows = solve(sites[0][1]).rows
    found = [one for path, site in sites for one in list_outcomes(path, site, rows)]
    counts = Counter(found)
    assert set(counts) == {
        ("", Verdict.PASS),
        ("change.if_rest_proven", Verdict.NOT_PROVEN),
    }
    assert min(counts.values()) > 10
