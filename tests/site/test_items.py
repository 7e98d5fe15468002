"""Lines of sheet Project: what names no item is refused, and never a default."""

import random
import string

import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.columns.fields import find_item
from netdesign.site.columns.office import load_plan
from netdesign.site.reader import read_site
from netdesign.words.catalogue import LANGUAGES
from tests.site.conftest import SOUND
from tests.site.csv_folder import write_csv_folder

PROFILE = "eurocode"
ITEMS = load_plan("project").items


def write_csv(path, project, sheets=SOUND):
    """A folder of csv files; ``project`` is the lines of its sheet as typed."""
    return write_csv_folder(path, {**sheets, "Project": project})


def findings_of(path):
    with pytest.raises(SiteDataError) as caught:
        read_site(path)
    return [one for one in caught.value.findings if one.severity == "error"]


@pytest.mark.parametrize(
    "line",
    [
        *("profile,eurocode", "profile: my own limits", "Profiel;eurocode"),
        *("Profiel;", "client;Commune", "what follows is by the office;x"),
    ],
)
def test_a_line_that_names_no_item_is_one_finding(tmp_path, line):
    path = write_csv(tmp_path / "site", ["item;value", "name;Combe", line])
    (finding,) = findings_of(path)
    assert (finding.sheet, finding.cell) == ("Project", "A3")
    assert finding.text == line.split(";")[0]
    assert "profile" in str(finding.accepted)


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


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_misspelt_profile_is_refused_or_read_never_left_out(tmp_path, language):
    rng = random.Random(language)
    name = next(one for one in ITEMS if one.key == "standard").label_in(language)
    for _ in range(8):
        typed = misspell(name, rng)
        path = write_csv(tmp_path / "site", ["item;value", f"{typed};{PROFILE}"])
        known = find_item(typed, ITEMS)
        if known is None:
            assert [one.cell for one in findings_of(path)] == ["A2"]
        elif known.key == "standard":
            assert read_site(path).project.standard == PROFILE


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
        line = rng.choice(["", " ", ";"]) + "profile" + rng.choice(marks) + PROFILE
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
    cells = ["" if cell is None else str(cell) for cell in SOUND["Rows"][1]]
    sheets["Rows"].append([mark.join(["R3 above the old hut", *cells[1:]])])
    found = findings_of(write_csv(tmp_path / "site", ["item;value"], sheets))
    assert found[0].sheet == "Rows"


def test_a_cell_beyond_the_headings_of_a_csv_is_refused(tmp_path):
    """One delimiter too many shifts an optional cell out of its column."""
    sheets = {name: [*rows] for name, rows in SOUND.items()}
    sheets["Rows"][0] = [*sheets["Rows"][0], "altitude [m]"]
    sheets["Rows"][1] = [*sheets["Rows"][1], None, 2087]
    (finding,) = findings_of(write_csv(tmp_path / "site", ["item;value"], sheets))
    assert (str(finding.rule), finding.text) == ("has no heading above it", "2087")
