"""The anchor schedule: forces, numbers, proof loads; what fails is not ordered."""

import random
import re
from dataclasses import replace

import pytest

from netdesign.outcome import Verdict
from netdesign.report.sections.rated import ANCHOR_MEMBERS, list_anchor
from netdesign.report.sections.schedule import (
    list_anchors,
    show_dips,
    show_schedule,
)
from netdesign.report.words import ENGLISH, show_member
from netdesign.study.case_records import PartRecord
from tests.report.build_study import build_study

BUILT = build_study()
FACTOR = 1.37


def draw_study(seed):
    """The study with numbers and lengths for most of its anchors."""
    dice = random.Random(seed)
    rows = []
    for row in BUILT.rows:
        types = {
            (one.member, one.resistance_type)
            for one in row.checks
            if one.member in ANCHOR_MEMBERS and one.is_of_force
        }
        parts = [
            PartRecord(
                part=member,
                type_id=kind,
                count=dice.choice((None, dice.randrange(1, 40))),
                size=dice.choice((None, round(dice.uniform(2.0, 9.0), 2))),
            )
            for member, kind in sorted(types)
        ]
        rows.append(replace(row, parts=parts))
    profile = replace(BUILT.profile, proof_factor=FACTOR)
    return replace(BUILT, rows=rows, profile=profile)


@pytest.fixture(params=range(3))
def study(request):
    return draw_study(request.param)


def read_tables(study):
    """Texts of schedule and order list."""
    part = show_schedule(study, ENGLISH)
    tables = [one for one in part.blocks if hasattr(one, "rows")]
    return [[[read(cell) for cell in line] for line in one.rows] for one in tables]


def read(cell):
    return cell.text or "".join(getattr(one, "text", "") for one in cell.content)


def test_every_anchor_with_a_force_has_its_line(study):
    schedule, _ = read_tables(study)
    lines = list(list_anchors(study))
    assert len(schedule) == len(lines)
    for row in study.rows:
        for check in row.checks:
            if check.member in ANCHOR_MEMBERS and check.is_of_force:
                assert any(
                    (x.row, x.member, x.type_id)
                    == (row.id, check.member, check.resistance_type)
                    for x in lines
                )
    for cells, line in zip(schedule, lines, strict=True):
        assert cells[1] == show_member(ENGLISH, line.member)
        assert cells[4] == ENGLISH.show_number("demand_kN", line.demand_kN)


def test_the_force_of_a_line_is_the_largest_of_its_checks(study):
    rows = {row.id: row for row in study.rows}
    for line in list_anchors(study):
        checks = list_anchor(rows[line.row], (line.member,))
        own = [x for x in checks if x.resistance_type == line.type_id and x.is_of_force]
        known = [x.demand_kN for x in own if x.demand_kN is not None]
        assert line.demand_kN == max(known, default=None)


def test_a_proof_load_is_the_factor_on_the_upper_end_of_the_pull(study):
    rows, shown = {row.id: row for row in study.rows}, 0
    for line in list_anchors(study):
        pulls = [
            x.read_band("E_d")[1]
            for x in rows[line.row].checks
            if x.member == line.member
            and x.resistance_type == line.type_id
            and x.mode == "pull_out"
            and x.read_band("E_d")[1] is not None
        ]
        if pulls:
            assert line.proof_kN == pytest.approx(FACTOR * max(pulls))
            shown += 1
    assert shown


def test_what_fails_is_not_ordered_and_the_rest_is_added_up(study):
    _, orders = read_tables(study)
    lines = [x for x in list_anchors(study) if x.type_id]
    kept = [x for x in lines if x.rated.verdict is not Verdict.FAIL]
    assert [line[0] for line in orders] == sorted({x.type_id for x in kept})
    for kind, count, *_ in orders:
        counts = [x.count for x in kept if x.type_id == kind]
        wanted = "-" if None in counts else f"{sum(counts)}"
        assert count == wanted


def test_a_bore_is_told_from_the_horizontal():
    assert show_dips([], ENGLISH) == "-"
    assert show_dips([21.6], ENGLISH) == "22°"
    assert show_dips([97.2], ENGLISH) == "83°"
    assert show_dips([14.7, 21.6], ENGLISH) == "15–22°"


def test_every_letter_is_explained(study):
    part = show_schedule(study, ENGLISH)
    (notes,) = [one.items for one in part.blocks if hasattr(one, "items")] or [()]
    schedule, _ = read_tables(study)
    letters = {letter for line in schedule for letter in line[-1].split()}
    assert letters == {re.match("[a-z]", one)[0] for one in notes}


def test_a_flat_bore_has_a_note_and_an_upright_one_none():
    row = next(x for x in BUILT.rows if any(p.anchor == "foot_anchor" for p in x.pulls))
    for dip, notes in ((-7.3, {"flat"}), (21.4, set()), (97.2, {"leans"})):
        pulls = [replace(x, dip_deg=dip) for x in row.pulls]
        study = replace(BUILT, rows=[replace(row, pulls=pulls)])
        found = {
            note
            for line in list_anchors(study)
            for note in line.notes
            if line.dips_deg and note in ("flat", "leans")
        }
        assert found == notes
