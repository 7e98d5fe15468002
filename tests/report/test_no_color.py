import re

import pytest
from rich.console import Console

from netdesign.report.terminal import print_summary
from tests.report.build_study import build_study

COLOUR = re.compile("\x1b\\[[0-9;]*[34][0-9]")  # a colour of letters or ground


@pytest.mark.parametrize("asked", [True, False])
def test_no_color_is_honoured_on_a_terminal(monkeypatch, capsys, asked):
    monkeypatch.setenv("TERM", "xterm-256color")
    for name in ("NO_COLOR", "FORCE_COLOR"):
        monkeypatch.delenv(name, raising=False)
    if asked:
        monkeypatch.setenv("NO_COLOR", "1")
    console = Console(force_terminal=True, color_system="standard")
    print_summary(build_study(), console)
    out = capsys.readouterr().out
    assert "FAIL" in out
    assert bool(COLOUR.search(out)) is not asked
