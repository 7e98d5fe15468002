"""Measured structures as data: what was measured, what is known, what only ranges.

The file's form is that of ``measured.toml``. A structure whose inputs are all values
gets a misfit; one with any range gets a plausibility band.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from netdesign.edge.given_files import parse_toml
from netdesign.errors import ModelError
from netdesign.words.message import say

SCHEMA = "netdesign.measured/1"
KINDS = ("net", "wall")
MARKS = ("read", "assumed", "unknown", "measured")
_WALL = (
    "slope_deg",
    "net_height_m",
    "filled",
    "density_kg_m3",
    "upslope_length_m",
    "glide_factor",
    "inclination_deg",
    "friction_deg",
)
_NET = (
    *_WALL,
    "slack",
    "stiffness_kN_per_m",
    "post_spacing_m",
    "uphill_anchor_ratio",
)
_ROPE = ("rope_stiffness_kN", "rope_sag")  # both, for the ropes between posts
ALONG_SLOPE = "along_slope"  # of a wall, per metre
_MOST = 200  # structures, and characters of a name


@dataclass(frozen=True, slots=True, kw_only=True)
class Span:
    """Knowledge of one input: a value, or a range with its reason."""

    low: float
    high: float
    mark: str
    reason: str = ""

    @property
    def is_known(self) -> bool:
        """One value, not a range."""
        return self.low == self.high

    def at(self, share: float) -> float:
        """Value at a share of the range, 0 to 1."""
        return self.low + share * (self.high - self.low)


@dataclass(frozen=True, slots=True, kw_only=True)
class Measurement:
    """One measured force, and the members of the model that it may be."""

    name: str
    members: tuple[str, ...]
    value: float  # [kN], or [kN/m] of a wall
    uncertainty: float  # the same unit; 0 where none is stated
    mark: str
    note: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Structure:
    """One measured structure.

    Attributes
    ----------
    id, title, kind, source, note : str
        What it is, "net" or "wall", and where that stands.
    measured : tuple of Measurement
        Forces.
    inputs : mapping of str to Span
        By the names of the file.
    open : tuple of str
        What is not known, and the public document that would close it.
    """

    id: str
    title: str
    kind: str
    source: str
    measured: tuple[Measurement, ...]
    inputs: Mapping[str, Span]
    note: str = ""
    open: tuple[str, ...] = ()

    @property
    def is_known(self) -> bool:
        """Every input has a value: a misfit has a meaning."""
        return all(span.is_known for span in self.inputs.values())

    @property
    def has_ropes(self) -> bool:
        """The ropes between the posts are given."""
        return set(_ROPE) <= self.inputs.keys()


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
        raise _refuse("schema", f'"{SCHEMA}"')
    tables = document.get("structure")
    if not isinstance(tables, list) or not 0 < len(tables) <= _MOST:
        raise _refuse("structure", "[[structure]]")
    found = [_read_named(number, one) for number, one in enumerate(tables, 1)]
    for name, count in Counter(one.id for one in found).items():
        if count > 1:
            raise _refuse(f"id = {name!r:.60}", "structure.id: 1 x")
    return tuple(found)


def _read_named(number: int, table: Any) -> Structure:
    """Structure; a refusal names it by its id, else by its number."""
    try:
        return _read_structure(table)
    except ModelError as error:
        name = table.get("id") if isinstance(table, dict) else None
        place = f"structure {name if isinstance(name, str) else number!s:.60}"
        raise ModelError(
            say("text.at_place", place=place, text=error.message)
        ) from None


def _refuse(field: str, accepted: str) -> ModelError:
    return ModelError(say("measured.field", field=field[:_MOST], accepted=accepted))


def _read_structure(table: Any) -> Structure:
    if not isinstance(table, dict):
        raise _refuse("structure", "[[structure]]")
    known = {"id", "title", "kind", "source", "note", "open", "measured", "inputs"}
    _require_known(table, known, "structure")
    kind = _text(table, "kind")
    if kind not in KINDS:
        raise _refuse("kind", ", ".join(KINDS))
    inputs = table.get("inputs")
    if not isinstance(inputs, dict):
        raise _refuse("inputs", "[structure.inputs]")
    wanted = _NET if kind == "net" else _WALL
    _require_known(inputs, {*wanted, *(_ROPE if kind == "net" else ())}, "inputs")
    missing = [name for name in wanted if name not in inputs]
    if missing or len(set(_ROPE) & inputs.keys()) == 1:
        raise _refuse("inputs", ", ".join(missing or _ROPE))
    measured = table.get("measured")
    if not isinstance(measured, list) or not measured:
        raise _refuse("measured", "[[structure.measured]]")
    remarks = table.get("open", [])
    if not isinstance(remarks, list) or not all(isinstance(r, str) for r in remarks):
        raise _refuse("open", "texts")
    return Structure(
        id=_text(table, "id"),
        title=_text(table, "title"),
        kind=kind,
        source=_text(table, "source"),
        note=_text(table, "note", ""),
        open=tuple(remarks),
        measured=tuple(_read_measurement(one, kind) for one in measured),
        inputs={name: _read_span(name, one) for name, one in inputs.items()},
    )


def _read_measurement(table: Any, kind: str) -> Measurement:
    if not isinstance(table, dict):
        raise _refuse("measured", "[[structure.measured]]")
    unit = "kN" if kind == "net" else "kN_per_m"
    known = {"name", "members", f"value_{unit}", f"uncertainty_{unit}", "mark", "note"}
    _require_known(table, known, "measured")
    members = table.get("members")
    if not isinstance(members, list) or not members:
        raise _refuse("members", "foot_anchor, uphill_guy, post ...")
    return Measurement(
        name=_text(table, "name"),
        members=tuple(str(one) for one in members),
        value=_number(table, f"value_{unit}"),
        uncertainty=_number(table, f"uncertainty_{unit}", 0.0),
        mark=_read_mark(table),
        note=_text(table, "note", ""),
    )


def _read_span(name: str, table: Any) -> Span:
    if not isinstance(table, dict):
        raise _refuse(name, "{ value = 1.0, mark = ... }")
    _require_known(table, {"value", "low", "high", "mark", "reason"}, name)
    if "value" in table:
        low = high = _number(table, "value")
    else:
        low, high = _number(table, "low"), _number(table, "high")
    if not low <= high:
        raise _refuse(name, "low <= high")
    return Span(
        low=low, high=high, mark=_read_mark(table), reason=_text(table, "reason", "")
    )


def _read_mark(table: dict[str, Any]) -> str:
    mark = _text(table, "mark")
    if mark not in MARKS:
        raise _refuse("mark", ", ".join(MARKS))
    return mark


def _require_known(table: dict[str, Any], known: set[str], place: str) -> None:
    for name in table.keys() - known:
        raise _refuse(f"{place}.{name}", ", ".join(sorted(known)))


def _text(table: dict[str, Any], name: str, default: str | None = None) -> str:
    value = table.get(name, default)
    if not isinstance(value, str):
        raise _refuse(name, '"..."')
    return value


def _number(table: dict[str, Any], name: str, default: float | None = None) -> float:
    value = table.get(name, default)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise _refuse(name, "0.0 ...")
    if not math.isfinite(value) or value < 0.0:
        raise _refuse(name, "0.0 ...")
    return float(value)
