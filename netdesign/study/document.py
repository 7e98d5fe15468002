"""A study as JSON text with its digest, and back; a faulty text is refused by place."""

from __future__ import annotations

import hashlib
import json
from collections import Counter
from collections.abc import Collection, Iterable, Mapping
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
    join_members,
    read_json,
    require_few_values,
    restore_json,
    write_part,
)
from netdesign.outcome import ContentError, StudyError
from netdesign.study.records import SCHEMA, RowStudy, Study
from netdesign.words.message import say

_OLD_SCHEMAS = ("netdesign.study/1", "netdesign.study/2", "netdesign.study/3")
# As a study without its digest has that line.
_OPEN_LINE = '\n"digest": ""'
_HOW_FAR = 200  # signs from the start, among which a document names its schema


def compute_digest(study: Study) -> str:
    """SHA-256 of a study without its own digest.

    It shows that a document is the one whose digest is printed in a report, or that it
    was altered by somebody who did not think of it. Who alters a document on purpose
    can compute it again: only a new solve shows that the numbers are true.
    """
    return hashlib.sha256(study.written.values.encode()).hexdigest()


def hash_text(text: str) -> str:
    """SHA-256 of a document as it is stored, without its own digest."""
    return _hash_parsed(json.loads(text, parse_int=float))


def _hash_parsed(document: dict[str, Any]) -> str:
    values = json.dumps({**document, "digest": ""}, check_circular=False)
    return hashlib.sha256(values.encode()).hexdigest()


def hash_results(study: Study) -> str:
    """SHA-256 of verdict and net rows: equal for equal results, whenever made."""
    results = {
        "verdict": write_part(study.verdict),
        "profile": write_part(study.profile.sha256),
        "rows": study.written_rows,
    }
    return hashlib.sha256(join_members(results).values.encode()).hexdigest()


def write_document(study: Study) -> str:
    """JSON text of a study, with its digest.

    Numbers stand in full, keys in the order of the fields.
    """
    # no text in the document has a line end of its own, so this line stands once
    digest = f'{_OPEN_LINE[:-1]}{compute_digest(study)}"'
    return study.written.text.replace(_OPEN_LINE, digest, 1)


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
    """Net row from the text that this program wrote of one.

    Raises
    ------
    ValueError
        If it is none.
    """
    row = json.loads(text)
    _drop_of_row(row)
    restored: RowStudy = restore_json(RowStudy, json.dumps(row, check_circular=False))
    return restored


def _drop_of_study(document: Any) -> bool:
    """Take out what is written beside the fields; any other key is refused then.

    False of what has none of it, and so is no study.
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
    """Members of an object without some of its keys; none of what is no object."""
    if not isinstance(part, dict):
        return []
    for name in names:
        part.pop(name, None)
    found = part.get(members)
    return found if isinstance(found, list) else []


def require_unaltered(study: Study, text: str) -> None:
    """Refuse a study that its text's digest is not of, or that says what is not so.

    The text holds what follows from the study's fields, too, and the digest is of both.

    Raises
    ------
    StudyError
        If one of them is another than was written.
    """
    if not study.digest == hash_text(text) == compute_digest(study):
        raise StudyError(say("stored.altered"))


def _require_sense(study: Study) -> None:
    """Refuse what has the right kind and is impossible all the same."""
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


# What reading another file than a study may end with.
_ODD = (
    *(OSError, ValueError, LookupError, TypeError, AttributeError),
    RecursionError,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredChecks:
    """Checks of some members from a stored study, with the site that they are of.

    Attributes
    ----------
    site_file, site_sha256 : str
        Of the site.
    rows : mapping of str to list of Check
        By the id of the net row.
    """

    site_file: str
    site_sha256: str
    rows: Mapping[str, list[Check]]


def load_checks(path: Path, members: Collection[str]) -> StoredChecks:
    """Checks of some members from a stored file, in a third of the time of all of it.

    Raises
    ------
    StudyError
        As `load_study` does.
    """
    try:
        text = decode_utf8(read_bounded(path, MAX_JSON_BYTES))
        require_few_values(text)
        document = json.loads(text, parse_int=float)
        if document["schema"] == SCHEMA and document["digest"] == _hash_parsed(
            document
        ):
            return _restore_checks(document, members)
    except (
        OSError,
        ValueError,
        LookupError,
        TypeError,
        AttributeError,
        RecursionError,
    ):
        pass
    load_study(path)  # it says what is wrong
    raise StudyError(say("study.unreadable", path=str(path), cause=SCHEMA))


def _restore_checks(document: Any, members: Collection[str]) -> StoredChecks:
    made = document["provenance"]
    rows = {}
    for row in document["rows"]:
        found = [one for one in row["checks"] if one["member"] in members]
        for one in found:
            _drop(one, Check.WRITTEN)
        texts = (json.dumps(one, check_circular=False) for one in found)
        rows[str(row["id"])] = [restore_json(Check, text) for text in texts]
    return StoredChecks(
        site_file=str(made["site_file"]),
        site_sha256=str(made["site_sha256"]),
        rows=rows,
    )
