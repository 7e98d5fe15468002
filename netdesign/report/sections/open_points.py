"""Everything that is open of a study, for ``--explain`` and the workbook."""

from __future__ import annotations

from collections.abc import Iterator

from netdesign.checks.check import Check
from netdesign.outcome import Verdict
from netdesign.report.sections.basis import (
    count_assumed,
    describe_floor,
    has_other_floor,
    label_rows,
    list_defaults,
    name_rows,
)
from netdesign.report.sections.checks import (
    describe_cause,
    list_flips,
    name_checks,
    name_few,
)
from netdesign.report.sections.scopes import list_exceeding
from netdesign.report.words import Words, show_member, show_text
from netdesign.study.records import Study
from netdesign.study.to_do import ToDo
from netdesign.words.names import name

_FLAT_DEG = 10.0  # below the horizontal, of a bore that is hard to fill


def list_open_points(study: Study, words: Words) -> Iterator[str]:
    """Points to settle before the report can be signed, the worst first."""
    yield from _list_open_checks(study, Verdict.FAIL, words)
    yield from _list_open_checks(study, Verdict.NOT_PROVEN, words)
    yield from _list_open_rows(study, words)
    yield from _list_declared(study, words)
    yield from list_exceeding(study, words)
    if has_other_floor(study):
        floor = words("heading.floor")
        yield words("show.label", label=floor, text=describe_floor(study, words))
    for topic in study.profile.not_checked:
        who = words(f"scope.{topic}_by")
        yield words("todo.not_checked", what=words(f"scope.{topic}"), who=who)
    assumed, count = count_assumed(study)
    if assumed:
        yield words("todo.unconfirmed", assumed=assumed, count=count)
    panels = [row.id for row in study.rows if row.panel and row.panel.assumed]
    if panels:
        yield words("todo.panels", rows=name_rows(panels, study, words))
    yield from _list_rising(study, words)
    defaults = len(list_defaults(study, words))
    if defaults:
        yield words("todo.defaults", count=defaults)


def _list_rising(study: Study, words: Words) -> Iterator[str]:
    """Anchors whose boreholes are so flat that mortar may run out of them."""
    rising = [
        (row.id, show_member(words, one.anchor))
        for row in study.rows
        for one in row.pulls
        if one.dip_deg < _FLAT_DEG - 1e-9
    ]
    if rising:
        ids, anchors = (list(dict.fromkeys(one)) for one in zip(*rising, strict=True))
        named = show_text(name_rows(ids, study, words))
        yield words("todo.rising", anchors=words.join(anchors), rows=named)


def _list_open_checks(study: Study, verdict: Verdict, words: Words) -> Iterator[str]:
    """Checks of one verdict; checks with one cause, and rows alike, share a point."""
    points: dict[tuple[str, str], list[str]] = {}
    for row in study.rows:
        causes: dict[str, list[Check]] = {}
        for check in row.checks:
            if check.verdict is verdict:
                is_by_force = check.is_of_force and verdict is Verdict.FAIL
                told = (
                    words("todo.fail") if is_by_force else describe_cause(check, words)
                )
                causes.setdefault(told, []).append(check)
        for cause, checks in causes.items():
            told = _add_change(checks, cause, words)
            points.setdefault((name_few(checks, words), told), []).append(row.id)
    for (named, told), ids in points.items():
        place = f"{show_text(name_rows(ids, study, words))}, {named}"
        yield words("show.label", label=place, text=told)


def _add_change(checks: list[Check], cause: str, words: Words) -> str:
    """Cause of a point; of a single check with what makes it pass."""
    flips = list_flips(checks[0], words) if len(checks) == 1 else ()
    return words("todo.with_change", what=cause, change=flips[0]) if flips else cause


def _list_open_rows(study: Study, words: Words) -> Iterator[str]:
    """Laws that rows do not meet; those that rows share are told once."""
    rows: dict[str, list[str]] = {}
    for row in study.rows:
        for reason in row.unmet:
            rows.setdefault(words.show(reason), []).append(row.id)
    yield from label_rows(rows, study, words)


def _list_declared(study: Study, words: Words) -> Iterator[str]:
    """Documents that are said to prove checks, each with the checks."""
    found: dict[tuple[str, str], list[Check]] = {}
    for row in study.rows:
        for check in row.checks:
            if check.declared and check.verdict is Verdict.DECLARED:
                proof = words.show(check.declared.describe())
                found.setdefault((show_text(row.id), proof), []).append(check)
    for (row_id, proof), checks in found.items():
        place = f"{row_id}, {name_checks(checks, words)}"
        yield words("todo.declared", checks=place, proof=proof)


def show_line(line: ToDo, study: Study, words: Words) -> str:
    """What is to be done, after the net rows that need it."""
    rows = show_text(name_rows(list(line.rows), study, words))
    return words("to_do.line", rows=rows, text=words.show(line.text))


def list_conditions(study: Study, words: Words) -> list[str]:
    """What has to hold beside the checks, by who sees to it and for which rows."""
    shared: dict[tuple[str, tuple[str, ...]], list[str]] = {}
    for condition in study.conditions:
        key = (condition.who, tuple(condition.rows))
        shared.setdefault(key, []).append(words.show(condition.message))
    return [
        words(
            "condition.line",
            who=words.show(name("who", who)),
            rows=show_text(name_rows(rows, study, words)),
            text=words.join(texts),
        )
        for (who, rows), texts in shared.items()
    ]
