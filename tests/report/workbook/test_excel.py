import io
import re
from dataclasses import replace

import numpy as np
import pytest
from openpyxl.utils import get_column_letter
from xlsxwriter.worksheet import Worksheet

from netdesign.calculation.quantity import Kind
from netdesign.outcome import Verdict, merge_verdicts
from netdesign.report.words import ENGLISH, Words
from netdesign.report.workbook.check_sheet import CHANGED
from netdesign.report.workbook.excel import SHEETS, render_workbook
from netdesign.study.document import compute_digest
from netdesign.words.catalogue import LANGUAGES, load_texts
from netdesign.words.message import say
from tests.report.build_study import FORMULA, SCRIPT, build_study
from tests.report.reading import find_steps, read_rows, read_workbook, recalculate
from tests.words.test_catalogue import list_gaps

LIMIT = 1e-12  # relative: one rounding of a product, with room


def hold_back(study):
    """The same study with passing checks held back for failed cases."""
    row = study.rows[0]
    check = replace(row.checks[0], verdict=Verdict.NOT_PROVEN, reason="Failed cases.")
    slack = replace(row.checks[6], verdict=Verdict.NOT_PROVEN)
    checks = [check, *row.checks[1:6], slack]
    held = replace(row, checks=checks, verdict=Verdict.NOT_PROVEN)
    return replace(study, rows=[held, *study.rows[1:]])


def tell_apart(study):
    """The same study; each given value of a check has a cell of its own."""
    rows = [
        replace(
            row,
            checks=[
                replace(
                    check,
                    steps=[
                        replace(step, source=f"{step.source} {row.id} {number}")
                        if step.kind is Kind.GIVEN
                        else step
                        for step in check.steps
                    ],
                )
                for number, check in enumerate(row.checks)
            ],
        )
        for row in study.rows
    ]
    return replace(study, rows=rows)


STUDY = tell_apart(hold_back(build_study()))


@pytest.fixture(scope="module")
def content():
    return render_workbook(STUDY)


# What a factor, a resistance or an action is not, as cells can hold it.
NO_NUMBERS = (
    *(None, "", "abc", "1.5", " 2", "-", "#DIV/0!"),
    *("#N/A", "=1/0", '="1.5"', "=NA()", -1.5, -1e-9),
)
# Steps of a check, and columns of their low end, value and high end.
FACTORS = (("γ_E", "E"), ("R_k", "E"), ("γ_R", "E"))
ACTIONS = (("E_k", "D"), ("E_k", "E"), ("E_k", "F"))


def build_many(lines):
    """Net rows of checks that all pass, at least so many of them loaded."""
    (row,) = build_study(rows=1).rows
    assert {check.verdict for check in row.checks} == {Verdict.PASS}
    count = -(-lines // sum(check.is_of_force for check in row.checks))
    study = build_study(rows=1)
    rows = [replace(row, id=f"R{number}") for number in range(count)]
    return tell_apart(replace(study, rows=rows))


SPOILS = [
    *((*place, value) for place in FACTORS for value in (*NO_NUMBERS, 0, 0.0)),
    *((*place, value) for place in ACTIONS for value in NO_NUMBERS),
    *(("E_k", "E", 1e4), ("E_k", "D", 1e4)),
]
# Each language has a third of them, and so every one is tried.
SPOILS_OF = {
    language: SPOILS[k :: len(LANGUAGES)] for k, language in enumerate(LANGUAGES)
}
MANY = build_many(len(SPOILS_OF["en"]))
LOADED = [
    (line, check)
    for line, check in enumerate((c for row in MANY.rows for c in row.checks), 5)
    if check.is_of_force
]


def spoil(language):
    """One cell of each loaded check typed over."""
    book = read_workbook(render_workbook(MANY, language), formulas=True)
    sheet = list(book)[4]
    blocks = find_steps(sheet)
    for block, (symbol, letter, value) in zip(
        blocks, SPOILS_OF[language], strict=False
    ):
        where = block[symbol]
        is_empty = sheet[f"{letter}{where}"].value is None  # it is as the value
        sheet[f"{'E' if is_empty else letter}{where}"].value = value
    buffer = io.BytesIO()
    book.save(buffer)
    return buffer.getvalue()


@pytest.fixture(scope="module")
def fresh(content, tmp_path_factory):
    """Recalculated workbooks: of each language, and an edited English one."""
    books = {
        "en": content,
        "edited": edit(content),
        "between": edit(content, give_between()),
        **{name: edit_profile(name) for name in PROFILE_EDITS},
        **{name: render_workbook(STUDY, name) for name in ("fr", "de")},
        **{f"spoilt-{name}": spoil(name) for name in LANGUAGES},
    }
    return recalculate(books, tmp_path_factory.mktemp("books"))


def give_between():
    """Resistance that bears the missing check's force, but not its upper end."""
    check = STUDY.rows[2].checks[3]
    assert check.read("R_k") is None
    _, force = check.read_band("E_d")
    return check.read("γ_R") * (force + check.read("E_d")) / 2.0


def edit(content, given=1e4):
    """Three cells typed over, as an engineer would."""
    book = read_workbook(content, formulas=True)
    sheet = book["Steps"]
    first, second, third = np.array_split(find_steps(sheet), 3)
    sheet[f"E{first[1]['R_k']}"] = 1.0  # tiny pull-out resistance of the foot anchor
    sheet[f"E{third[3]['R_k']}"] = given  # the missing resistance
    sheet[f"E{second[5]['R_k']}"] = None  # the slack guy loses its resistance
    buffer = io.BytesIO()
    book.save(buffer)
    return buffer.getvalue()


# A value of the profile that is no factor of a check; factors of all.
PROFILE_EDITS = {
    "other-value": ("inclination.low", 24.0),
    "no-value": ("inclination.low", None),
    "on-action": ("factor.action", 1.4),
    "on-resistance": ("factor.tendon", 1.3),
}


def edit_profile(name):
    """One value of the profile typed over in the workbook of a study that passes."""
    study = LOOSE
    book = read_workbook(render_workbook(study), formulas=True)
    key, number = PROFILE_EDITS[name]
    line = [one.id for one in study.profile.values].index(key)
    book["Profile"][f"C{5 + line}"] = number
    buffer = io.BytesIO()
    book.save(buffer)
    return buffer.getvalue()


def follow_factors(study):
    """The same study; the first check's resistance rests on the factors themselves."""
    (row,) = study.rows
    names = list_gaps(load_texts("en")["post_bending.beside"])
    bending = say("post_bending.beside", **dict.fromkeys(names, 1.0))
    first = replace(row.checks[0], resistance_derivation=bending)
    return replace(study, rows=[replace(row, checks=[first, *row.checks[1:]])])


LOOSE = follow_factors(build_study(rows=1))


def expected_checks(study):
    return [check for row in study.rows for check in row.checks]


def assert_equals_study(content, study):
    book = read_workbook(content)
    rows = read_rows(book["Checks"], "No.")
    for line, check in zip(rows, expected_checks(study), strict=True):
        low, high = check.utilisation_band
        expected = {
            "E_k [kN]": check.read("E_k"),
            "γ_E": check.read("γ_E"),
            "E_d low [kN]": check.read_band("E_d")[0],
            "E_d [kN]": check.demand_kN,
            "E_d high [kN]": check.read_band("E_d")[1],
            "R_k [kN]": check.read("R_k"),
            "γ_R": check.read("γ_R"),
            "R_d [kN]": check.resistance_kN,
            "μ low": low,
            "μ": check.utilisation,
            "μ high": high,
        }
        for heading, value in expected.items():
            shown = "-" if value is None else pytest.approx(value, rel=LIMIT)
            assert line[heading] == shown, heading
        assert line["Verdict"] == ENGLISH(f"verdict.{check.verdict}")
    summary = read_rows(book["Decision"], "No.")
    words = [line["Verdict"] for line in summary]
    assert words == [ENGLISH(f"verdict.{row.verdict}") for row in study.rows]
    assert book["Decision"]["C3"].value == ENGLISH(f"verdict.{study.verdict}")


def test_cached_values_equal_the_study(content):
    assert_equals_study(content, STUDY)


def test_recalculation_equals_the_study(content, fresh):
    assert_equals_study(fresh["en"], STUDY)
    cached, live = read_workbook(content), read_workbook(fresh["en"])
    formulas = read_workbook(content, formulas=True)
    count = 0
    for sheet in formulas:
        for line in sheet.iter_rows():
            for cell in line:
                if cell.data_type != "f":
                    continue
                count += 1
                value = cached[sheet.title][cell.coordinate].value
                is_number = isinstance(value, float)
                expected = pytest.approx(value, rel=LIMIT) if is_number else value
                shown = live[sheet.title][cell.coordinate].value
                assert shown == expected, (sheet.title, cell.coordinate)
    assert count > 150


def test_verdicts_follow_an_edited_cell(fresh):
    book = read_workbook(fresh["edited"])
    assert book["Checks"]["S6"].value == "FAIL"
    assert book["Checks"]["S18"].value == "NOT PROVEN"
    assert book["Checks"]["S22"].value == "PASS"
    verdicts = [line["Verdict"] for line in read_rows(book["Decision"], "No.")]
    assert verdicts == ["FAIL", "FAIL", "PASS"]


def test_a_resistance_given_later_meets_the_whole_band_of_the_force(fresh):
    book = read_workbook(fresh["between"])
    line = read_rows(book["Checks"], "No.")[22 - 5]
    assert line["μ low"] < line["μ"] < 1.0 < line["μ high"]
    assert line["Verdict"] == "NOT PROVEN"


@pytest.mark.parametrize("language", LANGUAGES)
def test_what_is_no_number_never_passes(language, fresh):
    words, book = Words(language), read_workbook(fresh[f"spoilt-{language}"])
    passes, open_ = (words(f"verdict.{v}") for v in ("pass", "not_proven"))
    sheet = book[words("heading.checks")]
    spoilt = dict(zip((line for line, _ in LOADED), SPOILS_OF[language], strict=False))
    for line, check in LOADED:
        expected = open_ if line in spoilt else passes
        assert sheet[f"S{line}"].value == expected, (check.id, spoilt.get(line))
    summary = book[words("heading.decision")]
    assert summary["C3"].value == open_
    assert {summary[f"C{line}"].value for line in range(6, 6 + len(MANY.rows))} == {
        open_
    }


@pytest.mark.parametrize("language", LANGUAGES)
def test_sentences_of_the_study_go_where_they_no_longer_hold(language, fresh):
    words, book = Words(language), read_workbook(fresh[f"spoilt-{language}"])
    sheet = book[words("heading.checks")]
    changed = {words(CHANGED), words("caption.changed_factor")}
    spoilt = [line for (line, _), _ in zip(LOADED, SPOILS_OF[language], strict=False)]
    for line, check in LOADED:
        shown = {sheet[f"{letter}{line}"].value for letter in "VW"}
        assert (len(shown) == 1 and shown <= changed) is (line in spoilt), check.id
    summary = book[words("heading.decision")]
    assert summary["D3"].value == words("meaning.not_proven")
    assert [summary[f"{letter}6"].value for letter in "JKM"] == [
        *("-", "-", words(CHANGED))
    ]


def test_what_governs_goes_with_the_numbers(fresh):
    book = read_workbook(fresh["en"])
    checks, summary = book["Checks"], book["Decision"]
    assert {summary[f"J{line}"].value for line in (6, 7, 8)} <= {
        line["Check"] for line in read_rows(checks, "No.")
    }
    assert summary["K6"].value == "450 kg/m³, φ 15°, θ 35°"
    book = read_workbook(fresh["edited"])
    checks, summary = book["Checks"], book["Decision"]
    assert [checks[f"W{line}"].value for line in (5, 6, 18, 22)] == [
        *("Failed cases.", *(ENGLISH(CHANGED),) * 3)
    ]
    assert summary["D3"].value == ENGLISH("meaning.fail")
    for line in (6, 7, 8):
        found = [summary[f"{letter}{line}"].value for letter in "JKM"]
        assert found == ["-", "-", ENGLISH(CHANGED)]


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_first_sheet_says_how_the_report_is_verified(language):
    words = Words(language)
    book = read_workbook(render_workbook(STUDY, language))
    shown = [cell.value for line in next(iter(book)).iter_rows() for cell in line]
    assert "netdesign verify --study study.json --site combe.xlsx" in shown
    assert compute_digest(STUDY) in shown
    assert words("heading.verify_report") in shown


def test_a_spreadsheet_program_refuses_what_no_factor_can_be(content):
    sheet = read_workbook(content)["Steps"]
    rules = sheet.data_validations.dataValidation
    found = {str(rule.sqref): (rule.type, rule.operator, rule.formula1)
             for rule in rules}  # fmt: skip
    above, least = (
        ("decimal", "greaterThan", "0"),
        ("decimal", "greaterThanOrEqual", "0"),
    )
    for block in find_steps(sheet):
        assert found[f"E{block['R_k']}"] == above
    first = find_steps(sheet)[0]
    assert {found[f"{letter}{first['E_s']}"] for letter in "DEF"} == {least}


def test_derived_numbers_and_verdicts_are_formulas(content):
    sheet = read_workbook(content, formulas=True)["Checks"]
    lines = read_rows(sheet, "No.")
    for line, check in zip(lines, expected_checks(STUDY), strict=True):
        derived = ["Verdict"]
        if check.steps:
            derived += ["μ low", "μ", "μ high"]
            derived += ["E_d low [kN]", "E_d [kN]", "E_d high [kN]", "R_d [kN]"]
        for heading in derived:
            assert str(line[heading]).startswith("="), heading
    summary = read_workbook(content, formulas=True)["Decision"]
    assert str(summary["C3"].value).startswith("=IFERROR(IF(COUNTIF(")
    assert str(summary["C6"].value).startswith("=IFERROR(IF(D6>0")


WITH_FORMULAS = ("Decision", "Inputs", "Checks", "Steps", "Profile")


def test_only_our_formulas_exist(content):
    book = read_workbook(content, formulas=True)
    for sheet in book:
        for line in sheet.iter_rows():
            for cell in line:
                if cell.hyperlink is not None:  # only inside the workbook
                    assert cell.hyperlink.target is None
                    assert cell.hyperlink.location.startswith("'")
                if cell.data_type == "f":
                    assert sheet.title in WITH_FORMULAS
                    assert cell.value != FORMULA
    names = {cell.value for cell in book["Checks"]["B"]}
    assert FORMULA in {cell.value for cell in book["Inputs"]["D"]}
    assert {f"Ridge {SCRIPT}", FORMULA} <= names


def test_no_formula_needs_the_prefix_of_a_newer_function(content):
    """The writer of workbooks is told not to look for any."""
    sheets = read_workbook(content, formulas=True)
    cells = (cell for sheet in sheets for row in sheet.iter_rows() for cell in row)
    formulas = {cell.value for cell in cells if cell.data_type == "f"}
    look = Worksheet()._prepare_formula
    assert len(formulas) > 100
    assert {one for one in formulas if f"={look(one)}" != one} == set()
    assert look("=XLOOKUP(A1,B:B,C:C)") != "XLOOKUP(A1,B:B,C:C)"  # it does look


def test_sheets_are_ready_to_read_and_print(content):
    book = read_workbook(content)
    assert book.sheetnames == [ENGLISH(f"heading.{name}") for name in SHEETS]
    for sheet in book:
        assert sheet.freeze_panes
        upright = sheet.title == "Steps"
        assert sheet.page_setup.orientation == ("portrait" if upright else "landscape")
        assert sheet.page_setup.fitToHeight == 0  # one page wide, any length
        # the heading of one table would stand above columns of another
        captions = sum(bool(cell.font.i) for cell in sheet["A"])
        is_one = captions == 1 or sheet.title in ("Decision", "Checks")
        assert bool(sheet.print_title_rows) is is_one, sheet.title
    assert book["Checks"].auto_filter.ref == "A4:W25"
    assert {"overall_verdict", "row_verdicts", "check_verdict"} <= set(
        book.defined_names
    )


def test_no_text_runs_out_of_its_sheet():
    """One that does makes the whole sheet small on paper, down to 4 pt as seen."""
    book = read_workbook(render_workbook(STUDY, "de"))  # whose words are the longest
    for sheet in list(book)[1:]:
        table = find_table_columns(sheet)
        merged = {str(area).split(":")[0] for area in sheet.merged_cells.ranges}
        for line in sheet.iter_rows(min_row=2):
            for cell in line:
                if not isinstance(cell.value, str) or cell.coordinate in merged:
                    continue
                last = max(cell.column, len(table))
                room = sum(table[cell.column - 1 : last])
                is_wrapped = cell.alignment.wrap_text
                fits = is_wrapped or len(cell.value) * 0.72 <= room + 1.0
                assert fits or sheet.column_dimensions[cell.column_letter].hidden, (
                    sheet.title,
                    cell.coordinate,
                )


def find_table_columns(sheet):
    """Widths of the columns of a sheet, as far as its widest table goes."""
    last = max(c.column for line in sheet.iter_rows() for c in line if c.font.b)
    letters = [get_column_letter(k) for k in range(1, last + 1)]
    return [sheet.column_dimensions[letter].width for letter in letters]


def list_live(book):
    """Verdict, utilisation and reason of each check."""
    lines = read_rows(book["Checks"], "No.")
    return [(one["Verdict"], one["μ"], one["Reason"]) for one in lines]


@pytest.mark.parametrize("name", ["other-value", "no-value"])
def test_nothing_is_proven_by_a_profile_that_was_not_solved(name, fresh):
    book = read_workbook(fresh[name])
    reason = ENGLISH("caption.changed_factor")
    assert {(one, why) for one, _, why in list_live(book)} == {("NOT PROVEN", reason)}
    summary = book["Decision"]
    assert summary["C3"].value == "NOT PROVEN"
    assert summary["M6"].value == ENGLISH(CHANGED)


# A factor on all actions of a study that passes, and the verdict of its checks.
FACTOR_EDITS = {
    "eases": (0.75, "pass"),
    "breaks": (4.5, "fail"),
    "spans": (None, "not_proven"),
    "lacks": ("", "not_proven"),
}


def find_spanning(study):
    """Factor by which the band of the most used check lies across its resistance."""
    loaded = [one for one in expected_checks(study) if one.utilisation]
    check = max(loaded, key=lambda one: one.utilisation)
    low, high = check.utilisation_band
    return 1.5 * 2.0 / (low + high)


def edit_factor(language, factor):
    """The factor on all actions typed over in the workbook of a study that passes."""
    study = build_study(rows=1)
    book = read_workbook(render_workbook(study, language), formulas=True)
    line = [one.id for one in study.profile.values].index("factor.action")
    value = find_spanning(study) if factor is None else factor
    book[Words(language)("heading.profile")][f"C{5 + line}"] = value
    buffer = io.BytesIO()
    book.save(buffer)
    return buffer.getvalue()


@pytest.fixture(scope="module")
def factored(tmp_path_factory):
    """Recalculated workbooks by language and edit."""
    books = {
        f"{language}-{name}": edit_factor(language, factor)
        for language in LANGUAGES
        for name, (factor, _) in FACTOR_EDITS.items()
    }
    return recalculate(books, tmp_path_factory.mktemp("factored"))


@pytest.mark.long
@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", FACTOR_EDITS)
def test_no_sentence_outlives_the_verdict_of_another_factor(language, name, factored):
    words, book = Words(language), read_workbook(factored[f"{language}-{name}"])
    _, verdict = FACTOR_EDITS[name]
    sheet, summary = book[words("heading.checks")], book[words("heading.decision")]
    lines = read_rows(sheet, words("heading.no"))
    found = [
        (one[words("heading.verdict")], one[words("heading.reason")]) for one in lines
    ]
    assert (words(f"verdict.{verdict}"), words(CHANGED)) in found
    stale = {words("check.passes"), words("check.fails")}
    assert all(s not in stale or v == words("verdict.pass") for v, s in found)
    assert summary["C6"].value == words(f"verdict.{verdict}")
    assert summary["M6"].value == words(CHANGED)


def test_factors_of_the_profile_are_live(fresh):
    for name, share in (("on-action", 1.4 / 1.5), ("on-resistance", 1.3 / 1.35)):
        live = list_live(read_workbook(fresh[name]))
        checks = expected_checks(LOOSE)
        # its resistance has the factors of the study
        assert live[0][::2] == ("NOT PROVEN", ENGLISH("caption.changed_factor"))
        for (verdict, used, _), check in zip(live[1:], checks[1:], strict=True):
            assert verdict == "PASS"
            if check.utilisation and check.read("γ_R") and check.mode != "rope":
                wanted = check.utilisation * share
                assert used == pytest.approx(wanted, rel=1e-9), check.id


def test_factors_are_read_from_the_profile():
    """Change one there, and the demand of every check follows."""
    book = read_workbook(render_workbook(STUDY), formulas=True)
    calculations, profile = book["Steps"], book["Profile"]
    ids = [one.id for one in STUDY.profile.values]
    blocks = find_steps(calculations)
    loaded = [one for one in expected_checks(STUDY) if one.is_of_force]
    count = 0
    for block, check in zip(blocks, loaded, strict=True):
        for symbol in ("γ_E", "γ_R"):
            step = check.known[symbol]
            if step.source in ids:
                place = f"'{profile.title}'!$C${5 + ids.index(step.source)}"
                assert place in calculations[f"E{block[symbol]}"].value
                count += 1
    assert count == 30


def test_a_number_has_as_many_digits_as_on_the_page(content):
    """A decimal comma is a mark, too: without it a cell showed all sixteen digits."""
    english, german = (
        [
            [cell.number_format for line in sheet.iter_rows() for cell in line]
            for sheet in read_workbook(book)
        ]
        for book in (content, render_workbook(STUDY, "de"))
    )
    assert english == german
    assert sum(form.startswith("0.0") for sheet in english for form in sheet) > 500


def test_ends_of_intervals_are_numbers(content):
    sheet = read_workbook(content)["Cases"]
    heads = [line[0] for line in sheet.iter_rows(values_only=True)]
    start = len(heads) - heads[::-1].index("Net row")
    named = [cell.value for cell in sheet[start]]
    ends = [(one.low_kN, one.high_kN) for row in STUDY.rows for one in row.extremes]
    names = [f"{ENGLISH('heading.band')} {end} [kN]" for end in ("low", "high")]
    places = [named.index(name) for name in names]
    lines = sheet.iter_rows(min_row=start + 1, values_only=True)
    found = [[line[place] for place in places] for line in lines]
    assert np.array(found) == pytest.approx(np.array(ends), rel=1e-15)


def test_summary_leads_to_every_sheet_and_back(content):
    book = read_workbook(content)
    targets = {
        cell.hyperlink.location.split("!")[0].strip("'")
        for line in book["Decision"].iter_rows()
        for cell in line
        if cell.hyperlink
    }
    assert targets == {ENGLISH(f"heading.{name}") for name in SHEETS[1:]}
    for sheet in list(book)[1:]:
        back = [c.hyperlink for line in sheet.iter_rows() for c in line if c.hyperlink]
        assert [link.location for link in back] == ["'Decision'!A1"]


@pytest.mark.parametrize("language", ["fr", "de"])
def test_workbook_in_other_languages_calculates_the_same(language, fresh):
    words, book = Words(language), read_workbook(fresh[language])
    sheet, head = book[words("heading.checks")], words("heading.no")
    for line, check in zip(read_rows(sheet, head), expected_checks(STUDY), strict=True):
        assert line[words("heading.verdict")] == words(f"verdict.{check.verdict}")
        used = check.utilisation
        assert line["μ"] == ("-" if used is None else pytest.approx(used, rel=LIMIT))
    overall = book[words("heading.decision")]["C3"].value
    assert overall == words(f"verdict.{STUDY.verdict}")


def test_numbers_are_numbers_with_a_format(content):
    cases = read_workbook(content)["Cases"]
    lines = read_rows(cases, "Net row")
    records = [case for row in STUDY.rows for case in row.cases]
    assert len(lines) == len(records) == 81
    for line, record in zip(lines, records, strict=True):
        force = record.post_kN
        shown = "-" if force is None else pytest.approx(force, rel=LIMIT)
        assert line["Post [kN]"] == shown
    assert cases["E5"].number_format == "[>=99.95]0;[>=9.995]0.0;0.00"


@pytest.mark.parametrize("rows", [0, 1])
def test_small_studies_have_a_workbook(rows):
    study = build_study(rows=1)
    parts = study.rows[:rows]
    verdict = merge_verdicts(row.verdict for row in parts)
    content = render_workbook(replace(study, rows=parts, verdict=verdict))
    book = read_workbook(content)
    assert book["Decision"]["C3"].value == ENGLISH(f"verdict.{verdict}")


def test_bare_row_has_a_workbook():
    study = build_study(rows=1)
    bare = replace(
        study.rows[0],
        checks=[],
        extremes=[],
        cases=[],
        drawing=None,
        verdict=Verdict.NOT_PROVEN,
    )
    study = replace(study, rows=[bare], notes=[], verdict=Verdict.NOT_PROVEN)
    book = read_workbook(render_workbook(study))
    assert book["Checks"]["A5"].value == "none: no check was made"
    assert book["Cases"]["A4"].value.startswith("none")


def test_workbook_repeats_byte_for_byte(content):
    assert content == render_workbook(STUDY)


def list_shared(sheet):
    """Checks by number with the line of their design force, and where it comes from."""
    for number, block in enumerate(find_steps(sheet)):
        line = block.get("E_d")
        source = str(sheet[f"H{line}"].value)
        if line and re.fullmatch(r"E\d+", source):
            yield number, line, source


SHARED_SPOILS = (None, "abc", "", "#N/A", -3.0, "=1/0")


@pytest.mark.long
def test_checks_that_share_a_design_force_fall_with_it(tmp_path):
    """The force blank, a text or negative: where it is worked out, or read."""
    study = build_study()
    content, books, touched = render_workbook(study), {}, {}
    sheet = read_workbook(content, formulas=True)["Steps"]
    shared = list(list_shared(sheet))
    assert len(shared) >= 3
    for k, value in enumerate(SHARED_SPOILS):
        number, line, source = shared[k % len(shared)]
        for name, cell in (("read", f"E{line}"), ("made", source)):
            book = read_workbook(content, formulas=True)
            book["Steps"][cell].value = value
            book.save(buffer := io.BytesIO())
            books[f"{name}{k}"] = buffer.getvalue()
            others = {n for n, _, of in shared if of == source}
            touched[f"{name}{k}"] = others if name == "made" else {number}
    fresh = recalculate(books, tmp_path)
    calculated = [
        5 + place for place, c in enumerate(expected_checks(study)) if c.steps
    ]
    for name, numbers in touched.items():
        checks = read_workbook(fresh[name])["Checks"]
        for number in numbers:
            assert checks[f"S{calculated[number]}"].value == "NOT PROVEN", name
