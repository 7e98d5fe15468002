"""Lists as three offices send them: read at once, or after one file of answers."""

import re
from types import SimpleNamespace

import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.questions import write_questions
from netdesign.site.reader import read_site
from netdesign.site.titles import name_map
from tests.site.offices import austrian, french, norwegian
from tests.site.offices.write import write_folder, write_xlsx

MOST_QUESTIONS = 6
# Share of a rope's breaking force: clips, no ends named, sockets.
LEFT = {french: 0.8, austrian: 0.75, norwegian: 1.0}
OFFICES = {
    "french-xlsx": (french, write_xlsx, "liste.xlsx"),
    "austrian-xlsx": (austrian, write_xlsx, "Werkliste.xlsx"),
    "norwegian-csv": (norwegian, write_folder, "storfjellet"),
    "norwegian-xlsx": (norwegian, write_xlsx, "storfjellet.xlsx"),
}


def answer(text, answers):
    """The file of answers as the office fills it in, and how much it was asked."""
    lines, count = [], 0
    for line in text.splitlines():
        asked = re.match(r'"(.*)" = "(.*)\?', line)
        if asked:
            count += 1
            line = f'"{asked[1]}" = "{answers[asked[1]]}"'
        lines.append(line)
    return "\n".join(lines), count


@pytest.fixture(scope="module", params=OFFICES)
def read(request, tmp_path_factory):
    office, write, name = OFFICES[request.param]
    path = write(office, tmp_path_factory.mktemp("office") / name)
    if office.ANSWERS:
        with pytest.raises(SiteDataError):
            read_site(path)
        text, count = answer(write_questions(path)[0], office.ANSWERS)
        assert 0 < count <= MOST_QUESTIONS
        name_map(path).write_text(text, encoding="utf-8")
    return office, read_site(path)


def test_every_value_is_understood_as_it_was_meant(read):
    office, site = read
    assert [row.id for row in site.rows] == list(office.ROWS)
    for row in site.rows:
        understood = {
            echo.label.key.rpartition(".")[2]: echo.value
            for echo in row.inputs
            if "!" in echo.cell and echo.value != "" and not echo.derivation
        }
        understood = {
            key: one.partition(" (")[0] if isinstance(one, str) else one
            for key, one in understood.items()
        }
        meant = {"id": row.id, **office.ROWS[row.id]}
        assert understood == pytest.approx(meant)


def test_a_glide_factor_means_that_the_ground_slides(read):
    _, site = read
    for row in site.rows:
        assert row.ground.kind == "sliding"
        law = next(
            one for one in row.inputs if one.label.key == "column.Nets.ground_law"
        )
        assert law.derivation


def test_ranges_are_as_they_were_meant(read):
    office, site = read
    found = {}
    for echo in site.range_inputs:
        name, _, end = str(echo.label).rpartition(", ")
        if end in ("low", "high"):
            found.setdefault(name, []).append(echo.value)
    assert {name: tuple(ends) for name, ends in found.items()} == office.RANGES


def test_the_cover_sheet_is_the_project(read):
    office, site = read
    given = {key: getattr(site.project, key) for key in office.PROJECT}
    assert given == office.PROJECT


def test_types_are_as_they_were_meant(read):
    office, site = read
    for row in site.rows:
        for one in row.resistances:
            meant = office.TYPES.get(one.type_id, {}).get(one.mode)
            if meant is not None:
                left = LEFT[office] if one.mode == "rope" else 1.0
                assert one.value == pytest.approx(left * 1e3 * meant)


def test_an_anchor_counts_with_the_tests_in_its_ground(read):
    office, site = read
    if office is not french:
        return
    least = {"scree": 222.0, "rock": 240.0}
    for row in site.rows:
        (foot,) = [
            one
            for one in row.resistances
            if (one.member, one.mode) == ("foot_anchor", "pull_out")
        ]
        ground = office.ROWS[row.id]["ground"]
        assert foot.ground == ground
        assert foot.tests.least == pytest.approx(1e3 * least[ground])


def test_what_is_left_out_is_told(read):
    office, site = read
    told = " ".join(map(str, site.findings))
    for text in office.TOLD:
        assert text in told


def test_a_steel_and_a_profile_bring_their_numbers(read):
    """S235 means 235 MPa, and HEA 160 its section about the weaker axis."""
    office, site = read
    names = {
        french: ("HEA 160", 235e6, 6.156e-6),
        norwegian: ("HEB 140", 355e6, 5.497e-6),
    }
    if office not in names:
        return
    name, strength, _ = names[office]
    posts = [
        one
        for row in site.rows
        for one in row.resistances
        if one.type_id == name and one.mode in ("compression", "compression_bending")
    ]
    assert {one.mode for one in posts} == {"compression", "compression_bending"}
    for one in posts:
        if one.mode == "compression_bending":
            assert one.dimensions.strength == strength
        else:
            assert str(one.derivation).count(f"{strength / 1e6:g} MPa") == 2


def test_dotted_dates_are_days_and_months(read):
    office, site = read
    if office is norwegian:
        (series,) = site.monitoring
        days = [time / 86400 for time in series.times]
        assert days == [0.0, 31.0, 73.0]


@pytest.mark.parametrize(
    ("write", "file"),
    [(write_xlsx, "a.xlsx"), (write_folder, "a")],
)
def test_net_rows_under_a_name_that_nobody_knows_are_asked_about(tmp_path, write, file):
    name = "Rive gauche, ouvrages"
    sheets = {
        name if key == "Filets B" else key: one for key, one in french.SHEETS.items()
    }
    office = SimpleNamespace(SHEETS=sheets, MERGED={}, STRUCK={})
    path = write(office, tmp_path / file)
    with pytest.raises(SiteDataError) as refused:
        read_site(path)
    told = [one.rule.key for one in refused.value.findings if one.sheet == name]
    assert told == ["table.net_rows"]
    text = write_questions(path)[0]
    assert f'"{name}" = "?"' in text
    answers = {**french.ANSWERS, name: "Nets"}
    name_map(path).write_text(answer(text, answers)[0], encoding="utf-8")
    assert len(read_site(path).rows) == len(french.ROWS)
