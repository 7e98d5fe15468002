"""Shape of the files of a limit profile; refuses what it does not know."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Literal, TypeVar

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    FiniteFloat,
    ValidationError,
    model_validator,
)
from pydantic_core import ErrorDetails

from netdesign.errors import StandardError

ACTION_FACTOR = "action.snow"
MIN_INCLINATION = "geometry.inclination.min"
MAX_INCLINATION = "geometry.inclination.max"
MODES = ("tendon", "pull_out", "rope", "compression")
BASES = ("tested", "computed", "declared")

LIMIT_IDS = (MIN_INCLINATION, MAX_INCLINATION)
# A factor of one mode, or of one mode on one basis: the closer one is used.
FACTOR_IDS = (
    ACTION_FACTOR,
    *(f"resistance.{mode}" for mode in MODES),
    *(f"resistance.{mode}.{basis}" for mode in MODES for basis in BASES),
)


def _limit_id(text: str) -> str:
    return _known(text, LIMIT_IDS)


def _factor_id(text: str) -> str:
    return _known(text, FACTOR_IDS)


def _known(text: str, accepted: Sequence[str]) -> str:
    if text not in accepted:
        message = f"must be one of {', '.join(accepted)}"
        raise ValueError(message)
    return text


class _Table(BaseModel):
    model_config = ConfigDict(
        extra="forbid", frozen=True, strict=True, str_strip_whitespace=True
    )


Text = Annotated[str, Field(min_length=1)]


class DocumentFile(_Table):
    """``document.toml``: which document this is, and what it is not."""

    id: Annotated[str, Field(pattern=r"^[a-z0-9][a-z0-9._-]*$")]
    title: Text
    edition: Text
    language: Text
    transcribed_by: Text
    checked_by: Text
    what_it_is: Text
    what_it_is_not: Text


class Entry(_Table):
    """One value: as printed, with clause, source and how well it is known."""

    id: Text
    clause: Text  # "-" where there is none
    text: Text
    value: Annotated[FiniteFloat, Field(gt=0)]
    unit: Text
    status: Literal["read", "secondary", "assumed", "user"]
    source: Text


class LimitEntry(Entry):
    """A limit of geometry."""

    id: Annotated[str, AfterValidator(_limit_id)]
    unit: Literal["deg"]


class FactorEntry(Entry):
    """A partial factor on actions or resistances."""

    id: Annotated[str, AfterValidator(_factor_id)]
    unit: Literal["-"]


class LimitsFile(_Table):
    """``limits.toml``: ``[[limit]]`` tables; ``limit = []`` if there are none."""

    limit: list[LimitEntry]

    @model_validator(mode="after")
    def _check(self) -> LimitsFile:
        _require_unique(self.limit)
        by_id = {entry.id: entry.value for entry in self.limit}
        if by_id and set(by_id) != set(LIMIT_IDS):
            message = f"{' and '.join(LIMIT_IDS)} are only accepted together"
            raise ValueError(message)
        if by_id and not by_id[MIN_INCLINATION] < by_id[MAX_INCLINATION]:
            message = f"{MIN_INCLINATION} must be less than {MAX_INCLINATION}"
            raise ValueError(message)
        return self


class FactorsFile(_Table):
    """``factors.toml``: ``[[factor]]`` tables; ``factor = []`` if there are none."""

    factor: list[FactorEntry]

    @model_validator(mode="after")
    def _check(self) -> FactorsFile:
        _require_unique(self.factor)
        return self


def _require_unique(entries: Sequence[Entry]) -> None:
    ids = [entry.id for entry in entries]
    twice = sorted({name for name in ids if ids.count(name) > 1})
    if twice:
        message = f"each id may stand once; twice or more: {', '.join(twice)}"
        raise ValueError(message)


FileT = TypeVar("FileT", DocumentFile, LimitsFile, FactorsFile)


def check_table(
    shape: type[FileT], table: Mapping[str, object], file_name: str
) -> FileT:
    """Check a parsed TOML file against its shape.

    Parameters
    ----------
    shape : type
        One of the three file models of this module.
    table : mapping
        What the TOML parser gave.
    file_name : str
        Name for messages.

    Returns
    -------
    DocumentFile, LimitsFile or FactorsFile
        The checked file; values as printed, in the unit that stands beside them.

    Raises
    ------
    StandardError
        If anything is missing, unknown or out of range; names file, key, value and
        what is accepted, all at once.
    """
    try:
        return shape.model_validate(table)
    except ValidationError as error:
        lines = [_describe(shape, detail) for detail in error.errors()]
        message = "\n".join(f"{file_name}: {line}" for line in lines)
        raise StandardError(message) from None


def _describe(shape: type[BaseModel], detail: ErrorDetails) -> str:
    """One line from one complaint: where, what is accepted, what stands there."""
    place = " ".join(_name(part) for part in detail["loc"]) or "whole file"
    if detail["type"] == "extra_forbidden":
        known = shape.model_fields if len(detail["loc"]) == 1 else Entry.model_fields
        return f"{place}: unknown key; accepted are {', '.join(known)}"
    if detail["type"] == "missing":
        return f"{place}: is missing"
    message = detail["msg"].removeprefix("Value error, ")
    if detail["type"] == "value_error" and not detail["loc"]:
        return f"{place}: {message}"
    return f"{place} = {detail['input']!r}: {message}"


def _name(part: str | int) -> str:
    return f"entry {part + 1}" if isinstance(part, int) else f"'{part}'"
