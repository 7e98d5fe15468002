"""The anchor schedule: what is built and the forces that it is built for."""

import re
from dataclasses import replace

import pytest

from netdesign.report.words import ENGLISH, Words, show_member
from netdesign.report.workbook.quantities import build_schedule
from netdesign.site.model import InputEcho
from netdesign.study.support_records import PanelRecord
from netdesign.words.catalogue import LANGUAGES
from netdesign.words.message import say
from netdesign.words.names import name_mode
from tests.report.build_study import build_study

STUDY = build_study()
MEMBERS = ("uphill_anchor", "uphill_guy", "downhill_anchor", "post")


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_part_with_a_force_has_a_line(language):
    words = Words(language)
    lines = [[cell.text for cell in x] for x in build_schedule(STUDY, words).rows]
    for row in STUDY.rows:
        for check in row.checks:
            if check.is_of_force:
                named = [row.id, show_member(words, check.member)]
                kinds = [line[2] for line in lines if line[:2] == named]
                assert (check.resistance_type or "-") in kinds


def test_forces_are_the_upper_ends_of_their_checks():
    for row in STUDY.rows:
        lines = [x for x in build_schedule(STUDY, ENGLISH).rows if x[0].text == row.id]
        for line in lines:
            ends = [
                one.read_band("E_d")[1]
                for one in row.checks
                if one.is_of_force
                and one.position != "edge"
                and show_member(ENGLISH, one.member) == line[1].text
            ]
            known = [end for end in ends if end is not None]
            assert line[8].number == (max(known) if known else None)


def test_the_least_resistance_passes_and_anything_below_does_not():
    for row in STUDY.rows:
        for line in build_schedule(STUDY, ENGLISH).rows:
            if line[0].text != row.id:
                continue
            for check in row.checks:
                if show_member(ENGLISH, check.member) != line[1].text:
                    continue
                _, demand = check.read_band("E_d")
                factor = check.read("γ_R")
                if demand and factor:
                    mode = ENGLISH.show(name_mode(check.mode))
                    found = re.search(rf"(?:{mode} |^)([\d.]+)", line[-1].text)
                    least = float(found[1])
                    assert demand * factor <= least < 1.01 * demand * factor


def echo(column, value):
    label = say(f"column.Nets.{column}")
    return InputEcho(label=label, unit="", text=f"{value}", value=value, cell="Nets!A2")


@pytest.mark.parametrize("language", LANGUAGES)
def test_each_part_has_its_number_and_place(language):
    words = Words(language)
    inputs = [echo("guy_count", 2.0), echo("uphill_anchor_distance", 3.27)]
    of_force = next(one for one in STUDY.rows[0].checks if one.is_of_force)
    checks = [replace(of_force, member=one) for one in MEMBERS]
    row = replace(STUDY.rows[0], inputs=inputs, checks=checks)
    lines = build_schedule(replace(STUDY, rows=[row]), words).rows
    places = {line[1].text: line[3].text for line in lines}
    at = {one: places[show_member(words, one)] for one in MEMBERS}
    assert at["uphill_anchor"].startswith("2 ")
    assert words.write("3.27 m") in at["uphill_anchor"]
    assert at["uphill_guy"].startswith("2 ")
    assert "3" not in at["uphill_guy"]
    assert at["post"].startswith("1 ")
    # nobody gave the other distance
    assert " - m" in at["downhill_anchor"]


@pytest.mark.parametrize(
    ("has_mid", "assumed", "shown"),
    [
        (False, [], "1 per post"),
        (True, [], "1 per post, 1 in mid-panel"),
        (True, ["mid_anchors"], "1 per post; in mid-panel: not given"),
        (False, ["mid_anchors", "net_cut"], "1 per post; in mid-panel: not given"),
    ],
)
def test_foot_anchors_in_mid_panel_are_counted(has_mid, assumed, shown):
    of_force = next(one for one in STUDY.rows[0].checks if one.is_of_force)
    panel = PanelRecord(
        cut="upper",
        has_mid_anchors=has_mid,
        ropes=[],
        assumed=[say(f"column.Nets.{one}") for one in assumed],
    )
    checks = [replace(of_force, member="foot_anchor")]
    row = replace(STUDY.rows[0], checks=checks, panel=panel)
    ((_, _, _, place, *_),) = build_schedule(replace(STUDY, rows=[row]), ENGLISH).rows
    assert place.text == shown
