"""Tables of items and values, one a line: which item a line names, or what is wrong."""

from __future__ import annotations

import difflib
import re

from netdesign.site.cells.findings import Finding, Refusal, quote
from netdesign.site.columns.fields import (
    Field,
    Language,
    find_item,
    split_heading,
)
from netdesign.site.columns.lexicon import UNKNOWN, Lexicon
from netdesign.site.readings import Reading, refuse
from netdesign.site.tables import Table
from netdesign.site.titles import Meaning, Title, is_asked, list_titles, understand
from netdesign.words.message import Message, say

_MARKS = re.compile(r"[;,|:=\t]")  # what may stand between an item and its value


def match_item(
    name: Reading, table: Table, what: str, findings: list[Finding]
) -> Meaning:
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

    Returns
    -------
    Meaning
        Without a field where there is a finding.
    """
    if name.cell is None:
        return Meaning(UNKNOWN)
    lexicon = Lexicon.of(table.plan.items, table.plan)
    meaning = understand(Title(name.cell), lexicon, table.sheet.answers)
    if meaning.is_ignored:
        rule = say("item.ignored", file=table.sheet.answered_in)
        refuse(name, rule, "", findings, severity="note")
    elif meaning.answer and meaning.field:
        file = table.sheet.answered_in
        rule = say("heading.answered", name=meaning.field.name, file=file)
        refuse(name, rule, "", findings, severity="note")
    elif meaning.field is None:
        refuse(name, *_explain(name.word, table, what, meaning), findings)
    return meaning


def refuse_unused_answers(table: Table, key: str, findings: list[Finding]) -> None:
    """Refuse answers to headings and lines that a table of items does not have."""
    cells = [table.cell(row, key) for row in table.rows]
    titles = [Title(cell) for cell in cells if cell is not None and not cell.is_blank]
    titles += list_titles(table.sheet, table.heading_row)
    for one in table.sheet.answers:
        if not any(is_asked(title, one) for title in titles):
            rule = say("heading.unused_answer", file=table.sheet.answered_in)
            findings.append(table.sheet.finding(Refusal(rule, quote(one))))


def _explain(
    text: str, table: Table, what: str, meaning: Meaning
) -> tuple[Message, Message]:
    """Rule and what is accepted, with names in the language of the table's headings."""
    if meaning.is_wrong_answer:
        rule = say("heading.wrong_answer", answer=quote(meaning.answer))
        return rule, say("heading.answer_wanted", file=table.sheet.answered_in)
    start, language = _MARKS.split(text)[0], table.language
    unclear = meaning.match.readings or table.plan.find_unclear(split_heading(start)[0])
    if unclear:
        labels = tuple(_label(one, language) for one in unclear)
        readings, contrary = tuple(map(quote, labels)), meaning.match.contrary
        rule = say("heading.ambiguous", readings=readings)
        if contrary:
            rule = say("heading.contrary", readings=readings, contrary=quote(contrary))
        return rule, say("item.accepted", names=labels)
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
