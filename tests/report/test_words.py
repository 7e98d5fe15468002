import math
from dataclasses import replace

import pytest

from netdesign.commands.running import EXIT_CODES
from netdesign.outcome import SolveError, Verdict
from netdesign.quantities import QUANTITIES
from netdesign.report import words
from netdesign.snow.creep_law import CREEP_LAWS
from netdesign.study.record_provenance import name_law
from netdesign.words.catalogue import LANGUAGES
from tests.each import each
from tests.report.build_study import build_check, build_extreme, build_row


def test_every_verdict_has_its_own_word_sign_and_exit_code():
    assert set(words.VERDICTS) == set(Verdict)
    codes = {signs.exit_code for signs in words.VERDICTS.values()}
    assert len(codes) == len(Verdict)
    for language in LANGUAGES:
        told = words.Words(language)
        shown = [words.show_verdict(verdict, told) for verdict in Verdict]
        for read in ("word", "symbol", "style", "meaning"):
            assert len({getattr(one, read) for one in shown}) == len(Verdict)


def test_exit_codes_are_those_of_the_interface():
    codes = {v: shown.exit_code for v, shown in words.VERDICTS.items()}
    assert codes == EXIT_CODES
    assert codes == {
        Verdict.PASS: 0, Verdict.FAIL: 1, Verdict.NOT_PROVEN: 4, Verdict.DECLARED: 6
    }  # fmt: skip
    assert codes[Verdict.NOT_PROVEN] == SolveError.exit_code


@pytest.mark.parametrize("value", [None, math.nan, math.inf])
def test_a_missing_number_is_never_zero_or_empty(value):
    assert words.ENGLISH.show_number("demand_kN", value) == "-"
    assert words.ENGLISH.show_with_unit("demand_kN", value) == "-"


@pytest.mark.parametrize(
    ("value", "expected"),
    [(0.99999, "1.000"), (1.0, "1.000"), (1.0000001, ">1.000"), (1.001, "1.001")],
)
def test_a_ratio_above_one_never_reads_as_one(value, expected):
    assert words.ENGLISH.show_number("utilisation", value) == expected


def test_text_loses_control_characters_and_line_breaks():
    assert words.show_text("a\x1b[31m\nb\x00") == "a [31m b"
    assert words.show_text(" \n ") == "-"


def test_a_no_break_space_stays_between_words():
    told = words.Words(language="fr")("show.label", label="R1", text="non")
    assert words.show_text(f" {told}\n\t{told} \u00a0") == f"{told} {told}"
    assert "\u00a0" in told


@each("key", QUANTITIES)
def test_number_format_writes_as_many_decimals_as_the_text(key):
    quantity, code = QUANTITIES[key], words.number_format(key)
    if quantity.decimals is None:
        assert code == "General"
    else:
        assert code.split("E")[0].partition(".")[2] == "0" * quantity.decimals


def test_names_of_checks_and_cases():
    row = build_row("A", 2, scale=0.6)
    check = build_check("foot_anchor", "pull_out", row.extremes[0], 480.0)
    assert words.show_check(words.ENGLISH, check) == "Foot anchor, pull-out"
    worst = build_extreme("post", row.cases).case
    assert words.ENGLISH.name_case(worst) == "450 kg/m³, φ 15°, θ 35°"
    assert words.ENGLISH.name_case_short(worst) == "450 / 15 / 35"


@pytest.mark.parametrize("law", CREEP_LAWS.values(), ids=str)
def test_the_source_of_a_creep_law_is_told_in_the_language(law):
    """Laws of somebody's own keep their words."""
    stored = name_law(law)
    told = {
        words.show_own(words.Words(language), stored): language
        for language in LANGUAGES
    }
    assert len(told) == len(LANGUAGES)
    assert told[stored] == "en"
    assert all(text.startswith(f"{law.name} (") for text in told)
    own = name_law(replace(law, source="our own tests"))
    assert words.show_own(words.Words("de"), own) == f"{law.name} (our own tests)"
