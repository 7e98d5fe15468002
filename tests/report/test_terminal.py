import io

import pytest
from rich.console import Console

from netdesign.commands.check_run import _print_summaries
from netdesign.report.blocks import write_plain
from netdesign.report.sections.checks import describe_study_scopes
from netdesign.report.sections.rated import ANCHORS, list_anchor, rate, show_rated
from netdesign.report.terminal import Matrix, print_summary
from netdesign.report.words import ENGLISH, VERDICTS, Words
from netdesign.words.catalogue import LANGUAGES
from tests.report.build_study import SCRIPT, build_study

STUDY = build_study()
IDS = ["Couloir 1", "=1+1", f"Ridge {SCRIPT}"]


def printed(study, *, width=160, encoding="utf-8", language="en", **options):
    stream = io.TextIOWrapper(io.BytesIO(), encoding=encoding)
    print_summary(study, Console(file=stream, width=width), language, **options)
    stream.flush()
    return stream.buffer.getvalue().decode(encoding).splitlines()


def list_row_lines(lines):
    """Lines of the net rows, below title and headings."""
    head = next(k for k, line in enumerate(lines) if "n" in line.split())
    return lines[head + 1 : head + 1 + len(STUDY.rows)]


def test_a_line_for_each_net_row_then_what_is_to_be_done_and_the_verdict():
    lines = printed(STUDY)
    rows = list_row_lines(lines)
    for line, row, name in zip(rows, STUDY.rows, IDS, strict=True):
        assert line.startswith(name[:9])
        for group in ANCHORS.values():
            shown = write_plain(show_rated(rate(list_anchor(row, group)), ENGLISH))
            assert " ".join(shown.split()[:2]) in line
    places = {
        one: min(k for k, line in enumerate(lines) if line.startswith(one))
        for one in ("Couloir 1", "Office", "Verdict: FAIL", "Checks: 2 FAIL")
    }
    assert list(places.values()) == sorted(places.values())
    assert "  ".join(lines).count(describe_study_scopes(STUDY, ENGLISH)) == 1


@pytest.mark.parametrize("encoding", ["utf-8", "ascii", "cp1252"])
@pytest.mark.parametrize("width", [80, 100])
@pytest.mark.parametrize("language", LANGUAGES)
def test_every_column_keeps_its_width_and_no_line_is_longer(language, width, encoding):
    lines = printed(STUDY, width=width, encoding=encoding, language=language)
    assert max(map(len, lines)) <= width
    signs = "✓✗?†" if encoding == "utf-8" else "vx?+"
    heads = [*printed(STUDY, width=width, language=language)]
    head = next(line for line in heads if Words(language)("terminal.uphill") in line)
    places = [head.index(Words(language)(f"terminal.{key}")) for key in ANCHORS]
    for line in list_row_lines(lines):
        assert all(line[place - 1] == " " for place in places)
        assert {line[place] for place in places} <= {*signs, "-"}


def test_a_row_is_printed_alone_as_it_is_printed_with_the_others():
    stream = io.StringIO()
    console = Console(file=stream, width=100)
    matrix = Matrix([row.id for row in STUDY.rows], console, ENGLISH)
    for row in reversed(STUDY.rows):
        matrix.print_row(row)
    alone = stream.getvalue().splitlines()
    assert alone[::-1] == list_row_lines(printed(STUDY, width=100))


def test_texts_of_the_site_are_not_markup():
    study = build_study(rows=1)
    object.__setattr__(study.rows[0], "id", "[red]A[/red]\x1b[31m")
    assert any("[red]A[/red] [31m" in line for line in printed(study))


def test_every_verdict_has_a_sign_of_one_column():
    assert {len(one.symbol) for one in VERDICTS.values()} == {1}


def test_of_several_studies_each_stands_below_its_profile(capsys):
    asked = {"explain": False, "scopes": ()}
    _print_summaries([STUDY], asked)
    alone = capsys.readouterr().out
    _print_summaries([STUDY, STUDY], asked)
    headed = f"{STUDY.profile.id}:\n{alone}"
    assert capsys.readouterr().out == 2 * headed
