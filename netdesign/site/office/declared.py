"""Sheet Declared of the input workbook: what documents of others prove."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cache

from netdesign.site.columns.fields import normalise
from netdesign.site.declared_sheet import DECLARABLE, OF_ROWS
from netdesign.site.readings import Reading, Row
from netdesign.structure.members import END_ANCHORS, Member
from netdesign.words.catalogue import LANGUAGES, render
from netdesign.words.message import say

_ANCHORS = (
    *(Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR, Member.DOWNHILL_ANCHOR),
    *END_ANCHORS,
)
_OF_GROUND = ("wedge", "cover")
_OF_BASE = ("bearing", "sliding")


def _list_checks(group: str) -> Iterator[tuple[str, str]]:
    """Member and mode of the checks that one word stands for."""
    for member, mode in DECLARABLE:
        is_anchor = member in _ANCHORS and mode != "connection"
        is_of_group = {
            "anchors": is_anchor or (member, mode) == ("net", "anchors"),
            "structure": not is_anchor and member != Member.NET,
            "post base": member == Member.POST_BASE and mode in _OF_BASE,
            "ground at the anchors": mode in _OF_GROUND,
        }
        if is_of_group[group]:
            yield member, mode


GROUPS = ("structure", "anchors", "post base", "ground at the anchors")


def name_group(group: str, language: str = "") -> str:
    """Word for several checks in a language."""
    key = f"choice.check.{normalise(group)}"
    return next(render(say(key), one) for one in LANGUAGES if one == language)


@cache
def _list_groups() -> Mapping[str, str]:
    """Groups by their normalised words in every language."""
    return {
        normalise(name_group(group, language)): group
        for group in GROUPS
        for language in LANGUAGES
    }


def list_declared(lines: Sequence[Row]) -> list[Row]:
    """Lines of sheet Declared: one for each row and check that a line names."""
    return [one for line in lines for one in _spread(line)]


def _spread(line: Row) -> Iterator[Row]:
    check = line["check"]
    group = _list_groups().get(normalise(check.word))
    named = line["row"].word.replace(";", ",").split(",")
    for row in filter(None, map(str.strip, named)):
        own = {**line, "row": replace(line["row"], value=row)}
        if group is None:
            yield own
            continue
        for one in _name_checks(check, group):
            yield {**own, "check": one}


def _name_checks(check: Reading, group: str) -> Iterator[Reading]:
    """Checks of a group, those at the row's end, too, by the ids that all know."""
    for member, mode in _list_checks(group):
        yield replace(check, value=f"{member}.{mode}")
        if (member, mode) not in OF_ROWS:
            yield replace(check, value=f"{member}.{mode}.end")
