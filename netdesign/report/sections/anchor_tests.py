"""Pull-out tests of a row's anchors: resistance by each way, and their acceptance."""

from __future__ import annotations

from collections.abc import Iterator

from netdesign.report.blocks.table import (
    Cell,
    Table,
    name_columns,
    number_cell,
    rich_cell,
    text_cell,
)
from netdesign.report.blocks.text import Piece
from netdesign.report.words import MISSING, Words, show_text
from netdesign.study.records import (
    CheckRecord,
    RowStudy,
    SingleTestRecord,
    TestsRecord,
)
from netdesign.words.names import name

_Tested = list[tuple[CheckRecord, TestsRecord, float | None]]


def show_tests(row: RowStudy, words: Words) -> Iterator[Table]:
    """Tables of the anchor types that were tested; none without tests."""
    tested = list(_list_types(row))
    if tested:
        yield _tabulate_routes(tested, words)
    if any(tests.singles for _, tests, _ in tested):
        yield _tabulate_singles(tested, words)


def _list_types(
    row: RowStudy,
) -> Iterator[tuple[CheckRecord, TestsRecord, float | None]]:
    """First check of each tested type, its tests, and the largest design force [kN]."""
    checks: dict[str, list[CheckRecord]] = {}
    for check in row.checks:
        if check.tests is not None:
            checks.setdefault(check.resistance_type, []).append(check)
    for first, *others in checks.values():
        forces = [one.read_band("E_d")[1] for one in (first, *others)]
        known = [one for one in forces if one is not None]
        force = max(known) if len(known) == len(forces) else None
        if first.tests is not None:
            yield first, first.tests, force


def _tabulate_routes(tested: _Tested, words: Words) -> Table:
    routes = list(tested[0][1].routes)
    names = [f"{words.show(name('route', one))}\nR_k [kN]" for one in routes]
    headings = [words("heading.type"), words("tests.number"), *names]
    rows: list[tuple[Cell, ...]] = []
    for check, tests, _ in tested:
        numbers = (
            number_cell(words, "resistance_kN", tests.routes[one]) for one in routes
        )
        kind, count = text_cell(check.resistance_type), text_cell(f"{tests.count}")
        rows.append((kind, count, *numbers))
        remarks = words.join(_list_remarks(tests, words))
        if remarks:
            rows.append((rich_cell((Piece(remarks, "small"),)),))
    counting = words.show(name("route", tested[0][1].route))
    return Table(
        caption=words("tests.by_route", route=counting),
        columns=name_columns(headings, numbers=names),
        rows=tuple(rows),
        symbols="headings",
    )


def _list_remarks(tests: TestsRecord, words: Words) -> Iterator[str]:
    """Lower bounds, and why a way gives no number."""
    held = sum(one.is_held is True for one in tests.singles)
    if held:
        key = "tests.all_held" if held == tests.count else "tests.some_held"
        yield words(key, held=held, count=tests.count)
    for route, reason in tests.reasons.items():
        label = words.show(name("route", route))
        yield words("show.label", label=label, text=words.show(reason))


def _tabulate_singles(tested: _Tested, words: Words) -> Table:
    keys = ("load", "proof", "displacement", "outcome", "wanted", "accepted")
    headings = [words(f"tested.{key}") for key in keys]
    rows = tuple(
        _show_single(check, one, tests.proof_factor, force, words)
        for check, tests, force in tested
        for one in tests.singles
    )
    return Table(
        caption=words("tests.acceptance"),
        columns=name_columns(
            [words("heading.type"), words("tests.cell"), *headings],
            numbers=[headings[0], headings[1], headings[2], headings[4]],
        ),
        rows=rows,
        symbols="headings",
    )


def _show_single(
    check: CheckRecord,
    one: SingleTestRecord,
    factor: float | None,
    force: float | None,
    words: Words,
) -> tuple[Cell, ...]:
    wanted = None if factor is None or force is None else factor * force
    moved = one.displacement_mm
    outcome = {True: "held", False: "pulled", None: "not_said"}[one.is_held]
    return (
        text_cell(check.resistance_type),
        text_cell(show_text(one.cell)),
        number_cell(words, "demand_kN", one.load_kN),
        number_cell(words, "demand_kN", one.proof_load_kN),
        text_cell(MISSING if moved is None else words.write(f"{moved:.1f}")),
        text_cell(words(f"tested.{outcome}")),
        number_cell(words, "demand_kN", wanted),
        text_cell(words(f"tested.{_judge(one, wanted)}")),
    )


def _judge(one: SingleTestRecord, wanted: float | None) -> str:
    """Acceptance of an anchor by its test: yes, no, or open."""
    if one.is_held is False:
        return "no"
    loads = [load for load in (wanted, one.proof_load_kN) if load is not None]
    if loads and one.load_kN < max(loads):
        return "no"
    return "yes" if one.is_held and wanted is not None else "open"
