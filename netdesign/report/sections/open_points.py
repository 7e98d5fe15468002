"""Lines to be done and conditions of a study, each with its net rows, in words."""

from __future__ import annotations

from netdesign.report.sections.basis import name_rows
from netdesign.report.words import Words, show_text
from netdesign.study.records import Study
from netdesign.study.to_do import ToDo
from netdesign.words.names import name


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
