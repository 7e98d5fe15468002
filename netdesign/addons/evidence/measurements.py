"""Work that is measured, and tables of it: on a terminal, and on pages.

Its clock, repeats in turns, processes, statistics. A *document* is what ``--json``
prints: plain values by key. A key has its name, with unit, in an area of the catalogue;
what has none there is for programs, and not shown.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from statistics import quantiles
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from netdesign.report.blocks import (
    Cell,
    Column,
    Table,
    given_cell,
    number_cell,
    text_cell,
)
from netdesign.report.words import ENGLISH, MISSING
from netdesign.words.catalogue import load_texts

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text

Name = TypeVar("Name", bound=str)
Item = TypeVar("Item")
Result = TypeVar("Result")

_CHUNK = 4  # items that a process takes at once, where they are short


class Clock:
    """Measures what runs within a ``with``; processes that have ended count too.

    Processor time tells of the work even where other programs keep the machine busy.

    Attributes
    ----------
    wall_s, cpu_s : float
        Known at the end [s].
    """

    wall_s: float
    cpu_s: float

    def __enter__(self) -> Clock:
        """Start."""
        self._wall, self._cpu = time.perf_counter(), _read_cpu()
        return self

    def __exit__(self, *_: object) -> None:
        """Stop."""
        self.wall_s = time.perf_counter() - self._wall
        self.cpu_s = _read_cpu() - self._cpu


def _read_cpu() -> float:
    """Processor time of this process and of its ended children [s]."""
    ended = os.times()  # of the children of Windows it knows nothing
    return time.process_time() + ended.children_user + ended.children_system


def measure(work: Callable[[], object]) -> float:
    """Wall time of a piece of work [s]."""
    with Clock() as clock:
        work()
    return clock.wall_s


def run_in_turns(
    works: Mapping[Name, Callable[[], Result]],
    repeats: int,
    on_done: Callable[[object], None] | None = None,
) -> dict[Name, list[Result]]:
    """Results of each work, all repeated in turns: a busy machine slows all of them.

    In every second repeat the last one begins.
    """
    results: dict[Name, list[Result]] = {name: [] for name in works}
    for number in range(repeats):
        for name in list(works)[:: -1 if number % 2 else 1]:
            results[name].append(works[name]())
            if on_done is not None:
                on_done(name)
    return results


def spread(
    work: Callable[[Item], Result],
    items: Sequence[Item],
    *,
    jobs: int = 1,
    chunk: int = _CHUNK,
    on_done: Callable[[Result], object] | None = None,
) -> list[Result]:
    """Results in the order of the items, whatever the processes did.

    A process takes so many items at once. Unlike ``envelope.run`` it does not go on
    after a process has died, but raises: a benchmark is to show that none dies.
    """
    results = []
    for result in _work_through(work, items, jobs, chunk):
        results.append(result)
        if on_done is not None:
            on_done(result)
    return results


def _work_through(
    work: Callable[[Item], Result], items: Sequence[Item], jobs: int, chunk: int
) -> Iterator[Result]:
    if jobs == 1:
        yield from map(work, items)
        return
    # each with one thread of the BLAS: the package has set that in the environment
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
        try:
            yield from pool.map(work, items, chunksize=chunk)
        except BaseException:
            pool.shutdown(wait=True, cancel_futures=True)
            raise


def summarise_times(times: Sequence[float]) -> dict[str, float | None]:
    """Median and 95th percentile [s]; None of fewer than two."""
    if len(times) < 2:
        return {"median_s": None, "p95_s": None}
    parts = quantiles(times, n=20, method="inclusive")
    return {"median_s": parts[9], "p95_s": parts[18]}


def fit_order(sizes: Sequence[float], values: Sequence[float]) -> float:
    """Power p of the best fit values ~ sizes^p, on logarithms [-]."""
    slope, _ = np.polyfit(np.log(sizes), np.log(values), 1)
    return float(slope)


def share(holds: Iterable[bool]) -> float | None:
    """Share of the entries that hold; None without any."""
    answers = list(holds)
    return sum(answers) / len(answers) if answers else None


AREA = "bench_value"
_WIDTH = 58  # of a name before its value
_GAP, _LEAST = 2, 24  # between columns; of the longest texts where there is no room
_DIGITS = {"expected": 5, "got": 5, "error": 2}  # of the others four
_ANSWERS = ("bench.yes", "bench.no")

Row = Mapping[str, Any]


def show_document(document: Row, console: Console) -> None:
    """Print the numbers of a document, then each of its lists of rows as a table."""
    from rich.text import Text

    lists = {key: value for key, value in document.items() if _is_table(value)}
    for key, value in document.items():
        if key not in lists and _is_named(AREA, key):
            line = Text(f"  {ENGLISH(f'{AREA}.{key}'):{_WIDTH}} ")
            console.print(line + _show(key, value, AREA), soft_wrap=True)
    for key, rows in lists.items():
        if rows and _is_named(AREA, key):
            show_lines([ENGLISH(f"{AREA}.{key}")], console)
            show_rows(rows, console)


def show_rows(rows: Sequence[Row], console: Console, area: str = AREA) -> None:
    """Print rows of equal keys as a table, numbers to the right.

    The longest texts alone are broken where there is no room.
    """
    from rich.table import Table
    from rich.text import Text

    table = Table(box=None, pad_edge=False, padding=(0, _GAP, 0, 0))
    keys = [key for key in rows[0] if _is_named(area, key)]
    heads = [Text(ENGLISH(f"{area}.{key}")) for key in keys]
    shown = [[_show(key, row[key], area) for key in keys] for row in rows]
    widths = [
        max(text.cell_len for text in column)
        for column in zip(heads, *shown, strict=True)
    ]
    longest = max(range(len(keys)), key=widths.__getitem__)
    for number, (key, head) in enumerate(zip(keys, heads, strict=True)):
        is_text = any(isinstance(row[key], str) for row in rows)
        table.add_column(
            head,
            justify="left" if is_text else "right",
            overflow="fold",
            min_width=min(widths[number], _LEAST)
            if number == longest
            else widths[number],
        )
    for row in shown:
        table.add_row(*row)
    # numbers are never cut: on a narrow terminal lines go on below
    needed = sum(widths) - max(0, widths[longest] - _LEAST) + _GAP * len(keys)
    console.print(table, width=max(console.width, needed), crop=False)


def show_lines(lines: Iterable[str], console: Console) -> None:
    """Print lines as they are."""
    for line in lines:
        console.print(line, highlight=False, markup=False, soft_wrap=True)


def _show(key: str, value: object, area: str) -> Text:
    from rich.text import Text

    if isinstance(value, bool) and key == "pass":
        good, bad = (
            ENGLISH(f"verify_table.{answer}") for answer in ("passes", "fails")
        )
        return Text(good, "green") if value else Text(bad, "bold red")
    return Text(_write(key, value, area))


def _write(key: str, value: object, area: str) -> str:
    """Value on one line: a number to four digits, parts one after the other."""
    if isinstance(value, Mapping):
        named = [(name, part) for name, part in value.items() if _is_named(area, name)]
        return ENGLISH.join(
            f"{ENGLISH(f'{area}.{name}')} {_write(name, part, area)}"
            for name, part in named
        )
    if isinstance(value, list):
        return ENGLISH.join(_write(key, part, area) for part in value) or MISSING
    if isinstance(value, bool):
        return ENGLISH(_ANSWERS[not value])
    if isinstance(value, float):
        return f"{value:.{_DIGITS.get(key, 4)}g}"
    if value is None:
        return MISSING
    return _name(value) if isinstance(value, str) else str(value)


def _name(text: str) -> str:
    """Word of the program by its key; what others wrote, as it is."""
    key = f"bench_word.{text.replace(' ', '_')}"
    return ENGLISH(key) if key in load_texts("en") else text


def _is_named(area: str, key: str) -> bool:
    return f"{area}.{key}" in load_texts("en")


def _is_table(value: object) -> bool:
    return isinstance(value, list) and all(isinstance(row, Mapping) for row in value)


FORCE = "foot_size_kN_per_m"


@dataclass(frozen=True, slots=True, kw_only=True)
class Kind:
    """Kind of a column: how a value becomes a cell, and the quantity of its numbers."""

    show: Callable[[Any], Cell]
    quantity: str = ""
    is_number: bool = True


def tabulate(
    caption: str,
    columns: Sequence[tuple[str, Kind]],
    rows: Iterable[Sequence[object]],
) -> Table:
    """Table of rows of plain values; a heading, or its key, is enough."""
    texts = load_texts("en")
    return Table(
        caption=caption,
        columns=tuple(
            Column(
                heading=ENGLISH(heading) if heading in texts else heading,
                quantity=kind.quantity,
                is_number=kind.is_number,
            )
            for heading, kind in columns
        ),
        rows=tuple(
            tuple(
                kind.show(value) for (_, kind), value in zip(columns, row, strict=True)
            )
            for row in rows
        ),
    )


def kilo(value: float | None) -> float | None:
    """Value in thousands; None stays."""
    return None if value is None else value / 1e3


def _show_time(value: float | None) -> Cell:
    """Three significant digits without a power of ten."""
    if value is None:
        return Cell(text=MISSING)
    shown = float(f"{value:.3g}")
    return Cell(text=f"{shown:.10g}", number=value)


def _show_change(share: float | None) -> Cell:
    percent = None if share is None else 100.0 * share
    return number_cell(ENGLISH, "change_percent", percent)


FORCES = Kind(
    show=lambda value: number_cell(ENGLISH, FORCE, kilo(value)), quantity=FORCE
)
ERRORS = Kind(
    show=lambda value: number_cell(ENGLISH, "error_kN_per_m", kilo(value)),
    quantity="error_kN_per_m",
)
CHANGES = Kind(show=_show_change, quantity="change_percent")
INCLINATIONS = Kind(
    show=lambda value: given_cell(ENGLISH, value), quantity="inclination_deg"
)
TIMES = Kind(show=_show_time)
TEXTS = Kind(show=text_cell, is_number=False)
# The ends of a range.
RANGES = Kind(
    show=lambda ends: text_cell(
        ENGLISH("show.band", low=f"{ends[0]:.0f}", high=f"{ends[1]:.0f}")
    )
)
NUMBER_TEXTS = Kind(show=text_cell)  # set as numbers are
