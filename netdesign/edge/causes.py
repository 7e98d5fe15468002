"""Causes that others raise, in words of ours where there are some."""

from __future__ import annotations

import errno
import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from netdesign.edge.given_files import is_held
from netdesign.outcome import ContentError, NetDesignError
from netdesign.words.message import Message, say

# Of the kinds that a system tells by number; others keep the system's words.
_OS_ERRORS = {
    getattr(errno, name): name
    for name in (
        *("ENOENT", "EACCES", "EISDIR", "ENOTDIR", "EEXIST", "ENOSPC", "EROFS"),
        *("ENAMETOOLONG", "EFBIG", "EIO", "ELOOP", "EPERM", "EBUSY"),
    )
}
# Faults of a value's shape by the name that pydantic gives them, and what they state.
_LIMITS = {
    "greater_than": "gt",
    "greater_than_equal": "ge",
    "less_than": "lt",
    "less_than_equal": "le",
}
_JSON_PLACE = re.compile(r"line (\d+) column (\d+)")
_PLAIN = (
    *("missing", "extra_forbidden", "finite_number", "float_type", "int_type"),
    *("bool_type", "string_type", "list_type", "dict_type"),
)
_ALIKE = {
    "float_parsing": "float_type",
    "int_parsing": "int_type",
    "int_from_float": "int_type",
    "bool_parsing": "bool_type",
    "unexpected_keyword_argument": "extra_forbidden",
    "model_type": "dict_type",
    "model_attributes_type": "dict_type",
    "dataclass_type": "dict_type",
}


def explain(error: BaseException) -> Message | str:
    """Cause of a failure: a message of ours, or the words of whoever raised it."""
    if isinstance(error, NetDesignError | ContentError):
        return error.message
    if isinstance(error, OSError) and error.strerror:
        return explain_system(error)
    return str(error)


def explain_system(error: OSError) -> Message | str:
    """Words of the system, without the file."""
    name = _OS_ERRORS.get(error.errno or 0)
    return say(f"os_error.{name}") if name else str(error.strerror)


def explain_with_file(error: OSError) -> Message | str:
    """Cause of a failure, with the file that the system names."""
    if error.filename is None:
        return explain(error)
    path = Path(os.fsdecode(error.filename))
    if is_held(error, path):
        return say("os_error.open_in_program", file=repr(str(path)))
    return say("os_error.at_file", cause=explain(error), file=repr(error.filename))


def _explain_literal(words: list[str]) -> Message:
    """Accepted values: words that pydantic lists in quotes."""
    if len(words) == 1:
        return say("shape.literal_one", expected=words[0])
    return say("shape.literal_error", some=tuple(words[:-1]), last=words[-1])


def explain_shape(fault: Mapping[str, Any]) -> Message | str:
    """Fault of a value: one of those that pydantic lists."""
    kind, context = fault["type"], fault.get("ctx", {})
    kind = _ALIKE.get(kind, kind)
    if kind in _LIMITS:
        return say(f"shape.{kind}", limit=context[_LIMITS[kind]])
    if kind in _PLAIN:
        return say(f"shape.{kind}")
    if kind == "json_invalid":
        line, column = _JSON_PLACE.findall(str(context["error"]))[-1]
        return say("shape.json_invalid", line=line, column=column)
    if kind == "literal_error":
        return _explain_literal(re.findall(r"'[^']*'", str(context["expected"])))
    if kind == "string_pattern_mismatch":
        return say("shape.string_pattern_mismatch", pattern=str(context["pattern"]))
    error = context.get("error")
    if isinstance(error, ContentError):
        return error.message
    return str(fault["msg"]).removeprefix("Value error, ")
