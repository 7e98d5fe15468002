"""Checks in words and cells; what would make one pass, and limits of single values."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from netdesign.checks.check import Change, Check
from netdesign.outcome import SEVERITY, Verdict
from netdesign.report.blocks import (
    Badge,
    Block,
    Cell,
    Content,
    Items,
    Paragraph,
    Piece,
    Sketch,
)
from netdesign.report.words import (
    MISSING,
    Words,
    append_unit,
    show_check,
    show_text,
    show_verdict,
)
from netdesign.study.governing import (
    find_governing,
    is_far_from_limit,
)
from netdesign.study.records import RowStudy
from netdesign.words.message import Message, say
from netdesign.words.names import name, name_check, name_mode

_OVER, _BELOW = "#b23a1e", "#7d838b"  # of a bar: beyond utilisation 1, and below
_BAR_UNIT = 100.0  # length of a bar at utilisation 1
_BAR_BEYOND = 50.0  # length that is left for all above 1
_FEW = 4  # checks that share a reason and are named
# Key of a gap: the row lacks more inputs than a check names.


def badge_cell(verdict: Verdict, words: Words) -> Cell:
    """Symbol and word of a verdict."""
    return Cell(content=(Badge(show_verdict(verdict, words)),))


def describe_resistance(check: Check, words: Words) -> str:
    """Type, basis and cell of a resistance: ``GEWI 28, tested, Anchors!E7``."""
    basis = check.resistance_basis
    parts = (
        check.resistance_type,
        words.show(name("basis", basis)) if basis else "",
        check.resistance_cell,
    )
    return show_text(", ".join(part for part in parts if part))


def name_case(check: Check, words: Words, *, is_short: bool = False) -> str:
    """Case that brings the demand: of the ranges, or the guideline's load case."""
    if check.governs == "maker":
        return words("load_name.maker")
    if check.governs != "guideline":
        show = words.name_case_short if is_short else words.name_case
        return show(check.case)
    named = show_text(words.show(name("load_case", check.load_case)))
    inclination = words.show_with_unit("inclination_deg", check.load_inclination_deg)
    return f"{named}, θ {inclination}"


def show_used(check: Check, words: Words, *, with_interval: bool = True) -> Content:
    """Utilisation with its interval where both ends differ in print, and its bar."""
    low, high = check.used_band
    used = Piece(words.show_number("utilisation", check.used), "ratio")
    if low is None or high is None or check.used is None:
        return (used,)
    ends = [words.show_number("utilisation", one) for one in (low, high)]
    band = f" ({words.show_band('utilisation', low, high)})"
    bar = _draw_bar(low, check.used, high)
    is_shown = with_interval and ends[0] != ends[1]
    return (used, Piece(band, "band"), bar) if is_shown else (used, bar)


def _draw_bar(low: float, value: float, high: float) -> Sketch:
    """Ratio bar: the utilisation, its interval in white, and a mark at 1."""
    start, end, last = (f"{_measure_bar(one):.1f}" for one in (low, value, high))
    return Sketch(
        '<svg class="bar" viewBox="0 0 150 12" preserveAspectRatio="xMinYMid" '
        'aria-hidden="true"><path stroke="#e9ecef" stroke-width="6" d="M0 6h150"/>'
        f'<path stroke="{_OVER if value > 1 else _BELOW}" stroke-width="6" '
        f'd="M0 6h{end}"/>'
        f'<path stroke="#fff" stroke-width="2" d="M{start} 6H{last}"/>'
        '<path stroke="#1b1e22" stroke-width="1.5" d="M100 0v12"/></svg>'
    )


def _measure_bar(ratio: float) -> float:
    """Length of a bar: in proportion up to 1, then ever slower, so that 9 is no 1.5."""
    if ratio <= 1.0:
        return _BAR_UNIT * ratio
    return _BAR_UNIT + _BAR_BEYOND * (1.0 - 1.0 / ratio)


def describe_loads(check: Check, words: Words) -> str:
    """Characteristic force by each load, the one that governs first; "" of one alone.

    Solved ones at most: with their error and what may hide between cases.
    """
    found = {}
    letters = dict(zip(_LOADS, "cptgm", strict=True))
    for load, letter in letters.items():
        symbol = check.name_force(letter)
        _, force = check.read_band(symbol)
        if force is not None:
            shown = words.show_with_unit("max_kN", force)
            found[load] = words(f"load_force.{load}", force=shown)
    if len(found) < 2:
        return ""
    order = sorted(found, key=lambda load: load != check.governs)
    return words.join(found[load] for load in order)


def describe_briefly(row: RowStudy, words: Words) -> str:
    """Reason of a row's verdict in some ten words; "" of a pass."""
    check = find_governing(row.checks)
    if row.verdict is Verdict.PASS:
        return ""
    if check is None or check.verdict is not row.verdict:
        return words.show(row.reasons[0]) if row.reasons else words("todo.row_open")
    if check.verdict is Verdict.DECLARED and check.declared:
        return show_text(check.declared.document)
    gaps = [_leave_out_cell(one) for one in check.gaps]
    if gaps and check.verdict is not Verdict.FAIL:
        return words.join(words.show(one) for one in gaps)
    return describe_cause(check, words)


def _leave_out_cell(told: Message) -> Message:
    """The same without the cells that it names."""
    if told.key == "check.of_cell" and isinstance(told.arguments["what"], Message):
        return _leave_out_cell(told.arguments["what"])
    inner = {
        name: _leave_out_cell(one) if isinstance(one, Message) else one
        for name, one in told.arguments.items()
    }
    return say(told.key, **inner)


def describe_cause(check: Check, words: Words) -> str:
    """Cause that keeps a check from passing, without what its numbers say already."""
    has_numbers = check.is_of_force and not check.is_unbounded
    if check.verdict is Verdict.FAIL and has_numbers and check.demand_kN is not None:
        demand, resistance = _show_apart(check.demand_kN, check.resistance_kN, words)
        return words("show.exceeds", demand=demand, resistance=resistance)
    if check.gaps:
        return words.join(map(words.show, check.gaps))
    return words.show(check.told)


def _show_apart(
    demand: float, resistance: float | None, words: Words
) -> tuple[str, str]:
    """Both forces in kN; with two more digits where they would read the same."""
    forces = {"demand_kN": demand, "resistance_kN": resistance}
    shown = [words.show_number(key, force) for key, force in forces.items()]
    if shown[0] == shown[1]:
        shown = [words.show_digits(force) for force in forces.values()]
    first, second = (append_unit(one, "kN") for one in shown)
    return first, second


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckLine:
    """One resistance with its check inside the row and at its end; one may lack."""

    inside: Check | None
    end: Check | None

    @property
    def checks(self) -> list[Check]:
        """Checks of the line, inside first."""
        return [one for one in (self.inside, self.end) if one is not None]

    @property
    def verdict(self) -> Verdict:
        """The worse verdict of both."""
        return min((one.verdict for one in self.checks), key=SEVERITY.index)

    @property
    def demands(self) -> tuple[object, ...]:
        """Member, type and design forces, which several modes may share."""
        forces = (one.demand_kN if one else None for one in (self.inside, self.end))
        first = self.checks[0]
        return (first.member, first.resistance_type, *forces)

    def name(self, words: Words) -> str:
        """Member and mode; of places the second support alone, which has a line."""
        first = self.checks[0]
        position = first.position if first.position == "second" else ""
        return words.show(name_check(first.member, first.mode, position))

    def describe(self, words: Words) -> str:
        """Mode, design resistance, and utilisations inside the row and at its end."""
        first = self.checks[0]
        mode = words.show(name_mode(first.mode))
        resistance = words.show_number("resistance_kN", first.resistance_kN)
        used = " / ".join(
            words.show_number("utilisation", one.used) if one else MISSING
            for one in (self.inside, self.end)
        )
        return f"{mode} {resistance}, {used}"

    def list_remarks(self, words: Words) -> list[str]:
        """Reasons that say more than the numbers; once where both places share it."""
        told = {
            one.position == "edge": _tell_beside(one, words)
            for one in self.checks
            if one.open or one.gaps
        }
        shown = list(dict.fromkeys(told.values()))
        if len(self.checks) == 1 or (len(told) > 1 and len(shown) == 1):
            return shown
        places = {False: words("heading.inside"), True: words("heading.at_end")}
        return [
            words("show.label", label=places[is_end], text=text)
            for is_end, text in told.items()
        ]


def list_lines(checks: Sequence[Check]) -> Iterator[CheckLine]:
    """Checks of forces, in their order; those of one resistance share a line."""
    places: dict[tuple[object, ...], list[Check]] = {}
    for check in checks:
        if check.is_of_force:
            places.setdefault(_name_resistance(check), []).append(check)
    for together in places.values():
        # one inside and one at the end belong together; more never share a line
        pair = [one for one in together if one.position != "second"]
        is_pair = [one.position == "edge" for one in pair] == [False, True]
        alone = [one for one in together if not is_pair or one not in pair]
        for group in [*([pair] if is_pair else []), *([one] for one in alone)]:
            shown = {one.position == "edge": one for one in group}
            yield CheckLine(inside=shown.get(False), end=shown.get(True))


def part_lines(
    lines: Sequence[CheckLine],
) -> tuple[list[CheckLine], dict[str, list[CheckLine]]]:
    """Lines that stand alone, and by member those that are told beside them.

    Of the modes of one design force the most used stands alone, and each that says more
    than its numbers.
    """
    groups: dict[tuple[object, ...], list[CheckLine]] = {}
    for line in lines:
        groups.setdefault(line.demands, []).append(line)
    leading = {id(min(group, key=_rank_line)) for group in groups.values()}
    alone: list[CheckLine] = []
    beside: dict[str, list[CheckLine]] = {}
    for line in lines:
        if id(line) in leading or line.verdict is not Verdict.PASS:
            alone.append(line)
        else:
            beside.setdefault(line.checks[0].member, []).append(line)
    return alone, beside


def _rank_line(line: CheckLine) -> tuple[int, bool, float]:
    return min(one.rank for one in line.checks)


def _name_resistance(check: Check) -> tuple[object, ...]:
    return (
        check.member,
        check.mode,
        check.clause,
        check.resistance_type,
        check.resistance_basis,
        check.resistance_cell,
        check.resistance_kN,
    )


def _tell_beside(check: Check, words: Words) -> str:
    """Sentence of a reason, without what the numbers of a failure say."""
    is_by_numbers = check.verdict is Verdict.FAIL and not check.declared
    if is_by_numbers and check.gaps:
        return words.join(map(words.show, check.gaps))
    return words.show(check.told)


def name_checks(checks: Sequence[Check], words: Words) -> str:
    """Names of checks, one after the other."""
    return (
        words.join(dict.fromkeys(show_check(words, one) for one in checks)) or MISSING
    )


def name_few(checks: Sequence[Check], words: Words) -> str:
    """Names of checks that share something; of many the first, and how many more."""
    few, rest = name_checks(checks[:_FEW], words), len(checks) - _FEW
    return words("todo.and_more", names=few, count=rest) if rest > 0 else few


_LOADS = ("coupled", "panel", "truss", "guideline", "maker")
_FAR = 2.0  # times today's value, or its half: beyond it nobody would build
_SENSES = {
    "at least": "show.change_at_least",
    "at most": "show.change_at_most",
    "has": "show.change_has",
}


def show_changes(row: RowStudy, words: Words) -> tuple[str, tuple[Block, ...]]:
    """Heading and sentences of a row: what would make its checks pass."""
    passes = row.verdict in (Verdict.PASS, Verdict.DECLARED)
    heading = words("heading.room_left" if passes else "heading.would_pass_with")
    told = list(_list_row_changes(row, words))
    if told:
        return heading, (Items(items=tuple(told)),)
    is_far = all(map(is_far_from_limit, row.checks))
    key = "heading.no_change_needed" if is_far else "heading.no_change_alone"
    return heading, (Paragraph(text=words(key), look="none"),)


def _list_row_changes(row: RowStudy, words: Words) -> Iterator[str]:
    """Changes that turn checks; those with the same changes share a sentence."""
    told: dict[str, list[str]] = {}
    for check in row.checks:
        text = words.join(list_flips(check, words))
        if check.changes and text:
            told.setdefault(text, []).append(show_check(words, check))
    for text, names in told.items():
        yield words("show.label", label=words.join(names), text=text)


def list_flips(check: Check, words: Words) -> tuple[str, ...]:
    """Changes that turn one check, in short; none where no change alone does.

    ``post spacing at most 1.42 m, now 4 m (as far as the calculated cases show)``
    """
    useful = filter(is_useful, check.changes)
    return tuple(_add_note(_compare_now(one, words), one, words) for one in useful)


def is_useful(change: Change) -> bool:
    """Somebody may build it: a resistance or type, or a number near today's.

    A post spacing of 0.3 m in the place of 3.5 m is none.
    """
    if change.bound is None:
        return False
    if change.unit == "kN" or not change.now:
        return True
    return 1.0 / _FAR <= change.bound / change.now <= _FAR


def _compare_now(change: Change, words: Words) -> str:
    text = describe_change(change, words)
    if change.now is None:
        return text
    now = round(change.now, 3) if change.unit == "m" else change.now  # cos of a slope
    shown = words.show_quantity(now, change.unit)
    return words("show.change_now", change=text, now=shown)


def _add_note(text: str, change: Change, words: Words) -> str:
    if change.note is None:
        return text
    return words("show.with_note", text=text, note=words.show(change.note))


def describe_change(change: Change, words: Words) -> str:
    """One change in words: ``snow density at most 219 kg/m3``."""
    quantity = words.show(change.quantity)
    if change.bound is None:
        return words("show.change_none", quantity=quantity)
    bound = words.show_quantity(change.bound, change.unit)  # rounded by the search
    if change.unit == "kN" and change.sense == "at least":
        bound = append_unit(words.show_minimum(change.bound), "kN")
    return words(_SENSES[change.sense], quantity=quantity, bound=bound)


def _explain_change(change: Change, words: Words) -> str:
    """One change with the condition that it has."""
    text = _compare_now(change, words)
    if change.bound is not None:
        text = words("show.passes_with", change=text)
    return _add_note(text, change, words)


def list_changes(rows: Sequence[tuple[str, Check]], words: Words) -> list[str]:
    """Lines of what turns each check, by net row; else why there is nothing."""
    found = [
        show_text(
            words(
                "show.label",
                label=words(
                    "show.row_and_check",
                    row=row,
                    check=show_check(words, check),
                    verdict=words(f"verdict.{check.verdict}"),
                ),
                text=_explain_change(change, words),
            )
        )
        for row, check in rows
        for change in check.changes
        if is_useful(change)
    ]
    if found:
        return found
    is_far = all(is_far_from_limit(check) for _, check in rows)
    return [words("show.no_change" if is_far else "show.no_change_alone")]
