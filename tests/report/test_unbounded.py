"""A check that nothing resists governs everywhere, and is shown as infinite."""

import io
import json
import math
import random
import re
from dataclasses import replace

import pytest
from rich.console import Console

from netdesign.outcome import Verdict
from netdesign.report.difference import compare_studies, write_difference
from netdesign.report.page.html import render_html
from netdesign.report.terminal import print_summary
from netdesign.report.words import Words
from netdesign.report.workbook.excel import render_workbook
from netdesign.study.document import read_document, write_document
from netdesign.study.governing import (
    find_governing,
    find_highest,
    find_worst,
)
from netdesign.words.catalogue import LANGUAGES
from tests.checks.given_pulls import POST, study_row
from tests.report.build_study import build_row
from tests.report.reading import (
    PageReader,
    read_checks,
    read_workbook,
    recalculate,
)
from tests.study.test_support_checks import ROW, SWISS
from tests.turn import turn

BENT = "post.compression_bending"
WEAK_POST = POST | {"section modulus [cm3]": 6, "post width [mm]": 300}


@pytest.fixture
def study(tmp_path):
    """Its post is used up by bending; its foot anchor fails by many times its force."""
    anchor = ROW["anchor"] | {"pull-out resistance [kN]": 20}
    return study_row(tmp_path, SWISS, **(ROW | {"anchor": anchor}), post=WEAK_POST)


@pytest.fixture
def sound(tmp_path):
    """The same row with a post that stands."""
    folder = tmp_path / "sound"
    folder.mkdir()
    return study_row(folder, SWISS, **ROW)


def draw_checks(dice):
    """Checks of a row: of any verdict, with a utilisation that fits it, or without."""
    plain = build_row("R", 3, scale=0.6).checks[0]
    checks = []
    for number in range(dice.randint(1, 9)):
        verdict = dice.choice(list(Verdict))
        is_unbounded = verdict is Verdict.FAIL and dice.random() < 0.3
        used = math.inf if is_unbounded else _draw_used(dice, verdict)
        reason = "nothing is left" if is_unbounded else None
        turned = turn(plain, verdict, utilisation=used, reason=reason)
        checks.append(replace(turned, id=f"check {number}"))
    return checks


def _draw_used(dice, verdict):
    if verdict is Verdict.FAIL:
        return dice.uniform(1.01, 12.0)
    known = dice.uniform(0.1, 0.99)
    return known if verdict is Verdict.PASS else dice.choice([None, known])


def test_governing_check_of_a_failing_row_is_used_as_much_as_any_that_fails():
    dice = random.Random(20261124)
    for _ in range(500):
        checks = draw_checks(dice)
        failing = [one for one in checks if one.verdict is Verdict.FAIL]
        governing = find_governing(checks)
        if failing:
            assert governing in failing
            most = max(-1.0 if one.used is None else one.used for one in failing)
            assert (-1.0 if governing.used is None else governing.used) == most
        if any(one.is_unbounded for one in checks):
            assert sorted(checks, key=lambda one: one.rank)[0].is_unbounded
            assert find_highest(checks).is_unbounded
            assert find_worst(checks).is_unbounded


def test_infinity_governs_before_many_times_the_resistance(study):
    row = study.rows[0]
    others = [one.utilisation for one in row.checks if one.utilisation]
    assert max(others) > 5.0
    governing = find_governing(row.checks)
    assert (governing.id, governing.utilisation) == (BENT, None)
    assert governing.used == math.inf
    assert row.drawing is None or row.drawing.case == governing.case


def test_study_says_it_without_an_infinite_number_and_reads_it_back(study):
    text = write_document(study)
    json.loads(text, parse_constant=pytest.fail)  # neither Infinity nor NaN
    again = read_document(text)
    assert [one.is_unbounded for one in again.rows[0].checks] == [
        one.is_unbounded for one in study.rows[0].checks
    ]
    assert write_document(again) == text


def test_terminal_shows_infinity_and_explains_it_first(study):
    stream = io.StringIO()
    print_summary(study, Console(file=stream, width=160), explain=True)
    (line,) = [one for one in stream.getvalue().splitlines() if one.startswith("R  ")]
    assert "Post, compression with bending" in line
    assert " ∞ " in line
    assert "∞ (" not in line
    lines = stream.getvalue().splitlines()
    told = [one for one in lines if one.startswith("R Post, compression")]
    assert told[0].startswith("R Post, compression with bending (FAIL)")


@pytest.mark.parametrize("language", LANGUAGES)
def test_page_has_infinity_on_its_first_page_and_in_the_worked_check(study, language):
    reader = PageReader(render_html(study, language))
    rows, *_ = reader.tables["decision"]
    assert rows[1][3] == "✗ ∞"  # of its structure
    assert rows[1][6] == "∞"
    (worked,) = reader.tables["row-1-worked"]
    assert worked[-1][-1] == "∞"
    page = " ".join(" ".join(reader.text).split())
    assert not re.search(r"\binf\b", page)


def test_workbook_shows_infinity(study):
    cached = read_workbook(render_workbook(study)).worksheets[0]
    assert (cached["H6"].value, cached["I6"].value) == ("∞", "∞")
    assert cached["J6"].value == "Post, compression with bending"


@pytest.mark.long
def test_recalculated_workbook_keeps_infinity(study, tmp_path):
    books = recalculate({"one": render_workbook(study)}, tmp_path)
    checks = read_checks(read_workbook(books["one"])["Checks"])
    (bent,) = [one for one in checks if one.name == "Post, compression with bending"]
    assert (bent.verdict, bent.used[1]) == ("FAIL", "∞")


def test_document_shows_infinity(study):
    pytest.importorskip("docx")
    from netdesign.report.document.word import render_document
    from tests.report.document.reading import list_tables

    cells = [
        cell
        for table in list_tables(render_document(study))
        for line in table
        for cell in line
    ]
    assert "∞" in cells
    assert not any("∞ -" in cell for cell in cells)


def test_difference_names_infinity(sound, study):
    changes = compare_studies(sound, study)
    found = {(one.area, one.what.key): one for one in changes}
    change = found["governing", "diff_check.utilisation"]
    assert change.tell("en").endswith("→ ∞") or change.tell("en").endswith("-> ∞")
    assert change.new == "unbounded"
    json.dumps(write_difference(changes), allow_nan=False)
    others = [one for one in changes if one.area == "other"]
    assert not any("unbounded" in Words("en").show(one.what) for one in others)
