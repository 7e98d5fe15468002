"""Precedence of options, the file beside the input, and defaults."""

import json

import pytest


@pytest.fixture
def rows(call, tmp_path):
    """Number of net rows that a dry run of the example plans with."""
    (tmp_path / "inner").mkdir()
    site = tmp_path / "inner" / "site.xlsx"
    assert call("init", site, "--example").code == 0

    def plan(*options):
        ended = call("check", site, "--dry-run", "--json", *options)
        assert ended.code == 0, ended.err
        return json.loads(ended.out)["net_rows"]

    return plan


def write(path, text):
    path.write_text(text, encoding="utf-8")
    return path


def test_an_option_overrules_the_file(rows, tmp_path):
    write(tmp_path / "inner" / "netdesign.toml", '[check]\nrow = ["A1", "A2"]\n')
    assert rows() == 2
    assert rows("--row", "B3") == 1


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
