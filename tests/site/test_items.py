"""Tables of items and values: what names no item is refused, and never a default."""

import random
import string

import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.columns.all_tables import PROJECT_ITEMS
from netdesign.site.columns.fields import find_item
from netdesign.site.reader import read_site
from netdesign.words.catalogue import LANGUAGES
from tests.site.conftest import SOUND
from tests.site.csv_folder import write_csv_folder

PROFILE = "eurocode"


def write_csv(path, project, sheets=SOUND):
    """A folder of csv files; ``project`` is the lines of its sheet as typed."""
    return write_csv_folder(path, {"Project": project, **sheets})


def findings_of(path):
    with pytest.raises(SiteDataError) as caught:
        read_site(path)
    return [one for one in caught.value.findings if one.severity == "error"]


@pytest.mark.parametrize(
    ("line", "near"),
    [
        ("standard,eurocode", '"standard" alone'),
        ("standard, my own profile of limits", '"standard" alone'),
        ("standard: my own profile of limits", '"standard" alone'),
        ("standard\teurocode", '"standard" alone'),
        ("Standrad;eurocode", "standard"),
        ("Standrad;", "standard"),
        ("Standrad,eurocode", "standard"),
        ("nrme;eurocode", "standard"),
        ("client;Commune", "name, number, author, checker, revision, standard"),
        ("what follows is by the office of forests;x", "name, number"),
    ],
)
def test_a_line_that_names_no_item_is_one_finding(tmp_path, line, near):
    path = write_csv(tmp_path / "site", ["item;value", "name;Combe", line])
    (finding,) = findings_of(path)
    assert (finding.sheet, finding.cell) == ("Project", "A3")
    assert finding.text == line.split(";")[0]
    assert str(finding.accepted).startswith(near)


def misspell(word, rng):
    """Word with one letter gone, doubled, exchanged, or two that changed places."""
    k = rng.randrange(len(word) - 1)
    return rng.choice(
        [
            word[:k] + word[k + 1 :],
            word[:k] + word[k] + word[k:],
            word[:k] + rng.choice(string.ascii_lowercase) + word[k + 1 :],
            word[:k] + word[k + 1] + word[k] + word[k + 2 :],
        ]
    )


@pytest.mark.parametrize("kind", ["xlsx", "csv"])
def test_no_misspelt_item_of_any_language_is_lost(kind, save, sheets, tmp_path):
    rng = random.Random(7)
    for _ in range(12):
        field = rng.choice(PROJECT_ITEMS)
        word = misspell(field.label_in(rng.choice(LANGUAGES)), rng)
        if find_item(word, PROJECT_ITEMS):
            continue
        lines = [["item", "value"], ["standard", PROFILE], [word, "something"]]
        if kind == "csv":
            path = write_csv(tmp_path / "site", [";".join(line) for line in lines])
        else:
            path = save({"Project": lines, **sheets})
        (finding,) = findings_of(path)
        assert (finding.sheet, finding.text) == ("Project", word)
        assert find_item(word, PROJECT_ITEMS) is None


def read_or_refuse(path):
    """Sheets that a site was refused for, and its profile if it was not."""
    try:
        return set(), read_site(path).project.standard.strip()
    except SiteDataError as error:
        faults = [one for one in error.findings if one.severity == "error"]
        return {one.sheet for one in faults}, ""


def test_a_line_of_items_is_read_or_refused_wherever_its_marks_stand(tmp_path):
    """Any line with the item and the profile: its profile is used, or it is refused."""
    rng = random.Random(11)
    marks = [";", ",", "\t", "|", ":", "=", " ", ";;", " ;", "; ", '";"']
    used = 0
    for _ in range(40):
        line = rng.choice(["", " ", ";"]) + "standard" + rng.choice(marks) + PROFILE
        line += rng.choice(["", ";", " ", ";;;", ";x"])
        path = write_csv(tmp_path / "site", ["item;value", line])
        refused_in, profile = read_or_refuse(path)
        assert refused_in <= {"Project", ""}, line  # "": no csv at all
        assert profile == PROFILE or refused_in, line
        used += not refused_in
    assert 0 < used < 40


@pytest.mark.parametrize("mark", [",", "\t", "|"])
def test_a_net_row_with_another_delimiter_is_no_note(tmp_path, mark):
    """A long name makes it read like prose: a row would be lost, and the rest pass."""
    sheets = {name: [*rows] for name, rows in SOUND.items()}
    cells = ["" if cell is None else str(cell) for cell in SOUND["Nets"][1]]
    sheets["Nets"].append([mark.join(["R3 above the old hut", *cells[1:]])])
    (first, *_) = findings_of(write_csv(tmp_path / "site", ["item;value"], sheets))
    assert first.sheet == "Nets"


def test_a_cell_beyond_the_headings_of_a_csv_is_refused(tmp_path):
    """One delimiter too many shifts an optional cell out of its column."""
    sheets = {name: [*rows] for name, rows in SOUND.items()}
    sheets["Nets"][0] = [*sheets["Nets"][0], "slack [-]"]
    sheets["Nets"][1] = [*sheets["Nets"][1], None, 0.087]
    (finding,) = findings_of(write_csv(tmp_path / "site", ["item;value"], sheets))
    assert (str(finding.rule), finding.text) == ("has no heading above it", "0.087")
