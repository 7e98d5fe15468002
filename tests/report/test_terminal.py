import io
import re

from rich.console import Console

from netdesign.report.summary import build_summary
from netdesign.report.terminal import open_console, print_summary
from netdesign.report.view.whole import build_view
from tests.report.build_study import SCRIPT, build_study


def printed(study, **options):
    stream = io.StringIO()
    print_summary(build_summary(study), Console(file=stream, width=160, **options))
    return stream.getvalue()


def test_one_line_for_each_net_row_then_reasons_and_assumed_values():
    lines = printed(build_study()).splitlines()
    assert [line.split("  ")[0] for line in lines[1:4]] == [
        "Couloir 1",
        "=1+1",
        f"Ridge {SCRIPT}",
    ]
    assert "=1+1: 1 of the cases has no result." in lines
    assert any(
        line.endswith("factor.action = 1.5, factor.tendon = 1.35") for line in lines
    )
    assert lines[-1].startswith("Verdict: FAIL - ")


def test_summary_in_french_has_the_same_numbers():
    stream = io.StringIO()
    console = Console(file=stream, width=200)
    print_summary(build_summary(build_study(), "fr"), console)
    lines = stream.getvalue().splitlines()
    assert lines[-1].startswith("Verdict\u00a0: NON SATISFAIT - ")
    english = printed(build_study()).splitlines()
    for number in range(1, 4):
        numbers = re.findall(r"\d+\.\d+", english[number])
        shown = re.findall(r"\d+,\d+", lines[number])
        assert [one.replace(",", ".") for one in shown] == numbers
        assert not re.search(r"\d\.\d", lines[number])


def test_no_colour_where_the_console_has_none():
    assert "\x1b" not in printed(build_study())
    assert "\x1b" in printed(build_study(), force_terminal=True, no_color=False)


def test_texts_of_the_site_are_not_markup():
    study = build_study(rows=1)
    object.__setattr__(study.rows[0], "id", "[red]A[/red]\x1b[31m")
    assert "[red]A[/red] [31m" in printed(study)


def test_a_narrow_terminal_breaks_no_number_and_no_word():
    stream = io.StringIO()
    print_summary(build_summary(build_study()), Console(file=stream, width=80))
    text = stream.getvalue()
    for check in (row.governing for row in build_view(build_study()).rows):
        for part in (*check.title.split(), check.demand, check.utilisation):
            assert part in text
    assert "Utilisation" in text


def test_a_pipe_is_as_wide_as_the_table(monkeypatch):
    monkeypatch.delenv("COLUMNS", raising=False)
    assert open_console().width == 160
    monkeypatch.setenv("COLUMNS", "70")
    assert open_console().width == 70
