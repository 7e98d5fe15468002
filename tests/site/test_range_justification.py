"""Justification of a range: an input of its own, beside its ends."""

from netdesign.site.reader import read_site

REASON = (
    "R1: equivalent density at the highest snow 303 to 331 kg/m³; Davos, winters: 4"
)


def test_justification_stands_beside_the_range_with_its_cell(sheets, save):
    sheets["Ranges"][0] = [*sheets["Ranges"][0], "justification"]
    sheets["Ranges"][1] = [*sheets["Ranges"][1], REASON]
    site = read_site(save(sheets))
    (found,) = [one for one in site.range_inputs if "justification" in str(one.label)]
    assert str(found.label) == "density, justification"
    assert (found.value, found.text, found.cell) == (REASON, REASON, "Ranges!D2")
    assert site.ranges["density"].high == 400.0
