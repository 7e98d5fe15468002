"""An office's own list, mapped once, is read as the input workbook would be."""

import math
import random
from dataclasses import replace

import openpyxl
import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.cells.cells import UNDECLARED, name_column
from netdesign.site.lists.ask import is_own_list, write_list_map
from netdesign.site.lists.list_map import name_map, read_list_map
from netdesign.site.reader import read_site
from netdesign.site.template.office_workbook import write_site_workbook
from tests.site.lists.answer import answer_list
from tests.site.lists.offices import CONSULTANT, OFFICES, TYROL, VALAIS


def number(text):
    return float(str(text).replace(",", "."))


def list_typed(office, meaning):
    """What the lines of the first sheet have in the column of a meaning."""
    sheet = office.sheets[0]
    place = list(sheet.headings.values()).index(meaning)
    return [line[place] for line in sheet.lines]


def read_answered(office, folder):
    path = office.write(folder)
    answer_list(office, path)
    return read_site(path)


@pytest.fixture(scope="module")
def sites(tmp_path_factory):
    """Site of each list, as its office wrote it, by its file."""
    folder = tmp_path_factory.mktemp("lists")
    return {one.file: read_answered(one, folder) for one in OFFICES}


@pytest.mark.parametrize("office", OFFICES, ids=lambda one: one.file)
def test_every_row_has_what_the_list_says(office, sites):
    site = sites[office.file]
    assert [row.id for row in site.rows] == list_typed(office, "rows.id")
    slopes = list(map(number, list_typed(office, "rows.slope_angle")))
    assert [math.degrees(row.slope_angle) for row in site.rows] == pytest.approx(slopes)
    spacings = list(map(number, list_typed(office, "rows.post_spacing")))
    assert [row.layout.post_spacing for row in site.rows] == pytest.approx(spacings)
    counts = list(map(number, list_typed(office, "rows.post_count")))
    assert [row.post_count for row in site.rows] == counts


@pytest.mark.parametrize("office", OFFICES, ids=lambda one: one.file)
def test_snow_is_vertical_or_normal_in_its_own_unit(office, sites):
    site = sites[office.file]
    (heading, meaning), *_ = [
        one for one in office.sheets[0].headings.items() if "rows.snow" in one[1]
    ]
    factor = 0.01 if "cm" in heading else 1.0
    for row, typed in zip(site.rows, list_typed(office, meaning), strict=True):
        size = factor * number(typed)
        wanted = size * math.cos(row.slope_angle) if "vertical" in meaning else size
        assert row.snow_thickness == pytest.approx(wanted)


@pytest.mark.parametrize("office", [VALAIS, CONSULTANT], ids=lambda one: one.file)
def test_each_row_has_the_net_of_its_own_line(office, sites):
    heights = list(map(number, list_typed(office, "net_types.net_height")))
    rows = sites[office.file].rows
    assert [row.net_height for row in rows] == pytest.approx(heights)


def test_rows_that_name_a_net_have_it_alike(tmp_path):
    """Another height in one of the lines that name it is a slip."""
    sheet, lines = TYROL.sheets[0], [list(one) for one in TYROL.sheets[0].lines]
    meanings = list(sheet.headings.values())
    height, named = map(meanings.index, ("net_types.net_height", "rows.net_type"))
    first = next(x for x in lines if [y[named] for y in lines].count(x[named]) > 1)
    first[height] += 0.5
    office = replace(TYROL, sheets=(replace(sheet, lines=lines), *TYROL.sheets[1:]))
    path = office.write(tmp_path)
    answer_list(office, path)
    with pytest.raises(SiteDataError) as refused:
        read_site(path)
    keys = [one.rule.key for one in refused.value.findings if one.severity == "error"]
    assert set(keys) == {"nets.used_twice"}


def test_each_input_names_its_cell_in_the_list(sites):
    site = sites[TYROL.file]
    for line, row in enumerate(site.rows, 4):
        found = {one.cell for one in row.inputs}
        # altitude, slope, snow, D_K, spacing
        assert {f"Werke!{one}{line}" for one in "CEFJK"} <= found


@pytest.mark.parametrize("office", OFFICES, ids=lambda one: one.file)
def test_answers_are_kept_when_it_is_mapped_again(office, tmp_path):
    path = office.write(tmp_path)
    _, missing = write_list_map(path, UNDECLARED, office.language)
    assert missing > 0
    answer_list(office, path)
    before = read_list_map(path)
    text, left = write_list_map(path, UNDECLARED, office.language)
    assert left == 0
    name_map(path).write_text(text, encoding="utf-8")
    assert read_list_map(path).tables == before.tables


@pytest.mark.parametrize("office", OFFICES, ids=lambda one: one.file)
def test_answers_that_are_missing_are_named_in_a_line_a_sheet(office, tmp_path):
    path = office.write(tmp_path)
    text, missing = write_list_map(path, UNDECLARED, office.language)
    name_map(path).write_text(text, encoding="utf-8")
    with pytest.raises(SiteDataError) as refused:
        read_site(path)
    names = [one.text for one in refused.value.findings]
    assert len(names) == missing
    told = str(refused.value)
    assert len(told.splitlines()) <= len(office.sheets)
    assert sum(f'"{name}"' in told for name in names[:12]) == len(names[:12])


def find_cell(office, path, meaning, line):
    """Address of a cell in a line of the first sheet, from 0."""
    (sheet, *_), tables = office.sheets, read_list_map(path).tables
    column = 1 + list(sheet.headings.values()).index(meaning)
    row = tables[sheet.name].headings_in_line + bool(sheet.units) + 1 + line
    return f"{name_column(column)}{row}"


@pytest.mark.parametrize("meaning", ["rows.slope_angle", "net_types.net_height"])
def test_a_needed_cell_that_is_empty_is_named(meaning, tmp_path):
    sheet = TYROL.sheets[0]
    place = list(sheet.headings.values()).index(meaning)
    named = list(sheet.headings.values()).index("rows.net_type")
    lines = [list(one) for one in sheet.lines]
    for line in lines:
        line[named] = None
    lines[2][place] = None
    office = replace(TYROL, sheets=(replace(sheet, lines=lines), *TYROL.sheets[1:]))
    path = office.write(tmp_path)
    answer_list(office, path)
    with pytest.raises(SiteDataError) as refused:
        read_site(path)
    faults = [one for one in refused.value.findings if one.severity == "error"]
    places = {(one.sheet, one.cell) for one in faults}
    assert places == {(sheet.name, find_cell(office, path, meaning, 2))}


def test_a_list_with_the_headings_of_the_template_and_other_sheets_is_mapped(tmp_path):
    """What tells to map it would otherwise be told that nothing is to be mapped."""
    path = tmp_path / "site.xlsx"
    write_site_workbook(path, example=True, language="fr")
    assert not is_own_list(path, UNDECLARED)
    book = openpyxl.load_workbook(path)
    book.worksheets[1].title = "Liste 2026"
    book.save(path)
    assert is_own_list(path, UNDECLARED)


@pytest.mark.parametrize("cells", [[], ["row"], ["Datum", "Wetter", "Wind", "Ort"]])
def test_a_workbook_without_known_headings_is_no_list(cells, tmp_path):
    book = openpyxl.Workbook()
    book.active.append(cells)
    book.save(tmp_path / "site.xlsx")
    with pytest.raises(SiteDataError) as refused:
        write_list_map(tmp_path / "site.xlsx")
    (finding,) = refused.value.findings
    assert finding.rule.key == "list_map.no_list"


def spoil(path, old, new):
    place = name_map(path)
    text = place.read_text(encoding="utf-8")
    assert old in text
    place.write_text(text.replace(old, new, 1), encoding="utf-8")


@pytest.mark.parametrize(
    ("old", "new", "rule"),
    [
        ('"Comments" = "ignore"', '"Comments" = "?"', "list_map.unanswered"),
        ('"Comments" = "ignore"', '"Comments" = "Rows: nothing"', "list_map.no_column"),
        ('"Comments" = "ignore"', '"Other" = "ignore"', "list_map.new_heading"),
        ("headings_in_line = 1", "headings_in_line = 2", "list_map.new_heading"),
        (
            "headings_in_line = 1",
            "headings_in_line = 0",
            "tables.net_schedule.headings_in_line",
        ),
        ('becomes = "Rows"', 'becomes = "Rooms"', "tables.net_schedule.becomes"),
        ('list = "', 'lists = "', "lists"),
    ],
)
def test_a_faulty_answer_is_refused(old, new, rule, tmp_path):
    path = CONSULTANT.write(tmp_path)
    answer_list(CONSULTANT, path)
    spoil(path, old, new)
    with pytest.raises(SiteDataError) as refused:
        read_site(path)
    findings = refused.value.findings
    assert rule in {one.rule.key for one in findings} | {one.text for one in findings}


def test_an_answer_in_another_unit_than_the_list_is_refused(tmp_path):
    path = TYROL.write(tmp_path)
    answer_list(TYROL, path)
    spoil(path, "[cm lotrecht]", "[m lotrecht]")
    with pytest.raises(SiteDataError) as refused:
        read_site(path)
    keys = {one.rule.key for one in refused.value.findings}
    assert "list_map.other_unit" in keys


@pytest.mark.parametrize("office", OFFICES, ids=lambda one: one.file)
def test_a_row_of_a_list_is_changed_by_its_own_id_and_our_keys(office, tmp_path):
    built = read_answered(office, tmp_path)
    draw = random.Random(office.file)
    name = draw.choice(built.rows).id
    spacing, tilt = round(draw.uniform(2.6, 3.2), 2), round(draw.uniform(11, 19), 1)
    change = {row.id: {"post_tilt": tilt} for row in built.rows}  # of no column there
    change[name] |= {"post_spacing": spacing, "foot_anchor": "", "gap": 0.7}
    site = read_site(tmp_path / office.file, change=change)
    for now, was in zip(site.rows, built.rows, strict=True):
        assert now.layout.post_tilt == pytest.approx(math.radians(tilt))
        assert now.net_height == was.net_height
        if now.id == name:
            assert (now.layout.post_spacing, now.gap) == (spacing, 0.7)
            assert now.find_anchor_type("foot_anchor") is None
        else:
            assert now.layout.post_spacing == was.layout.post_spacing
            assert now.gap == was.gap
    known = {one.cell for one in site.what_if}
    assert len(known) == len(site.what_if) > 2


def test_a_net_of_several_rows_is_not_changed_for_one_of_them(tmp_path):
    built = read_answered(TYROL, tmp_path)
    with pytest.raises(SiteDataError) as refused:
        read_site(tmp_path / TYROL.file, change={built.rows[0].id: {"post_tilt": 13.7}})
    assert [one.rule.key for one in refused.value.findings] == ["frames.shared"]


@pytest.mark.parametrize(("unit", "scale"), [("m", 1.0), ("cm", 100.0)])
def test_the_posts_of_a_row_are_those_that_stand_on_its_length(tmp_path, unit, scale):
    """A part of a bay at the end has no post: fewer posts ask more of their anchors."""
    draw = random.Random(unit)
    drawn = [(draw.randint(2, 14), draw.choice([0.0, 0.3, 0.9])) for _ in range(6)]
    lines = [
        f"W{k};36,5;3,3;1,9;3,0;3,6;{scale * 3.6 * (bays + part):.2f}".replace(".", ",")
        for k, (bays, part) in enumerate(drawn)
    ]
    path = tmp_path / "werke.csv"
    headings = "Reihe;Hangneigung [°];Schneehöhe lotrecht [m];Gleitfaktor N;D_K [m]"
    heading = f"{headings};Stützenabstand [m];Reihenlänge [{unit}]"
    path.write_text("\n".join([heading, *lines]), encoding="utf-8")
    text, missing = write_list_map(path)
    assert not missing
    name_map(path).write_text(text, encoding="utf-8")
    rows = read_site(path).rows
    assert [row.post_count for row in rows] == [1 + bays for bays, _ in drawn]
    assert all(row.find_assumed("post_count") is None for row in rows)


def test_a_row_that_is_shorter_than_a_bay_is_asked_about(tmp_path):
    path = tmp_path / "werke.csv"
    headings = "Reihe;Hangneigung [°];Schneehöhe lotrecht [m];Gleitfaktor N;D_K [m]"
    lines = ["W1;36,5;3,3;1,9;3,0;3,6;3,5", "W2;37,2;3,3;1,9;3,0;3,6;3,6"]
    heading = f"{headings};Stützenabstand [m];Reihenlänge [m]"
    path.write_text("\n".join([heading, *lines]), encoding="utf-8")
    text, _ = write_list_map(path)
    name_map(path).write_text(text, encoding="utf-8")
    asked = [[str(one) for one in row.questions] for row in read_site(path).rows]
    assert [any("G2" in one for one in each) for each in asked] == [True, False]
