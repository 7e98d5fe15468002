"""Anchor schedule: what is drilled, with its forces; what is ordered; its tests."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from netdesign.checks.check import Check, SingleTest
from netdesign.outcome import Verdict
from netdesign.report.blocks import (
    Block,
    Cell,
    Items,
    Paragraph,
    Part,
    Piece,
    Table,
    fixed_cell,
    force_cell,
    given_cell,
    key_columns,
    number_cell,
    section,
    strong,
    symbols,
    text_cell,
)
from netdesign.report.sections.rated import (
    ANCHOR_MEMBERS,
    Rated,
    find_demand,
    list_anchor,
    rate,
    show_answer,
    used_cell,
)
from netdesign.report.words import MISSING, Words, append_unit, show_member, show_text
from netdesign.study.records import RowStudy, Study
from netdesign.words.catalogue import round_force_up

_FLAT_DEG = 10.0  # below the horizontal, of a bore that is hard to fill
_UPRIGHT_DEG = 90.0


@dataclass(frozen=True, slots=True, kw_only=True)
class AnchorLine:
    """Anchors of one type in one place of a row.

    Attributes
    ----------
    demand_kN : float or None
        Largest design force of all cases and supports [kN].
    proof_kN : float or None
        Load of the test that accepts one [kN].
    notes : tuple of str
        Keys of what is to be known of it.
    """

    row: str
    member: str
    type_id: str
    rated: Rated
    demand_kN: float | None
    count: int | None
    length_m: float | None
    dips_deg: tuple[float, ...]
    proof_kN: float | None
    proof_limit_kN: float | None
    notes: tuple[str, ...]


def list_anchors(study: Study) -> Iterator[AnchorLine]:
    """Lines of the schedule, by row, anchor and type."""
    for row in study.rows:
        for member in ANCHOR_MEMBERS:
            checks = list_anchor(row, (member,))
            of_type: dict[str, list[Check]] = {}
            for check in checks:
                if check.is_of_force:
                    of_type.setdefault(check.resistance_type, []).append(check)
            for type_id, forces in of_type.items():
                beside = [check for check in checks if not check.is_of_force]
                rated = rate([*forces, *beside])
                if rated:
                    yield _build_line(row, member, type_id, rated, forces, study)


def _build_line(
    row: RowStudy,
    member: str,
    type_id: str,
    rated: Rated,
    forces: Sequence[Check],
    study: Study,
) -> AnchorLine:
    parts = [
        part for part in row.parts if part.part == member and part.type_id == type_id
    ]
    counts = [part.count for part in parts if part.count is not None]
    pulls = [pull for pull in row.pulls if pull.anchor == member]
    pulled = [force for force in forces if force.mode == "pull_out"]
    proof = _find_proof(pulled, study.profile.proof_factor)
    limits = [x.proof_limit_kN for x in pulled if x.proof_limit_kN is not None]
    dips = tuple(dict.fromkeys(round(pull.dip_deg, 1) for pull in pulls))
    limit = min(limits, default=None)
    count = sum(counts) if counts and len(counts) == len(parts) else None
    return AnchorLine(
        row=row.id,
        member=member,
        type_id=type_id,
        rated=rated,
        demand_kN=find_demand(forces),
        count=count,
        length_m=next((part.size for part in parts if part.size is not None), None),
        dips_deg=dips,
        proof_kN=proof,
        proof_limit_kN=limit,
        notes=(
            *_list_notes(rated, pulled, dips),
            *(("tendon",) if limit is not None and (proof or 0.0) > limit else ()),
            *(("weak",) if type_id in _find_weak(row) else ()),
            *(("uncounted",) if count is None and type_id else ()),
        ),
    )


def _find_proof(pulled: Sequence[Check], factor: float | None) -> float | None:
    """Load of the test: the profile's factor on the upper end of the design force."""
    ends = [x for check in pulled if (x := check.read_band("E_d")[1]) is not None]
    return None if factor is None or not ends else factor * max(ends)


def _find_weak(row: RowStudy) -> set[str]:
    """Types whose tendon bears less than the ground holds: EN 1997-1, 8.5.4."""
    borne: dict[str, dict[str, float]] = {}
    for check in row.checks:
        design = check.read("R_d")
        if check.mode in ("tendon", "pull_out") and design is not None:
            borne.setdefault(check.resistance_type, {})[check.mode] = design
    return {
        kind
        for kind, of in borne.items()
        if of.get("tendon", math.inf) < of.get("pull_out", 0.0)
    }


def _list_notes(
    rated: Rated, pulled: Sequence[Check], dips: Sequence[float]
) -> Iterator[str]:
    """Keys of what is to be known of an anchor, in the order of their letters."""
    if any(dip < _FLAT_DEG for dip in dips):
        yield "flat"
    if any(dip > _UPRIGHT_DEG for dip in dips):
        yield "leans"
    if rated.verdict is Verdict.FAIL:
        yield "fails"
    elif any(check.resistance_kN is None for check in pulled):
        yield "untested"


def show_schedule(study: Study, words: Words) -> Part:
    """Section with the anchors of each row, and what is ordered of each type."""
    lines = list(list_anchors(study))
    letters = _letter_notes(lines)
    notes = tuple(f"{x}: {words(f'anchors.{key}')}" for key, x in letters.items())
    blocks: list[Block] = [
        Paragraph(text=words("anchors.reading"), look="meta"),
        _tabulate(lines, letters, words),
    ]
    if notes:
        blocks.append(Items(items=notes, look="notes-of small"))
    blocks.append(_tabulate_order(lines, study, words))
    return section("schedule", words("heading.schedule"), *blocks, look="sheet")


def _letter_notes(lines: Sequence[AnchorLine]) -> dict[str, str]:
    """Letter of each note that some line has."""
    keys = dict.fromkeys(note for line in lines for note in line.notes)
    return {key: "abcdefgh"[place] for place, key in enumerate(keys)}


_RIGHT = ("count", "demand", "resistance", "guideline", "dip", "length", "proof")


def _tabulate(
    lines: Sequence[AnchorLine], letters: dict[str, str], words: Words
) -> Table:
    keys = ("row", "anchor", "type", *_RIGHT[:3], "used", *_RIGHT[3:], "notes")
    rows, before = [], ""
    for line in lines:
        name, rated = show_text(line.row), line.rated
        demand = force_cell(words, line.demand_kN)
        answer = show_answer(rated, words, has_guide=False)
        rows.append(
            (
                Cell(text=name, content=(Piece("" if line.row == before else name),)),
                text_cell(show_member(words, line.member)),
                text_cell(line.type_id),
                _count_cell(line.count, words),
                replace(demand, content=strong(demand.text)),
                force_cell(words, rated.check.resistance_kN),
                used_cell(rated, words, answer),
                number_cell(words, "utilisation", rated.by_guideline),
                text_cell(show_dips(line.dips_deg, words)),
                fixed_cell(words, line.length_m, 1),
                _proof_cell(line, words),
                Cell(text=" ".join(sorted(letters[key] for key in line.notes))),
            )
        )
        before = line.row
    return Table(
        caption="",
        columns=key_columns(words, "anchors.", keys, numbers=_RIGHT),
        rows=tuple(rows),
        empty=words("heading.no_check"),
        look="schedule cards",
        symbols="headings",
    )


def _count_cell(count: int | None, words: Words) -> Cell:
    return text_cell(MISSING) if count is None else given_cell(words, count)


def show_dips(dips_deg: Sequence[float], words: Words) -> str:
    """Bores below the horizontal; one beyond upright from its other side."""
    if not dips_deg:
        return MISSING
    whole = [180.0 - x if x > _UPRIGHT_DEG else x for x in dips_deg]
    shown = [words.show_fixed(end, 0) for end in (min(whole), max(whole))]
    return append_unit("–".join(dict.fromkeys(shown)), "°")


def _proof_cell(line: AnchorLine, words: Words) -> Cell:
    """Load of its test; none of an anchor that fails, and no more than a tendon has."""
    fails = line.rated.verdict is Verdict.FAIL
    return cap_proof_load(None if fails else line.proof_kN, line.proof_limit_kN, words)


def _tell_tests(check: Check | None, words: Words) -> str:
    """Pull-out tests of a type, with what follows from them."""
    if check is None or check.tests is None:
        return MISSING
    least = words.show_number("resistance_kN", check.tests.least_kN)
    known = words.show_number("resistance_kN", check.read("R_k"))
    count = check.tests.count
    return words("anchors.tested", count=count, least=least, resistance=known)


def _tabulate_order(lines: Sequence[AnchorLine], study: Study, words: Words) -> Table:
    """Types with their numbers, metres and loads; what fails is not ordered."""
    orders: dict[str, list[AnchorLine]] = {}
    for line in lines:
        if line.rated.verdict is not Verdict.FAIL and line.type_id:
            orders.setdefault(line.type_id, []).append(line)
    numbers = ("count", "length", "total", "demand", "proof")
    tested = {
        check.resistance_type: check
        for row in study.rows
        for check in row.checks
        if check.tests is not None
    }
    return Table(
        caption=words("anchors.order"),
        columns=key_columns(
            words, "anchors.", ("type", *numbers, "tests", "rows"), numbers=numbers
        ),
        rows=tuple(
            _show_order(kind, of_type, tested.get(kind), words)
            for kind, of_type in sorted(orders.items())
        ),
        empty=words("show.none"),
        look="order cards",
        symbols="headings",
    )


def _show_order(
    kind: str, of_type: Sequence[AnchorLine], tested: Check | None, words: Words
) -> tuple[Cell, ...]:
    counts = [line.count for line in of_type if line.count is not None]
    count = sum(counts) if len(counts) == len(of_type) else None
    lengths = [line.length_m for line in of_type if line.length_m is not None]
    is_known = count is not None and len(lengths) == len(of_type)
    total = sum((x.count or 0) * (x.length_m or 0.0) for x in of_type)
    demands = [line.demand_kN for line in of_type if line.demand_kN is not None]
    worst = max(of_type, key=lambda line: line.proof_kN or 0.0)
    rows = dict.fromkeys(show_text(line.row) for line in of_type)
    ends = (min(lengths), max(lengths)) if lengths else (None,)
    each = [words.show_fixed(end, 1) for end in ends]
    return (
        text_cell(kind),
        _count_cell(count, words),
        text_cell("–".join(dict.fromkeys(each))),
        fixed_cell(words, total if is_known else None, 0),
        force_cell(words, max(demands, default=None)),
        _proof_cell(worst, words),
        Cell(content=symbols(_tell_tests(tested, words))),
        text_cell(", ".join(rows)),
    )


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
            look="tests cards",
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
        ends = [check.read_band("E_d")[1] for check in checks]
        known = [end for end in ends if end is not None]
        factor, is_whole = study.profile.proof_factor, len(known) == len(ends)
        wanted = factor * max(known) if factor is not None and is_whole else None
        for test in tests.singles if tests else ():
            yield _show_single(checks[0].resistance_type, test, wanted, words)


def _show_single(
    kind: str, test: SingleTest, wanted: float | None, words: Words
) -> tuple[Cell, ...]:
    return (
        text_cell(kind),
        text_cell(test.cell),
        force_cell(words, test.load_kN),
        force_cell(words, test.proof_load_kN),
        text_cell(words.show_fixed(test.displacement_mm, 1)),
        text_cell(words(f"tests.{_OUTCOMES[test.is_held]}")),
        cap_proof_load(wanted, None, words),
        text_cell(words(f"tests.{_judge(test, wanted)}")),
    )


def _judge(test: SingleTest, wanted: float | None) -> str:
    """Acceptance of an anchor by its test: yes, no, or open."""
    if test.is_held is False:
        return "no"
    loads = [load for load in (wanted, test.proof_load_kN) if load is not None]
    if loads and test.load_kN < max(loads):
        return "no"
    return "yes" if test.is_held and wanted is not None else "open"


def cap_proof_load(load: float | None, limit: float | None, words: Words) -> Cell:
    """Load of a test, rounded up [kN]; rounded down where its tendon limits it."""
    if load is None:
        return text_cell(MISSING)
    if limit is not None and load > limit:
        return fixed_cell(words, math.floor(limit), 0)
    return Cell(text=words.show_minimum(load), number=round_force_up(load))
