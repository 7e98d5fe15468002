"""``netdesign verify --study``: what was stored comes out again, or it is said."""

import json
import os
import subprocess
import sys
from functools import lru_cache

import pytest

import netdesign as nd
from netdesign import cli
from netdesign.commands import report
from netdesign.solving import workers
from netdesign.solving.solve import solve_scene
from netdesign.study.document import hash_text, read_document, write_document
from tests.make import write_rows

DIFFERS, REFUSED, UNPROVEN, FAULT = 1, 3, 4, 5
solve_once = lru_cache(maxsize=None)(solve_scene)
PROGRAM = (sys.executable, "-c", "from netdesign.cli import main; main()")


@pytest.fixture(scope="module")
def home(tmp_path_factory):
    """Folder with a site of one net row, and its study."""
    folder = tmp_path_factory.mktemp("stored")
    write_rows(folder / "site.xlsx", ["R7"])
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        options = ["--accuracy", "0.0512345678", "--jobs", "1", "--no-html"]
        argv = ["netdesign", "check", "site.xlsx", "--quiet", "--no-excel", *options]
        patch.setattr("sys.argv", argv)
        with pytest.raises(SystemExit) as caught:
            cli.main()
    assert caught.value.code == DIFFERS  # the row fails: this is its verdict
    return folder


@pytest.fixture
def verify(home, call, tmp_path, monkeypatch):
    """Verifies the study after it, or its site, was changed by hand."""
    monkeypatch.setattr(workers, "solve_scene", solve_once)
    text = (home / "netdesign-out" / "study.json").read_text(encoding="utf-8")

    def run(change=lambda _: None, *options):
        study = json.loads(text)
        change(study)
        sealed = write_document(read_document(json.dumps(study)))  # as a forger would
        (tmp_path / "study.json").write_text(sealed, encoding="utf-8")
        given = options or ("--site", home / "site.xlsx")
        return call("verify", "--study", "study.json", "--jobs", 1, *given)

    return run


def test_a_study_comes_out_again_from_its_site_file(home):
    ended = subprocess.run(
        [*PROGRAM, "verify", "--study", "netdesign-out/study.json", "--jobs", "1"],
        cwd=home, env=os.environ | {"NETDESIGN_STORE": str(home / "none.sqlite")},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert "site file, SHA-256: equal" in ended.stdout
    assert "limit profile, SHA-256: equal" in ended.stdout
    study = json.loads((home / "netdesign-out" / "study.json").read_text())
    count = len(study["rows"][0]["cases"])
    assert f"{count} cases solved again" in ended.stdout
    assert "\nsame bytes\n" in ended.stdout
    assert ended.stdout.splitlines()[-1].startswith(
        "not checked, as only the run knows it"
    )
    assert not (home / "none.sqlite").exists()  # no stored case was believed


def to_pass(study):
    """As one would who puts another number wherever a check does not pass."""
    for check in study["rows"][0]["checks"]:
        check.update(open=[], met=check["met"] and "pass")
        for step in check["steps"]:
            if step["symbol"] == "μ":
                step["value"] = 0.5
                step.pop("low", None), step.pop("high", None)


def last_digits(study):
    study["rows"][0]["cases"][0]["error_percent"] *= 1.0 + 1e-9


def test_a_study_made_to_pass_ends_with_1_and_has_no_verified_report(
    verify, call, home
):
    ended = verify(to_pass)
    assert ended.code == DIFFERS
    assert "verdict: stored 'pass', again 'fail'" in ended.out
    assert "same" not in ended.out
    options = ("--verify", "--site", home / "site.xlsx", "--out", "out")
    reported = call("report", "study.json", *options)
    assert reported.code == REFUSED
    assert "verdict: stored 'pass', again 'fail'" in reported.err
    assert call("report", "study.json", "--out", "out", "--no-excel").code == 0


# A change of one value, and the place that is named.
CHANGES = (
    (
        lambda s: s["rows"][0]["cases"][2].update(post_kN=1.0),
        "rows.R7.cases.2.post_kN: stored 1.0, again ",
    ),
    (
        lambda s: s["rows"][0]["cases"].pop(),
        ".outcome: stored None, again 'converged'",
    ),
    (
        lambda s: s["profile"]["values"][0].update(value=0.5),
        "profile.values.geometry.inclination.min.value: stored 0.5, again 25.0",
    ),
    (
        lambda s: s["project"].update(author="\x1b[31mA. N. Other"),
        "project.author: stored '",
    ),
    (lambda s: s["notes"].clear(), "notes.0.key: stored None, again "),
)


def test_every_changed_value_has_its_place(verify, monkeypatch):
    monkeypatch.setattr(report, "_SHOWN", 10_000)

    def change(study):
        for change_one, _ in CHANGES:
            change_one(study)

    ended = verify(change)
    assert ended.code == DIFFERS
    for _, place in CHANGES:
        assert place in ended.out
    assert "\x1b" not in ended.out


def test_a_check_too_many_is_a_difference(verify):
    ended = verify(lambda s: s["rows"][0]["checks"].append(s["rows"][0]["checks"][0]))
    assert ended.code == DIFFERS
    assert "again None" in ended.out


def test_an_altered_study_is_refused_at_reading(home, call, tmp_path):
    """By accident; its verdict alone, under the digest of before or one made anew."""
    text = (home / "netdesign-out" / "study.json").read_text(encoding="utf-8")
    study = json.loads(text) | {"verdict": "pass"}
    digests = study["digest"], hash_text(json.dumps(study))
    altered = [json.dumps(study | {"digest": one}) for one in digests]
    path = tmp_path / "damaged.json"
    words = (("verify", "--study", path), ("report", path), ("diff", path, path))
    for content, commands in (
        (text.replace('"R7"', '"R8"', 1), words),
        *((one, words[:1]) for one in altered),
    ):
        path.write_text(content, encoding="utf-8")
        for command in commands:
            ended = call(*command)
            assert ended.code == REFUSED
            assert "damaged.json: it was altered after it was written" in ended.err


def test_the_last_digits_of_another_machine_are_no_difference(verify):
    ended = verify(last_digits)
    assert ended.code == 0
    assert "\nsame numbers, within 1e-06 of each\n" in ended.out


def test_other_versions_are_told_and_leave_the_study_unproven(verify):
    def age(study):
        study["provenance"]["version"] = "0.0.9"
        study["provenance"]["libraries"]["numpy"] = "1.0.0"

    ended = verify(age)
    assert ended.code == UNPROVEN
    assert "not verified: netdesign 0.0.9 then, " in ended.out
    assert "not verified: numpy 1.0.0 then, " in ended.out
    assert "same numbers" in ended.out


@pytest.mark.parametrize(
    ("change", "what"),
    [
        (lambda s: s["provenance"].update(site_sha256="0" * 64), "site file"),
        (lambda s: s["profile"].update(sha256="0" * 64), "limit profile"),
    ],
)
def test_other_inputs_are_named_and_not_solved(verify, change, what):
    ended = verify(change)
    assert ended.code == DIFFERS
    assert f"{what}, SHA-256: DIFFERS\n  stored {'0' * 64}\n" in ended.out
    assert "not calculated again" in ended.out


def test_a_fault_of_the_program_is_no_difference(verify, monkeypatch):
    def fail(*_, **__):
        raise RuntimeError("spoilt")

    monkeypatch.setattr("netdesign.solving.workers.solve_scene", fail)
    ended = verify()
    assert ended.code == FAULT
    assert "RuntimeError: spoilt" in ended.err
    assert "DIFFERS" not in ended.out


def test_settings_that_cannot_be_had_again_are_refused(verify):
    def change(study):
        study["provenance"]["settings"]["creep_law"] = "my own"

    ended = verify(change)
    assert ended.code == REFUSED
    assert "creep law 'my own'" in ended.err


def test_a_row_left_out_by_hand_is_found(home, call, tmp_path, monkeypatch):
    """Also where it stands among those left out: notes of all rows tell of it still."""
    write_rows(tmp_path / "two.xlsx", ["R7", "R1"])
    solving = ("--accuracy", "0.0512345678", "--jobs", "1", "--no-html", "--no-excel")
    monkeypatch.setattr(workers, "solve_scene", solve_once)
    assert call("check", "two.xlsx", *solving).code == DIFFERS
    study = json.loads((tmp_path / "netdesign-out" / "study.json").read_text())
    study["rows"] = [one for one in study["rows"] if one["id"] == "R1"]
    study["left_out"] = ["R7"]
    sealed = write_document(read_document(json.dumps(study)))
    (tmp_path / "study.json").write_text(sealed, encoding="utf-8")
    ended = call("verify", "--study", "study.json")
    assert ended.code == DIFFERS, ended.out
    assert "not verified: net rows R7, which were left out" in ended.out


def test_a_study_from_python_is_shown_compared_and_verified(
    home, call, tmp_path, monkeypatch
):
    """Both doors: what `check` of Python wrote is a study of the commands."""
    monkeypatch.setattr(workers, "solve_scene", solve_once)
    made = nd.check(home / "site.xlsx", accuracy=0.0512345678)
    (tmp_path / "py.json").write_text(write_document(made), encoding="utf-8")
    site = ("--site", home / "site.xlsx")
    stored = home / "netdesign-out" / "study.json"
    verified = call("verify", "--study", "py.json", *site)
    assert (verified.code, "same bytes" in verified.out) == (0, True), verified.out
    shown = call("report", "py.json", "--verify", *site, "--no-excel")
    assert shown.code == DIFFERS  # its verdict
    (tmp_path / "site.xlsx").write_bytes((home / "site.xlsx").read_bytes())
    compared = call("diff", "py.json", stored, "--verify")
    assert compared.code == 0, compared.err
    first, second = compared.out.splitlines()
    assert first.startswith("verified: ")
    assert second == "the two studies are the same but for their time"
