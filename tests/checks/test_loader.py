"""Profiles from the program and from a folder; their hash; what is refused."""

import math
import re
import shutil
from pathlib import Path

import pytest

from netdesign.checks.loader import list_standards, load_standard
from netdesign.edge.input_files import find_resource
from netdesign.outcome import StandardError

NF_STYLE = "nf-p-95-304-style"


@pytest.fixture
def folder(tmp_path) -> Path:
    """A copy of the profile that comes with the program."""
    source = find_resource("standards") / NF_STYLE
    return Path(shutil.copytree(source, tmp_path / "mine"))


def edit(path: Path, old: str, new: str) -> None:
    text = path.read_text("utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), "utf-8")


def test_every_profile_of_the_program_loads_under_its_own_id():
    names = list_standards()
    swiss = "swiss-guideline-2007"
    assert names == ("eurocode", NF_STYLE, "onr-24805-style", swiss)
    assert [load_standard(name).id for name in names] == list(names)


def test_values_are_kept_as_printed_and_in_si():
    standard = load_standard(NF_STYLE)
    inclination = standard.find("geometry.inclination.max")
    assert (inclination.value, inclination.unit) == (35.0, "deg")
    assert inclination.value_si == math.radians(35.0)
    assert standard.find("action.snow").value_si == 1.5


def test_factor_of_the_basis_is_used_and_else_that_of_the_mode():
    standard = load_standard(NF_STYLE)

    def found(mode: str, basis: str) -> str | None:
        value = standard.find_resistance_factor(mode, basis)
        return value.id if value else None

    assert found("pull_out", "tested") == "resistance.pull_out.tested"
    assert found("pull_out", "computed") == "resistance.pull_out.computed"
    assert found("pull_out", "declared") is None
    assert found("pull_out", "") is None
    assert found("rope", "declared") == "resistance.rope"
    assert found("rope", "") == "resistance.rope"
    assert found("crushing", "tested") is None


def test_folder_gives_the_same_profile_as_the_id(folder):
    assert load_standard(folder) == load_standard(NF_STYLE)
    assert load_standard(str(folder)) == load_standard(NF_STYLE)


@pytest.mark.parametrize("end", [b"\r\n", b"\r"])
def test_hash_does_not_depend_on_line_ends(folder, end):
    before = load_standard(folder).sha256
    for path in folder.iterdir():
        path.write_bytes(path.read_bytes().replace(b"\n", end))
    assert re.fullmatch("[0-9a-f]{64}", before)
    assert load_standard(folder).sha256 == before


@pytest.mark.parametrize(
    "name", ["document.toml", "limits.toml", "factors.toml", "NOTES.md"]
)
def test_hash_depends_on_every_file(folder, name):
    before = load_standard(folder).sha256
    with (folder / name).open("a") as file:
        file.write("\n# one more remark\n")
    assert load_standard(folder).sha256 != before


def test_hash_depends_on_names_and_not_on_foreign_files(folder):
    before = load_standard(folder).sha256
    (folder / ".DS_Store").write_bytes(b"x")
    (folder / "sub").mkdir()
    assert load_standard(folder).sha256 == before
    (folder / "NOTES.md").rename(folder / "REMARKS.md")
    assert load_standard(folder).sha256 != before


def test_byte_order_mark_is_allowed(folder):
    path = folder / "factors.toml"
    before = load_standard(folder).values
    path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes())
    assert load_standard(folder).values == before


NONE_NEAR = f"is unknown. Accepted are {', '.join(list_standards())}, or"


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ("NF P 95-304", f"'NF P 95-304' is unknown. Did you mean {NF_STYLE}?"),
        ("ONR-style", f"Did you mean onr-24805-style or {NF_STYLE}? Accepted are"),
        ("zzz", f"limit profile 'zzz' {NONE_NEAR}"),
        ("x" * 5000, NONE_NEAR),
        (Path(__file__), NONE_NEAR),
    ],
)
def test_an_unknown_profile_is_refused_with_what_is_near_or_accepted(given, told):
    with pytest.raises(StandardError, match=re.escape(told)):
        load_standard(given)


def test_all_missing_and_all_foreign_files_are_named(folder):
    (folder / "more.toml").write_text("")
    (folder / "again.toml").write_text("")
    needed = "document.toml, limits.toml, factors.toml"
    accepted = f"{needed}, model.toml, tables.toml, choices.toml"
    expected = f"unknown file again.toml, more.toml; accepted are {accepted} and *.md"
    with pytest.raises(StandardError, match=re.escape(expected) + "$"):
        load_standard(folder)
    for name in ("limits.toml", "factors.toml"):
        (folder / name).unlink()
    expected = f"lacks limits.toml, factors.toml; needs {needed}"
    with pytest.raises(StandardError, match=re.escape(expected) + "$"):
        load_standard(folder)


def test_a_file_that_is_too_large_is_refused_with_the_folder(folder):
    (folder / "NOTES.md").write_text("a" * 300_000)
    with pytest.raises(
        StandardError, match=r"mine: cannot be read: is larger than 256"
    ):
        load_standard(folder)


def test_a_choice_without_a_file_of_choices_is_refused(folder):
    with (folder / "document.toml").open("a") as file:
        file.write('choice = "annex"\n')
    with pytest.raises(StandardError) as caught:
        load_standard(folder)
    assert str(caught.value) == (
        f"{folder}: lacks choices.toml, in which 'choice' = 'annex' of document.toml "
        "must stand"
    )


def test_choices_without_a_choice_are_refused_with_what_is_accepted(folder):
    shutil.copy(find_resource("standards") / "eurocode" / "choices.toml", folder)
    with pytest.raises(StandardError) as caught:
        load_standard(folder)
    assert str(caught.value) == (
        f"{folder / 'document.toml'}: 'choice' = '': must be one of "
        "piles-in-tension-da2, nails-da2, en-1537, denmark, grouted-anchors-2013 "
        "(choices.toml)"
    )


@pytest.mark.parametrize("rest", [b"value = = 1", b"\xff\xfe"])
def test_file_that_is_not_toml_is_named(folder, rest):
    (folder / "limits.toml").write_bytes(rest)
    with pytest.raises(StandardError, match=r"limits\.toml: is not TOML in UTF-8"):
        load_standard(folder)


def test_reason_of_a_factor_below_1_stands_beside_its_value(folder):
    factors, why = folder / "factors.toml", "Measured on nine nets of this type."
    text = factors.read_text("utf-8").replace("value = 1.5\n", "value = 0.87\n", 1)
    factors.write_text(text, "utf-8")
    with pytest.raises(StandardError, match=r"action\.snow = 0\.87 lies beyond 1"):
        load_standard(folder)
    edit(factors, "value = 0.87\n", f'value = 0.87\nreason_beyond = "{why}"\n')
    values = {value.id: value for value in load_standard(folder).listed}
    assert values["action.snow"].reason_beyond == why
    others = {v.reason_beyond for k, v in values.items() if k != "action.snow"}
    assert others == {""}
