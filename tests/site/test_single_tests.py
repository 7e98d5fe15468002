"""Single pull-out tests: as their number, least and mean typed on sheet Anchors."""

import random
from dataclasses import replace
from statistics import fmean

import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.reader import read_site
from netdesign.words.catalogue import LANGUAGES

TITLES = {
    "en": ("Tests", ["anchor type", "ground", "pull-out force [kN]"]),
    "fr": ("Essais d'arrachement", ["type", "sol", "effort d'arrachement [kN]"]),
    "de": ("Zugversuche", ["Anker", "Untergrund", "Ausziehkraft [kN]"]),
}
GROUNDS = {
    "en": {"scree": "scree", "rock": "rock"},
    "fr": {"scree": "éboulis", "rock": "rocher"},
    "de": {"scree": "Geröll", "rock": "Fels"},
}


@pytest.fixture
def site(sheets):
    """Sheets whose anchors have neither a pull-out resistance nor tests."""
    for line in sheets["Anchors"][1:]:
        line[2:] = [None, None]
    return sheets


def find_pull_out(path):
    row = read_site(path).rows[0]
    return next(
        one
        for one in row.resistances
        if (one.member, one.mode) == ("foot_anchor", "pull_out")
    )


def give_ground(sheets, word):
    sheets["Nets"][0].append("ground of the anchors")
    for line in sheets["Nets"][1:]:
        line.append(word)


@pytest.mark.parametrize("language", LANGUAGES)
def test_tests_count_for_their_type_in_their_ground(site, save, language):
    rng = random.Random(5)
    name, headings = TITLES[language]
    kind = "A1"
    forces = {
        ground: [round(rng.uniform(150.0, 400.0), 1) for _ in range(4)]
        for ground in GROUNDS[language]
    }
    lines = [
        [kind, GROUNDS[language][ground], force]
        for ground, listed in forces.items()
        for force in listed
    ]
    rng.shuffle(lines)
    site[name] = [headings, *lines]
    for ground, listed in forces.items():
        sheets = {key: [list(line) for line in table] for key, table in site.items()}
        give_ground(sheets, GROUNDS[language][ground])
        found = find_pull_out(save(sheets))
        assert found.ground == ground
        assert found.tests.count == 4
        assert found.tests.least == pytest.approx(1e3 * min(listed))
        assert found.tests.mean == pytest.approx(1e3 * fmean(listed))


def test_they_are_what_the_same_numbers_on_sheet_anchors_are(site, save):
    kind = "A1"
    site["Tests"] = [TITLES["en"][1], [kind, None, 210.0], [kind, None, 260.0]]
    by_test = find_pull_out(save(site))
    del site["Tests"]
    site["Anchors"][0] += [
        *("number of tests", "least tested resistance [kN]"),
        "mean tested resistance [kN]",
    ]
    for line in site["Anchors"][1:]:
        line += [2, 210.0, 235.0]
    typed = find_pull_out(save(site))
    counted = replace(by_test, tests=replace(by_test.tests, singles=()))
    assert replace(counted, source="") == replace(typed, source="")


@pytest.mark.parametrize(
    ("line", "told"),
    [
        (["A99", None, 200.0], "no id of sheet Anchors"),
        ([None, "swamp", 200.0], "not a known word"),
        ([None, "rock", "much"], "not a number"),
        ([None, "rock", 0.2], "1 to 10000 kN"),
    ],
)
def test_what_is_no_test_is_refused_in_its_cell(site, save, line, told):
    kind = "A1"
    site["Tests"] = [TITLES["en"][1], [line[0] or kind, *line[1:]]]
    with pytest.raises(SiteDataError) as caught:
        read_site(save(site))
    found = [one for one in caught.value.findings if one.severity == "error"]
    assert {one.sheet for one in found} == {"Tests"}
    assert told in str(found[0])


def test_tests_beside_others_of_their_type_are_refused(site, save, refused):
    kind = "A1"
    site["Anchors"][0] += [
        *("number of tests", "least tested resistance [kN]"),
        "mean tested resistance [kN]",
    ]
    for line in site["Anchors"][1:]:
        line += [2, 210.0, 235.0]
    site["Tests"] = [TITLES["en"][1], [kind, None, 222.0]]
    (finding,) = refused(save(site))
    assert (finding.sheet, finding.cell) == ("Tests", "C2")


def test_a_ground_that_its_line_does_not_have_is_refused(site, save, refused):
    kind = "A1"
    site["Anchors"][0].append("ground")
    for line in site["Anchors"][1:]:
        line.append("scree")
    site["Tests"] = [TITLES["en"][1], [kind, "rock", 222.0]]
    (finding,) = refused(save(site))
    assert (finding.sheet, finding.cell) == ("Tests", "B2")
