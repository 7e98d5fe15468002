"""Anchor schedule: the force that each part of each row is built for, one line each."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from netdesign.report.blocks.table import (
    Cell,
    Column,
    Table,
    name_columns,
    number_cell,
    text_cell,
    text_column,
)
from netdesign.report.words import (
    MISSING,
    Words,
    add_unit,
    append_unit,
    show_member,
)
from netdesign.structure.members import EndMember, NetPart
from netdesign.study.records import CheckRecord, RowStudy, Study, find_input, find_word
from netdesign.words.message import say
from netdesign.words.names import name_mode

_PUSHED = ("post", "post_base")
_END = "edge"
_PER_POST = "schedule.per_post"
_MID_ANCHORS = say("column.Nets.mid_anchors")
_SIDES = ("uphill", "downhill")


def build_schedule(study: Study, words: Words) -> Table:
    """Parts of each row with the forces that they are built for.

    Every force is the upper end of its interval, per anchor, as its check takes it.
    """
    numbers = [
        f"{words(f'heading.{place}')}\n{symbol} [kN]"
        for place in ("inside", "at_end")
        for symbol in ("E_k", "E_d")
    ]
    headings = ("member", "type", "schedule_place", "schedule_force", "directions")
    return Table(
        caption=words("caption.schedule"),
        columns=(
            text_column(words("heading.net_row")),
            *name_columns([words(f"heading.{one}") for one in headings], numbers=()),
            *name_columns(numbers, numbers=numbers),
            Column(heading=add_unit(words("heading.schedule_needed"), "kN")),
        ),
        rows=tuple(line for row in study.rows for line in _list_lines(row, words)),
        empty=words("heading.no_check"),
        symbols="headings",
    )


def _list_lines(row: RowStudy, words: Words) -> Iterator[tuple[Cell, ...]]:
    """Line of each part of a row that a force loads."""
    lines: dict[tuple[str, str, str], list[CheckRecord]] = {}
    for check in row.checks:
        if check.is_of_force:
            place = (check.member, check.resistance_type, _name_force(check))
            lines.setdefault(place, []).append(check)
    for (member, kind, force), checks in lines.items():
        yield (
            text_cell(row.id),
            text_cell(show_member(words, member)),
            text_cell(kind),
            text_cell(_describe_place(row, member, words)),
            text_cell(words(f"schedule.{force}")),
            text_cell(_show_pulls(row, member, words)),
            *_show_forces([one for one in checks if one.position != _END], words),
            *_show_forces([one for one in checks if one.position == _END], words),
            text_cell(describe_needed(checks, words)),
        )


def _describe_place(row: RowStudy, member: str, words: Words) -> str:
    """Number of a part for each post or row end, and where it stands."""
    if member in (*EndMember,):
        return words("schedule.per_end")
    if member in (*NetPart,):
        return words("schedule.along")
    side = next((one for one in _SIDES if member.startswith(one)), None)
    if side is None:
        return words(_name_foot(row) if member == "foot_anchor" else _PER_POST, count=1)
    count = find_input(row, "guy_count")
    if "guy" in member:
        return words(
            "schedule.per_post", count=MISSING if count is None else f"{count:.0f}"
        )
    distance = find_input(row, f"{side}_anchor_distance")
    is_shared = count == 2.0 and find_word(row, "guy_anchors") == "shared"
    return words(
        f"schedule.{'shared' if is_shared else 'per_post'}_{side}",
        count=MISSING if count is None else f"{count:.0f}",
        distance=MISSING if distance is None else words.write(f"{distance:.2f}"),
    )


def _name_foot(row: RowStudy) -> str:
    """Words for the number of foot anchors: there may be one in mid-panel, too."""
    if row.panel is None:
        return _PER_POST
    if _MID_ANCHORS in row.panel.assumed:
        return "schedule.mid_not_given"
    return "schedule.with_mid" if row.panel.has_mid_anchors else _PER_POST


def _name_force(check: CheckRecord) -> str:
    if check.mode == "sliding":
        return "across"
    return "push" if check.member in _PUSHED else "pull"


def _show_pulls(row: RowStudy, member: str, words: Words) -> str:
    """Directions of the pulls on an anchor, from the slope surface."""
    ends = [(x.least_deg, x.largest_deg) for x in row.pulls if x.anchor == member]
    if not ends:
        return MISSING
    low, high = min(x for x, _ in ends), max(x for _, x in ends)
    shown = [words.show_number("least_deg", end) for end in (low, high)]
    is_one = shown[0] == shown[1]
    return append_unit(
        shown[0] if is_one else words.show_band("least_deg", low, high), "°"
    )


def _show_forces(checks: Sequence[CheckRecord], words: Words) -> Iterator[Cell]:
    """Largest characteristic and design force of checks at one place [kN]."""
    for symbol in ("E_k", "E_d"):
        yield number_cell(words, "demand_kN", find_largest(checks, symbol))


def find_largest(checks: Sequence[CheckRecord], symbol: str) -> float | None:
    """Largest upper end of a force of some checks [kN]; None unless all are known."""
    found = [one.read_band(symbol)[1] for one in checks]
    known = [one for one in found if one is not None]
    return max(known) if known and len(known) == len(found) else None


def describe_needed(checks: Sequence[CheckRecord], words: Words) -> str:
    """Least characteristic resistance that carries the design forces, by modes [kN].

    One number where all modes need the same.
    """
    needed: dict[str, float] = {}
    for mode in dict.fromkeys(check.mode for check in checks):
        found = [_find_needed(check) for check in checks if check.mode == mode]
        known = [one for one in found if one is not None]
        if known and len(known) == len(found):
            needed[mode] = max(known)
    shown = {
        words.show(name_mode(mode)): words.show_number("resistance_kN", value)
        for mode, value in needed.items()
    }
    if len(set(shown.values())) == 1:
        return next(iter(shown.values()))
    return words.join(f"{mode} {number}" for mode, number in shown.items())


def _find_needed(check: CheckRecord) -> float | None:
    """R_k at which the utilisation is 1 at its upper end [kN]."""
    _, demand = check.read_band("E_d")
    factor = check.read("γ_R")
    return None if demand is None or factor is None else demand * factor
