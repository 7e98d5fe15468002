import io

from rich.console import Console

from netdesign.commands.check_run import _print_summaries
from netdesign.report.sections.scopes import describe_study_scopes
from netdesign.report.terminal import print_summary
from netdesign.report.words import ENGLISH, show_check
from netdesign.study.scopes import find_governing
from tests.report.build_study import SCRIPT, build_study


def printed(study, *, explain=False, **options):
    stream = io.StringIO()
    console = Console(file=stream, width=160, **options)
    print_summary(study, console, explain=explain)
    return stream.getvalue()


def test_one_line_for_each_net_row_then_the_verdict_and_what_is_open():
    lines = printed(build_study()).splitlines()
    assert [line.split("  ")[0] for line in lines[1:4]] == [
        "Couloir 1",
        "=1+1",
        f"Ridge {SCRIPT}",
    ]
    assert lines[4].startswith("Verdict: FAIL - ")
    assert lines[6] == describe_study_scopes(build_study(), ENGLISH)
    assert lines[7].startswith("Checks: 2 FAIL, 1 NOT PROVEN, ")
    assert lines[7].endswith("Cases: 80 solved, 1 without a result.")
    assert [line.split("  ")[0] for line in lines[8:]] == [
        "Office",
        "Geotechnical engineer",
    ]


def test_texts_of_the_site_are_not_markup():
    study = build_study(rows=1)
    object.__setattr__(study.rows[0], "id", "[red]A[/red]\x1b[31m")
    assert "[red]A[/red] [31m" in printed(study)


def test_a_narrow_terminal_breaks_no_number_and_no_word():
    stream = io.StringIO()
    print_summary(build_study(), Console(file=stream, width=80))
    text = stream.getvalue()
    for row in build_study().rows:
        check = find_governing(row.checks)
        used = ENGLISH.show_number("utilisation", check.used)
        for part in (*show_check(ENGLISH, check).split(", end")[0].split(), used):
            assert part in text
    assert "Structure" in text


def test_of_several_studies_each_stands_below_its_profile(capsys):
    study = build_study()
    _print_summaries([study], explain=False)
    alone = capsys.readouterr().out
    _print_summaries([study, study], explain=False)
    headed = f"{study.profile.id}:\n{alone}"
    assert capsys.readouterr().out == 2 * headed
