"""Tables of items and values, one a line: which item a line names, or what is wrong."""

from __future__ import annotations

import difflib
import re

from netdesign.site.cells.findings import Finding, quote
from netdesign.site.columns.fields import (
    Field,
    Language,
    find_item,
    split_heading,
)
from netdesign.site.readings import Reading, refuse
from netdesign.site.tables import Table
from netdesign.words.message import Message, say

_MARKS = re.compile(r"[;,|:=\t]")  # what may stand between an item and its value


def match_item(
    name: Reading, table: Table, what: str, findings: list[Finding]
) -> Field | None:
    """Item that a line names.

    Parameters
    ----------
    name : Reading
        Cell with the item's name.
    table : Table
        Its plan lists the items.
    what : str
        ``item`` or ``quantity``; for the finding.
    findings : list of Finding
        Appended to, where no item has that name: a line that cannot be read must
        not end as a default.
    """
    items = table.plan.items
    found = find_item(name.word, items)
    if found is None:
        refuse(name, *_explain(name.word, table, what), findings)
    return found


def _explain(text: str, table: Table, what: str) -> tuple[Message, Message]:
    """Rule and what is accepted, with names in the language of the table's headings."""
    start, language = _MARKS.split(text)[0], table.language
    unclear = table.plan.find_unclear(split_heading(start)[0])
    if unclear:
        labels = tuple(_label(one, language) for one in unclear)
        readings = tuple(map(quote, labels))
        return say("heading.ambiguous", readings=readings), say(
            "item.accepted", names=labels
        )
    both = find_item(start, table.plan.items)
    if both and start != text:
        is_item = what == "item"
        rule = say("item.in_one_cell" if is_item else "item.quantity_in_one_cell")
        return rule, say("item.alone", name=quote(_label(both, language)))
    rule = say("item.unknown" if what == "item" else "item.unknown_quantity")
    names = tuple(_label(field, language) for field in table.plan.items)
    near = _find_nearest(start, table.plan.items)
    if near is None:
        return rule, say("item.accepted", names=names)
    return rule, say(
        "item.accepted_near", names=names, near=quote(_label(near, language))
    )


def _label(field: Field, language: Language) -> str:
    return field.heading_for(language)


def _find_nearest(text: str, items: tuple[Field, ...]) -> Field | None:
    """Item with the name most like a text, in whatever language."""
    names = {name: field for field in items for name in field.names}
    key, _ = split_heading(text)
    near = difflib.get_close_matches(key, names, n=1)
    return names[near[0]] if near else None
