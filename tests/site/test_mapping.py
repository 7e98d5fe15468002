"""Answers beside a workbook: used, named, and refused where they do not fit."""

import math
import tomllib

import pytest

from netdesign.site.questions import write_questions
from netdesign.site.reader import read_site
from netdesign.site.titles import name_map

HEADINGS = 0


@pytest.fixture
def give(save, sheets):
    """Save the sheets with a file of answers beside them."""

    def give_answers(text):
        path = save(sheets)
        name_map(path).write_text(text, encoding="utf-8")
        return path

    return give_answers


def test_an_answer_gives_field_and_unit(sheets, give):
    sheets["Nets"][HEADINGS][1] = "Steilheit"
    path = give('[headings.Nets]\n"Steilheit" = "Hangneigung [%]"\n')
    row = read_site(path).rows[0]
    assert row.slope_angle == pytest.approx(math.atan(0.4))
    slope = next(one for one in row.inputs if one.cell == "Nets!B2")
    assert (slope.text, slope.label.key) == ("40 %", "column.Nets.slope_angle")


def test_an_answer_may_be_a_key_of_the_program(sheets, give):
    sheets["Nets"][HEADINGS][1] = "Steilheit [°]"
    path = give('[headings.Nets]\n"Steilheit" = "slope_angle"\n')
    assert read_site(path).rows[0].slope_angle == pytest.approx(math.radians(40))


def test_an_answer_against_the_unit_of_the_heading_is_refused(sheets, give, refused):
    sheets["Nets"][HEADINGS][1] = "Steilheit [°]"
    path = give('[headings.Nets]\n"Steilheit" = "slope angle [%]"\n')
    (finding,) = (one for one in refused(path) if one.severity == "error")
    assert finding.cell == "B1"
    assert str(finding.rule) == ('is not the unit of the heading, "slope angle [%]"')


def test_a_column_that_is_ignored_is_told(sheets, give):
    sheets["Nets"][HEADINGS] += ["Hk [m]"]
    sheets["Nets"][1] += [4.2]
    path = give('[headings.Nets]\n"Hk [m]" = "ignore"\n')
    site = read_site(path)
    told = [one for one in site.findings if one.cell == "O1"]
    assert [str(one.rule) for one in told] == ["is not read: so site.map.toml says"]


def test_a_sheet_of_another_name_is_answered(sheets, give):
    sheets["Feuil1"] = sheets.pop("Nets")
    path = give('[sheets]\n"Feuil1" = "Filets"\n')
    assert [row.id for row in read_site(path).rows] == ["R1", "R2"]


def test_a_line_of_a_sheet_of_items_is_answered(sheets, give):
    sheets["Ranges"][1][0] = "Raumgewicht Schnee"
    sheets["Ranges"] += [["Loi", 1, 2, None]]
    path = give(
        '[headings.Ranges]\n"Raumgewicht Schnee" = "density [kg/m3]"\n'
        '"Loi" = "ignore"\n'
    )
    assert read_site(path).ranges["density"].high == 400.0


# A file of answers, and what is wrong with it
@pytest.mark.parametrize(
    ("text", "rule"),
    [
        ("[headings.Nets]\nx = 3\n", 'has no text as the answer to "x"'),
        ("[other]\n", 'has the unknown key "other"'),
        ("headings = 3\n", "has a value where a table of answers should be"),
        ('decimal_mark = "?"\n', 'has a decimal_mark that is neither "comma" nor'),
        ('schema = "netdesign.map/9"\n', "is not of schema netdesign.map/1"),
        ('[sheets]\nNets = "Netzwerk"\n', 'answers "Netzwerk" to the sheet "Nets"'),
        ("[headings", "cannot be read"),
        ('[sheets]\nGone = "ignore"\n', "is no sheet of the workbook"),
        ("[headings.Gone]\n", "has answers, but is no sheet that is read"),
        (
            '[headings.Nets]\n"Dk" = "net height [m]"\n',
            "has no heading of which site.map.toml says what it is",
        ),
        (
            '[headings.Ranges]\n"Dk" = "density [kg/m3]"\n',
            "has no heading of which site.map.toml says what it is",
        ),
        (
            '[headings.Nets]\n"slope angle [deg]" = "height"\n',
            'is answered with "height", which is no heading of this sheet',
        ),
        (
            '[headings.Nets]\n"slope angle [deg]" = "net height [m]"\n',
            'names "net height" again',
        ),
    ],
)
def test_answers_that_do_not_fit_are_refused(give, refused, text, rule):
    rules = [str(one.rule) for one in refused(give(text)) if one.severity == "error"]
    assert any(one.startswith(rule) for one in rules)


def test_what_is_asked_stands_in_the_file_with_what_is_understood(sheets, save):
    sheets["Nets"][HEADINGS][1] = "Neigung [°]"
    sheets["Nets"][HEADINGS][8] = "Netzhöhe"
    sheets["Ranges"][1][0] = "Raumgewicht Schnee"
    text, missing = write_questions(save(sheets), language="de")
    assert missing == 3
    answers = tomllib.loads(text)["headings"]
    assert answers["Nets"] == {"Neigung [°]": "?", "Netzhöhe": "Netzhöhe [?]"}
    assert answers["Ranges"] == {"Raumgewicht Schnee": "?"}
    assert '# "post spacing [m]" = "Stützenabstand [m]"' in text


def test_answers_given_so_far_are_kept(sheets, give):
    sheets["Nets"][HEADINGS][1] = "Steilheit [°]"
    sheets["Nets"][HEADINGS][8] = "Netzhöhe"
    path = give('[headings.Nets]\n"Steilheit" = "slope_angle"\n')
    text, missing = write_questions(path)
    assert missing == 1
    assert tomllib.loads(text)["headings"]["Nets"]["Steilheit"] == "slope_angle"


def test_a_sheet_with_the_headings_of_a_missing_one_is_proposed(sheets, save):
    sheets["Feuil1"] = sheets.pop("Nets")
    text, missing = write_questions(save(sheets))
    assert (tomllib.loads(text)["sheets"], missing) == ({"Feuil1": "?"}, 1)
    assert '"Feuil1" = "?"  # "Nets"' in text


def test_headings_of_a_proposed_sheet_are_asked_for_at_once(sheets, save):
    sheets["Feuil1"] = sheets.pop("Nets")
    sheets["Feuil1"][HEADINGS][1] = "Neigung [°]"
    path = save(sheets)
    text, missing = write_questions(path)
    assert missing == 2
    assert tomllib.loads(text)["headings"]["Feuil1"] == {"Neigung [°]": "?"}
    answered = text.replace('"Feuil1" = "?"', '"Feuil1" = "Nets"')
    answered = answered.replace('"Neigung [°]" = "?"', '"Neigung [°]" = "slope angle"')
    name_map(path).write_text(answered, encoding="utf-8")
    assert read_site(path).rows


def test_two_columns_of_one_heading_are_asked_by_their_letters(sheets, give, refused):
    sheets["Nets"][HEADINGS] += ["Anker", "Anker"]
    path = give("")
    text, missing = write_questions(path)
    assert missing == 2
    assert '"O: Anker" = "?"' in text
    name_map(path).write_text(
        '[headings.Nets]\n"O: Anker" = "ignore"\n"P: Anker" = "uphill anchor"\n'
    )
    told = {one.cell: str(one.rule) for one in read_site(path).findings if one.cell}
    assert told == {
        "O1": "is not read: so site.map.toml says",
        "P1": 'is read as "uphill anchor": so site.map.toml says',
    }


def test_an_open_question_is_one_until_its_heading_is_understood(sheets, save, refused):
    headings = sheets["Nets"][HEADINGS]
    known, headings[1] = headings[1], "Neigung [°]"
    path = save(sheets)
    answers = 'schema = "netdesign.map/1"\n[headings.Nets]\n"Neigung [°]" = "?"\n'
    name_map(path).write_text(answers, encoding="utf-8")
    rules = [str(one.rule) for one in refused(path)]
    assert any(one.startswith("has a question mark still") for one in rules)
    headings[1] = known
    path = save(sheets)
    answers = answers.replace("Neigung [°]", known)
    name_map(path).write_text(answers, encoding="utf-8")
    assert len(read_site(path).rows) == 2
    assert write_questions(path)[1] == 0
