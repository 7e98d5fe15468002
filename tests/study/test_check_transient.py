"""`check --method transient`: what is the demand, and that its tables agree.

The suite takes three rows of the built-in example; ``python -m pytest -m slow`` all.
"""

import json
import sys
from dataclasses import replace

import pytest

from netdesign import cli
from netdesign.outcome import Outcome
from netdesign.study import cases as site_cases
from netdesign.words.message import say
from tests.short_example import write_short_example
from tests.tiny_site import write_site

MEMBERS = ["Foot anchor", "Uphill guy", "Post"]  # the downhill guy is slack
ALLOWED = 0.05  # over the steady state on sliding ground (FACTS.md, section 12)


@pytest.fixture
def site_file(tmp_path):
    return write_site(tmp_path / "site.xlsx")


def check(monkeypatch, capsys, site_file, *options):
    arguments = ["check", site_file, "--accuracy", "0.1", "--jobs", "1", "--json"]
    monkeypatch.setattr(
        sys, "argv", ["netdesign", *map(str, arguments), "--quiet", *options]
    )
    with pytest.raises(SystemExit) as end:
        cli.main()
    return end.value.code, json.loads(capsys.readouterr().out)


def test_a_history_without_plateau_is_not_proven(monkeypatch, capsys, site_file):
    def fail_last(_, results, settings, *__):
        assert settings.accuracy == 0.1
        lost = replace(
            results[0][-1],
            outcome=Outcome.PLATEAU_NOT_REACHED,
            reason="history of a governing case: no plateau",
            member_forces={},
            solution=None,
        )
        return [[*results[0][:-1], lost]]

    monkeypatch.setattr(site_cases, "confirm_rows", fail_last)
    code, study = check(monkeypatch, capsys, site_file, "--method", "transient")
    assert code == 4
    assert study["verdict"] == "not_proven"
    assert "no plateau" in json.dumps(study["rows"][0]["reasons"])
    assert study["provenance"]["settings"]["method"] == "transient"


def test_larger_forces_of_histories_are_the_demands(monkeypatch, capsys, site_file):
    def double(_, results, *__, **___):
        return [
            [
                replace(
                    one,
                    member_forces={
                        member: replace(
                            band,
                            low=2 * band.low,
                            value=2 * band.value,
                            high=2 * band.high,
                        )
                        for member, band in one.member_forces.items()
                    },
                )
                for one in results[0]
            ]
        ]

    _, steady = check(monkeypatch, capsys, site_file)
    assert steady["provenance"]["settings"]["method"] == "steady"
    monkeypatch.setattr(site_cases, "confirm_rows", double)
    _, doubled = check(monkeypatch, capsys, site_file, "--method", "transient")
    for before, after in zip(
        steady["rows"][0]["extremes"], doubled["rows"][0]["extremes"], strict=True
    ):
        assert after["max_kN"] == pytest.approx(2 * before["max_kN"])


def name_member_of(note):
    """English name of the member that a note is about."""
    return str(say(note["arguments"]["member"]["key"]))


def list_history_notes(row):
    return [note for note in row["notes"] if note["key"].startswith("row.history_")]


def require_judged(row):
    """No member without a demand; whose it is and why is said of each."""
    assert "history of a governing case" not in json.dumps(row["reasons"])
    assert not any(case["outcome"] != "converged" for case in row["cases"])
    notes = list_history_notes(row)
    assert [name_member_of(note) for note in notes] == MEMBERS


@pytest.fixture
def example(tmp_path):
    """Rows of the example: no slip, and two whose ground slides."""

    def write(rows, **how):
        path = tmp_path / f"{'-'.join(rows)}.xlsx"
        write_short_example(path, rows, **how)
        return path

    return write


@pytest.mark.long
def test_the_steady_state_is_the_demand_but_for_what_is_surely_more(
    monkeypatch, capsys, example
):
    site = example(["R1", "R4", "R5"])
    options = ("--accuracy", "0.01")
    _, steady = check(monkeypatch, capsys, site, *options)
    _, followed = check(monkeypatch, capsys, site, *options, "--method", "transient")
    for before, after in zip(steady["rows"], followed["rows"], strict=True):
        require_judged(after)
        raised = [
            name_member_of(note)
            for note in list_history_notes(after)
            if note["key"] == "row.history_exceeds"
        ]
        for old, new in zip(before["extremes"], after["extremes"], strict=True):
            name = old["quantity"].replace("_", " ").capitalize()
            if name in raised:
                # surely more in its case, which may be another than before
                allowed = (1.0 + ALLOWED) * old["max_kN"]
                assert old["max_kN"] < new["max_kN"] < allowed
                is_same_case = old["case"] == new["case"]
                assert old["high_kN"] < new["low_kN"] or not is_same_case
            else:
                assert new["max_kN"] == old["max_kN"]


def require_tables_agree(row):
    """Largest force and the same case solved again, by the method that is named.

    Returns the bounds that were solved again.
    """
    extremes = {one["quantity"]: one["max_kN"] for one in row["extremes"]}
    for bound in row["envelope"]["bounds"]:
        assert bound["max_kN"] == extremes[bound["quantity"]]
        again = bound["confirmation"]
        if again is None:
            continue
        difference = again["confirmed_kN"] / again["screened_kN"] - 1.0
        assert again["difference_percent"] == pytest.approx(100.0 * difference)
        if again["method"] == "transient":
            assert bound["max_kN"] == pytest.approx(again["confirmed_kN"], rel=1e-2)
            assert 0.0 < difference < ALLOWED
        else:
            assert bound["max_kN"] == pytest.approx(again["screened_kN"], rel=1e-9)
    return [bound for bound in row["envelope"]["bounds"] if bound["confirmation"]]


def test_tables_of_a_searched_row_agree(monkeypatch, capsys, example):
    site = example(["R4"], is_grid=False)
    options = ("--accuracy", "0.03", "--method", "transient")
    _, study = check(monkeypatch, capsys, site, *options)
    require_judged(study["rows"][0])
    assert require_tables_agree(study["rows"][0])


@pytest.mark.slow
def test_every_row_of_the_example_is_judged(monkeypatch, capsys, tmp_path):
    monkeypatch.chdir(tmp_path)
    arguments = ["check", "--example", "--method", "transient", "--json", "--quiet"]
    monkeypatch.setattr(sys, "argv", ["netdesign", *arguments])
    with pytest.raises(SystemExit):
        cli.main()
    study = json.loads(capsys.readouterr().out)
    assert len(study["rows"]) == 7
    for row in study["rows"]:
        require_judged(row)
        assert require_tables_agree(row)
