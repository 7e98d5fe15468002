"""Notional reliability in every output: one decimal, no verdict, reasons."""

import html
import io
import re
from dataclasses import replace

from rich.console import Console

from netdesign.addons.reliability.section import (
    list_reliability,
    show_reliability,
    tabulate_indices,
)
from netdesign.report.page import render_html
from netdesign.report.terminal import print_summary
from netdesign.report.words import ENGLISH, Words
from netdesign.report.workbook.excel import render_workbook
from netdesign.study.records import ReliabilityRecord
from netdesign.words.catalogue import LANGUAGES
from netdesign.words.message import say
from tests.each import each
from tests.report.build_study import build_reliability, build_study
from tests.report.reading import read_workbook

BARE = build_study()
MADE_UP = build_reliability(BARE.rows[0].checks[0].id)
FIT = "fit 2026"
SHARES = {"snow_height": 0.471, "model": 0.379, "resistance": 0.15}
KNOWN = replace(
    MADE_UP,
    beta=3.4271,
    standard_error=0.0137,
    beta_by_form=3.3189,
    beta_at_full=3.1273,
    variables=[
        replace(
            one,
            alpha_squared=SHARES[one.name],
            source=one.source if one.is_assumed else say("source.typed", text=FIT),
        )
        for one in MADE_UP.variables
    ],
)
LACKING = ReliabilityRecord(check="", reason=say("reliability.no_check"))
STUDY = replace(
    BARE,
    rows=[
        replace(BARE.rows[0], reliability=KNOWN),
        replace(BARE.rows[1], reliability=LACKING),
        BARE.rows[2],
    ],
)
LONG = re.compile(r"\b3[.,](?:42|43|31|32|12|13)")  # of an index with two decimals


def test_without_records_there_is_no_annex():
    assert list(show_reliability(BARE, ENGLISH)) == []
    assert list(list_reliability(BARE, ENGLISH)) == []
    assert "annex-reliability" not in render_html(BARE)
    assert "Reliability" not in read_workbook(render_workbook(BARE)).sheetnames


@each("language", LANGUAGES)
def test_a_page_has_index_shares_and_reasons(language):
    words = Words(language)
    page = render_html(STUDY, language)
    annex = html.unescape(page[page.index('id="annex-reliability"') :])
    assert words("reliability.is_not") in annex
    assert words.write("3.4") in annex
    assert words.write("+0.3") in annex
    assert not LONG.search(annex)
    assert all(words.write(one) in annex for one in ("3.1", "3.3", "3.7"))
    assert words("reliability.percent", share="47") in annex
    assert words.show(LACKING.reason) in annex
    assert FIT in annex


@each("beta, error, shown", [
    (3.4271, 0.0137, "3.4 (3.3 to 3.5)"),
    (3.35, 0.005, "3.4 (3.3 to 3.4)"),
    (2.96, 0.019, "3.0 (2.9 to 3.0)"),
])  # fmt: skip
def test_the_band_is_rounded_outwards(beta, error, shown):
    record = replace(KNOWN, beta=beta, standard_error=error)
    study = replace(STUDY, rows=[replace(STUDY.rows[0], reliability=record)])
    (line, *_) = tabulate_indices(study, ENGLISH).rows
    assert shown in [cell.text for cell in line]
    low, high = map(float, re.findall(r"[\d.]+", shown)[1:])
    assert low <= beta - 2.0 * error
    assert high >= beta + 2.0 * error


@each("language", LANGUAGES)
def test_a_terminal_has_it_in_two_lines_without_a_word_of_a_verdict(language):
    words = Words(language)
    lines = list(list_reliability(STUDY, words))
    assert len(lines) == 2
    assert words.write("3.4 (3.3") in lines[0]
    assert words.show(LACKING.reason) in lines[1]
    verdicts = [words(f"verdict.{one}") for one in ("pass", "fail", "not_proven")]
    assert not any(one in line for one in verdicts for line in lines)
    console = Console(file=io.StringIO(), width=200)
    print_summary(STUDY, console, language)
    assert lines[0] in console.file.getvalue()
