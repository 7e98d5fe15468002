"""Sheet "Schedule": forces of each part; what is ordered of each type."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from netdesign.checks.check import Check
from netdesign.report.blocks import (
    Cell,
    Column,
    Table,
    fixed_cell,
    key_columns,
    name_columns,
    number_cell,
    text_cell,
)
from netdesign.report.sections.basis import name_rows
from netdesign.report.sections.tested import show_proof_load
from netdesign.report.words import (
    MISSING,
    Words,
    add_unit,
    append_unit,
    show_member,
)
from netdesign.structure.members import EndMember, Member, NetPart
from netdesign.study.parts import PartRecord
from netdesign.study.records import RowStudy, Study, find_input, find_word
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
    headings = (
        *("member", "type", "schedule_place", "schedule_force"),
        *("directions", "schedule_dip"),
    )
    return Table(
        caption=words("caption.schedule"),
        columns=(
            Column(heading=words("heading.net_row")),
            *key_columns(words, "heading.", headings),
            *name_columns(numbers, numbers=numbers),
            Column(heading=add_unit(words("heading.schedule_needed"), "kN")),
        ),
        rows=tuple(line for row in study.rows for line in _list_lines(row, words)),
        empty=words("heading.no_check"),
        symbols="headings",
    )


def _list_lines(row: RowStudy, words: Words) -> Iterator[tuple[Cell, ...]]:
    """Line of each part of a row that a force loads."""
    lines: dict[tuple[str, str, str], list[Check]] = {}
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
            text_cell(_show_dips(row, member, words)),
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


def _name_force(check: Check) -> str:
    if check.mode == "sliding":
        return "across"
    return "push" if check.member in _PUSHED else "pull"


def _show_pulls(row: RowStudy, member: str, words: Words) -> str:
    """Directions of the pulls on an anchor, from the slope surface."""
    pulls = [one for one in row.pulls if one.anchor == member]
    return _show_span(
        [x for one in pulls for x in (one.least_deg, one.largest_deg)], words
    )


def _show_dips(row: RowStudy, member: str, words: Words) -> str:
    """Dip of an anchor's borehole below the horizontal; negative where it rises."""
    pulls = [one for one in row.pulls if one.anchor == member]
    return _show_span([one.dip_deg for one in pulls], words)


def _show_span(angles: Sequence[float], words: Words) -> str:
    """Least and largest of some angles [deg]; one where both look alike."""
    if not angles:
        return MISSING
    low, high = min(angles), max(angles)
    shown = [words.show_number("least_deg", end) for end in (low, high)]
    is_one = shown[0] == shown[1]
    return append_unit(
        shown[0] if is_one else words.show_band("least_deg", low, high), "°"
    )


def _show_forces(checks: Sequence[Check], words: Words) -> Iterator[Cell]:
    """Largest characteristic and design force of checks at one place [kN]."""
    for symbol in ("E_k", "E_d"):
        yield number_cell(words, "demand_kN", find_largest(checks, symbol))


def find_largest(checks: Sequence[Check], symbol: str) -> float | None:
    """Largest upper end of a force of some checks [kN]; None unless all are known."""
    return _find_most(one.read_band(symbol)[1] for one in checks)


def _find_most(values: Iterable[float | None]) -> float | None:
    """Largest of some values; None unless all are known."""
    every = list(values)
    known = [one for one in every if one is not None]
    return max(known) if known and len(known) == len(every) else None


def describe_needed(checks: Sequence[Check], words: Words) -> str:
    """Least characteristic resistance that carries the design forces, by modes [kN].

    One number where all modes need the same. What the head of a rope anchor needs is
    told by its check: it takes a part of the force.
    """
    shown: dict[str, str] = {}
    for mode in dict.fromkeys(x.mode for x in checks if x.mode != "direction"):
        most = _find_most(_find_needed(check) for check in checks if check.mode == mode)
        if most is not None:
            shown[words.show(name_mode(mode))] = words.show_minimum(most)
    if len(set(shown.values())) == 1:
        return next(iter(shown.values()))
    return words.join(f"{mode} {number}" for mode, number in shown.items())


def _find_needed(check: Check) -> float | None:
    """R_k at which the utilisation is 1 at its upper end [kN]."""
    _, demand = check.read_band("E_d")
    factor = check.read("γ_R")
    return None if demand is None or factor is None else demand * factor


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
    checks: list[Check] = field(default_factory=list)


def build_quantities(study: Study, words: Words, *, has_prices: bool = False) -> Table:
    """Types of all net rows with their largest design force, numbers and metres.

    ``has_prices`` adds empty columns for prices and amounts.
    """
    prices = PRICES if has_prices else ()
    counts = ("count", "each", "total")
    return Table(
        caption=words("quantities.caption"),
        columns=(
            *key_columns(words, "quantities.", ("part", "type", "rows")),
            Column(heading="E_d [kN]", is_number=True),
            *key_columns(words, "quantities.", ("proof",), numbers=("proof",)),
            *key_columns(words, "quantities.", counts, numbers=counts),
            *key_columns(words, "quantities.", prices, numbers=prices),
            Column(heading=words("quantities.needed")),
        ),
        rows=tuple(
            (
                *_show(kind, type_id, line, study, words),
                *(Cell() for _ in prices),
                text_cell(describe_needed(line.checks, words) or MISSING),
            )
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
        _show_proof(line, study.profile.proof_factor, words),
        text_cell(MISSING) if kind == "net" else _sum(counts, words, 0),
        text_cell(MISSING) if kind == "net" else _show_each(sizes, words),
        _sum(products, words, 0 if kind == "net" else 1, unit),
    )


def _show_proof(line: _Line, factor: float | None, words: Words) -> Cell:
    """Load to which a test of the type proves it in all its net rows [kN]."""
    pulled = [one for one in line.checks if one.mode == "pull_out"]
    force = find_largest(pulled, "E_d")
    load = None if factor is None or force is None else factor * force
    return show_proof_load(load, pulled, words)


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
