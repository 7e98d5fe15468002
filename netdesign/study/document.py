"""A study as JSON text with its digest, and back; two studies compared value by value.

A text with a fault is refused, and the refusal names the place.
"""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from netdesign.calculation.steps import require_calculation
from netdesign.checks.check import Check
from netdesign.edge.input_files import (
    decode_utf8,
    explain,
    explain_shape,
    list_faults,
    read_bounded,
)
from netdesign.edge.json_text import (
    MAX_JSON_BYTES,
    hash_values,
    read_json,
    restore_json,
    write_json,
)
from netdesign.outcome import ContentError, StudyError
from netdesign.study.records import SCHEMA, RowStudy, Study
from netdesign.words.message import Message, say

_OLD_SCHEMAS = ("netdesign.study/1", "netdesign.study/2", "netdesign.study/3")
# As a study without its digest has that line.
_OPEN_LINE = '\n"digest": ""'
_HOW_FAR = 200  # signs from the start, among which a document names its schema


def compute_digest(study: Study) -> str:
    """SHA-256 of a study without its own digest.

    It shows that a document is the one whose digest is printed in a report, or that it
    was altered by accident. Who alters a document on purpose
    can compute it again: only a new solve shows that the numbers are true.
    """
    return study.own_digest


def hash_text(text: str) -> str:
    """SHA-256 of a document as it is stored, without its own digest."""
    return hash_values(json.dumps({**json.loads(text), "digest": ""}))


def write_document(study: Study) -> str:
    """JSON text of a study, with its digest.

    Numbers stand in full, keys in the order of the fields.
    """
    # no text in the document has a line end of its own, so this line stands once
    digest = f'{_OPEN_LINE[:-1]}{compute_digest(study)}"'
    return study.written.replace(_OPEN_LINE, digest, 1)


def read_document(text: str) -> Study:
    """Study from its JSON text.

    Raises
    ------
    StudyError
        Naming every key that is missing, unknown or of the wrong kind, of each list
        those of its first faulty member.
    """
    from pydantic import ValidationError

    for old in _OLD_SCHEMAS:
        if f'"{old}"' in text[:_HOW_FAR]:
            raise StudyError(say("study_file.old_schema", old=old, new=SCHEMA))
    try:
        study: Study = read_json(Study, text, _drop_of_study)
        _require_sense(study)
    except ValidationError as error:
        faults = [
            say(
                "text.at_place",
                place=".".join(map(str, fault["loc"])) or say("study.document"),
                text=explain_shape(fault),
            )
            for fault in error.errors(include_input=False, include_url=False)
        ]
        raise StudyError(
            say("study.faults", schema=SCHEMA, faults=list_faults(faults))
        ) from None
    except ValueError as error:
        raise StudyError(
            say("study.fault", schema=SCHEMA, fault=explain(error))
        ) from None
    return study


def restore_row(text: str) -> RowStudy:
    """Read a net row from the text that this program wrote; it keeps that text.

    2.0 that was written as 2 is written so again.

    Raises
    ------
    ValueError
        If the text is no net row.
    """
    row = json.loads(text)
    _drop_of_row(row)
    restored: RowStudy = restore_json(RowStudy, json.dumps(row, check_circular=False))
    vars(restored)["written"] = text
    return restored


def _drop_of_study(document: Any) -> bool:
    """Remove the values that follow from the fields; other keys are refused later.

    False where a document has none of these values, and so is no study.
    """
    if not isinstance(document, dict) or document.keys().isdisjoint(Study.WRITTEN):
        return False
    for row in _drop(document, Study.WRITTEN, "rows"):
        _drop_of_row(row)
    return True


def _drop_of_row(row: Any) -> None:
    for check in _drop(row, RowStudy.WRITTEN, "checks"):
        _drop(check, Check.WRITTEN)


def _drop(part: Any, names: Iterable[str], members: str = "") -> list[Any]:
    """Remove keys of an object, and return the members of one of its lists."""
    if not isinstance(part, dict):
        return []
    for name in names:
        part.pop(name, None)
    listed = part.get(members)
    return listed if isinstance(listed, list) else []


def require_unaltered(study: Study, text: str) -> None:
    """Refuse a study whose text does not have its digest.

    The text holds what follows from the study's fields, too, and the digest is of both.

    Raises
    ------
    StudyError
        If one of them is another than was written.
    """
    if not study.digest == hash_text(text) == compute_digest(study):
        raise StudyError(say("stored.altered"))


def _require_sense(study: Study) -> None:
    """Refuse equal row ids, calculations out of order and impossible dates."""
    counts = Counter(row.id for row in study.rows)
    twice = [name for name, count in counts.items() if count > 1]
    if twice:
        raise ContentError(say("study.id_twice", id=f"{twice[0]!r:.60}"))
    for row in study.rows:
        for check in row.checks:
            require_calculation(check.steps)
    started = study.provenance.started
    try:
        datetime.fromisoformat(started or "1980-01-01")
    except ValueError:
        raise ContentError(say("study.no_date", started=f"{started!r:.60}")) from None


def load_study(path: Path) -> Study:
    """Study from a stored file.

    Raises
    ------
    StudyError
        If the file cannot be read, is no study, or is another one than was written.
    """
    try:
        text = decode_utf8(read_bounded(path, MAX_JSON_BYTES))
    except (OSError, ValueError) as error:
        raise StudyError(
            say("study.unreadable", path=str(path), cause=explain(error))
        ) from None
    try:
        study = read_document(text)
        require_unaltered(study, text)
        return study
    except StudyError as error:
        named = say("text.at_place", place=str(path), text=error.message)
        raise StudyError(named) from None


SAME = 1e-6  # relative; other machines differ in the last digits only
ROUNDING = 1e-12  # relative; of the same number, summed in another order
# Absolute, of residuals, shares and small differences, which are rounding themselves.
_NOISE = 1e-6
_PERCENT = "_percent"  # end of the name of a difference or an error


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """Value that differs between two studies; None in the study that lacks it."""

    place: str  # "rows.R1.checks.foot_anchor.tendon.demand_kN"
    stored: Any
    again: Any

    @property
    def message(self) -> Message:
        """``rows.R1.verdict: stored 'pass', again 'fail'``."""
        stored, again = show_value(self.stored), show_value(self.again)
        return say("value.differs", place=self.place, stored=stored, again=again)


def show_value(value: object) -> Message | str:
    """A value as Python writes it, a number with the reader's decimal mark; or none."""
    if value is None:
        return say("value.none")
    return say("value.number", number=value) if type(value) is float else repr(value)


def list_values(part: object) -> dict[str, Any]:
    """Values of a study, or of a part of one, by their places.

    Members of a list stand under their ids, if each has its own; the order of these
    is a value too.
    """
    values: dict[str, Any] = {}
    _collect(json.loads(write_json(part)), "", values)
    return values


def compare_values(
    stored: object, again: object, *, is_exact: bool = False
) -> list[Difference]:
    """Places at which two parts differ, in the order of the first.

    Parameters
    ----------
    stored, again : object
        Studies, or the same part of each.
    is_exact : bool
        Numbers count as different by more than their rounding; otherwise by more than
        a millionth, which other machines and libraries do not reach.
    """
    return compare_listed(list_values(stored), list_values(again), is_exact=is_exact)


def compare_listed(
    old: Mapping[str, Any], new: Mapping[str, Any], *, is_exact: bool = False
) -> list[Difference]:
    """Places at which two parts differ, in the order of the first.

    Parameters
    ----------
    old, new : mapping
        What ``list_values`` gives of the two parts.
    is_exact : bool
        As in ``compare_values``.
    """
    places = dict.fromkeys((*old, *new))
    return [
        Difference(place=place, stored=old.get(place), again=new.get(place))
        for place in places
        if place not in old
        or place not in new
        or not _is_same(old[place], new[place], 0.0 if is_exact else _find_noise(place))
    ]


def _collect(value: Any, place: str, values: dict[str, Any]) -> None:
    """Add the values of a part to those known, in the order of the part."""
    if not value or not isinstance(value, dict | list):
        values[place] = value
        return
    before = f"{place}." if place else ""
    if isinstance(value, list):
        ids = _list_ids(value)
        if ids:
            values[f"{before}order"] = ", ".join(ids)
        value = dict(zip(ids or range(len(value)), value, strict=True))
    for name, part in value.items():
        _collect(part, f"{before}{name}", values)


def _list_ids(members: Sequence[Any]) -> list[str]:
    """Ids or symbols of the members of a list; none if one lacks it or two share it."""
    if not all(isinstance(member, dict) for member in members):
        return []
    ids = [str(member.get("id", member.get("symbol", ""))) for member in members]
    return ids if all(ids) and len(set(ids)) == len(ids) else []


def _find_noise(place: str) -> float:
    """Absolute difference that counts as none; two forces make a difference in %."""
    return 100.0 * _NOISE if place.endswith(_PERCENT) else _NOISE


def _is_same(old: Any, new: Any, noise: float) -> bool:
    if all(isinstance(value, float) or type(value) is int for value in (old, new)):
        tolerance = SAME if noise else ROUNDING
        return math.isclose(old, new, rel_tol=tolerance, abs_tol=noise)
    return type(old) is type(new) and bool(old == new)
