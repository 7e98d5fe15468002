"""Slips of the pen in a workbook: one number is altered, and who notices it.

Altered are all numbers that a verdict rests on: times and by 10, 100 and 1000, taken
for the number beside or below it, the heading's unit taken for the next one.
"""

from collections import Counter
from dataclasses import dataclass, replace
from functools import cache, lru_cache

import pytest

from netdesign.checks import load_standard
from netdesign.outcome import SiteDataError, Verdict
from netdesign.site import reader
from netdesign.site.office.sheets import find_office_tables
from netdesign.site.reader import read_cells, read_site
from netdesign.solving import workers
from netdesign.solving.solve import solve_scene
from netdesign.study.judge import judge_site
from tests.grid import solve_site
from tests.make import write_site
from tests.site.plausible.office import ROWS, draw_office
from tests.small_site import RUN

TABLES = ("project", "rows", "net_types", "anchor_types", "ropes", "posts")
FACTORS = {
    "times 10": 10.0,
    "times 100": 100.0,
    "times 1000": 1000.0,
    "by 10": 0.1,
    "by 100": 0.01,
    "by 1000": 0.001,
}


@dataclass(frozen=True)
class Slip:
    kind: str
    place: str
    instead: dict[str, str]


def list_numbers(path):
    """Cells with numbers, table by table: by line number and column."""
    found = find_office_tables(read_cells(path), [])
    for name in TABLES:
        table = found.tables[name]
        if table is None:
            continue
        yield {
            (number, reading.cell.column): reading.cell
            for number, line in zip(table.rows, found.lines[name], strict=True)
            for reading in line.values()
            if reading.cell is not None and isinstance(reading.cell.value, int | float)
        }


def list_slips(path):
    for numbers in list_numbers(path):
        columns = sorted({column for _, column in numbers})
        for (row, column), cell in numbers.items():
            for kind, factor in FACTORS.items() if cell.value else ():
                text = f"{cell.value * factor:.10g}"
                yield Slip(kind, cell.place, {cell.place: text})
            later = columns[columns.index(column) + 1 :][:1]
            beside = numbers.get((row, later[0])) if later else None
            below = numbers.get((row + 1, column))
            for kind, other in (("column", beside), ("line", below)):
                if other is not None and other.text != cell.text:
                    swapped = {cell.place: other.text, other.place: cell.text}
                    yield Slip(f"swapped with the next {kind}", cell.place, swapped)


def is_noticed(path, slip, known):
    """Whether reading says a word; ``known`` are those on the sound workbook."""
    try:
        site = read_site(path, instead=slip.instead)
    except SiteDataError:
        return True
    return any(str(one) not in known for one in site.findings)


def list_known(path):
    return {str(one) for one in read_site(path).findings}


def is_asked(path, slip):
    try:
        return bool(read_site(path, instead=slip.instead).questions)
    except SiteDataError:
        return True


pytestmark = pytest.mark.long
MOST, MOST_BETTER = 0.05, 0.005
LIKE = "swapped with the next line"
SNOW_AND_N = {"Rows!C", "Rows!D"}
RANK = {Verdict.FAIL: 0, Verdict.NOT_PROVEN: 0, Verdict.DECLARED: 1, Verdict.PASS: 2}


@pytest.fixture(scope="module")
def measure(tmp_path_factory):
    """All slips of a list, and those that are read without a word."""
    folder = tmp_path_factory.mktemp("slips")

    @cache
    def measure_one(seed, rows=8):
        tables = draw_office(seed, rows=rows)
        path = write_site(folder / f"{seed}-{rows}.xlsx", tables)
        known, slips = list_known(path), list(list_slips(path))
        return path, slips, [one for one in slips if not is_noticed(path, one, known)]

    with pytest.MonkeyPatch.context() as patch:  # what stays the same is made once
        patch.setattr(reader, "read_cells", lru_cache(reader.read_cells))
        patch.setattr(workers, "solve_scene", cache(solve_scene))
        yield measure_one


def test_few_slips_are_read_without_a_word(measure):
    kinds, unnoticed = Counter(), Counter()
    for seed in (3, 5, 7):
        _, slips, unread = measure(seed)
        kinds.update(one.kind for one in slips)
        unnoticed.update(one.kind for one in unread)
    table = {kind: f"{unnoticed[kind]} of {kinds[kind]}" for kind in kinds}
    assert kinds.total() > 2000
    told = unnoticed.total() - unnoticed[LIKE]
    assert told <= MOST * kinds.total(), table
    by_ten = sum(unnoticed[kind] for kind in FACTORS)
    assert by_ten <= MOST_BETTER * sum(kinds[kind] for kind in FACTORS), table


def test_slips_by_ten_are_noticed_in_fewer_rows_than_a_median_needs(measure):
    """Asked for or refused: a note would not do."""
    silent, count = [], 0
    for seed in range(3):
        path, slips, _ = measure(seed, ROWS)
        of_ten = [one for one in slips if one.kind in ("times 10", "by 10")]
        silent += [one for one in of_ten if not is_asked(path, one)]
        count += len(of_ten)
    assert len(silent) <= 0.01 * count, silent


def judge(site):
    """Rows of the study by their ids."""
    standard = load_standard("nf-p-95-304-style")
    study = judge_site(site, solve_site(site, RUN), standard, RUN)
    return {row.id: row for row in study.rows}


def take_changed(site, sound):
    """Site of the rows that are not as they were: the others are judged as before."""
    if site.ranges != sound.ranges:
        return site
    same = {row.id: row for row in sound.rows}
    return replace(
        site, rows=tuple(row for row in site.rows if row != same.get(row.id))
    )


def is_better(rows, before):
    """A verdict is better, or a utilisation lower by more than its interval."""
    for row in rows.values():
        old = before[row.id]
        if RANK[row.verdict] > RANK[old.verdict]:
            return True
        known = {one.id: one for one in old.checks}
        for check in row.checks:
            was = known.get(check.id)
            if was is None or None in (check.utilisation, was.utilisation):
                continue
            low, high = was.utilisation_band
            if check.utilisation < was.utilisation - (high - low):
                return True
    return False


def test_no_slip_that_is_read_without_a_word_helps(measure):
    """But for numbers that nothing tells apart, and one of which gains by it.

    Those of like rows; snow height [m] and N of a row, which stand side by side.
    """
    path, slips, unread = measure(3)
    sound = read_site(path)
    before, better = judge(sound), []
    for slip in unread:
        site = take_changed(read_site(path, instead=slip.instead), sound)
        if is_better(judge(site), before):
            better.append(slip)
    told = [one for one in better if one.kind != LIKE and not is_snow_for_n(one)]
    assert len(told) <= MOST_BETTER * len(slips), told


def is_snow_for_n(slip):
    return {place.rstrip("0123456789") for place in slip.instead} == SNOW_AND_N
