"""JSON of documents: written without control signs, read within bounds of size."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields, is_dataclass
from functools import cache, lru_cache
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

from netdesign.outcome import ContentError
from netdesign.words.message import say

if TYPE_CHECKING:  # slow to import and only needed to read a document
    from pydantic import TypeAdapter
    from pydantic_core import CoreSchema

# A study of as many net rows and cases as a site may have (``site/cells/cells.py``,
# ``envelope/ranges.py``), with some room: a row has up to 450 kB, 17,000 values and
# 3,200 objects, a case 520 bytes, 13 values and 2 objects.
MAX_JSON_BYTES = 704 * 2**20
MAX_VALUES = 24_000_000
MAX_OBJECTS = 5_000_000
_SMALL = 20_000  # values
_MOST_KEYS = 200  # of one object
_NEXT = ",\n"  # between items


def write_json(document: object) -> str:
    """JSON text, each item on a line; letters of every language stay as they are.

    Signs that would steer a terminal or turn the direction of writing become codes. A
    dataclass is an object with its fields in their order. Lines are not indented: only
    without does ``json`` write in C, five times faster.

    pydantic spells numbers otherwise, and not alike from version to version (1e-07 as
    1e-7, 1e+22 as 1e22); studies have the same bytes.

    >>> write_json("\\x9b2J")
    '"\\\\u009b2J"'
    """
    text = json.dumps(
        document,
        ensure_ascii=False,
        allow_nan=False,
        check_circular=False,  # what is written is made of frozen values
        separators=(_NEXT, ": "),
        default=list_fields,
    )
    if text.replace("\n", "").isprintable():
        return text
    return "".join(
        sign if sign.isprintable() or sign == "\n" else json.dumps(sign)[1:-1]
        for sign in text
    )


def join_items(parts: Sequence[str]) -> str:
    """List of texts that `write_json` made."""
    return f"[{_NEXT.join(parts)}]"


def join_members(parts: Mapping[str, str]) -> str:
    """Object with such texts by their keys."""
    members = (f"{json.dumps(key)}: {text}" for key, text in parts.items())
    return f"{{{_NEXT.join(members)}}}"


def hash_values(text: str) -> str:
    """SHA-256 of the values of a JSON text: 2 and 2.0 are one number, spaces none."""
    values = json.dumps(json.loads(text, parse_int=float), check_circular=False)
    return hashlib.sha256(values.encode()).hexdigest()


def list_fields(value: Any) -> dict[str, Any]:
    """Fields of a dataclass as they are, not copies of all that is in them.

    Of a mapping that cannot be changed, its members. Of a class with
    ``LEAVES_OUT_NONE`` no field that is None: none at all, or none of those it names.
    Of one with ``WRITTEN`` also these properties, which follow from its fields.

    Raises
    ------
    TypeError
        If the value is something else, which JSON does not have.
    """
    if isinstance(value, MappingProxyType):
        return dict(value)
    if not is_dataclass(value):
        raise TypeError(f"{type(value).__name__} is not JSON serializable")
    kind: Any = type(value)
    names = (*_name_fields(kind), *getattr(kind, "WRITTEN", ()))
    values = {name: getattr(value, name) for name in names}
    leaves_out = getattr(value, "LEAVES_OUT_NONE", ())
    if not leaves_out:
        return values
    named = values if leaves_out is True else leaves_out
    return {
        name: entry
        for name, entry in values.items()
        if entry is not None or name not in named
    }


@cache
def _name_fields(kind: Any) -> tuple[str, ...]:
    return tuple(field.name for field in fields(kind))


class _FirstFault:
    """A list is read up to its first fault: each fault costs kilobytes."""

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> CoreSchema:
        """Schema that pydantic asks for."""
        from pydantic import FailFast

        schema: CoreSchema = handler.generate_schema(Annotated[source, FailFast()])
        return schema


Item = TypeVar("Item")
Drop = Callable[[Any], bool]
Items = Annotated[list[Item], _FirstFault()]  # a list of a document


def read_json(shape: type, text: str, drop: Drop = lambda _: False) -> Any:
    """Value of a dataclass from its JSON text.

    ``drop`` takes out of the document what is written beside the fields, and tells
    whether there was any: a huge text that is no such document is not copied.

    Raises
    ------
    ValidationError
        If the text is no JSON, or not of this shape.
    ValueError
        If it holds too much, is nested too deep, or has a key twice in one object.
    """
    values = require_few_values(text)
    # a validator copies the whole document for each key that it misses
    needed = {x.name for x in fields(shape) if x.default is x.default_factory}
    text = _inspect(text, drop, needed if values > _SMALL else set())
    return restore_json(shape, text)


def require_few_values(text: str) -> int:
    """Number of values of a JSON text, about.

    Raises
    ------
    ContentError
        If it holds more than a study of the largest site.
    """
    values = text.count(",")
    if values > MAX_VALUES or text.count("{") > MAX_OBJECTS:
        raise ContentError(
            say("file.holds_more", values=MAX_VALUES, objects=MAX_OBJECTS)
        )
    return values


def restore_json(shape: type, text: str) -> Any:
    """Value of a dataclass from a text that `write_json` made of one, under seal.

    Raises
    ------
    ValidationError
        If the text is not of this shape.
    """
    return _build_validator(shape).validate_json(text)


def _inspect(text: str, drop: Drop, needed: set[str]) -> str:
    """Text without the keys that ``drop`` removes; a key that is twice is refused."""

    def note_keys(pairs: list[tuple[str, object]]) -> dict[str, object]:
        if len(pairs) > _MOST_KEYS:
            raise ContentError(say("file.many_keys", most=_MOST_KEYS))
        keys = {key for key, _ in pairs}
        if len(keys) < len(pairs):
            raise ContentError(say("file.key_twice", keys=f"{sorted(keys)!r:.100}"))
        return dict(pairs)

    try:
        document = json.loads(text, object_pairs_hook=note_keys)
        if lacking := needed.difference(document if isinstance(document, dict) else ()):
            raise ContentError(say("file.lacks", keys=", ".join(sorted(lacking))))
        return json.dumps(document, check_circular=False) if drop(document) else text
    except RecursionError:
        raise ContentError(say("file.nested")) from None
    except json.JSONDecodeError:
        return text  # the validator says where


@lru_cache(maxsize=8)
def _build_validator(shape: type) -> TypeAdapter[Any]:
    from pydantic import TypeAdapter

    return TypeAdapter(shape)
