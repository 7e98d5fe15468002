"""Log of a rewriting, so that no filled cell is lost silently."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass, field

from netdesign.site.cells.findings import quote, shorten
from netdesign.site.columns.office import load_columns
from netdesign.site.readings import Reading, Row
from netdesign.words.message import Message, say

_MOST_PLACES = 3  # named in a line
Line = dict[str, object]  # of the new workbook, by key


@dataclass(frozen=True, slots=True)
class RewriteLog:
    """Log of a rewriting: which cells are ticked off, and what was done with them.

    Attributes
    ----------
    ticked : set of str
        Places of the cells that need no further word.
    done : dict of Message to list of str
        Places of the cells that were changed or left out, by what was done.
    """

    ticked: set[str] = field(default_factory=set)
    done: dict[Message, list[str]] = field(default_factory=dict)

    def tick(self, *readings: Reading) -> None:
        """Tick off cells that stand in the new workbook as they are."""
        self.ticked.update(reading.place for reading in readings)

    def change(self, change: Message, *readings: Reading) -> None:
        """Tick off cells that stand there in another form, and note how."""
        typed = [reading for reading in readings if is_typed(reading)]
        self.tick(*typed)
        if typed:
            self.done.setdefault(change, []).extend(reading.place for reading in typed)

    def leave(self, key: str, *readings: Reading) -> None:
        """Tick off cells that are not copied, and note why."""
        for reading in filter(is_typed, readings):
            self.tick(reading)
            reason = say(key, name=reading.field.name)
            text = quote(reading.cell.text) if reading.cell else ""
            self.done.setdefault(reason, []).append(f"{reading.place} = {text}")

    def leave_rest(self, lines: Iterable[Row]) -> None:
        """Note all cells of a sheet that are not ticked off."""
        for line in lines:
            rest = (
                reading for reading in line.values() if reading.place not in self.ticked
            )
            self.leave("rewrite.left", *rest)

    def list_done(self) -> Iterator[Message]:
        """What was done, each kind once, with its first cells."""
        for change, places in self.done.items():
            distinct = list(dict.fromkeys(places))
            yield say(
                "rewrite.done", how=change, places=shorten(distinct, _MOST_PLACES)
            )


def is_typed(reading: Reading) -> bool:
    """Whether something stands in the cell."""
    return reading.cell is not None and not reading.cell.is_blank


def show(reading: Reading) -> object:
    """Value of a cell in the first unit of its column; as typed if it is none."""
    return reading.text if reading.value is None else reading.value


def copy_line(
    table: str, line: Row, sheet: str, log: RewriteLog, skip: Collection[str] = ()
) -> Line:
    """Copy the cells of a line that a table of the new workbook has, too.

    Parameters
    ----------
    table : str
        Table of the new workbook.
    line, sheet : Row, str
        Line of the old workbook, and its sheet.
    log : RewriteLog
        The cells are ticked off in it.
    skip : collection of str
        Keys of the columns that are left out.
    """
    copied: Line = {}
    for column in load_columns(table):
        key, (place, _, old) = column.field.key, column.like.rpartition(".")
        is_other = place != sheet or old not in line or key in skip
        if is_other or not is_typed(line[old]):
            continue
        log.tick(line[old])
        value = show(line[old])
        is_share = column.unit == "%" or column.choice == "sag_unit"
        if is_share and isinstance(value, float):
            value = round(100.0 * value, 8)
        copied[key] = value
    return copied
