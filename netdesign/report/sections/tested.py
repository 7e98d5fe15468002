"""Pull-out tests, each with its acceptance by the design force of all rows."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from netdesign.checks.check import Check, SingleTest
from netdesign.report.blocks import (
    Cell,
    Table,
    fixed_cell,
    force_cell,
    key_columns,
    text_cell,
)
from netdesign.report.words import MISSING, Words
from netdesign.study.records import Study
from netdesign.words.catalogue import round_force_up

_OUTCOMES = {True: "held", False: "pulled", None: "not_said"}


def show_tests(study: Study, words: Words) -> Iterator[Table]:
    """Table of the single tests of all anchor types; none where only sums are given.

    The order list has their number and what follows from them.
    """
    lines = tuple(_list_lines(study, words))
    numbers = ("load", "proof", "moved", "wanted")
    keys = ("type", "cell", *numbers[:3], "outcome", "wanted", "accepted")
    if lines:
        yield Table(
            caption=words("tests.caption"),
            columns=key_columns(words, "tests.", keys, numbers=numbers),
            rows=lines,
            look="tests",
            symbols="headings",
        )


def _list_lines(study: Study, words: Words) -> Iterator[tuple[Cell, ...]]:
    of_type: dict[str, list[Check]] = {}
    for row in study.rows:
        for check in row.checks:
            if check.tests is not None:
                of_type.setdefault(check.resistance_type, []).append(check)
    for checks in of_type.values():
        tests = checks[0].tests
        ends = [one.read_band("E_d")[1] for one in checks]
        known = [one for one in ends if one is not None]
        whole = tests is not None and len(known) == len(ends)
        factor = tests.proof_factor if tests and whole else None
        wanted = None if factor is None else factor * max(known)
        for one in tests.singles if tests else ():
            yield _show_single(checks, one, wanted, words)


def _show_single(
    checks: Sequence[Check], one: SingleTest, wanted: float | None, words: Words
) -> tuple[Cell, ...]:
    limits = [x.proof_limit_kN for x in checks if x.proof_limit_kN is not None]
    return (
        text_cell(checks[0].resistance_type),
        text_cell(one.cell),
        force_cell(words, one.load_kN),
        force_cell(words, one.proof_load_kN),
        text_cell(words.show_fixed(one.displacement_mm, 1)),
        text_cell(words(f"tests.{_OUTCOMES[one.is_held]}")),
        cap_proof_load(wanted, min(limits, default=None), words),
        text_cell(words(f"tests.{_judge(one, wanted)}")),
    )


def _judge(one: SingleTest, wanted: float | None) -> str:
    """Acceptance of an anchor by its test: yes, no, or open."""
    if one.is_held is False:
        return "no"
    loads = [load for load in (wanted, one.proof_load_kN) if load is not None]
    if loads and one.load_kN < max(loads):
        return "no"
    return "yes" if one.is_held and wanted is not None else "open"


def cap_proof_load(load: float | None, limit: float | None, words: Words) -> Cell:
    """Load of a test, rounded up [kN]; rounded down where its tendon limits it."""
    if load is None:
        return text_cell(MISSING)
    if limit is not None and load > limit:
        return fixed_cell(words, math.floor(limit), 0)
    return Cell(text=words.show_minimum(load), number=round_force_up(load))
