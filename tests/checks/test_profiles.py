"""The shipped profiles side by side, and what a swapped value changes."""

import json
import shutil
import tomllib

import pytest

from netdesign.checks import list_standards, load_standard
from netdesign.edge.input_files import find_resource
from netdesign.edge.json_text import write_json
from netdesign.outcome import StandardError, Verdict
from tests.checks.given_pulls import find_second, judge_row, study_row

SECOND = find_second(1.0)

NAMES = ("eurocode", "nf-p-95-304-style", "onr-24805-style", "swiss-guideline-2007")
ROW = {
    "anchor": {
        "kind": "rope anchor",
        "tendon": 360,
        "pull_out": 280,  # as of one test: 200
        "proven": "tests",
        "head_across": 150,
    },
    "foot": (20.0, 18.0),
    "head": (5.0, -22.0),
    "guy_anchors": "shared",  # those of two posts would cross in the ground
    "gap": 1.0,
}


def edit(path, old, new):
    text = path.read_text("utf-8")
    assert text.count(old) == 1, old
    path.write_text(text.replace(old, new), "utf-8")


@pytest.fixture
def folder(tmp_path):
    def copy(name):
        source = find_resource("standards") / name
        return shutil.copytree(source, tmp_path / name)

    return copy


@pytest.mark.parametrize("name", NAMES)
def test_every_value_has_a_source_and_none_claims_to_be_read(name):
    standard = load_standard(name)
    entries = [*standard.values, *standard.tables]
    assert {entry.status for entry in entries} <= {"assumed", "secondary"}
    assert all(len(entry.source) > 10 for entry in entries)
    document = find_resource("standards") / name / "document.toml"
    assert "nobody yet" in tomllib.loads(document.read_text("utf-8"))["checked_by"]


@pytest.mark.parametrize(
    ("name", "tested", "tendon", "post"),
    [
        ("nf-p-95-304-style", 1.35, 1.5, 1.05),
        ("swiss-guideline-2007", 1.35, 1.35, 1.05),
        ("eurocode", 1.15, 1.5, 1.0),
        ("onr-24805-style", 1.2, 1.5, 1.1),
    ],
)
def test_profiles_differ_by_their_resistance_factors_alone(name, tested, tendon, post):
    """Same demand under all four: they take the same load factor and end effect.

    Nobody says that the anchors are bars: the larger factor of tendon and rope counts.
    """
    checks = judge_row(name, **ROW)
    assert checks["foot_anchor.tendon"].demand_kN == pytest.approx(
        1.5 * 94.18 * 1.00499 * SECOND, rel=1e-4
    )
    factors = [
        checks[key].read("γ_R")
        for key in ("foot_anchor.pull_out", "foot_anchor.tendon", "post.compression")
    ]
    assert factors == pytest.approx([tested, tendon, post], rel=1e-12)


def test_geometry_is_checked_as_far_as_a_profile_has_limits():
    def geometry(name):
        checks = judge_row(name, **ROW)
        return {key: c.verdict for key, c in checks.items() if key.startswith("geom")}

    few = {"geometry.inclination", "geometry.slope", "geometry.height"}
    few.add("geometry.anchors")
    assert set(geometry("nf-p-95-304-style")) == few
    swiss = geometry("swiss-guideline-2007")
    assert set(swiss) == few | {
        "geometry.spacing",
        "geometry.gap",
    }
    assert set(swiss.values()) == {Verdict.PASS}


def test_swapped_limit_changes_verdict_and_hash_and_nothing_else(folder):
    mine = folder("nf-p-95-304-style")
    before = study_row(mine, **ROW)
    edit(mine / "factors.toml", "value = 1.35\n", "value = 2.7\n")
    after = study_row(mine, **ROW)
    assert (before.verdict, after.verdict) == (Verdict.PASS, Verdict.FAIL)
    assert before.profile.sha256 != after.profile.sha256
    was, now = (json.loads(write_json(one)) for one in (before, after))
    for study in (was, now):
        for key in ("sha256", "proof_factor"):  # both follow from the value
            study["profile"].pop(key)
        for value in study["profile"]["values"]:
            if value["id"] == "resistance.pull_out.tested":
                value.pop("value")
        (row,) = study["rows"]
        for one in (study, row):
            one.pop("verdict")
            one.pop("scopes")
        row["checks"] = [c for c in row["checks"] if c["mode"] != "pull_out"]
    was["provenance"] = now["provenance"]  # hash of the workbook: its time stamp
    assert was == now


def test_national_choice_takes_the_place_of_its_factors(folder):
    mine = folder("eurocode")
    recommended = load_standard(mine)
    edit(mine / "document.toml", '"piles-in-tension-da2"', '"denmark"')
    danish = load_standard(mine)
    assert recommended.find("resistance.pull_out.tested").value == 1.15
    assert danish.find("resistance.pull_out.tested").value == 1.43
    assert danish.find("resistance.rope") == recommended.find("resistance.rope")
    assert len(danish.values) == len(recommended.values)
    assert danish.sha256 != recommended.sha256


def test_consequence_class_3_is_stricter(folder):
    mine = folder("onr-24805-style")
    edit(mine / "document.toml", 'choice = "cc2"', 'choice = "cc3"')
    values = {v.id: v.value for v in load_standard(mine).values}
    assert values["resistance.tendon"] == pytest.approx(1.15 * 1.5, rel=1e-12)
    assert values["resistance.pull_out.tested"] == 1.5


@pytest.mark.parametrize(
    ("name", "file", "old", "new", "told"),
    [
        (
            "eurocode",
            "document.toml",
            '"piles-in-tension-da2"',
            '"frence"',
            "'choice' = 'frence': must be one of piles-in-tension-da2",
        ),
        (
            "eurocode",
            "tables.toml",
            "{ from = 2, to = 2, value = 1.3 }",
            "{ from = 3, to = 3, value = 1.3 }",
            "'rows' entry 2: 'from' = 3, 'to' = 3: must begin at 2",
        ),
        (
            "eurocode",
            "tables.toml",
            "{ from = 2, to = 2, value = 1.3 }",
            "{ from = 1, to = 2, value = 1.3 }",
            "'rows' entry 2: 'from' = 1, 'to' = 2: must begin at 2",
        ),
    ],
)
def test_spoilt_profile_is_refused_by_file_and_key(folder, name, file, old, new, told):
    mine = folder(name)
    edit(mine / file, old, new)
    with pytest.raises(StandardError) as caught:
        load_standard(mine)
    assert file in str(caught.value)
    assert told in str(caught.value)


def test_half_a_group_is_refused(folder):
    mine = folder("swiss-guideline-2007")
    path = mine / "model.toml"
    blocks = path.read_text("utf-8").split("[[value]]")
    kept = [one for one in blocks if 'id = "end.isolated_gap"' not in one]
    path.write_text("[[value]]".join(kept), "utf-8")
    with pytest.raises(
        StandardError, match=r"end\.constant is only accepted with end\.isolated_gap"
    ):
        load_standard(mine)


def test_a_table_does_not_extrapolate():
    table = load_standard("swiss-guideline-2007").find_table("glide.factor.south")
    assert [table.find(k) for k in (0, 1, 4, 5)] == [None, 1.3, 3.2, None]
    tests = load_standard("eurocode").find_table("correlation.tests.least")
    assert [tests.find(k) for k in (1, 2, 3, 4, 5, 100)] == [1.4, 1.2, 1.05, 1, 1, 1]


@pytest.mark.parametrize("name", list_standards())
def test_profiles_have_the_guideline_as_floor_unless_they_say_otherwise(folder, name):
    assert load_standard(name).floor == "guideline"
    mine = folder(name)
    file = mine / "document.toml"
    text = file.read_text("utf-8")
    file.write_text(text.replace('load.floor = "guideline"\n', ""), "utf-8")
    assert load_standard(mine).floor == "guideline"
    file.write_text(text.replace('"guideline"', '"none"'), "utf-8")
    assert load_standard(mine).floor == "none"


def test_a_profile_says_which_load_governs(folder):
    mine = folder("swiss-guideline-2007")
    assert load_standard(mine).has_maker_floor
    assert not load_standard(mine).is_by_guideline
    file = mine / "document.toml"
    floor = 'load.floor = "guideline"\n'
    edit(file, floor, f'{floor}load.governs = "guideline"\nload.maker = "none"\n')
    assert load_standard(mine).is_by_guideline
    assert not load_standard(mine).has_maker_floor
    edit(file, floor, 'load.floor = "none"\n')
    with pytest.raises(StandardError, match=r"load\.governs"):
        load_standard(mine)


def test_a_profile_says_its_choice_and_what_it_does_not_check():
    """What document.toml and choices.toml have, read by themselves."""
    folder = find_resource("standards") / "eurocode"
    document = tomllib.loads((folder / "document.toml").read_text("utf-8"))
    choices = tomllib.loads((folder / "choices.toml").read_text("utf-8"))["choice"]
    (chosen,) = (one for one in choices if one["name"] == document["choice"])
    scope = document.get("scope", {})
    loaded = load_standard("eurocode")
    assert loaded.choice_text == chosen["text"] != ""
    unchecked = {topic for topic, said in scope.items() if said == "not checked"}
    assert set(loaded.not_checked) >= unchecked
    other = load_standard("nf-p-95-304-style")
    assert other.choice_text == ""
