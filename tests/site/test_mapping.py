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
            'names "effective height D_K" again',
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
    assert answers["Nets"] == {"Neigung [°]": "?", "Netzhöhe": "wirksame Höhe D_K [?]"}
    assert answers["Ranges"] == {"Raumgewicht Schnee": "?"}
    assert '# "post spacing [m]" = "Stützenabstand [m]"' in text


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
