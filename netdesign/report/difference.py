"""Changes between two studies: verdicts, checks, inputs, and all else.

Each study is one mapping of values by area, net row and name; a change is a value that
is not the same in both.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

from netdesign.checks.check import Check
from netdesign.edge.input_files import make_printable
from netdesign.outcome import Verdict
from netdesign.quantities import QUANTITIES
from netdesign.report.words import Words, find_choice
from netdesign.site.model import InputEcho
from netdesign.study.document import ROUNDING, compare_values
from netdesign.study.records import RowStudy, Study
from netdesign.study.scopes import find_governing
from netdesign.words.catalogue import Language, as_given, name, name_check, name_member
from netdesign.words.message import Message, say

SCHEMA = "netdesign.diff/1"
_RANKS = {str(Verdict.PASS): 0, str(Verdict.DECLARED): 1, str(Verdict.NOT_PROVEN): 2}
_WORST = 3  # rank of a failure, and of what is no longer there
# Values of a check that are told one by one; all others are counted.
_OF_CHECK = ("utilisation", "resistance_kN")
_MOST_DIGITS = 17  # tell any two numbers apart
_NOTHING = (None, "", "-")
# In the order in which they are told.
_AREAS = (
    *("verdict", "settings", "project", "profile", "range", "input"),
    *("governing", "check", "other"),
)
Place = tuple[str, str, Message]  # area, net row, name of the value
Pairs = Iterator[tuple[Message, Any]]  # names and values


@dataclass(frozen=True, slots=True)
class _Word:
    """Key of a value as documents have it, and its words."""

    key: str
    name: Message = field(compare=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """One value that is not the same in both studies.

    Attributes
    ----------
    area : str
        ``verdict``, ``governing``, ``check``, ``project``, ``profile``, ``range``,
        ``input``, ``settings`` or ``other``.
    row : str
        Id of the net row; empty for the whole study.
    what : Message
        Name of the value.
    before, after : object
        The values, in the unit that ``what`` names; None where a study has none.
    """

    area: str
    row: str = ""
    what: Message
    before: Any = None
    after: Any

    @property
    def old(self) -> Any:
        """Value before, as documents have it."""
        return _take_key(self.before)

    @property
    def new(self) -> Any:
        """Value after, as documents have it."""
        return _take_key(self.after)

    def __str__(self) -> str:
        """``R1: utilisation: 0.73 -> 0.81``."""
        return self.tell("en")

    def tell(self, language: Language, rows: Sequence[str] = ()) -> str:
        """The change on one line, in a language; of all rows that share it."""
        words = Words(language)
        before, after = _show(self.before, self.after, words)
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
        is_new_pass = self.old is None and self.new == Verdict.PASS
        return self.area == "verdict" and not is_new_pass


def _take_key(value: Any) -> Any:
    return value.key if isinstance(value, _Word) else value


def compare_studies(old: Study, new: Study) -> list[Change]:
    """Every change from one study to another; what got worse comes first.

    Causes stand before their effects, behind the verdicts. Only the time and the
    command of the two are left out, and rounding.
    """
    rows_old = {row.id: row for row in old.rows}
    rows_new = {row.id: row for row in new.rows}
    both = [row_id for row_id in rows_old if row_id in rows_new]
    before, after = _describe(old, both), _describe(new, both)
    pairs = ((x, before.get(x), after.get(x)) for x in dict.fromkeys((*before, *after)))
    changes = [
        Change(area=area, row=row, what=what, before=was, after=now)
        for (area, row, what), was, now in pairs
        if not _is_same(was, now)
    ]
    changes += _count_values("", _list_shared(old), _list_shared(new))
    for row in both:
        changes += _count_values(row, rows_old[row], rows_new[row])
    ids = ["", *rows_old, *rows_new]
    return sorted(
        changes,
        key=lambda x: (_AREAS.index(x.area), _rank(x), ids.index(x.row)),
    )


def _describe(study: Study, both: Sequence[str]) -> dict[Place, Any]:
    """Values by their places; a name used again gets the number of its use.

    Of a row that is not in ``both`` studies the verdict alone.
    """
    values: dict[Place, Any] = {}
    counts: Counter[Place] = Counter()
    listed = (
        (area, row, what, value)
        for area, row, pairs in _list_areas(study, both)
        for what, value in pairs
    )
    for area, row, what, value in listed:
        counts[area, row, what] += 1
        count = counts[area, row, what]
        name = say("diff.again", what=what, count=count) if count > 1 else what
        values[area, row, name] = value
    return values


def share_rows(changes: Sequence[Change]) -> list[tuple[Change, list[str]]]:
    """Changes as a terminal tells them, each with the net rows that share it."""
    shared: dict[object, tuple[Change, list[str]]] = {}
    for change in changes:
        is_of_row = bool(change.row) and change.area != "verdict"
        texts = (change.area, change.what, str(change.old), str(change.new))
        key: object = texts if is_of_row else (*texts, change.row, len(shared))
        _, rows = shared.setdefault(key, (change, []))
        rows.append(change.row)
    return list(shared.values())


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
    if not change.row or change.area != "verdict":
        return 0
    if change.new is None:
        return 3
    ranks = [_RANKS.get(str(side), _WORST) for side in (change.old, change.new)]
    if change.is_turned and (change.old is None or ranks[1] > ranks[0]):
        return 1 if change.old == Verdict.PASS else 2
    return 4


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
        yield Change(area="other", row=row, what=what, after=count)


def _list_shared(study: Study) -> dict[str, object]:
    """What a study says of all its rows, and the rows' order."""
    return {
        "profile": study.profile,
        "order": [row.id for row in study.rows],
        "range_inputs": study.range_inputs,
        "notes": study.notes,
        "site_sha256": study.provenance.site_sha256,
    }


def _list_areas(
    study: Study, both: Sequence[str]
) -> Iterator[tuple[str, str, Iterable[tuple[Message, Any]]]]:
    """Area and row of all that a study says, with the names and values of each."""
    yield "verdict", "", [(say("diff.verdict"), _tell(study.verdict))]
    yield "settings", "", _list_settings(study)
    yield "project", "", _list_project(study)
    yield "profile", "", _list_profile(study)
    yield "range", "", _list_inputs(study.range_inputs)
    for row in study.rows:
        if row.id not in both:
            yield "verdict", row.id, [(say("diff.net_row"), _tell(row.verdict))]
            continue
        yield "verdict", row.id, _list_verdicts(row)
        yield "governing", row.id, _list_governing(row)
        yield "check", row.id, _list_checks(row)
        yield "input", row.id, _list_inputs(row.inputs)


def _list_verdicts(row: RowStudy) -> Pairs:
    yield say("diff.verdict"), _tell(row.verdict)
    for check in row.checks:
        yield say("diff.check", check=_name_check(check)), _tell(check.verdict)


def _name_check(check: Check) -> Message:
    return name_check(check.member, check.mode, check.position)


def _list_governing(row: RowStudy) -> Pairs:
    """Governing check with its numbers, and the largest force of each member."""
    check = find_governing(row.checks)
    if check is not None:
        yield say("diff.governing_check"), _Word(check.id, _name_check(check))
        for key in ("utilisation", "demand_kN", "resistance_kN"):
            yield say(f"diff_check.{key}"), _read_value(check, key)
        point = check.case.values if check.case else {}
        for key, value in point.items():
            named = _add_unit(QUANTITIES[key].label, QUANTITIES[key].unit)
            yield say("diff.governing_case", key=named), value
    for force in row.member_forces:
        quantity = name_member(force.quantity)
        yield say("diff.largest", quantity=quantity), force.value_kN


def _list_checks(row: RowStudy) -> Pairs:
    for check in row.checks:
        title = _name_check(check)
        for key in _OF_CHECK:
            what = say("diff.of_check", check=title, what=say(f"diff_check.{key}"))
            yield what, _read_value(check, key)


def _read_value(check: Check, key: str) -> Any:
    """Value of a check; a utilisation without a bound is a word: JSON has none."""
    if key == "utilisation" and check.is_unbounded:
        return _Word("unbounded", say("diff_value.unbounded"))
    return getattr(check, key)


def _list_project(study: Study) -> Pairs:
    for key, value in asdict(study.project).items():
        yield say(f"diff_project.{key}"), value


def _list_inputs(inputs: Sequence[InputEcho]) -> Pairs:
    for echo in inputs:
        yield _add_unit(echo.label, echo.unit), _read_input(echo)


def _read_input(echo: InputEcho) -> Any:
    choice = find_choice(echo)
    return _Word(str(echo.value), choice) if choice else echo.value


def _add_unit(what: Message, unit: str) -> Message:
    return say("diff.with_unit", what=what, unit=unit) if unit else what


def _list_profile(study: Study) -> Pairs:
    profile = study.profile
    yield say("diff.profile"), profile.id
    yield say("diff.edition"), profile.edition
    yield say("diff.version"), profile.version
    yield say("diff.choice"), profile.choice
    yield say("diff.floor"), profile.floor
    yield say("diff.shared_sum"), profile.shared_sum
    for value in profile.values:
        yield say("diff.with_unit", what=value.id, unit=value.unit), value.value


def _list_settings(study: Study) -> Pairs:
    """Cells of a what-if, then program, site file, settings and libraries.

    Without its cells the verdicts of a what-if would be read as the site's.
    """
    provenance = study.provenance
    for cell in study.what_if:
        yield say("diff.what_if", cell=cell.cell), cell.now
    yield say("diff.version"), provenance.version
    yield say("diff.site_file"), provenance.site_file
    for key, value in provenance.settings.items():
        yield name("setting", key), value
    for key, value in provenance.libraries.items():
        yield as_given(key), value


def _show(old: Any, new: Any, words: Words) -> tuple[str, str]:
    """Both values, with as many digits as tell them apart."""
    for digits in range(4, _MOST_DIGITS + 1):
        shown = _round(old, digits, words), _round(new, digits, words)
        if shown[0] != shown[1]:
            break
    return shown


def _round(value: Any, digits: int, words: Words) -> str:
    if isinstance(value, _Word):
        return words.show(value.name)
    if value in _NOTHING:
        return words("diff.none")
    is_number = isinstance(value, float)
    return words.write(f"{value:.{digits}g}") if is_number else str(value)
