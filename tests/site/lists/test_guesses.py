"""Guesses at headings of five offices: none is wrong, most are right or ranked."""

from collections import Counter

import pytest

from netdesign.site.cells.cells import UNDECLARED
from netdesign.site.lists.ask import (
    _find_kind,
    find_heading_line,
    guess_headings,
    write_list_map,
)
from netdesign.site.lists.list_map import ListTable, read_list
from tests.site.lists.answer import find_target, name_target
from tests.site.lists.offices import OFFICES, OfficeList, OfficeSheet


def judge(office, path):
    """How each heading was guessed at, by what it means."""
    names = {one.name: one for one in office.sheets}
    for sheet in read_list(path, UNDECLARED).sheets:
        line = find_heading_line(sheet)
        kind = _find_kind(sheet, line)
        table = ListTable(becomes=kind, headings_in_line=line)
        for one in guess_headings(sheet, table, office.language):
            meaning = names[sheet.name].headings[one.name]
            yield one.name, rate(one, meaning, kind, office.language)


def rate(one, meaning, kind, language):
    """Right, wrong, or a question: with the right column first, among three, or not."""
    if "?" not in one.answer or one.target is not None:
        own = name_target(one.target) if one.target else one.answer
        return "right" if own == meaning else "wrong"
    if meaning in ("ask", "ignore"):
        return "asked"
    wanted = find_target(kind, meaning).label(language)
    listed = [entry.split(" [")[0] for entry in one.ranked.split(" · ")]
    names = [entry if "[" in entry else entry.rsplit(" ", 1)[0] for entry in listed]
    names = [x if x == wanted else x.rsplit(" ", 1)[0] for x in names]
    if wanted not in names:
        return "unranked"
    return "first" if names[0] == wanted else "ranked"


@pytest.fixture(scope="module")
def rated(tmp_path_factory):
    folder = tmp_path_factory.mktemp("lists")
    return {
        (office.file, name): how
        for office in OFFICES
        for name, how in judge(office, office.write(folder))
    }


@pytest.mark.parametrize("heading", ["N°", "n °", "Nº"])
def test_a_number_of_a_line_is_no_glide_factor(tmp_path, heading):
    path = tmp_path / "liste.csv"
    text = f"{heading};pente [°];hauteur de neige [m]\nN1;34;2,9\nN2;37;3,3\n"
    path.write_text(text, encoding="utf-8")
    (sheet,) = read_list(path, UNDECLARED).sheets
    table = ListTable(becomes="rows")
    first = next(iter(guess_headings(sheet, table, "fr")))
    assert first.target is None
    assert "?" in first.answer


def test_no_guess_is_wrong(rated):
    assert [name for name, how in rated.items() if how == "wrong"] == []


def test_most_headings_are_known_or_ranked(rated):
    counts = Counter(rated.values())
    assert sum(counts.values()) >= 95
    assert counts["right"] >= 0.55 * sum(counts.values())
    assert counts["unranked"] <= 0.11 * sum(counts.values())


def make_list(*headings, language="de"):
    """A list with a few known headings and some more."""
    known = {"Reihe": "", "Hangneigung [°]": "", "Stützenabstand [m]": ""}
    every = known | dict.fromkeys(headings, "")
    sheet = OfficeSheet("Netzreihen", (), every, (tuple(range(len(every))),))
    return OfficeList("liste.xlsx", language, (sheet,))


def guess_at(tmp_path, *headings):
    office = make_list(*headings)
    (sheet,) = read_list(office.write(tmp_path), UNDECLARED).sheets
    table = ListTable(becomes="rows")
    found = {one.name: one for one in guess_headings(sheet, table, "de")}
    return [found[one] for one in headings]


def test_only_an_exact_word_is_ignored(tmp_path):
    found = guess_at(tmp_path, "Bemerkung", "Bemerkungg", "N")
    assert next(one.answer for one in found) == "ignore"
    assert "ignore" not in [one.answer for one in found][1:]


def test_two_headings_of_one_column_are_asked(tmp_path):
    found = guess_at(tmp_path, "Meereshöhe [m]", "Seehöhe [m]")
    assert [one.answer for one in found] == ["?", "?"]


def test_a_heading_without_a_unit_asks_for_it(tmp_path):
    (one,) = guess_at(tmp_path, "Meereshöhe")
    assert one.answer.endswith("[?]")


@pytest.mark.parametrize("measure", ["vertical", "normal"])
def test_a_heading_that_says_its_measure_is_known(tmp_path, measure):
    path = tmp_path / "list.csv"
    path.write_text(
        f"row;slope ψ [deg];snow height [cm {measure}]\nR1;37;281\n", "utf-8"
    )
    text, _ = write_list_map(path)
    assert f'"Rows: snow height [cm {measure}]"' in text
