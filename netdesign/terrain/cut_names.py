"""Names of columns as a shapefile has them: cut to ten bytes."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from netdesign.site.columns.all_tables import NETS
from netdesign.site.columns.fields import Field, normalise
from netdesign.site.columns.lexicon import Lexicon
from netdesign.words.message import Message, say

_LENGTH = 10  # bytes; a blank at the end is lost, or a letter of two has no room
_DOUBLE = re.compile(r"(.{1,8})_\d{1,2}")  # a second column whose cut name is alike


@dataclass(frozen=True, slots=True, kw_only=True)
class CutNames:
    """Columns that cut names stand for.

    Attributes
    ----------
    full : mapping of str to str
        Heading of sheet Nets by cut name.
    unclear : tuple of Message
        Faults: names that may stand for several headings.
    notes : tuple of Message
        Names that were taken for the one heading that begins so.
    """

    full: Mapping[str, str] = field(default_factory=dict)
    unclear: tuple[Message, ...] = ()
    notes: tuple[Message, ...] = ()


def read_cut_names(names: Sequence[str]) -> CutNames:
    """Headings that cut names stand for: each where one alone begins so.

    A name of ten letters that is a heading may be the beginning of another one, too.
    """
    doubles = {one[1] for one in map(_DOUBLE.fullmatch, names) if one}
    full: dict[str, str] = {}
    unclear: list[Message] = []
    notes: list[Message] = []
    lexicon = Lexicon.of(NETS.fields, NETS)
    for name in names:
        exact, size = lexicon.match(name).field, len(name.encode())
        if size < _LENGTH - 1 or (size < _LENGTH and exact):
            continue
        found = _find_fields(name)
        found |= {exact.key: exact} if exact else {}
        readings = tuple(one.name for one in found.values())
        shown = f"{name!r:.60}"
        heading = next((one.heading_for("en") for one in found.values()), "")
        is_double = name[:8] in doubles or heading in full.values()
        if len(found) > 1 or (found and is_double):
            unclear.append(say("terrain.cut", name=shown, readings=readings))
        elif found and not exact:
            (only,) = found.values()
            full[name] = heading
            notes.append(say("terrain.cut_read", name=shown, heading=only.title))
    return CutNames(full=full, unclear=tuple(unclear), notes=tuple(notes))


def _find_fields(name: str) -> dict[str, Field]:
    """Columns with a heading that begins so."""
    start = normalise(name)
    return {
        one.key: one
        for one in NETS.fields
        if start and any(normalise(own).startswith(start) for own in one.raw_names)
    }
