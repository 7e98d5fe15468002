"""Study -> a terminal: a line for each net row, the verdict, and what is open."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterable, Iterator
from itertools import groupby
from typing import TYPE_CHECKING

from netdesign.outcome import SEVERITY, Verdict
from netdesign.report.console import print_lines
from netdesign.report.sections.additions import list_additions
from netdesign.report.sections.basis import (
    describe_cases,
    describe_floor,
    has_other_floor,
    list_notes,
    name_cases,
)
from netdesign.report.sections.checks import (
    describe_briefly,
    describe_loads,
    list_changes,
    name_case,
)
from netdesign.report.sections.open_points import (
    list_conditions,
    show_line,
)
from netdesign.report.sections.scopes import (
    describe_study_scopes,
    list_exceeding,
    list_headings,
    show_scope,
)
from netdesign.report.what_if import mark_verdict
from netdesign.report.words import (
    VerdictWords,
    Words,
    show_check,
    show_text,
)
from netdesign.study.records import RowStudy, Study
from netdesign.study.scopes import SCOPES, find_governing
from netdesign.study.to_do import MOST_LINES, WHO, list_to_do
from netdesign.words.catalogue import Language
from netdesign.words.names import name

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

_NUMBER = re.compile(r"\d")
_FEW_IDS = 3  # net rows that one line names
_STYLES = {
    "pass": "green",
    "fail": "bold red",
    "not-proven": "yellow",
    "declared": "cyan",
}
# Id of a net row, scopes with their styles, governing check, reason.
RowLine = tuple[str, tuple[tuple[str, str], ...], str, str]


def print_summary(
    study: Study,
    console: Console,
    language: Language = "en",
    *,
    explain: bool = False,
    scopes: Collection[str] = (),
) -> None:
    """Print one line per net row, the verdict, what is open, and explanations.

    Colour, width and destination are those of ``console``; texts of the site
    are never read as markup.

    Parameters
    ----------
    study : Study
        What was found.
    console : rich.console.Console
        Where it is printed.
    language : str
        Of the summary.
    explain : bool
        Whether to say all that is open, the loads, and what would turn each check.
    scopes : collection of str
        Those that are asked for; none for all.
    """
    from rich.text import Text

    words = Words(language)
    verdict = mark_verdict(study, words)
    if study.what_if:
        console.print(Text(words("what_if.mark"), style="bold"), soft_wrap=True)
    if study.rows:
        console.print(_build_table(study, words))
    overall = Text(words("show.overall", verdict="")).append_text(_word(verdict))
    console.print(overall.append(f" - {verdict.meaning}"), soft_wrap=True)
    if study.rows:
        print_lines(_list_scopes(study, words, scopes), console)
    lines = _list_lines(study, words, is_short=not explain)
    print_lines(lines, console)
    if explain:
        print_lines(_explain(study, words), console)


def _build_table(study: Study, words: Words) -> Table:
    from rich.table import Table
    from rich.text import Text

    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column(words("heading.net_row"), overflow="fold", min_width=4)
    for heading in list_headings(words):
        table.add_column(heading, no_wrap=True)
    table.add_column(words("heading.governing_check"), overflow="fold", min_width=13)
    table.add_column(words("heading.reason"), overflow="fold")
    for row, scopes, *texts in list_rows(study, words):
        cells = [Text(text, style=_STYLES[style]) for text, style in scopes]
        table.add_row(Text(row), *cells, *map(Text, texts))
    return table


def _list_scopes(study: Study, words: Words, asked: Collection[str]) -> Iterator[str]:
    """Anchors, structure and siting of all rows; what the symbols are."""
    yield words("scopes.legend")
    yield describe_study_scopes(study, words)
    if asked:
        named = tuple(words(f"of_scope.{one}") for one in asked)
        verdict = words(f"verdict.{study.find_verdict(asked)}")
        yield words("scopes.asked", scopes=named, verdict=verdict)
    yield from list_exceeding(study, words)


def _word(verdict: VerdictWords) -> Text:
    from rich.text import Text

    return Text(verdict.word, style=_STYLES[verdict.style])


def list_rows(study: Study, words: Words) -> Iterator[RowLine]:
    """Lines of the net rows; those that say the same without a number are one."""
    lines = [_show_row(row, words) for row in study.rows]
    for _, group in groupby(lines, key=_tell_alike):
        first, *others = group
        ids = [first[0], *(one[0] for one in others)]
        few = len(ids) <= _FEW_IDS
        name = ", ".join(ids) if few else f"{ids[0]} … {ids[-1]} ({len(ids)})"
        yield (name, *first[1:])


def _tell_alike(line: RowLine) -> tuple[object, ...]:
    """Things that lines in one must share; of one with a number its own name."""
    name, scopes, check, reason = line
    has_number = any(_NUMBER.search(text) for text, _ in scopes)
    return "" if reason and not has_number else name, scopes, check, reason


def _show_row(row: RowStudy, words: Words) -> RowLine:
    check = find_governing(row.checks)
    return (
        show_text(row.id),
        tuple(show_scope(row, scope, words) for scope in SCOPES),
        show_check(words, check) if check else words("heading.no_check"),
        describe_briefly(row, words),
    )


def _list_lines(study: Study, words: Words, *, is_short: bool) -> Iterator[str]:
    """Counts, and what is open."""
    verdicts = [check.verdict for row in study.rows for check in row.checks]
    checks = _count_verdicts(verdicts, words)
    yield words("show.counts", checks=checks, cases=describe_cases(study, words))
    if has_other_floor(study):
        floor = words("heading.floor")
        yield words("show.label", label=floor, text=describe_floor(study, words))
    for one in list_additions(study):
        yield from one.list_lines(study, words)
    yield from _list_to_do(study, words, MOST_LINES if is_short else None)
    yield from list_conditions(study, words)
    yield from list_exceeding(study, words)


def _list_to_do(study: Study, words: Words, most: int | None) -> Iterator[str]:
    """What is to be done, by who has it: his name before his first line."""
    lines = list_to_do(study, most)
    names = {who: words.show(name("who", who)) for who in WHO}
    width = max((len(names[one.who]) for one in lines), default=0)
    for who in WHO:
        named = names[who]
        for one in lines:
            if one.who == who:
                yield f"{named:{width}}  {show_line(one, study, words)}"
                named = ""


def _count_verdicts(verdicts: Iterable[Verdict], words: Words) -> str:
    """Numbers of verdicts, the worst first: ``1 FAIL, 4 PASS``."""
    counts = Counter(verdicts)
    shown = [
        words(
            "show.count_verdict",
            count=counts[verdict],
            verdict=words(f"verdict.{verdict}"),
        )
        for verdict in SEVERITY
        if counts[verdict]
    ]
    return ", ".join(shown) or words("show.none")


def _explain(study: Study, words: Words) -> Iterator[str]:
    """Loads of the governing checks, notes, and what turns each check."""
    yield name_cases(study, words)
    for row in study.rows:
        check = find_governing(row.checks)
        if check and (loads := describe_loads(check, words)):
            place = f"{show_text(row.id)}, {show_check(words, check)}"
            told = words.join([name_case(check, words), loads])
            yield words("show.label", label=place, text=told)
    floor = describe_floor(study, words)
    yield words("show.label", label=words("heading.floor"), text=floor)
    for note in list_notes(study, words):
        yield words("show.note", note=note)
    yield from list_changes(
        [
            (row.id, check)
            for row in study.rows
            for check in sorted(row.checks, key=lambda one: one.rank)
        ],
        words,
    )
