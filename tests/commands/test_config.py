"""Precedence of options, the file beside the input, and defaults."""

import json

import pytest


@pytest.fixture
def jobs(call, tmp_path):
    """Processes that a dry run of the example plans with."""
    (tmp_path / "inner").mkdir()
    site = tmp_path / "inner" / "site.xlsx"
    assert call("init", site, "--example").code == 0

    def plan(*options):
        ended = call("check", site, "--dry-run", "--json", *options)
        assert ended.code == 0, ended.err
        return json.loads(ended.out)["jobs"]

    return plan


def write(path, text):
    path.write_text(text, encoding="utf-8")
    return path


def test_an_option_overrules_the_file(jobs, tmp_path):
    write(tmp_path / "inner" / "netdesign.toml", "[check]\njobs = 2\n")
    assert jobs() == 2
    assert jobs("--jobs", "5") == 5


def test_a_file_elsewhere_is_not_read(jobs, tmp_path):
    write(tmp_path / "netdesign.toml", "[check]\njobs = 200\n")  # the working folder
    assert jobs() != 200


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[check]\njobbs = 2\n", "[check] jobbs: is not known; did you mean 'jobs'?"),
        ("[chek]\njobs = 2\n", "[chek]: is not known; did you mean 'check'?"),
        ("[report]\nout = 'x'\n", "[report]: is not known"),
        (
            "[check]\njobs = 0\n",
            "[check] jobs = 0: Invalid value for '--jobs': 0 is not in the range "
            "1<=x<=256",
        ),
        ("[check]\naccuracy = 'fine'\n", "[check] accuracy = 'fine'"),
        ("[check]\naccuracy = []\n", "[check] accuracy = []: no such value fits"),
        ("[check]\ncache = {}\n", "[check] cache = {}: no such value fits"),
        ("[check]\nstandard = [['x']]\n", "[check] standard = [['x']]: no such value"),
        ("[check]\nannotate = false\n", "[check] annotate = False: no such value"),
        ("[check]\njobs = true\n", "[check] jobs = True: no such value"),
        ("[check]\nquiet = 'perhaps'\n", "[check] quiet = 'perhaps'"),
        ("check = 3\n", "check: must be a table of options"),
        ("[check\n", "cannot be read as TOML"),
        ("[check]\nconfig = 'x'\n", "[check] config: is not known"),
    ],
)
def test_faults_of_the_file_end_with_2_and_their_place(call, tmp_path, text, message):
    write(tmp_path / "netdesign.toml", text)
    ended = call("check", "site.xlsx", "--dry-run")
    assert ended.code == 2
    assert "netdesign.toml: " in ended.err.replace("\n", " ")
    assert message in " ".join(ended.err.split())


def test_lists_and_flags_may_stand_in_the_file(call, tmp_path):
    text = "[check]\nstandard = ['nonsense']\njson = true\n"
    write(tmp_path / "netdesign.toml", text)
    assert call("init", "site.xlsx", "--example").code == 0
    ended = call("check", "site.xlsx", "--dry-run")
    assert ended.code == 3
    assert "nonsense" in ended.err
    again = call(
        *("check", "site.xlsx", "--dry-run"),
        *("--standard", "nf-p-95-304-style"),
    )
    assert json.loads(again.out)["schema"] == "netdesign.plan/1"


def test_all_faults_of_a_file_are_told_at_once(call, tmp_path):
    (tmp_path / "netdesign.toml").write_text(
        '[check]\njob = 1\nstandrd = "x"\naccuracy = 7.3\n[chekc]\n'
    )
    ended = call("check", "site.xlsx", "--dry-run")
    assert ended.code == 2
    told = ("[chekc]", "[check] job", "[check] standrd", "[check] accuracy")
    assert [one for one in told if one in ended.err] == list(told)
