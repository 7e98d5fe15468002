"""Questions about numbers that can hardly be meant, by the net rows that rest on them.

A net row with an open question is not proven until the number is changed, or confirmed
on sheet Declared.
"""

from __future__ import annotations

import math
import re
from collections import defaultdict
from collections.abc import Collection, Container, Iterator, Mapping, Sequence
from itertools import chain
from statistics import median
from typing import TypeAlias

from netdesign.resistance.catalogue import find_bond_span
from netdesign.resistance.products import find_product
from netdesign.site.cells.findings import Finding, quote
from netdesign.site.columns.fields import from_si
from netdesign.site.declared_sheet import show_value
from netdesign.site.lines import TYPES, Lines
from netdesign.site.readings import Reading, Row, refuse
from netdesign.site.type_lines import find_depth, name_bare
from netdesign.site.type_resistances import (
    find_bond,
    find_proof_limit,
)
from netdesign.words.message import Message, say


def ask_about_numbers(
    lines: Lines, confirmed: Collection[str], findings: list[Finding]
) -> Mapping[str, tuple[Message, ...]]:
    """Open questions of every net row.

    Parameters
    ----------
    lines : Lines
        Of the whole site.
    confirmed : collection of str
        Cells of numbers that are confirmed on sheet Declared.
    findings : list of Finding
        Appended to: each open question once.
    """
    resting, questions = _find_resting(lines), dict[str, Message]()
    for reading, rule in _list_all_doubts(lines):
        place, is_open = reading.place, reading.place not in (*confirmed, *questions)
        if reading.cell is None or not is_open or not resting[place]:
            continue
        sheet, value = say("sheet.Declared"), show_value(reading.cell)
        how = say("plausible.settle", sheet=sheet, place=place, value=value)
        refuse(reading, rule, how, findings, severity="question")
        questions[place] = say(
            "plausible.asked",
            place=place,
            field=reading.field.name,
            text=quote(reading.text),
            rule=rule,
        )
    return {
        row: tuple(
            question for place, question in questions.items() if row in resting[place]
        )
        for row in lines.places
    }


_NOT_OF_ROWS = ("project", "declared")  # whose cells are judged where they are read


def _find_resting(lines: Lines) -> Mapping[str, set[str]]:
    """Net rows that rest on each cell; all of them rest on a cell of sheet Project.

    A row rests on its own line, and on each line that belongs to what its cells name.
    """
    naming: dict[str, set[str]] = defaultdict(set)
    users = [(line, {line["row"].word}) for line in lines.typed["layers"]]
    for line in lines.rows:
        row = line["id"].word
        users.append((line, {row}))
        for reading in (*line.values(), *lines.ends[row].values()):
            if reading.field.refers_to:
                for name in {reading.word, name_bare(reading.word)}:
                    naming[name].add(row)
    typed = (lines.typed[table] for table in ("net_types", "tests", "links"))
    types = (lines.types[table].values() for table in TYPES)
    users.extend(
        (line, naming[line["type" if "type" in line else "id"].word])
        for line in chain.from_iterable((*typed, *types))
    )
    resting: dict[str, set[str]] = defaultdict(lambda: set(lines.places))
    for line, rows in users:
        for reading in line.values():
            resting[reading.place] = resting.get(reading.place, set()) | rows
    return resting


def _list_all_doubts(lines: Lines) -> Iterator[Doubt]:
    """Doubts about all numbers, each line by itself and beside others of its table."""
    for table, typed in lines.typed.items():
        if table not in _NOT_OF_ROWS:
            yield from chain.from_iterable(map(_list_doubted_cells, typed))
    links, tests = lines.typed["links"], lines.typed["tests"]
    limits = [link for link in links if link["force"].field.key != "force"]
    strengths = [link for link in links if link not in limits]
    # the name is empty where columns are not compared from line to line
    groups: list[tuple[str, Sequence[Row]]] = [
        ("rows", lines.rows),
        ("", list(chain.from_iterable(lines.snow.values()))),
        ("", lines.ranges.lines),
        *((table, list(lines.types[table].values())) for table in TYPES),
        *(("links", strengths), ("links", limits), ("tests", tests)),
    ]
    row_lines = (*lines.rows, *lines.ends.values())
    used_ids = {reading.word for line in row_lines for reading in line.values()}
    for table, group in groups:
        used_lines = [
            line for line in group if table not in TYPES or line["id"].word in used_ids
        ]
        yield from chain.from_iterable(map(list_doubts, used_lines))
        yield from list_column_doubts(group, table)


Doubt: TypeAlias = tuple[Reading, Message]

_LEAST_STRUCK = 2  # cells; a longer line is struck out where most of it is
_TOLERANCE = 0.05  # of a value of the catalogue
_LOSS = 0.25  # what corrosion or a termination may take of a force of the catalogue
_FORCES = ("tendon", "rope")
_TESTED_BEYOND = 1.5  # times a bond stress of the catalogue, and as much below
_ANY_GROUND = say("plausible.any_ground")


def list_doubts(line: Row) -> Iterator[Doubt]:
    """Doubts about the numbers of a line, each by itself and beside the others.

    Parameters
    ----------
    line : mapping of str to Reading
        Of any sheet.
    """
    typed = {key: reading for key, reading in line.items() if _is_meant(reading)}
    alone = dict(_list_unlike_product(typed, line))
    for key, reading in typed.items():
        doubt = _doubt_alone(reading)
        if doubt and key not in alone:
            alone[key] = doubt
    for key, reading in typed.items():
        doubt = alone.get(key) or _doubt_beside(reading, line, alone)
        if doubt:
            alone[key] = doubt
            yield reading, doubt
    meant = {key: reading for key, reading in typed.items() if key not in alone}
    yield from _list_eccentric(meant, line)
    if "pull_out" in line:
        yield from _list_pulled(line, alone)


def _list_doubted_cells(line: Row) -> Iterator[Doubt]:
    """Cells with an old result or struck out; of a line struck out the first."""
    typed = [
        (reading, reading.cell.doubt)
        for reading in line.values()
        if reading.cell is not None
        and not reading.cell.is_blank
        and reading.derivation is None
    ]
    doubted = [(reading, doubt) for reading, doubt in typed if doubt is not None]
    struck = [pair for pair in doubted if pair[1].key == "cell.struck"]
    is_line = len(typed) > _LEAST_STRUCK and 2 * len(struck) > len(typed)
    left_out = struck[1:] if is_line else []
    yield from (pair for pair in doubted if pair not in left_out)


def _is_meant(reading: Reading) -> bool:
    """A number is typed, and it is no zero that stands for nothing."""
    says_none = reading.field.zero_says_none and reading.value == 0.0
    return is_typed(reading) and not says_none


def is_typed(reading: Reading) -> bool:
    """A number stands in the cell; it was not worked out from others.

    A slack is that of the sag in its own cell.
    """
    how = reading.derivation
    is_own = how is None or how.key == "office.slack_of_sag"
    return is_own and reading.state == "given" and isinstance(reading.value, float)


def _doubt_alone(reading: Reading) -> Message | None:
    usual = reading.field.usual
    if usual is None or usual.least <= reading.number <= usual.most:
        return None
    return say(
        "plausible.alone",
        number=reading.number,
        low=usual.least,
        high=usual.most,
        unit=reading.field.unit,
        source=say(f"plausible.source_{usual.source}"),
    )


def _doubt_beside(
    reading: Reading, line: Row, doubted: Container[str]
) -> Message | None:
    """Doubt beside other numbers of the line that are not in doubt themselves."""
    for usual in reading.field.beside:
        others = [line[key] for key in usual.powers]
        if any(other.state != "given" or not other.number for other in others):
            continue
        if any(key in doubted for key in usual.powers):
            continue
        scale = math.prod(line[key].si ** power for key, power in usual.powers.items())
        low, high = usual.least * scale, usual.most * scale
        if not low <= reading.si <= high:
            unit = reading.field.unit
            return say(
                "plausible.beside",
                others=tuple(map(_name_with_value, others)),
                low=from_si(low, unit),
                high=from_si(high, unit),
                unit=unit,
            )
    return None


def _doubt_tested(reading: Reading, line: Row) -> Message | None:
    """Doubt about a test that pulls its tendon too far: resistance/THEORY.md, (R32)."""
    limit = find_proof_limit(line, has_loop=False)
    if limit is None or reading.si <= limit * (1.0 + 1e-9):
        return None
    tendon = _name_with_value(line["tendon"])
    return say("plausible.tested", tendon=tendon, limit=limit / 1e3)


def _list_eccentric(typed: Row, line: Row) -> Iterator[Doubt]:
    """Doubt about an eccentricity that helps more than that of an empty cell."""
    reading = typed.get("head_eccentricity")
    needed = ("post_width", "section_modulus", "area")
    if reading is None or any(line[key].state != "given" for key in needed):
        return
    most = 0.5 * find_depth(line)
    if reading.si > most * (1.0 + 1e-9):
        unit = reading.field.unit
        number = from_si(most, unit)
        yield reading, say("plausible.eccentric", number=number, unit=unit)


def _list_pulled(line: Row, doubted: Container[str]) -> Iterator[Doubt]:
    """Doubt about a pull-out force, or the mean of its tests, also of sheet Tests."""
    is_tested = line["proven"].word == "tests"
    has_mean = is_tested and line["test_mean"].state == "given"
    key = "test_mean" if has_mean else "pull_out"
    reading = line[key]
    if reading.state != "given" or key in doubted:
        return
    doubt = _doubt_tested(reading, line) if is_tested else None
    doubt = doubt or _doubt_bond(reading, line, is_tested=is_tested)
    if doubt:
        yield reading, doubt


def _doubt_bond(reading: Reading, line: Row, *, is_tested: bool) -> Message | None:
    """Doubt about a pull-out force beyond what ground holds on the bond, or far below.

    A force from a test may lie further beyond the catalogue than a computed force.
    """
    bond = find_bond(line, reading.si)
    if bond is None:
        return None
    ground = line["ground"]
    low, high = find_bond_span(ground.word)
    room = _TESTED_BEYOND if is_tested else 1.0
    if low / room <= bond <= high * room:
        return None
    return say(
        "plausible.bond",
        bond=bond,
        place=line["bond_length"].place,
        ground=ground.field.name_word(ground.word) if ground.word else _ANY_GROUND,
        low=low,
        high=high,
        source=say("resistance_source.bond"),
    )


def _name_with_value(reading: Reading) -> Message:
    return say(
        "plausible.named",
        name=reading.field.name,
        number=reading.number,
        unit=reading.field.unit,
        place=reading.place,
    )


def _list_unlike_product(
    typed: Mapping[str, Reading], line: Row
) -> Iterator[tuple[str, Message]]:
    """Doubts about numbers that differ from the product that names the type."""
    columns = {
        key: reading.field.of_product
        for key, reading in typed.items()
        if reading.field.of_product
    }
    if not columns:
        return
    product = find_product(line["id"].word)
    if product is None:
        return
    for key, names in columns.items():
        reading = typed[key]
        spans = [product.values[name] for name in names if name in product.values]
        if not spans:
            continue
        if key in _FORCES:  # yield to ultimate
            spans = [(min(low for low, _ in spans), max(high for _, high in spans))]
        loss = _LOSS if key in _FORCES else _TOLERANCE
        if any(
            (1.0 - loss) * low <= reading.si <= (1.0 + _TOLERANCE) * high
            for low, high in spans
        ):
            continue
        unit = reading.field.unit
        shown = tuple(
            _name_span(from_si(low, unit), from_si(high, unit)) for low, high in spans
        )
        yield (
            key,
            say(
                "plausible.unlike",
                product=product.id,
                known=shown,
                unit=unit,
                sources=product.sources,
            ),
        )


def _name_span(low: float, high: float) -> Message:
    if math.isclose(low, high, rel_tol=1e-6):
        return say("plausible.one", number=low)
    return say("plausible.span", low=low, high=high)


_LEAST_LINES = {"rows": 3}  # rows are alike; types are not
_LEAST_OF_TYPES = 5
_BEYOND = 4.0  # times the scatter of a column about its median
_NAME = re.compile(r"^(\D*)(\d+(?:[.,]\d+)?)(.*)$")
# Force over the square of the diameter that a type's name gives [kN/mm2].
_FITS = (0.25, 1.3)
_OTHERS = 2  # types, at least, whose names give a diameter
_DIAMETERS = (10.0, 80.0)  # [mm]
_BY_DIAMETER = {"anchor_types": "tendon", "ropes": "rope"}


def list_column_doubts(lines: Sequence[Row], sheet: str) -> Iterator[Doubt]:
    """Doubts about numbers of a sheet beside others of their column.

    Parameters
    ----------
    lines : sequence of mapping of str to Reading
        All lines of the sheet.
    sheet : str
        Its name in English; empty where numbers differ from line to line.
    """
    keys = lines[0].keys() if lines and sheet else ()
    for key in keys:
        if not lines[0][key].field.scatters:
            least = _LEAST_LINES.get(sheet, _LEAST_OF_TYPES)
            yield from _list_outliers([line[key] for line in lines], least)
    if sheet in _BY_DIAMETER:
        yield from _list_misfits(lines, _BY_DIAMETER[sheet])
    if sheet == "tests":
        yield from _list_repeated_tests(lines)


def _list_repeated_tests(lines: Sequence[Row]) -> Iterator[Doubt]:
    """Doubts about tests that repeat an earlier line: each may be of another anchor."""
    for number, line in enumerate(lines):
        repeated = next(
            (earlier for earlier in lines[:number] if _are_same_test(earlier, line)),
            None,
        )
        if repeated is not None:
            yield (
                line["force"],
                say("plausible.same_line", place=repeated["force"].place),
            )


def _are_same_test(earlier: Row, line: Row) -> bool:
    """Two tests have the same force, and the same values where both give one."""
    pairs = [(earlier[key], reading) for key, reading in line.items()]
    given_pairs = [
        pair for pair in pairs if all(reading.state == "given" for reading in pair)
    ]
    is_known = (earlier["force"], line["force"]) in given_pairs
    return is_known and all(
        first.value == second.value for first, second in given_pairs
    )


def _list_outliers(readings: Sequence[Reading], least: int) -> Iterator[Doubt]:
    """Numbers far off the median of at least so many, by ratio."""
    typed = [
        reading for reading in readings if is_typed(reading) and reading.number > 0.0
    ]
    if len(typed) < least:
        return
    middle = median(reading.number for reading in typed)
    scatter = median(_find_ratio(reading.number, middle) for reading in typed)
    for reading in typed:
        if _find_ratio(reading.number, middle) > _BEYOND * scatter:
            yield (
                reading,
                say(
                    "plausible.outlier",
                    times=reading.number / middle,
                    middle=middle,
                    unit=reading.field.unit,
                    count=len(typed),
                ),
            )


def _find_ratio(first: float, second: float) -> float:
    return max(first / second, second / first)


def _list_misfits(lines: Sequence[Row], key: str) -> Iterator[Doubt]:
    """Forces that do not follow the diameters in the names of their types.

    Numbers are diameters where they fit the forces of all types but one.
    """
    entries = [entry for line in lines if (entry := _read_name(line, key))]
    off = [
        entry
        for entry in entries
        if not _FITS[0] <= entry[2].number / entry[1] ** 2 <= _FITS[1]
    ]
    if len(entries) - len(off) < _OTHERS or len(off) > 1:
        return
    for _, diameter, reading in off:
        yield reading, say("plausible.diameter", diameter=diameter)
    fitting = [entry for entry in entries if entry not in off]
    for stem, diameter, reading in fitting:
        for other_stem, other_diameter, beside in fitting:
            is_smaller = stem == other_stem and diameter < other_diameter
            if is_smaller and reading.number > beside.number:
                yield reading, say("plausible.more", place=beside.place)
                yield beside, say("plausible.less", place=reading.place)


def _read_name(line: Row, key: str) -> tuple[str, float, Reading] | None:
    """Text around the number of a name, the number, and the force of the type."""
    match, reading = _NAME.match(line["id"].word), line[key]
    if match is None or not is_typed(reading):
        return None
    diameter = float(match[2].replace(",", "."))
    if not _DIAMETERS[0] <= diameter <= _DIAMETERS[1]:
        return None
    return f"{match[1]}|{match[3]}", diameter, reading
