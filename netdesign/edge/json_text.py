"""JSON text that harms nobody: written without control signs, read with bounds."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import MISSING, dataclass, fields, is_dataclass
from functools import lru_cache
from json.encoder import encode_basestring
from math import isfinite
from operator import attrgetter
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

from netdesign.errors import ContentError
from netdesign.words.message import say

if TYPE_CHECKING:  # slow to import and only needed to read a document
    from pydantic import TypeAdapter
    from pydantic_core import SchemaValidator

# A study of as many net rows and cases as a site may have (``site/cells/limits.py``,
# ``envelope/ranges.py``), with some room: a row has up to 280 kB, 10,600 values and
# 1,600 objects, a case 520 bytes, 13 values and 2 objects.
MAX_JSON_BYTES = 384 * 2**20
MAX_VALUES = 14_000_000
MAX_OBJECTS = 2_100_000
_SMALL, _SMALL_TEXT = 20_000, 2 * 2**20  # values, signs
_FEW = 4  # values below which the encoder takes longer to set up than to write
_MOST_KEYS = 200  # of one object


def write_json(document: object, depth: int = 0) -> str:
    """JSON text, one value a line; letters of every language stay as they are.

    Signs that would steer a terminal or turn the direction of writing become codes. A
    dataclass is an object with its fields in their order. ``depth`` is the number of
    lists and objects that the text will stand in.

    >>> write_json("\\x9b2J")
    '"\\\\u009b2J"'
    """
    text = _write_value(document, _indent(depth))
    if text.replace("\n", "").isprintable():
        return text
    return "".join(
        sign if sign.isprintable() or sign == "\n" else json.dumps(sign)[1:-1]
        for sign in text
    )


def _indent(depth: int) -> str:
    """Line end, and the begin of the next line."""
    return "\n" + depth * " "


@dataclass(frozen=True, slots=True)
class JsonPart:
    """Part of a JSON document.

    Attributes
    ----------
    text : str
        As the document has it.
    values : str
        The same on one line and in ASCII, with every number as a float: equal for equal
        values, since 2 and 2.0 are one number and become one when a document is read.
    """

    text: str
    values: str


def write_part(value: object, depth: int) -> JsonPart:
    """Part of a document that stands in so many lists and objects."""
    text = write_json(value, depth)
    values = json.dumps(json.loads(text, parse_int=float), check_circular=False)
    return JsonPart(text, values)


def join_items(parts: Sequence[JsonPart], depth: int) -> JsonPart:
    """List of parts, itself in so many lists and objects."""
    return _join("[", [(one.text, one.values) for one in parts], "]", depth)


def join_members(parts: Mapping[str, JsonPart], depth: int) -> JsonPart:
    """Object with parts by their keys, itself in so many lists and objects."""
    pairs = [
        tuple(f"{_write_key(key)}: {one}" for one in (part.text, part.values))
        for key, part in parts.items()
    ]
    return _join("{", pairs, "}", depth)


def _join(
    opening: str, pairs: Sequence[tuple[str, ...]], closing: str, depth: int
) -> JsonPart:
    if not pairs:
        return JsonPart(opening + closing, opening + closing)
    margin, inside = _indent(depth), _indent(depth + 1)
    texts, values = zip(*pairs, strict=True)
    return JsonPart(
        f"{opening}{inside}{f',{inside}'.join(texts)}{margin}{closing}",
        f"{opening}{', '.join(values)}{closing}",
    )


def _write_value(value: Any, margin: str) -> str:
    """JSON of a value whose last line begins with ``margin``.

    The quick encoder knows no margins, but any separator: so it writes lists and
    objects of plain values, in which most of a document lies. pydantic would be
    quicker, but spells numbers otherwise, and not alike from version to version
    (1e-07 as 1e-7, 1e-05 as 0.00001, 1e+22 as 1e22); studies have the same bytes.
    """
    inside = f"{margin} "
    if not isinstance(value, dict | list | tuple):
        if not (is_dataclass(value) or isinstance(value, MappingProxyType)):
            return _build_encoder(inside).encode(value)
        value = list_fields(value)
    is_object = isinstance(value, dict)
    if not value:
        return "{}" if is_object else "[]"
    parts = value.values() if is_object else value
    if len(value) > _FEW and _PLAIN.issuperset(map(type, parts)):
        flat = _build_encoder(inside).encode(value)
        return f"{flat[0]}{inside}{flat[1:-1]}{margin}{flat[-1]}"
    written = [
        write(one) if (write := _WRITE.get(type(one))) else _write_value(one, inside)
        for one in parts
    ]
    if not is_object:
        return f"[{inside}{f',{inside}'.join(written)}{margin}]"
    members = [
        f"{_write_key(key)}: {text}" for key, text in zip(value, written, strict=True)
    ]
    return f"{{{inside}{f',{inside}'.join(members)}{margin}}}"


def _write_float(value: float) -> str:
    """Text as the encoder writes it, without what it sets up for each value."""
    return repr(value) if isfinite(value) else _build_encoder("").encode(value)


_WRITE: dict[type, Callable[[Any], str]] = {
    str: encode_basestring,
    float: _write_float,
    int: repr,
    bool: {True: "true", False: "false"}.__getitem__,
    type(None): lambda _: "null",
}
_PLAIN = frozenset(_WRITE)


@lru_cache(maxsize=1024, typed=True)
def _write_key(key: str) -> str:
    """Key as the encoder writes it, in quotes whatever it is."""
    return json.dumps({key: None}, ensure_ascii=False)[1 : -len(": null}")]


def list_fields(value: Any) -> dict[str, Any]:
    """Fields of a dataclass as they are; quicker than a copy of all that is in them.

    Of a mapping that cannot be changed, its members. A class with a true
    ``LEAVES_OUT_NONE`` has no field that is None.
    """
    if isinstance(value, MappingProxyType):
        return dict(value)
    shape: type = type(value)
    names, read, leaves_out = _open_shape(shape)
    pairs = zip(names, read(value), strict=True)
    if leaves_out:
        return {name: one for name, one in pairs if one is not None}
    return dict(pairs)


class _Shape(NamedTuple):
    """Names of a dataclass's fields, and what reads all their values."""

    names: tuple[str, ...]
    read: Callable[[object], Any]
    leaves_out_none: bool


@lru_cache(maxsize=256)
def _open_shape(shape: type) -> _Shape:
    names = tuple(one.name for one in fields(shape))
    leaves_out = bool(getattr(shape, "LEAVES_OUT_NONE", False))
    if len(names) > 1:
        return _Shape(names, attrgetter(*names), leaves_out)
    return _Shape(
        names, lambda value: [getattr(value, name) for name in names], leaves_out
    )


@lru_cache
def _build_encoder(margin: str) -> json.JSONEncoder:
    return json.JSONEncoder(
        ensure_ascii=False,
        allow_nan=False,
        check_circular=False,  # what is written is made of frozen values
        separators=(f",{margin}", ": "),
    )


def read_json(shape: type, text: str) -> Any:
    """Value of a dataclass from its JSON text.

    Of a small document all faults are told; of a large one the first of each list,
    since each fault costs a validator kilobytes.

    Raises
    ------
    ValidationError
        If the text is no JSON, or not of this shape.
    ValueError
        If it holds too much, is nested too deep, or has a key twice in one object.
    """
    values = text.count(",")
    if values > MAX_VALUES or text.count("{") > MAX_OBJECTS:
        raise ContentError(
            say("file.holds_more", values=MAX_VALUES, objects=MAX_OBJECTS)
        )
    keys = _inspect(text)
    if values <= _SMALL and len(text) <= _SMALL_TEXT:
        return _build_validator(shape).validate_json(text)
    strange = keys.symmetric_difference(field.name for field in fields(shape))
    strange -= {one.name for one in fields(shape) if one.default is not MISSING} - keys
    if strange:
        shown = ", ".join(sorted(strange))[:500]
        raise ContentError(say("file.unknown_or_missing", keys=shown))
    return _build_quick_validator(shape).validate_json(text)


def restore_json(shape: type, text: str) -> Any:
    """Value of a dataclass from a text that `write_json` made of one, under seal.

    Raises
    ------
    ValidationError
        If the text is not of this shape.
    """
    return _build_quick_validator(shape).validate_json(text)


def _inspect(text: str) -> set[str]:
    """Keys of the outermost object; an error where a text has two readings."""
    last: set[str] = set()

    def note_keys(pairs: list[tuple[str, object]]) -> None:
        nonlocal last
        if len(pairs) > _MOST_KEYS:
            raise ContentError(say("file.many_keys", most=_MOST_KEYS))
        last = {key for key, _ in pairs}
        if len(last) < len(pairs):
            raise ContentError(say("file.key_twice", keys=f"{sorted(last)!r:.100}"))

    try:
        json.loads(text, object_pairs_hook=note_keys)
    except RecursionError:
        raise ContentError(say("file.nested")) from None
    except json.JSONDecodeError:
        return set()  # the validator says where
    return last


@lru_cache(maxsize=8)
def _build_validator(shape: type) -> TypeAdapter[Any]:
    from pydantic import TypeAdapter

    return TypeAdapter(shape)


@lru_cache(maxsize=8)
def _build_quick_validator(shape: type) -> SchemaValidator:
    from pydantic import TypeAdapter
    from pydantic_core import SchemaValidator

    schema = TypeAdapter(shape).core_schema
    _stop_at_first_faults(schema)
    return SchemaValidator(schema)


def _stop_at_first_faults(schema: Any) -> None:
    if isinstance(schema, dict):
        if schema.get("type") == "list":
            schema["fail_fast"] = True
        for part in schema.values():
            _stop_at_first_faults(part)
    elif isinstance(schema, list | tuple):
        for part in schema:
            _stop_at_first_faults(part)
