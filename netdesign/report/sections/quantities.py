"""Quantities of a site by type: the largest force, how many, how many metres."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from netdesign.report.blocks.block import Part, section
from netdesign.report.blocks.table import (
    Cell,
    Column,
    Table,
    fixed_cell,
    name_columns,
    number_cell,
    text_cell,
)
from netdesign.report.sections.basis import name_rows
from netdesign.report.sections.schedule import (
    build_schedule,
    describe_needed,
    find_largest,
)
from netdesign.report.words import MISSING, Words
from netdesign.structure.members import EndMember, Member
from netdesign.study.parts import PartRecord
from netdesign.study.records import CheckRecord, Study

# What a member is ordered as.
_KINDS: Mapping[str, str] = {
    part: kind
    for kind, parts in {
        "anchor": (
            *(Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR, Member.DOWNHILL_ANCHOR),
            *(EndMember.LATERAL_ANCHOR, EndMember.END_GUY_ANCHOR, "mid_anchor"),
        ),
        "rope": (
            *(Member.UPHILL_GUY, Member.DOWNHILL_GUY, EndMember.END_GUY),
            *("ridge_rope", "lower_rope"),
        ),
        "post": (Member.POST, Member.POST_BASE, Member.POST_FOOT),
        "net": ("net",),
    }.items()
    for part in parts
}
_ORDER = ("anchor", "rope", "post", "net")
PRICES = ("price", "amount")


@dataclass(slots=True)
class _Line:
    """Parts of one type, its net rows and the checks of its forces."""

    parts: list[PartRecord] = field(default_factory=list)
    rows: dict[str, None] = field(default_factory=dict)
    checks: list[CheckRecord] = field(default_factory=list)


def show_schedule(study: Study, words: Words) -> Part:
    """Section with what is built in each row, and what is ordered of each type."""
    return section(
        "schedule",
        words("heading.schedule"),
        build_schedule(study, words).shown("schedule"),
        build_quantities(study, words).shown("schedule quantities"),
    )


def show_quantities(study: Study, words: Words) -> Part:
    """Section with what is ordered of each type alone."""
    table = build_quantities(study, words).shown("schedule quantities")
    return section("quantities", words("quantities.heading"), table)


def build_quantities(study: Study, words: Words, *, has_prices: bool = False) -> Table:
    """Types of all net rows with their largest design force, numbers and metres.

    ``has_prices`` adds empty columns for prices and amounts.
    """
    prices = [words(f"quantities.{one}") for one in PRICES] if has_prices else []
    headings = [words(f"quantities.{one}") for one in ("part", "type", "rows")]
    return Table(
        caption=words("quantities.caption"),
        columns=(
            *name_columns(headings, numbers=()),
            Column(heading="E_d [kN]", is_number=True),
            Column(heading=words("quantities.needed")),
            Column(heading=words("quantities.count"), is_number=True),
            Column(heading=words("quantities.each"), is_number=True),
            Column(heading=words("quantities.total"), is_number=True),
            *name_columns(prices, numbers=prices),
        ),
        rows=tuple(
            (*_show(kind, type_id, line, study, words), *(Cell() for _ in prices))
            for (kind, type_id), line in _gather(study)
        ),
        empty=words("show.none"),
        symbols="headings",
    )


def _gather(study: Study) -> list[tuple[tuple[str, str], _Line]]:
    lines: dict[tuple[str, str], _Line] = {}
    for row in study.rows:
        for part in row.parts:
            line = lines.setdefault((_KINDS[part.part], part.type_id), _Line())
            line.parts.append(part)
            line.rows[row.id] = None
        for check in row.checks:
            key = (_KINDS.get(check.member, ""), check.resistance_type)
            if check.is_of_force and key in lines:
                lines[key].checks.append(check)
    return sorted(lines.items(), key=lambda one: _ORDER.index(one[0][0]))


def _show(
    kind: str, type_id: str, line: _Line, study: Study, words: Words
) -> tuple[Cell, ...]:
    counts = [part.count for part in line.parts]
    sizes = [part.size for part in line.parts]
    pairs = zip(counts, sizes, strict=True)
    products = [
        None if count is None or size is None else count * size for count, size in pairs
    ]
    unit = "m²" if kind == "net" else "m"
    return (
        text_cell(words(f"quantities.{kind}")),
        text_cell(type_id or MISSING),
        text_cell(name_rows(list(line.rows), study, words)),
        number_cell(words, "demand_kN", find_largest(line.checks, "E_d")),
        text_cell(describe_needed(line.checks, words) if line.checks else MISSING),
        text_cell(MISSING) if kind == "net" else _sum(counts, words, 0),
        text_cell(MISSING) if kind == "net" else _show_each(sizes, words),
        _sum(products, words, 0 if kind == "net" else 1, unit),
    )


def _show_each(sizes: Sequence[float | None], words: Words) -> Cell:
    """Length of one, from the shortest to the longest [m]."""
    known = [one for one in sizes if one is not None]
    if not known or len(known) < len(sizes):
        return text_cell(MISSING)
    if max(known) - min(known) < 0.005:
        return fixed_cell(words, known[0], 2)
    low, high = (words.show_fixed(end, 2) for end in (min(known), max(known)))
    return text_cell(f"{low} – {high}")


def _sum(
    values: Iterable[float | None], words: Words, decimals: int, unit: str = ""
) -> Cell:
    """Sum; at least what is known of it, where something is not given."""
    every = list(values)
    known = [one for one in every if one is not None]
    if not known:
        return text_cell(MISSING)
    total = sum(known)
    shown = " ".join(one for one in (words.show_fixed(total, decimals), unit) if one)
    is_whole = len(known) == len(every)
    return Cell(text=shown, number=total) if is_whole else text_cell(f"≥ {shown}")
