"""Justification of a range: an input of its own, beside its ends."""

from netdesign.site.reader import read_site

REASON = (
    "R1: equivalent density at the highest snow 303 to 331 kg/m³; Davos, winters: 4"
)


def test_without_the_column_there_is_no_such_input(sheets, save):
    inputs = read_site(save(sheets)).range_inputs
    assert not [one for one in inputs if "justification" in str(one.label)]


def test_justification_stands_beside_the_range_with_its_cell(sheets, save):
    sheets["Ranges"][0] = [*sheets["Ranges"][0], "justification"]
    sheets["Ranges"][1] = [*sheets["Ranges"][1], REASON]
    site = read_site(save(sheets))
    (found,) = [one for one in site.range_inputs if "justification" in str(one.label)]
    assert str(found.label) == "density, justification"
    assert (found.value, found.text, found.cell) == (REASON, REASON, "Ranges!E2")
    assert site.ranges["density"].high == 400.0


def test_other_languages_have_the_column(sheets, save):
    sheets["Ranges"][0] = [*sheets["Ranges"][0], "Begründung"]
    sheets["Ranges"][2] = [*sheets["Ranges"][2], "Versuche am Ort"]
    inputs = read_site(save(sheets)).range_inputs
    assert [one.value for one in inputs if one.cell == "Ranges!E3"] == [
        "Versuche am Ort"
    ]
