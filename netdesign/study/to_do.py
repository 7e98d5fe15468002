"""What is to be done before a study is signed: few lines, each with who has the answer.

A line stands once for all the rows that it concerns, with the number that the worst of
them needs.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from netdesign.checks.check import Check
from netdesign.checks.rating import Open, OpenKind
from netdesign.outcome import SEVERITY, Verdict
from netdesign.site.columns.office import TABLES, load_columns
from netdesign.study.conditions import Who
from netdesign.study.records import RowStudy, Study
from netdesign.study.scopes import STRUCTURE, is_of_structure
from netdesign.words.catalogue import as_given, name_check, name_member, name_mode
from netdesign.words.message import Message, say

WHO: tuple[str, ...] = ("office", "ground", "supplier", "site", "all")
MOST_LINES = 10
_LOWERS = "check.assumed_lowers"  # neither end of a range passes
_TOGETHER = "check.assumed_together"  # the best ends of all ranges pass
_HEAD = "direction.no_head"  # says what the head has to take
_SHORT = ("post_bending.too_much_shortly",)

# Who answers for a column of the input workbook: a survey is made on the site.
# An assumed value that no column holds stands here itself.
_OF_COLUMN: Mapping[str, Who] = {
    "office": "office",
    "supplier": "supplier",
    "ground": "ground",
    "survey": "site",
    "assumed.by_posts": "office",
}
# Who answers for what a member can fail by.
_OF_MODE: Mapping[str, Who] = {
    **dict.fromkeys(("pull_out", "wedge", "bearing", "sliding", "cover"), "ground"),
    **dict.fromkeys(("tendon", "bending", "direction", "rope", "mesh"), "supplier"),
    **dict.fromkeys(("compression", "compression_bending", "connection"), "supplier"),
}


@dataclass(frozen=True, kw_only=True)
class ToDo:
    """One thing to be done.

    Attributes
    ----------
    who : str
        Who has the answer: ``office``, ``ground`` (the geotechnical engineer),
        ``supplier``, ``site``; ``all`` of the line that counts the others.
    text : Message
        What is needed, with its number.
    rows : tuple of str
        Ids of the net rows that need it, in the order of the study.
    """

    who: str
    text: Message
    rows: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Point:
    """One open point of one check of one row, with the key of its line."""

    who: Who
    key: tuple[str, ...]
    row: str
    check: Check
    point: Open | None


def list_to_do(study: Study, most: int | None = MOST_LINES) -> tuple[ToDo, ...]:
    """Lines of a study, the gravest first.

    Parameters
    ----------
    study : Study
        Of any verdict; one that passes may have none.
    most : int or None
        Largest number of lines, of which the last then counts the others; None: all.
    """
    lines: dict[tuple[str, ...], list[_Point]] = {}
    for row in study.rows:
        for point in _list_points(row):
            lines.setdefault((point.who, *point.key), []).append(point)
    every = [_sum_up(group) for group in sorted(lines.values(), key=_rank)]
    if most is None or len(every) <= most:
        return tuple(every)
    rest = every[most - 1 :]  # the last line counts them
    left = {row for line in rest for row in line.rows}
    ids = tuple(row.id for row in study.rows if row.id in left)
    more = ToDo(who="all", text=say("to_do.more", count=len(rest)), rows=ids)
    return (*every[: most - 1], more)


def _rank(group: Sequence[_Point]) -> tuple[int, float]:
    """Order of lines: by the worst verdict, then by the largest utilisation."""
    worst = min(SEVERITY.index(point.check.verdict) for point in group)
    return worst, -max(point.check.used or 0.0 for point in group)


def _list_points(row: RowStudy) -> Iterator[_Point]:
    """Open points of the checks of a row that do not pass.

    A failing check has one, and so has one whose band spans the limit. A structure
    without any resistance has a single point.
    """
    is_bare = any(check.member == STRUCTURE and check.open for check in row.checks)
    of_forces = {x.message for y in row.checks if y.is_of_force for x in y.open}
    for check in row.checks:
        is_part = check.member != STRUCTURE and is_of_structure(check)
        if is_bare and is_part and check.verdict is Verdict.NOT_PROVEN:
            continue
        is_spanning = check.verdict is Verdict.NOT_PROVEN and not check.open
        open_points: Sequence[Open | None] = ()
        if check.verdict is Verdict.FAIL or is_spanning:
            open_points = (None,)
        elif check.verdict is not Verdict.PASS:
            proofs = [point for point in check.open if point.proof is not None]
            open_points = proofs or check.open
        for point in open_points:
            who, *key = _sort(check, point, of_forces)
            yield _Point(who=who, key=(*key,), row=row.id, check=check, point=point)


def _sort(
    check: Check, point: Open | None, of_forces: Container[Message]
) -> tuple[Who, *tuple[str, ...]]:
    """Who has the answer to an open point of a check, and the key of its line.

    What checks without a force say has one line whatever its numbers, unless a check
    of a force of the row says the same.
    """
    if point is None:
        return _sort_by_numbers(check)
    who, message = _OF_MODE.get(check.mode, "office"), point.message
    is_missing = point.kind is OpenKind.RESISTANCE_MISSING
    if point.kind is OpenKind.ASSUMED_DECIDES:
        deciding = _name_deciding(message)
        holder = _find_holder(deciding) or "supplier"
        key = ("lowers",) if message.key == _LOWERS else ("decides", deciding)
        return holder, *key
    if is_missing and check.mode == "connection":
        return "supplier", "links"
    if message.key == _HEAD:
        return "office", "open", _HEAD
    if is_missing and check.is_of_force:
        is_of_product = check.resistance_type or check.mode == "mesh"
        return who if is_of_product else "office", "needs"
    if point.proof is not None:
        return who, "proof", str(point.proof.document)
    is_asked = point.kind in (OpenKind.UNSOLVED, OpenKind.VALUE_ASKED)
    named = who
    if is_asked or message.key == "bores.no_type":
        named = _find_holder(_name_asked(message)) or "office"
    is_whole = check.is_of_force or message in of_forces
    return named, "open", str(message) if is_whole else message.key


def _sort_by_numbers(check: Check) -> tuple[Who, *tuple[str, ...]]:
    """The same of a check that fails, or spans its limit, without an open point."""
    if not check.is_of_force:
        return "office", "open", check.plain_reason.key
    if _TOGETHER in [reason.key for reason in check.open_reasons]:
        return "supplier", "together", check.member
    return "office", "fails", check.verdict, check.member


def _name_deciding(message: Message) -> str:
    """Name of the assumed value that decides, or of what is assumed of ropes."""
    name = message.arguments.get("name")
    return name.key if isinstance(name, Message) else message.key


def _name_asked(message: Message) -> str:
    """Name of the first value that a message asks for; "" of none."""
    names = message.arguments.get("names")
    first = names[0] if isinstance(names, tuple) and names else ""
    return first.key if isinstance(first, Message) else ""


def _find_holder(name: str) -> Who | None:
    """Who has the value of a column, as the input workbook says; None of others."""
    table, _, key = name.removeprefix("column.").rpartition(".")
    columns = load_columns(table) if table in TABLES else ()
    has = next((column.has for column in columns if column.field.key == key), name)
    return _OF_COLUMN.get(has)


def _sum_up(group: Sequence[_Point]) -> ToDo:
    """Line of some points of one key: its number is that of the worst check."""
    worst = max(group, key=lambda each: (each.check.used or 0.0, _find_demand(each)))
    rows = tuple(dict.fromkeys(point.row for point in group))
    text, check = _describe(worst, group), worst.check
    titles = {(point.check.member, point.check.mode) for point in group}
    if worst.key[0] in _OF_ONE and (len(rows) > 1 or len(titles) > _FEW):
        title = name_check(check.member, check.mode)
        text = say("to_do.numbers_of", what=text, row=worst.row, check=title)
    return ToDo(who=worst.who, text=text, rows=rows)


_OF_ONE = ("fails", "together", "decides")  # lines with the numbers of one check


def _find_demand(point: _Point) -> float:
    return point.check.read_band("E_d")[1] or 0.0


def _describe(worst: _Point, group: Sequence[_Point]) -> Message:
    check, kind = worst.check, worst.key[0]
    checks = name_few_checks([check, *(point.check for point in group)])
    if kind == "fails" and check.verdict is Verdict.FAIL:
        return _describe_failed(check, checks)
    if kind == "needs":
        return _describe_needed([point.check for point in group])
    if kind == "links":
        types = dict.fromkeys(point.check.resistance_type for point in group)
        named = tuple(as_given(type_id) for type_id in types if type_id)
        return say("to_do.links", types=named or (name_member(check.member),))
    if kind == "proof":
        return say("to_do.proof", checks=checks, proof=worst.key[1])
    if worst.point is None:
        if kind == "together":
            ends = {"least": check.eased_low or 0.0, "used": check.used or 0.0}
            return say("to_do.together", checks=checks, **ends)
        if check.is_of_force:
            return say("to_do.spans", checks=checks)
        return _describe_open(checks, shorten_reason(check.plain_reason))
    if kind == "lowers":
        lowered = (x.point.message.arguments["name"] for x in group if x.point)
        names = (name for name in lowered if isinstance(name, Message))
        named = tuple(dict.fromkeys(names))
        if len(named) > 1:
            return say("to_do.lowers", names=named)
    return _describe_open(checks, worst.point.message)


def _describe_open(checks: tuple[Message, ...], reason: Message) -> Message:
    """Name the checks where they are few, and the reason."""
    is_few = len(checks) <= _FEW or reason.key.startswith("check.assumed_")
    return say("to_do.open", checks=checks, reason=reason) if is_few else reason


def shorten_reason(reason: Message) -> Message:
    """Reason without the formula that a calculation shows."""
    short = f"{reason.key}_shortly"
    return say(short) if short in _SHORT else reason


def _describe_failed(check: Check, checks: tuple[Message, ...]) -> Message:
    """Name force, resistance, use at the best ends, and a type that suffices."""
    demand, resistance = check.demand_kN, check.resistance_kN
    if demand is None or resistance is None:
        return _describe_open(checks, shorten_reason(check.plain_reason))
    failed = say("to_do.fails", checks=checks, demand=demand, resistance=resistance)
    if check.eased_low is not None and check.used is not None:
        ends = {"least": check.eased_low, "used": check.used}
        forces = {"demand": demand, "resistance": resistance}
        failed = say("to_do.from_best", checks=checks, **ends, **forces)
    other = next((each for each in check.changes if each.sense == "has"), None)
    if other is None:
        return failed
    mode = name_mode(check.mode)
    return say("to_do.with_type", what=failed, mode=mode, type=other.quantity)


def _describe_needed(checks: Sequence[Check]) -> Message:
    """Name the missing resistances, and the least value that each type needs."""
    needed: dict[str, float] = {}
    for check in checks:
        name = check.resistance_type or check.member
        needed[name] = max(needed.get(name, 0.0), check.needed_kN or 0.0)
    members = {check.member for check in checks if not check.resistance_type}
    named = {
        key: name_member(key) if key in members else as_given(key) for key in needed
    }
    of = (
        say("to_do.least", of=named[key], least=least) if least else named[key]
        for key, least in needed.items()
    )
    modes = dict.fromkeys(name_mode(check.mode) for check in checks)
    return say("to_do.needs", what=tuple(modes), of=tuple(of))


_FEW = 2  # checks or members that a line names


def name_few_checks(checks: Iterable[Check]) -> tuple[Message, ...]:
    """Titles of one or two checks of a line; of more their members, each once."""
    every = list(checks)
    titles = list(
        dict.fromkeys(name_check(check.member, check.mode) for check in every)
    )
    if len(titles) <= _FEW:
        return tuple(titles)
    members = list(dict.fromkeys(name_member(check.member) for check in every))
    if len(members) <= _FEW + 1:
        return tuple(members)
    return (*members[:_FEW], say("to_do.more_checks", count=len(titles) - _FEW))
