"""Quantities of the example with lengths: sums by hand, live prices in the sheet."""

import random
import re
from collections import defaultdict
from dataclasses import replace

import pytest

from netdesign.report.words import Words
from netdesign.report.workbook.excel import render_workbook
from netdesign.report.workbook.quantities import build_quantities
from netdesign.study.parts import PartRecord
from netdesign.words.catalogue import LANGUAGES
from tests.report.build_study import build_study
from tests.report.reading import read_workbook


def draw_parts(row, rng):
    """Parts for the members of a row's checks; of some nobody gives the number."""
    named = {
        (check.member, check.resistance_type)
        for check in row.checks
        if check.is_of_force and check.member != "post_base"
    }
    return [
        PartRecord(
            part=member,
            type_id=kind,
            count=rng.choice((None, rng.randrange(1, 40))),
            size=rng.choice((None, round(rng.uniform(2.0, 9.0), 2))),
        )
        for member, kind in sorted(named)
    ]


@pytest.fixture(scope="module", params=range(3))
def study(request):
    rng = random.Random(request.param)
    built = build_study()
    rows = [replace(row, parts=draw_parts(row, rng)) for row in built.rows]
    return replace(built, rows=rows)


def name_kind(member):
    """What a member is ordered as."""
    kinds = {"anchor": "Anchors", "guy": "Ropes", "post": "Posts", "base": "Posts"}
    return next(
        kind for end, kind in kinds.items() if re.search(f"{end}(_panel)?$", member)
    )


def add_up(study):
    """Pieces and metres by kind and type, straight from the parts of the rows."""
    found = defaultdict(lambda: [0, 0.0])
    for row in study.rows:
        for part in row.parts:
            if part.count is not None:
                line = found[name_kind(part.part), part.type_id or "-"]
                line[0] += part.count
                line[1] += part.count * (part.size or 0.0)
    return found


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_table_has_every_type_once_with_its_sums(study, language):
    table = build_quantities(study, Words(language))
    types = [(row[0].text, row[1].text) for row in table.rows]
    assert len(types) == len(set(types)) > 2
    sums = add_up(study)
    english = build_quantities(study, Words("en")).rows
    for row, own in zip(table.rows, english, strict=True):
        pieces, metres = sums[own[0].text, own[1].text]
        assert row[5].number in (None, pieces)
        assert row[7].number is None or row[7].number == pytest.approx(metres)
        assert (row[5].number is None) == (row[5].text[0] in "-≥")


def test_a_type_has_the_largest_force_of_all_its_checks(study):
    table = build_quantities(study, Words("en"))
    for row in table.rows:
        forces = [
            check.read_band("E_d")[1]
            for one in study.rows
            for check in one.checks
            if check.is_of_force
            and (check.resistance_type or "-") == row[1].text
            and name_kind(check.member) == row[0].text
        ]
        if forces and None not in forces:
            assert row[3].number == pytest.approx(max(forces))


def test_a_tested_type_has_the_proof_load_of_its_largest_pull_out(study):
    factor = 1.37
    profile = replace(study.profile, proof_factor=factor)
    table = build_quantities(replace(study, profile=profile), Words("en"))
    shown = 0
    for row in table.rows:
        forces = [
            check.read_band("E_d")[1]
            for one in study.rows
            for check in one.checks
            if check.mode == "pull_out"
            and check.resistance_type == row[1].text
            and name_kind(check.member) == row[0].text
        ]
        known = forces and None not in forces
        wanted = factor * max(forces) if known else None
        assert row[4].number == (pytest.approx(wanted) if known else None)
        shown += bool(known)
    assert shown
    without = build_quantities(study, Words("en"))
    assert {row[4].number for row in without.rows} == {None}


def test_a_price_gives_an_amount_in_the_sheet(study):
    book = read_workbook(render_workbook(study), formulas=True)
    sheet = book[book.sheetnames[1]]
    formulas = [
        (cell.row, str(cell.value))
        for row in sheet.iter_rows()
        for cell in row
        if str(cell.value).startswith("=IF(")
    ]
    lines = build_quantities(study, Words("en"), has_prices=True).rows
    assert len(formulas) == len(lines)
    for (number, formula), line in zip(formulas, lines, strict=True):
        assert sheet.cell(number, 2).value == line[1].text
        counted = re.fullmatch(
            r'=IF\(COUNT\(I\d+,[FH]\d+\)<2,"",([FH])\d+\*I\d+\)', formula
        )
        assert counted[1] == ("F" if line[5].number is not None else "H")
