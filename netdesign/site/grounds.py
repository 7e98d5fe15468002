"""Anchor types by the ground that a net row stands in.

A type may have several lines, each tested or worked out in one ground; a net row counts
with the line of its own ground.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace

from netdesign.site.cells.findings import Finding, quote
from netdesign.site.readings import Reading, Row, refuse
from netdesign.site.type_resistances import lacks_ground
from netdesign.words.message import say

_ANCHORS = "Anchors"
_WITH_GROUND = re.compile(r"(.+) \(([^()]*)\)")
_ByGround = dict[str, Row]  # lines of one type, by word of their ground; "" for none


def name_bare(name: str) -> str:
    """Name of a type without the ground that it may be named with."""
    whole = _WITH_GROUND.fullmatch(name)
    return whole[1] if whole else name


def name_by_ground(lines: Sequence[Row]) -> list[Row]:
    """Lines of sheet Anchors; a type with several grounds is named with each."""
    ids = [line["id"].word for line in lines]
    return [
        _rename(line, line["ground"])
        if ids.count(line["id"].word) > 1 and line["ground"].state == "given"
        else line
        for line in lines
    ]


def _rename(line: Row, ground: Reading) -> Row:
    name = f"{line['id'].word} ({ground.text.strip()})"
    return {**line, "id": replace(line["id"], value=name), "ground": ground}


def place_in_ground(
    rows: Sequence[Row],
    lines: Sequence[Row],
    grounds: Mapping[str, Reading],
    findings: list[Finding],
) -> tuple[list[Row], list[Row]]:
    """Rows whose anchors are those of their ground, and lines of the types so far.

    Parameters
    ----------
    rows : sequence of Row
        Lines of sheet Nets or Ends.
    lines : sequence of Row
        Of sheet Anchors, as read.
    grounds : mapping of str to Reading
        Ground by net row.
    findings : list of Finding
        Appended to: a type that the row's ground does not have.

    Returns
    -------
    list of Row, list of Row
        The rows; and lines that a type without a ground gets by that of a row, to
        work out its bond.
    """
    by_id: dict[str, _ByGround] = {}
    for line in lines:
        by_id.setdefault(line["id"].word, {})[line["ground"].word] = line
    made: dict[str, Row] = {}
    placed: list[Row] = []
    for row in rows:
        ground = grounds.get(row.get("row", row.get("id")).word)  # type: ignore[union-attr]
        named = {
            key: _resolve(one, by_id, ground, made, findings)
            for key, one in row.items()
            if one.field.refers_to == _ANCHORS
        }
        placed.append({**row, **named})
    return placed, list(made.values())


def _resolve(
    named: Reading,
    by_id: Mapping[str, _ByGround],
    ground: Reading | None,
    made: dict[str, Row],
    findings: list[Finding],
) -> Reading:
    """Cell that names a type, alone or with its ground: "A32 (scree)"."""
    whole = _WITH_GROUND.fullmatch(named.word)
    if named.word in by_id or whole is None or whole[1] not in by_id:
        known = by_id.get(named.word)
        return _choose(named, known, ground, made, findings) if known else named
    bare = replace(named, value=whole[1])
    chosen = _choose(bare, by_id[whole[1]], ground, made, findings)
    if chosen.state == "faulty" or chosen.word == named.word:
        return chosen
    rule = say("nets.other_ground", id=quote(whole[1]), ground=chosen.word)
    refuse(named, rule, quote(chosen.word), findings)
    return replace(named, state="faulty")


def _choose(
    named: Reading,
    of_type: _ByGround,
    ground: Reading | None,
    made: dict[str, Row],
    findings: list[Finding],
) -> Reading:
    """Cell that names the line of a type in a ground."""
    word = ground.word if ground else ""
    if len(of_type) > 1 and word in of_type and word:
        line = _rename(of_type[word], of_type[word]["ground"])
        return replace(named, value=line["id"].word)
    (line, *others) = of_type.values()
    if not others and not line["ground"].word and ground and _has_bond(line):
        line = _rename(line, ground)
        made.setdefault(line["id"].word, line)
        return replace(named, value=line["id"].word)
    if not others and (word in ("", line["ground"].word) or not line["ground"].word):
        return named
    known = tuple(one["ground"].text for one in of_type.values() if one["ground"].word)
    rule = say("nets.other_ground", id=quote(named.word), ground=quote(word))
    if not word:
        rule = say("nets.no_ground", id=quote(named.word))
    elif ground:
        rule = say("nets.other_ground", id=quote(named.word), ground=ground.text)
    refuse(named, rule, say("nets.grounds", grounds=known), findings)
    return replace(named, state="faulty")


def _has_bond(line: Row) -> bool:
    """A bond is to be worked out, once its ground is known."""
    is_open = all(line[key].state == "blank" for key in ("pull_out", "test_count"))
    return is_open and lacks_ground(line)
