"""Measured structures as data: what was measured, what is known, what only ranges.

The file's form is that of ``measured.toml``. A structure whose inputs are all values
gets a misfit; one with any range gets a plausibility band.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Literal

from pydantic import AliasChoices, Field, TypeAdapter, ValidationError

from netdesign.edge.causes import explain_shape
from netdesign.edge.given_files import list_faults, parse_toml
from netdesign.outcome import ModelError
from netdesign.words.message import Message, say

SCHEMA = "netdesign.measured/1"
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
_MOST = 200  # structures
_UNITS = {"net": "kN", "wall": "kN_per_m"}  # of what is measured

Mark = Literal["read", "assumed", "unknown", "measured"]
_Number = Annotated[float, Field(ge=0, allow_inf_nan=False, strict=True)]


def _named(*names: str) -> Any:
    """Field under one of several names in the file."""
    return Field(validation_alias=AliasChoices(*names))


@dataclass(frozen=True, slots=True, kw_only=True)
class Span:
    """Knowledge of one input: a value, or a range with its reason."""

    __pydantic_config__: ClassVar = {"extra": "forbid"}
    low: Annotated[_Number, _named("low", "value")]
    high: Annotated[_Number, _named("high", "value")]
    mark: Mark
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

    __pydantic_config__: ClassVar = {"extra": "forbid"}
    name: str
    members: tuple[str, ...]
    # [kN], or [kN/m] of a wall; uncertainty 0 where none is stated
    value: Annotated[_Number, _named("value_kN", "value_kN_per_m")]
    mark: Mark
    uncertainty: Annotated[
        _Number, _named("uncertainty_kN", "uncertainty_kN_per_m")
    ] = 0.0
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

    __pydantic_config__: ClassVar = {"extra": "forbid"}
    id: str
    title: str
    kind: Literal["net", "wall"]
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
        structure = _READER.validate_python(table)
        _require_complete(structure, table)
    except ValidationError as error:
        told = list_faults([_describe(fault) for fault in error.errors()])
    except ModelError as error:
        told = error.message
    else:
        return structure
    name = table.get("id") if isinstance(table, dict) else None
    place = f"structure {name if isinstance(name, str) else number!s:.60}"
    raise ModelError(say("text.at_place", place=place, text=told))


_READER = TypeAdapter(Structure)


def _describe(fault: Any) -> Message:
    value = fault["input"]
    shown = f" = {value!r:.100}" if isinstance(value, str | int | float) else ""
    place = ".".join(map(str, fault["loc"])) or "structure"
    return say("scene_file.fault", place=place, value=shown, fault=explain_shape(fault))


def _require_complete(structure: Structure, table: Mapping[str, Any]) -> None:
    """Inputs and units are those of the kind, ranges ascend, forces have members."""
    is_net = structure.kind == "net"
    wanted, given = _NET if is_net else _WALL, structure.inputs.keys()
    for name in given - {*wanted, *(_ROPE if is_net else ())}:
        raise _refuse(f"inputs.{name}", ", ".join(wanted))
    missing = [name for name in wanted if name not in given]
    if missing or len(set(_ROPE) & given) == 1:
        raise _refuse("inputs", ", ".join(missing or _ROPE))
    for name, span in structure.inputs.items():
        _require_ascending(name, span, table["inputs"][name])
    if not structure.measured:
        raise _refuse("measured", "[[structure.measured]]")
    unit = _UNITS[structure.kind]
    for one, force in zip(table["measured"], structure.measured, strict=True):
        if not force.members:
            raise _refuse("members", "foot_anchor, uphill_guy, post ...")
        for name in one:
            if name.partition("_")[0] in ("value", "uncertainty") and (
                name.partition("_")[2] != unit
            ):
                raise _refuse(f"measured.{name}", f"value_{unit}, uncertainty_{unit}")


def _require_ascending(name: str, span: Span, table: Mapping[str, Any]) -> None:
    """A value, or two ends in their order."""
    if "value" in table and table.keys() & {"low", "high"}:
        raise _refuse(name, "value, or low and high")
    if not span.low <= span.high:
        raise _refuse(name, "low <= high")


def _refuse(field: str, accepted: str) -> ModelError:
    return ModelError(say("measured.field", field=field[:_MOST], accepted=accepted))
