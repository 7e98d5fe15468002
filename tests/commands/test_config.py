"""Precedence of options, environment, files and defaults."""

import json

import click
import pytest

from netdesign import cli


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


def test_each_source_overrules_the_ones_below_it(jobs, tmp_path, monkeypatch):
    write(tmp_path / "inner" / "netdesign.toml", "[check]\njobs = 2\n")
    assert jobs() == 2
    other = write(tmp_path / "other.toml", "[check]\njobs = 3\n")
    assert jobs("--config", other) == 3
    monkeypatch.setenv("NETDESIGN_CHECK_JOBS", "4")
    assert jobs("--config", other) == 4
    assert jobs("--config", other, "--jobs", "5") == 5


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
    path = write(tmp_path / "mine.toml", text)
    ended = call("check", "--example", "--dry-run", "--config", path)
    assert ended.code == 2
    assert f"{path}: " in ended.err.replace("\n", " ")
    assert message in " ".join(ended.err.split())


def test_a_named_file_that_is_not_there_ends_with_2(call):
    ended = call("check", "--example", "--dry-run", "--config", "none.toml")
    assert ended.code == 2
    assert "none.toml: cannot be read" in ended.err


def test_lists_and_flags_may_stand_in_the_file(call, tmp_path):
    text = "[check]\nstandard = ['nonsense']\njson = true\n"
    path = write(tmp_path / "mine.toml", text)
    ended = call("check", "--example", "--dry-run", "--config", path)
    assert ended.code == 3
    assert "nonsense" in ended.err
    again = call(
        *("check", "--example", "--dry-run", "--config", path),
        *("--standard", "nf-p-95-304-style"),
    )
    assert json.loads(again.out)["schema"] == "netdesign.plan/1"


def test_every_option_can_be_given_by_a_variable_of_its_name(monkeypatch):
    """``--standard`` is ``standards`` inside: its variable was never read."""
    for name, command in cli.cli.commands.items():
        for param in command.params:
            for option in param.opts if isinstance(param, click.Option) else ():
                if option.startswith("--") and param.name not in ("config", "help"):
                    word = option.removeprefix("--").replace("-", "_").upper()
                    assert f"NETDESIGN_{name.upper()}_{word}" in param.envvar
    monkeypatch.setenv("NETDESIGN_CHECK_STANDARD", "eurocode onr-24805-style")
    context = cli.cli.commands["check"].make_context("check", ["--example"])
    assert context.params["standards"] == ("eurocode", "onr-24805-style")


@pytest.mark.parametrize(
    ("variable", "near"),
    [
        ("NETDESIGN_CHECK_STANDRAD", "'NETDESIGN_CHECK_STANDARD'"),
        ("NETDESIGN_CHECK_STANDARDD", "'NETDESIGN_CHECK_STANDARD'"),
        ("NETDESIGN_CHECK_ACURACY", "'NETDESIGN_CHECK_ACCURACY'"),
        ("NETDESIGN_CHECK_X", ""),
    ],
)
def test_a_variable_that_names_no_option_is_refused(call, monkeypatch, variable, near):
    monkeypatch.setenv(variable, "eurocode")
    ended = call("check", "--example", "--dry-run")
    assert ended.code == 2
    assert f"{variable}: is not known" in ended.err
    assert near in ended.err
    assert call("init", "site.xlsx").code == 0  # it is none of its own


def test_all_faults_of_a_file_are_told_at_once(call, tmp_path):
    (tmp_path / "netdesign.toml").write_text(
        '[check]\njob = 1\nstandrd = "x"\naccuracy = 7.3\n[chekc]\n'
    )
    ended = call("check", "site.xlsx", "--dry-run")
    assert ended.code == 2
    told = ("[chekc]", "[check] job", "[check] standrd", "[check] accuracy")
    assert [one for one in told if one in ended.err] == list(told)
