"""Links of sheet Links by the type of rope or anchor that they belong to."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from netdesign.resistance.connection import Link
from netdesign.site.cells.findings import Finding
from netdesign.site.grounds import name_bare
from netdesign.site.lines import Types
from netdesign.site.readings import Row, choose_given, refuse
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
    ids = [name for sheet in _SHEETS for name in types[sheet]]
    chains: dict[str, tuple[Link, ...]] = {}
    for line in lines:
        kinds = [one for one in ids if line["type"].word in (one, name_bare(one))]
        if _is_sound(line, kinds, findings):
            link = _read_link(line)
            chains |= {one: (*chains.get(one, ()), link) for one in kinds}
    return chains


def _is_sound(line: Row, kinds: Sequence[str], findings: list[Finding]) -> bool:
    """A line without a fault; others are told."""
    if any(reading.state == "faulty" for reading in line.values()):
        return False
    if not kinds:
        sheets = tuple(say(f"sheet.{sheet}") for sheet in _SHEETS)
        rule = say("nets.no_id", sheet=say("links.sheets", sheets=sheets))
        accepted = say("links.id_of_either", sheets=sheets)
        refuse(line["type"], rule, accepted, findings)
        return False
    return choose_given(line, ("strength", "working_limit"), findings) is not None


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
