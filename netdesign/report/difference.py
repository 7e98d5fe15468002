"""Changes between two studies: verdicts, checks, inputs, and all else."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any, TypeVar

from netdesign.checks.check import Check
from netdesign.edge.input_files import make_printable
from netdesign.outcome import Verdict
from netdesign.quantities import QUANTITIES
from netdesign.report.words import Words, find_choice
from netdesign.site.model import InputEcho
from netdesign.study.document import ROUNDING, compare_values
from netdesign.study.records import RowStudy, Study
from netdesign.study.scopes import find_governing
from netdesign.words.catalogue import Language
from netdesign.words.message import Message, say
from netdesign.words.names import as_given, name, name_check, name_member

SCHEMA = "netdesign.diff/1"
_MET, _UNMET = "met", "not met"
_PASSING = (str(Verdict.PASS), _MET)
_RANKS = {
    **{str(Verdict.PASS): 0, _MET: 0},
    str(Verdict.DECLARED): 1,
    **{str(Verdict.NOT_PROVEN): 2, _UNMET: 2},
}
_WORST = 3  # rank of a failure, and of what is no longer there
# Values of a check that are told one by one; those that follow from them are counted.
_OF_CHECK = (
    "utilisation",
    "demand_kN",
    "resistance_kN",
    "resistance_basis",
    "resistance_type",
    "clause",
    "declared",
)
# The same of its calculation: symbol, and which of low end, value and high end.
_OF_STEPS = {
    "demand_low_kN": ("E_d", 0),
    "demand_high_kN": ("E_d", 2),
    "utilisation_low": ("μ", 0),
    "utilisation_high": ("μ", 2),
    "action_factor": ("γ_E", 1),
    "resistance_characteristic_kN": ("R_k", 1),
    "resistance_factor": ("γ_R", 1),
}
_MOST_DIGITS = 17  # tell any two numbers apart
_NOTHING = (None, "", "-")
# In the order of the terminal.
_AREAS = (
    *("verdict", "quantity", "settings", "project", "profile", "range", "input"),
    *("governing", "check", "other"),
)
# What follows from a utilisation, or from a largest force, that is told beside it.
_FOLLOWS = (
    *("diff_check.demand_kN", "diff_check.demand_low_kN", "diff_check.demand_high_kN"),
    *("diff_check.utilisation_low", "diff_check.utilisation_high"),
    "diff.upper_bound",
)
_Value = TypeVar("_Value")
Named = Mapping[Message, Any]  # values by their names


@dataclass(frozen=True, slots=True)
class _Word:
    """Key of a value as documents have it, and its words."""

    key: str
    name: Message


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """One value that is not the same in both studies; None where one has none.

    Attributes
    ----------
    area : str
        ``verdict``, ``governing``, ``check``, ``project``, ``profile``, ``range``,
        ``input``, ``settings``, ``quantity`` or ``other``.
    row : str
        Id of the net row; empty for the whole study.
    what : Message
        Name of the value.
    old, new : object
        The values, in the unit that ``what`` names.
    names : tuple of Message or None
        Words of both values, where these are keys.
    """

    area: str
    row: str = ""
    what: Message
    old: Any
    new: Any
    names: tuple[Message | None, Message | None] = (None, None)

    def __str__(self) -> str:
        """``R1: utilisation: 0.73 -> 0.81``."""
        return self.tell("en")

    def tell(self, language: Language, rows: Sequence[str] = ()) -> str:
        """The change on one line, in a language; of all rows that share it."""
        words = Words(language)
        pairs = zip(self.names, (self.old, self.new), strict=True)
        old, new = (words.show(name) if name else side for name, side in pairs)
        before, after = _show(old, new, words)
        parts = {"what": self.name(words), "old": before, "new": after}
        names = ", ".join(rows or (self.row,))
        if self.area == "other":
            label = {"label": names, "text": parts["what"]}
            return make_printable(
                words("show.label", **label) if names else label["text"]
            )
        if self.row:
            sentence = words("diff.change_of_row", row=names, **parts)
        else:
            sentence = words("diff.change", **parts)
        return make_printable(sentence.replace("\n", " "))

    def name(self, words: Words) -> str:
        """Name of the value; inputs have those of the site workbook."""
        return words.show(self.what)

    @property
    def is_turned(self) -> bool:
        """A verdict that is another now, or is gone; not a new one that passes."""
        is_new_pass = self.old is None and self.new in _PASSING
        return self.area == "verdict" and not is_new_pass


def compare_studies(old: Study, new: Study) -> list[Change]:
    """Every change from one study to another; what got worse comes first.

    Only the time and the command of the two are left out, and rounding.
    """
    rows_old = {row.id: row for row in old.rows}
    rows_new = {row.id: row for row in new.rows}
    ids = list(dict.fromkeys((*rows_old, *rows_new)))
    pairs = [(name, rows_old.get(name), rows_new.get(name)) for name in ids]
    both = [(name, was, now) for name, was, now in pairs if was and now]

    def compare(area: str, describe: Callable[[Study], Named]) -> Iterator[Change]:
        return _compare(area, "", describe(old), describe(new))

    def compare_rows(
        area: str, describe: Callable[[RowStudy], Named]
    ) -> Iterator[Change]:
        for row, was, now in both:
            yield from _compare(area, row, describe(was), describe(now))

    verdicts = [
        *compare("verdict", _name_verdict),
        *(change for pair in pairs for change in _compare_verdicts(*pair)),
    ]
    return [
        *compare("settings", _list_replaced),
        *sorted(verdicts, key=_rank),
        *compare("quantity", _list_quantities),
        *compare_rows("governing", _list_governing),
        *compare_rows("check", _list_checks),
        *compare("project", _list_project),
        *compare("profile", _list_profile),
        *compare("range", lambda study: _list_inputs(study.range_inputs)),
        *compare_rows("input", lambda row: _list_inputs(row.inputs)),
        *compare("settings", _list_settings),
        *_count_values("", _list_shared(old), _list_shared(new)),
        *(change for pair in both for change in _count_values(*pair)),
    ]


def share_rows(changes: Sequence[Change]) -> list[tuple[Change, list[str]]]:
    """Changes as a terminal tells them, each with the net rows that share it.

    Causes stand before their effects, behind the verdicts; of a check that is used
    otherwise only its utilisation is told.
    """
    shared: dict[object, tuple[Change, list[str]]] = {}
    told_first = sorted(changes, key=lambda change: _AREAS.index(change.area))
    for change in filter(_is_told, told_first):
        is_of_row = bool(change.row) and change.area != "verdict"
        texts = (change.area, change.what, str(change.old), str(change.new))
        key: object = texts if is_of_row else (*texts, change.row, len(shared))
        _, rows = shared.setdefault(key, (change, []))
        rows.append(change.row)
    return list(shared.values())


def _is_told(change: Change) -> bool:
    what = change.what.arguments.get("what")
    key = what.key if isinstance(what, Message) else change.what.key
    return key not in _FOLLOWS


def name_area(area: str, language: Language) -> str:
    """Heading of the changes of one area."""
    return Words(language)(f"diff_area.{area}")


def write_difference(
    changes: Sequence[Change], language: Language = "en"
) -> dict[str, Any]:
    """JSON document of the changes; only their names follow the language."""
    words = Words(language)
    listed = [
        {
            "area": change.area,
            "row": change.row,
            "what": change.name(words),
            "old": change.old,
            "new": change.new,
        }
        for change in changes
    ]
    return {"schema": SCHEMA, "changes": listed}


def _rank(change: Change) -> int:
    """Sort key of a verdict: the study's, lost passes, else worse, gone, the others."""
    if not change.row:
        return 0
    if change.new is None:
        return 3
    ranks = [_RANKS.get(str(side), _WORST) for side in (change.old, change.new)]
    if change.is_turned and (change.old is None or ranks[1] > ranks[0]):
        return 1 if change.old in _PASSING else 2
    return 4


def _compare_verdicts(
    name: str, old: RowStudy | None, new: RowStudy | None
) -> Iterator[Change]:
    """Changed verdicts of a row and its checks; of a new or lost row its own only."""
    if old and new:
        yield from _compare("verdict", name, _list_verdicts(old), _list_verdicts(new))
        return
    ends = [
        {say("diff.net_row"): _tell(row.verdict)} if row else {} for row in (old, new)
    ]
    yield from _compare("verdict", name, ends[0], ends[1])


def _compare(area: str, row: str, old: Named, new: Named) -> Iterator[Change]:
    for what in dict.fromkeys((*old, *new)):
        pair = [_split(values.get(what)) for values in (old, new)]
        (before, after), names = zip(*pair, strict=True)
        if not _is_same(before, after):
            yield Change(
                area=area, row=row, what=what, old=before, new=after, names=names
            )


def _split(value: Any) -> tuple[Any, Message | None]:
    """Value as the document has it, and its words."""
    return (value.key, value.name) if isinstance(value, _Word) else (value, None)


def _is_same(old: Any, new: Any) -> bool:
    """No difference, none but rounding, or no value in either."""
    if isinstance(old, float) and isinstance(new, float):
        return math.isclose(old, new, rel_tol=ROUNDING)
    return old == new or (old in _NOTHING and new in _NOTHING)


def _tell(verdict: str) -> _Word:
    """A verdict with its words."""
    key = str(verdict)
    return _Word(key=key, name=say(f"diff_value.{key.replace(' ', '_')}"))


def _count_values(row: str, old: object, new: object) -> Iterator[Change]:
    """Number of all values of a part that differ, whether they are told or not."""
    count = len(compare_values(old, new, is_exact=True))
    if count:
        what = say("diff.values_of", count=count)
        yield Change(area="other", row=row, what=what, old=None, new=count)


def _list_shared(study: Study) -> dict[str, object]:
    """What a study says of all its rows, and the rows' order."""
    return {
        "profile": study.profile,
        "order": [row.id for row in study.rows],
        "range_inputs": study.range_inputs,
        "notes": study.notes,
        "site_sha256": study.provenance.site_sha256,
    }


def _name_verdict(study: Study) -> Named:
    return {say("diff.verdict"): _tell(study.verdict)}


def _list_verdicts(row: RowStudy) -> Named:
    return {
        say("diff.verdict"): _tell(row.verdict),
        **{
            say("diff.check", check=title): _tell(check.verdict)
            for title, check in _name_checks(row).items()
        },
        **_name_all(
            (
                say("diff.law", law=name("law", law.name)),
                _tell(_MET if law.is_met else _UNMET),
            )
            for law in row.independent
        ),
    }


def _name_all(pairs: Iterable[tuple[Message, _Value]]) -> dict[Message, _Value]:
    """Values by their names; a name used again gets the number of its use."""
    named: dict[Message, _Value] = {}
    counts: Counter[Message] = Counter()
    for what, value in pairs:
        counts[what] += 1
        again = say("diff.again", what=what, count=counts[what])
        named[again if counts[what] > 1 else what] = value
    return named


def _name_checks(row: RowStudy) -> dict[Message, Check]:
    return _name_all((_name_check(check), check) for check in row.checks)


def _name_check(check: Check) -> Message:
    return name_check(check.member, check.mode, check.position)


def _list_governing(row: RowStudy) -> Named:
    """Governing check with its numbers, and the largest force of each member."""
    values: dict[Message, Any] = {}
    check = find_governing(row.checks)
    if check is not None:
        values[say("diff.governing_check")] = _Word(check.id, _name_check(check))
        for key in ("utilisation", "demand_kN", "resistance_kN"):
            values[say(f"diff_check.{key}")] = _read_value(check, key)
        point = check.case.values if check.case else {}
        for key, value in point.items():
            named = _add_unit(QUANTITIES[key].label, QUANTITIES[key].unit)
            values[say("diff.governing_case", key=named)] = value
    extremes = _name_all(
        (name_member(force.quantity), force) for force in row.member_forces
    )
    for quantity, extreme in extremes.items():
        values[say("diff.largest", quantity=quantity)] = extreme.value_kN
        values[say("diff.upper_bound", quantity=quantity)] = extreme.bound_kN
    return values


def _list_checks(row: RowStudy) -> Named:
    return {
        say("diff.of_check", check=title, what=say(f"diff_check.{key}")): (
            _read_value(check, key)
        )
        for title, check in _name_checks(row).items()
        for key in (*_OF_CHECK, *_OF_STEPS)
    }


def _read_value(check: Check, key: str) -> Any:
    """Value of a check; the basis of its resistance has words, its proof a place.

    A utilisation without a bound is a word, too: JSON has no infinite number.
    """
    if key in _OF_STEPS:
        symbol, end = _OF_STEPS[key]
        step = check.step_of.get(symbol)
        return step.ends[end] if step else None
    value = getattr(check, key)
    if key == "utilisation" and check.is_unbounded:
        return _Word("unbounded", say("diff_value.unbounded"))
    if key == "declared":
        return _name_proof(check)
    if key == "resistance_basis" and value:
        return _Word(value, name("basis", value))
    return value


def _name_proof(check: Check) -> str | None:
    """Place of the proof of a declared check, as the workbook has it."""
    if check.declared is None:
        return None
    return ", ".join(text for text in asdict(check.declared).values() if text)


def _list_project(study: Study) -> Named:
    fields = asdict(study.project).items()
    return {say(f"diff_project.{key}"): value for key, value in fields}


def _list_inputs(inputs: Sequence[InputEcho]) -> Named:
    return _name_all(
        (_add_unit(echo.label, echo.unit), _read_input(echo)) for echo in inputs
    )


def _read_input(echo: InputEcho) -> Any:
    choice = find_choice(echo)
    return _Word(str(echo.value), choice) if choice else echo.value


def _add_unit(what: Message, unit: str) -> Message:
    return say("diff.with_unit", what=what, unit=unit) if unit else what


def _list_profile(study: Study) -> Named:
    profile = study.profile
    values = _name_all(
        (say("diff.with_unit", what=value.id, unit=value.unit), value.value)
        for value in profile.values
    )
    return {
        say("diff.profile"): profile.id,
        say("diff.edition"): profile.edition,
        say("diff.version"): profile.version,
        say("diff.choice"): profile.choice,
        say("diff.floor"): profile.floor,
        say("diff.shared_sum"): profile.shared_sum,
        **values,
    }


def _list_quantities(study: Study) -> Named:
    """Numbers of anchors by type, as far as they are known."""
    counts: dict[Message, Any] = {say("diff.net_rows"): len(study.rows)}
    for part in (piece for row in study.rows for piece in row.parts):
        what = say("diff.pieces", type=part.type_id)
        if part.count is not None:
            counts[what] = counts.get(what, 0) + part.count
    return counts


def _list_replaced(study: Study) -> Named:
    """Cells of a what-if: without them its verdicts would be read as the site's."""
    return {say("diff.what_if", cell=cell.cell): cell.now for cell in study.what_if}


def _list_settings(study: Study) -> Named:
    provenance = study.provenance
    settings = provenance.settings.items()
    return {
        say("diff.version"): provenance.version,
        say("diff.site_file"): provenance.site_file,
        **{name("setting", key): value for key, value in settings},
        **{as_given(key): value for key, value in provenance.libraries.items()},
    }


def _show(old: Any, new: Any, words: Words) -> tuple[str, str]:
    """Both values, with as many digits as tell them apart."""
    for digits in range(4, _MOST_DIGITS + 1):
        shown = _round(old, digits, words), _round(new, digits, words)
        if shown[0] != shown[1]:
            break
    return shown


def _round(value: Any, digits: int, words: Words) -> str:
    if value in _NOTHING:
        return words("diff.none")
    is_number = isinstance(value, float)
    return words.write(f"{value:.{digits}g}") if is_number else str(value)
