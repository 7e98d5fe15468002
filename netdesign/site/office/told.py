"""What a rewriting did with each cell: nothing that is filled in is lost silently."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass, field

from netdesign.site.cells.findings import quote, shorten
from netdesign.site.columns.office import load_columns
from netdesign.site.readings import Reading, Row
from netdesign.words.message import Message, say

_MOST_PLACES = 3  # named in one line
Line = dict[str, object]  # of the new workbook, by key


@dataclass(frozen=True, slots=True)
class Told:
    """Cells that have a place, by their own; what was done with others, by kind."""

    placed: set[str] = field(default_factory=set)
    done: dict[Message, list[str]] = field(default_factory=dict)

    def take(self, *readings: Reading) -> None:
        """Cells that stand in the new workbook as they are."""
        self.placed.update(one.place for one in readings)

    def do(self, how: Message, *readings: Reading) -> None:
        """Cells that stand there in another form."""
        given = [one for one in readings if is_typed(one)]
        self.take(*given)
        if given:
            self.done.setdefault(how, []).extend(one.place for one in given)

    def leave(self, key: str, *readings: Reading) -> None:
        """Cells that are not copied, for a reason."""
        for one in filter(is_typed, readings):
            self.take(one)
            how = say(key, name=one.field.name)
            text = quote(one.cell.text) if one.cell else ""
            self.done.setdefault(how, []).append(f"{one.place} = {text}")

    def leave_rest(self, lines: Iterable[Row]) -> None:
        """Cells of a sheet that have no place."""
        for line in lines:
            rest = (one for one in line.values() if one.place not in self.placed)
            self.leave("rewrite.left", *rest)

    def list_done(self) -> Iterator[Message]:
        """What was done, each kind once, with its first cells."""
        for how, places in self.done.items():
            some = list(dict.fromkeys(places))
            yield say("rewrite.done", how=how, places=shorten(some, _MOST_PLACES))


def is_typed(reading: Reading) -> bool:
    """Something stands in the cell."""
    return reading.cell is not None and not reading.cell.is_blank


def show(reading: Reading) -> object:
    """Value of a cell in the first unit of its column; as typed if it is none."""
    return reading.text if reading.value is None else reading.value


def copy_line(
    table: str, line: Row, sheet: str, told: Told, skip: Collection[str] = ()
) -> Line:
    """Cells of a line that a table of the new workbook has, too.

    Parameters
    ----------
    table : str
        Of the new workbook.
    line, sheet : Row, str
        Of the old one.
    told : Told
        Takes the cells.
    skip : collection of str
        Keys of the columns that are left out.
    """
    copied: Line = {}
    for column in load_columns(table):
        key, (place, _, old) = column.field.key, column.like.rpartition(".")
        is_other = place != sheet or old not in line or key in skip
        if is_other or not is_typed(line[old]):
            continue
        told.take(line[old])
        value = show(line[old])
        is_share = column.unit == "%" or column.choice == "sag_unit"
        if is_share and isinstance(value, float):
            value = round(100.0 * value, 8)
        copied[key] = value
    return copied
