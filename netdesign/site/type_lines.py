"""Lines of the type sheets as net rows meet them: by ground, with tests and links.

An anchor type may have several lines, each tested or worked out in one ground; a net
row counts with the line of its own ground. Its single pull-out tests are those of sheet
Tests, the chain of links behind it those of sheet Links.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from statistics import fmean

from netdesign.resistance.catalogue import Product
from netdesign.resistance.ground import SingleTest
from netdesign.resistance.products import find_product
from netdesign.resistance.steel import Link
from netdesign.site.cells.findings import Finding, quote
from netdesign.site.columns.fields import from_si
from netdesign.site.lines import Types, refuse_unknown_ids
from netdesign.site.readings import Reading, Row, refuse, refuse_beside, work_out
from netdesign.site.type_resistances import TEST_COLUMNS
from netdesign.words.message import Message, say

_WITH_GROUND = re.compile(r"(.+) \(([^()]*)\)")
_ByGround = dict[str, Row]  # lines of one type, by word of their ground; "" for none


def name_bare(name: str) -> str:
    """Name of a type without the ground that it may be named with."""
    match = _WITH_GROUND.fullmatch(name)
    return match[1] if match else name


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
    rows: Sequence[Row], lines: Sequence[Row], findings: list[Finding]
) -> list[Row]:
    """Rows whose anchors are those of their ground.

    Parameters
    ----------
    rows : sequence of Row
        Net rows, or the cells that name types at their ends.
    lines : sequence of Row
        Of sheet Anchors, as read.
    findings : list of Finding
        Appended to: a type that the row's ground does not have.

    Returns
    -------
    list of Row
        The rows.
    """
    by_id: dict[str, _ByGround] = {}
    for line in lines:
        by_id.setdefault(line["id"].word, {})[line["ground"].word] = line
    placed: list[Row] = []
    for row in rows:
        anchors = {
            key: _resolve(reading, by_id, row["ground"], findings)
            for key, reading in row.items()
            if reading.field.refers_to == "anchor_types"
        }
        placed.append({**row, **anchors})
    return placed


def _resolve(
    type_cell: Reading,
    by_id: Mapping[str, _ByGround],
    ground: Reading,
    findings: list[Finding],
) -> Reading:
    """Cell that names a type, alone or with its ground: "A32 (scree)"."""
    match = _WITH_GROUND.fullmatch(type_cell.word)
    if type_cell.word in by_id or match is None or match[1] not in by_id:
        of_type = by_id.get(type_cell.word)
        return _choose(type_cell, of_type, ground, findings) if of_type else type_cell
    bare = replace(type_cell, value=match[1])
    chosen = _choose(bare, by_id[match[1]], ground, findings)
    if chosen.state == "faulty" or chosen.word == type_cell.word:
        return chosen
    rule = say("nets.other_ground", ground=chosen.word)
    refuse(type_cell, rule, quote(chosen.word), findings)
    return replace(type_cell, state="faulty")


def _choose(
    type_cell: Reading,
    of_type: _ByGround,
    ground: Reading,
    findings: list[Finding],
) -> Reading:
    """Cell that names the line of a type in a ground."""
    word = ground.word
    if len(of_type) > 1 and word in of_type and word:
        line = _rename(of_type[word], of_type[word]["ground"])
        return replace(type_cell, value=line["id"].word)
    (line, *others) = of_type.values()
    if not others and (word in ("", line["ground"].word) or not line["ground"].word):
        return type_cell
    grounds = tuple(
        type_line["ground"].text
        for type_line in of_type.values()
        if type_line["ground"].word
    )
    rule = say("nets.no_ground")
    if word:
        rule = say("nets.other_ground", ground=ground.text)
    refuse(type_cell, rule, say("nets.grounds", grounds=grounds), findings)
    return replace(type_cell, state="faulty")


def count_in_tests(
    lines: Sequence[Row], tests: Sequence[Row], findings: list[Finding]
) -> list[Row]:
    """Lines of sheet Anchors with the tests of their type and ground.

    A type without a ground of its own gets a line for each in which it was tested. A
    test that names no ground stood in that of its type, where the type has one.

    Parameters
    ----------
    lines : sequence of Row
        Of sheet Anchors.
    tests : sequence of Row
        Of sheet Tests.
    findings : list of Finding
        Appended to: a type that is not there, a ground that it does not have, tests
        beside others.
    """
    places = {line["id"].word: line["id"].place for line in lines}
    refuse_unknown_ids((test["type"] for test in tests), places, findings)
    left = _group_tests(lines, tests)
    counted: list[Row] = []
    for line in lines:
        name, own = line["id"].word, line["ground"]
        has_own = bool(own.word) or (name, "") in left
        keys = (
            [(name, own.word)] if has_own else [key for key in left if key[0] == name]
        )
        of_line = [left.pop(key) for key in keys if key in left]
        for of_ground in of_line:
            for reading in (line[key] for key in TEST_COLUMNS):
                if reading.state == "given":
                    refuse_beside(of_ground[0]["force"], reading, findings)
            ground = own if has_own else of_ground[0]["ground"]
            counted.append(_fill_in(line, of_ground, ground))
        if not of_line:
            counted.append(line)
    for (name, word), of_ground in left.items():
        if name not in places:
            continue
        ground = of_ground[0]["ground"]
        if word:
            rule = say("tests.no_line", type=name)
            refuse(ground, rule, say("tests.line_wanted"), findings)
        else:
            cell = of_ground[0]["type" if ground.cell is None else "ground"]
            refuse(cell, say("tests.no_ground"), say("tests.ground_wanted"), findings)
    return counted


def _group_tests(
    lines: Sequence[Row], tests: Sequence[Row]
) -> dict[tuple[str, str], list[Row]]:
    """Tests by type and ground; without one, in the only ground of the type."""
    grounds: dict[str, list[str]] = {}
    for line in lines:
        grounds.setdefault(line["id"].word, []).append(line["ground"].word)
    groups: dict[tuple[str, str], list[Row]] = {}
    for test in tests:
        if test["force"].state == "given":
            name, word = test["type"].word, test["ground"].word
            of_type = grounds.get(name, ())
            (word,) = of_type if not word and len(of_type) == 1 else (word,)
            groups.setdefault((name, word), []).append(test)
    return groups


def _fill_in(line: Row, tests: Sequence[Row], ground: Reading) -> Row:
    """Line with number, least and mean of its tests, and their ground."""
    first, forces = tests[0]["force"], [test["force"].number for test in tests]
    how = say("tests.counted", count=len(tests), place=first.place)
    values = (float(len(forces)), min(forces), fmean(forces))
    counted = {
        key: replace(work_out(first, line[key].field, value, how), text="")
        for key, value in zip(TEST_COLUMNS, values, strict=True)
    }
    singles = tuple(map(_read_single, tests))
    counted["test_count"] = replace(counted["test_count"], singles=singles)
    proven = replace(line["proven"], state="given", value="tests")
    return {**line, **counted, "proven": proven, "ground": ground}


def _read_single(test: Row) -> SingleTest:
    """One test; a result that is not given stays open."""
    words = {"held": True, "pulled out": False}
    return SingleTest(
        load=test["force"].si,
        is_held=words.get(test["result"].word),
        proof_load=test["proof_load"].given_si,
        displacement=test["displacement"].given_si,
        source=test["force"].place,
    )


def fill_in_section(row: Row) -> Row:
    """Line of a post's type with the section that its name means, where none is typed.

    The weaker axis counts, and the wider side against the snow.
    """
    product = find_section(row)
    keys = [key for key in row if row[key].state == "blank"]
    if product is None:
        return row
    how = say("derivation.product", product=product.id, sources=product.sources)
    return {**row, **name_values(row, keys, product, ("post_width",), how)}


def name_values(
    row: Row,
    keys: Sequence[str],
    product: Product,
    largest: Sequence[str],
    how: Message,
) -> dict[str, Reading]:
    """Values that a product gives to columns: the least of each, or the largest."""
    values: dict[str, Reading] = {}
    for key in keys:
        field = row[key].field
        ends = product.list_ends(*field.of_product)
        if not ends:
            continue
        value = max(ends) if key in largest else min(ends)
        reading = replace(row[key], state="given", value=from_si(value, field.unit))
        values[key] = replace(reading, derivation=how, cell=row["id"].cell)
    return values


def find_section(row: Row) -> Product | None:
    """Section that the name of a post's type means."""
    product = find_product(row["id"].word)
    return product if product is not None and product.family == "section" else None


def find_depth(row: Row) -> float:
    """Depth of a post's section in the plane across the row, at most [m].

    By its name; else the width that the snow presses on, or 4 W / A: hollow sections
    have that depth, I-sections less. Theory: resistance/THEORY.md, (R11).
    """
    product = find_section(row)
    if product is not None and "depth" in product.values:
        return max(product.values["depth"][1], row["post_width"].si)
    return max(row["post_width"].si, 4.0 * row["section_modulus"].si / row["area"].si)


_LINKED = ("ropes", "anchor_types")


def read_links(
    lines: Sequence[Row], types: Types, findings: list[Finding]
) -> Mapping[str, tuple[Link, ...]]:
    """Chains of links by type.

    Parameters
    ----------
    lines : sequence of Row
        Of sheet Links, in the order of the chains.
    types : mapping of str to mapping of str to Row
        Lines of the type sheets.
    findings : list of Finding
        Appended to: an unknown type, a link without a force.
    """
    ids = [name for table in _LINKED for name in types[table]]
    chains: dict[str, tuple[Link, ...]] = {}
    for line in lines:
        kinds = [name for name in ids if line["type"].word in (name, name_bare(name))]
        if _is_sound(line, kinds, findings):
            link = _read_link(line)
            chains |= {name: (*chains.get(name, ()), link) for name in kinds}
    return chains


def _is_sound(line: Row, kinds: Sequence[str], findings: list[Finding]) -> bool:
    """A line has no fault; a fault is a finding."""
    if any(reading.state == "faulty" for reading in line.values()):
        return False
    if not kinds:
        sheets = tuple(say(f"sheet.{table}") for table in _LINKED)
        rule = say("nets.no_id", sheet=say("links.sheets", sheets=sheets))
        accepted = say("links.id_of_either", sheets=sheets)
        refuse(line["type"], rule, accepted, findings)
        return False
    force = line["force"]
    if force.state == "blank":
        refuse(force, say("cell.empty"), force.field.accepted, findings)
    return force.state == "given"


def _read_link(line: Row) -> Link:
    """Link of a line; a force of which the meaning is not given is a strength."""
    force, is_limit = line["force"], line["meaning"].word == "limit"
    return Link(
        kind=line["link"].word,
        breaking=None if is_limit else force.given_si,
        limit=force.given_si if is_limit else None,
        count=line["count"].given_count or 1,
        angle=line["angle"].given_si,
        source=force.place,
        is_of_whole=line["chain"].word == "complete",
    )
