"""Study -> the summary that a terminal shows."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import groupby

from netdesign.outcome import Verdict
from netdesign.report.gate import require_consistent
from netdesign.report.governing import SEVERITY, find_governing, rank_check
from netdesign.report.sections.basis import (
    describe_floor,
    has_other_floor,
    list_notes,
    name_cases,
)
from netdesign.report.sections.changes import list_changes
from netdesign.report.sections.checks import describe_briefly, describe_loads, name_case
from netdesign.report.sections.decision import list_open_points
from netdesign.report.sections.verify import describe_cases
from netdesign.report.terminal import Headings, RowLine, Summary
from netdesign.report.what_if import mark_verdict
from netdesign.report.words import (
    MISSING,
    Words,
    show_check,
    show_text,
    show_verdict,
)
from netdesign.structure.members import CARRYING_MEMBERS
from netdesign.study.records import CheckRecord, RowStudy, Study
from netdesign.words.catalogue import Language
from netdesign.words.names import name_check

_FEW_IDS = 3  # net rows that one line names


def build_summary(
    study: Study, language: Language = "en", *, explain: bool = False
) -> Summary:
    """Summary of a study in a language.

    Parameters
    ----------
    study : Study
        What was found.
    language : str
        Of the summary.
    explain : bool
        Whether to say all that is open, the loads, and what would turn each check.

    Raises
    ------
    NetDesignError
        If the study contradicts its own numbers.
    """
    require_consistent(study)
    words = Words(language)
    verdict = mark_verdict(study, words)
    further = tuple(_explain(study, words)) if explain else ()
    return Summary(
        headings=Headings(
            row=words("heading.net_row"),
            verdict=words("heading.verdict"),
            check=words("heading.governing_check"),
            utilisation=words("heading.utilisation"),
            reason=words("heading.reason"),
        ),
        rows=tuple(_fold([_show_row(row, words) for row in study.rows])),
        mark=words("what_if.mark") if study.what_if else "",
        lines=tuple(_list_lines(study, words, is_short=not explain)),
        overall=words("show.overall", verdict=""),
        verdict=verdict.word,
        style=verdict.style,
        meaning=verdict.meaning,
        changes=further,
    )


def _fold(lines: Sequence[RowLine]) -> Iterator[RowLine]:
    """Lines of the terminal; those that say the same without a number are one."""
    for _, group in groupby(lines, key=_tell_alike):
        first, *others = group
        ids = [first.id, *(one.id for one in others)]
        few = len(ids) <= _FEW_IDS
        name = ", ".join(ids) if few else f"{ids[0]} … {ids[-1]} ({len(ids)})"
        yield replace(first, id=name)


def _tell_alike(line: RowLine) -> tuple[str, ...]:
    """Things that lines in one must share; of one with a number its own name."""
    own = "" if line.utilisation == MISSING and line.reason else line.id
    return own, line.verdict, line.check, line.reason


def _show_row(row: RowStudy, words: Words) -> RowLine:
    check, verdict = find_governing(row.checks), show_verdict(row.verdict, words)
    return RowLine(
        id=show_text(row.id),
        verdict=verdict.word,
        style=verdict.style,
        check=_name_governing(check, words) if check else words("heading.no_check"),
        utilisation=words.show_number("utilisation", check.used) if check else MISSING,
        reason=describe_briefly(row, words),
    )


def _name_governing(check: CheckRecord, words: Words) -> str:
    """Check with its place, where that is the end of the row."""
    named = words.show(name_check(check.member, check.mode))
    is_of_end = check.position == "edge" and check.member in CARRYING_MEMBERS
    return words("check.of_end", check=named) if is_of_end else named


def _list_lines(study: Study, words: Words, *, is_short: bool) -> Iterator[str]:
    """Counts, and what is open."""
    verdicts = [check.verdict for row in study.rows for check in row.checks]
    checks = _count_verdicts(verdicts, words)
    yield words("show.counts", checks=checks, cases=describe_cases(study, words))
    if has_other_floor(study):
        floor = words("heading.floor")
        yield words("show.label", label=floor, text=describe_floor(study, words))
    points = list(list_open_points(study, words))
    if is_short:
        yield words("show.more_points", count=len(points))
        return
    for number, point in enumerate(points, 1):
        yield words("show.open_point", number=number, point=point)


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
    """Loads of the governing checks, reasons, notes, and what turns each check."""
    yield name_cases(study, words)
    for row in study.rows:
        check = find_governing(row.checks)
        if check and (loads := describe_loads(check, words)):
            place = f"{show_text(row.id)}, {show_check(words, check)}"
            told = words.join([name_case(check, words), loads])
            yield words("show.label", label=place, text=told)
        for reason in row.reasons:
            text = words.show(reason)
            yield words("show.label", label=show_text(row.id), text=text)
    floor = describe_floor(study, words)
    yield words("show.label", label=words("heading.floor"), text=floor)
    for note in list_notes(study, words):
        yield words("show.note", note=note)
    yield from list_changes(
        [
            (row.id, check)
            for row in study.rows
            for check in sorted(row.checks, key=rank_check)
        ],
        words,
    )
