"""File of measured structures, in the form of ``measured.toml``."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping
from importlib.resources import files as find_files
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from netdesign.addons.evidence.validation.structure import (
    INPUTS,
    ROPE_INPUTS,
    Span,
    Structure,
)
from netdesign.edge.causes import explain, explain_shape
from netdesign.edge.given_files import (
    MAX_TOML_BYTES,
    list_faults,
    parse_toml,
    read_bounded,
)
from netdesign.outcome import ModelError
from netdesign.words.message import Message, say

SCHEMA = "netdesign.measured/1"
_OWN = "measured.toml"
_MOST = 200  # structures


def read_structures(content: bytes) -> tuple[Structure, ...]:
    """Structures of a file.

    Parameters
    ----------
    content : bytes
        TOML in the form of ``measured.toml``.

    Raises
    ------
    ModelError
        If a field is missing, unknown, or out of its range; it is named.
    ValueError
        If it is no TOML.
    """
    document = parse_toml(content)
    if document.get("schema") != SCHEMA:
        raise ModelError(_tell("schema", f'"{SCHEMA}"'))
    tables = document.get("structure")
    if not isinstance(tables, list) or not 0 < len(tables) <= _MOST:
        raise ModelError(_tell("structure", "[[structure]]"))
    found = [_read_named(number, table) for number, table in enumerate(tables, 1)]
    for name, count in Counter(one.id for one in found).items():
        if count > 1:
            raise ModelError(_tell(f"id = {name!r:.60}", "structure.id: 1 x"))
    return tuple(found)


def _read_named(number: int, table: Any) -> Structure:
    """Structure; a refusal tells every fault, and names it by its id or number."""
    faults = list(_list_strange(table)) if isinstance(table, dict) else []
    try:
        structure = _READER.validate_python(table)
    except ValidationError as error:
        faults += [_describe(fault) for fault in error.errors()]
    else:
        faults += _list_odd(structure, table)
        if not faults:
            return structure
    name = table.get("id") if isinstance(table, dict) else None
    place = f"structure {name if isinstance(name, str) else number!s:.60}"
    raise ModelError(say("text.at_place", place=place, text=list_faults(faults)))


_READER = TypeAdapter(Structure)


def _describe(fault: Any) -> Message:
    value = fault["input"]
    shown = f" = {value!r:.100}" if isinstance(value, str | int | float) else ""
    place = ".".join(map(str, fault["loc"])) or "structure"
    return say("scene_file.fault", place=place, value=shown, fault=explain_shape(fault))


def _list_strange(table: Mapping[str, Any]) -> Iterator[Message]:
    """Inputs that a net does not have, and those that are missing."""
    given = table.get("inputs")
    if not isinstance(given, dict):
        return
    for name in sorted(given.keys() - {*INPUTS, *ROPE_INPUTS}):
        yield _tell(f"inputs.{name}", ", ".join(INPUTS))
    missing = [name for name in INPUTS if name not in given]
    if missing or len(ROPE_INPUTS.keys() & given.keys()) == 1:
        yield _tell("inputs", ", ".join(missing or ROPE_INPUTS))


def _list_odd(structure: Structure, table: Mapping[str, Any]) -> Iterator[Message]:
    """Ranges that do not ascend or leave what is accepted; forces of no member."""
    if not structure.measured:
        yield _tell("measured", "[[structure.measured]]")
    for name, span in structure.inputs.items():
        yield from _list_odd_ends(name, span, table["inputs"][name])
    for force in structure.measured:
        if not force.members:
            yield _tell("members", "foot_anchor, uphill_guy, post ...")


def _list_odd_ends(
    name: str, span: Span, table: Mapping[str, Any]
) -> Iterator[Message]:
    """A value, or two ends in their order, within what is accepted."""
    if "value" in table and table.keys() & {"low", "high"}:
        yield _tell(name, "value, or low and high")
    if not span.low <= span.high:
        yield _tell(f"{name} = {span.low:g} .. {span.high:g}", "low <= high")
    low, high = (INPUTS | ROPE_INPUTS).get(name, (-math.inf, math.inf))
    for end in dict.fromkeys((span.low, span.high)):
        if not low <= end <= high:
            yield _tell(f"{name} = {end:g}", f"{low:g} .. {high:g}")


def _tell(field: str, accepted: str) -> Message:
    return say("measured.field", field=field[:_MOST], accepted=accepted)


def read_all(path: Path | None) -> tuple[Structure, ...]:
    """Structures of a file, if one is given, then those that come with the program.

    Parameters
    ----------
    path : Path or None
        Of an owner's file.

    Raises
    ------
    ModelError
        If the file cannot be read, or a field is missing, unknown or out of range.
    """
    own = read_structures(find_files(__package__).joinpath(_OWN).read_bytes())
    if path is None:
        return own
    try:
        return (*read_structures(read_bounded(path, MAX_TOML_BYTES)), *own)
    except (ModelError, OSError, ValueError) as error:
        told = say("text.at_place", place=str(path), text=explain(error))
        raise ModelError(told) from None
