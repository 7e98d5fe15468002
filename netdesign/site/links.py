"""Links of sheet Links by the type of rope or anchor that they belong to."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from netdesign.resistance.connection import Link
from netdesign.site.cells.findings import Finding
from netdesign.site.lines import Types, refuse_unknown_ids
from netdesign.site.readings import Row, refuse
from netdesign.words.message import say

_SHEETS = ("Ropes", "Anchors")


def read_links(
    lines: Sequence[Row], types: Types, findings: list[Finding]
) -> Mapping[str, tuple[Link, ...]]:
    """Chains by type.

    Parameters
    ----------
    lines : sequence of Row
        Of sheet Links, in the order of the chains.
    types : mapping of str to mapping of str to Row
        Lines of the type sheets.
    findings : list of Finding
        Appended to: an unknown type, a link with two strengths, or none.
    """
    places = {
        name: line["id"].place
        for sheet in _SHEETS
        for name, line in types[sheet].items()
    }
    refuse_unknown_ids((line["type"] for line in lines), places, findings)
    chains: dict[str, tuple[Link, ...]] = {}
    for line in lines:
        breaking, limit = line["strength"], line["working_limit"]
        if "faulty" in {reading.state for reading in line.values()}:
            continue
        if (breaking.state == "given") is (limit.state == "given"):
            rule = say("links.one_strength", other=limit.field.name)
            seen = breaking if breaking.cell is not None else line["type"]
            refuse(seen, rule, say("accepted.exactly_one"), findings)
            continue
        chains[line["type"].word] = (
            *chains.get(line["type"].word, ()),
            _read_link(line),
        )
    return chains


def _read_link(line: Row) -> Link:
    breaking, limit, count = line["strength"], line["working_limit"], line["count"]
    return Link(
        kind=line["link"].word,
        breaking=breaking.given_si,
        limit=limit.given_si,
        count=int(count.number) if count.state == "given" else 1,
        angle=line["angle"].given_si,
        source=(breaking if breaking.state == "given" else limit).place,
    )
