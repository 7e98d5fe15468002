"""`check --method transient`: a history without plateau is never a pass."""

import json
import sys
from dataclasses import replace

import openpyxl
import pytest

from netdesign import cli, site_cases
from netdesign.outcome import Outcome
from tests.test_cli import SHEETS


@pytest.fixture
def site_file(tmp_path):
    workbook = openpyxl.Workbook()
    workbook.remove(workbook.active)
    for name, lines in SHEETS.items():
        sheet = workbook.create_sheet(name)
        for line in lines:
            sheet.append(line)
    path = tmp_path / "site.xlsx"
    workbook.save(path)
    return path


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
    assert "no plateau" in " ".join(study["rows"][0]["reasons"])
    assert "confirmed by a history" in study["provenance"]["settings"]["method"]


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
