"""A verdict is told as soon as it is known, before the reports are made."""

import sys

from netdesign.commands import check_run
from tests.make import write_rows
from tests.program import QUICK


def test_the_verdict_is_told_before_the_reports_are_made(call, tmp_path, monkeypatch):
    told = []

    def render(*given):
        told.append(sys.stdout.buffer.getvalue().decode())
        return check_run_render(*given)

    check_run_render = check_run.render_outputs
    monkeypatch.setattr(check_run, "render_outputs", render)
    write_rows(tmp_path / "site.xlsx", ["R1"])
    ended = call("check", "site.xlsx", "--out", "o", "--quiet", *QUICK)
    assert told, ended.err
    assert "Verdict:" in told[0]
    assert ended.out == told[0]
    assert (tmp_path / "o" / "report.xlsx").is_file()
