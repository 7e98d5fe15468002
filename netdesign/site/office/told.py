"""What a rewriting did with each cell: nothing that is filled in is lost silently."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from netdesign.site.cells.findings import quote, shorten
from netdesign.site.readings import Reading, Row
from netdesign.words.message import Message, say

_MOST_PLACES = 3  # named in one line


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
        given = [one for one in readings if one.state in ("given", "faulty")]
        self.take(*given)
        if given:
            self.done.setdefault(how, []).extend(one.place for one in given)

    def leave(self, reading: Reading, why: Message) -> None:
        """A cell that has no place there."""
        self.placed.add(reading.place)
        how = say("rewrite.left", name=reading.field.name, why=why)
        self.done.setdefault(how, []).append(_show_cell(reading))

    def empty(self, reading: Reading, why: Message) -> None:
        """A cell of the new workbook that is left empty: its reader refuses it."""
        how = say("rewrite.refused", name=reading.field.name, why=why)
        self.done.setdefault(how, []).append(_show_cell(reading))

    def leave_rest(self, sheet: str, lines: Iterable[Row]) -> None:
        """Cells of a sheet that nobody has placed."""
        for line in lines:
            for reading in line.values():
                is_typed = reading.cell is not None and not reading.cell.is_blank
                if is_typed and reading.place not in self.placed:
                    self.leave(reading, say(f"rewrite.of_{sheet.lower()}"))

    def list_done(self) -> Iterator[Message]:
        """What was done, each kind once, with its first cells."""
        for how, places in self.done.items():
            some = tuple(dict.fromkeys(places))
            listed = shorten(list(some), _MOST_PLACES)
            yield say("rewrite.done", how=how, places=listed)


def _show_cell(reading: Reading) -> str:
    text = reading.cell.text if reading.cell else ""
    return f"{reading.place} = {quote(text)}"


def show(reading: Reading) -> object:
    """Value of a cell in the first unit of its column; as typed if it is none."""
    if reading.state in ("given", "default") and reading.value is not None:
        return reading.value
    return reading.text


def copy_cells(line: Row, keys: Sequence[str], told: Told) -> dict[str, object]:
    """Those cells of a line that are filled in, as they are."""
    found = {key: line[key] for key in keys if line[key].state in ("given", "faulty")}
    told.take(*found.values())
    return {key: show(reading) for key, reading in found.items()}
