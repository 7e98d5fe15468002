"""Shape of the files of a limit profile; unknown keys and values are refused."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, fields, is_dataclass
from importlib.resources import files
from typing import Annotated, Any, Literal, Self, TypeVar, get_args

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    FiniteFloat,
    Strict,
    ValidationError,
    model_validator,
)
from pydantic_core import ErrorDetails

from netdesign.edge.input_files import explain_shape
from netdesign.outcome import ContentError, StandardError
from netdesign.units import radian_from_degree
from netdesign.words.message import Message, say

ACTION_FACTOR = "action.snow"
UPLIFT_FACTOR = "action.uplift"  # EN 1997-1 UPL, of what lifts a post
# Least and largest value; both are given, or none.
INCLINATIONS = ("geometry.inclination.min", "geometry.inclination.max")
SLOPES = ("geometry.slope.min", "geometry.slope.max")
PLAUSIBLE_SLOPES = ("geometry.slope.plausible.min", "geometry.slope.plausible.max")
HEIGHT_RATIO = "geometry.height.ratio"
MAX_GAP = "geometry.gap.max"
GROUND_FRICTION = "geometry.spacing.ground_friction"
SPACING_CAP = "geometry.spacing.factor.max"
DIMENSIONING = "load.dimensioning"  # form of the guideline's load
LATERAL_SHARE = "lateral.share"
CORRELATION_MEAN = "correlation.tests.mean"
CORRELATION_LEAST = "correlation.tests.least"
GLIDE_FACTORS = ("glide.factor.north", "glide.factor.south")  # two exposures
ROPE_ANGLE = "anchor.angle.rope"
LEAST_DIP = "anchor.dip.min"  # of a bore below the horizontal, so that mortar fills it
ANCHOR_DISTANCE = "anchor.distance.min"
# eta of a post where snow glides least, and its growth with the glide factor.
POST_EFFICIENCY, POST_EFFICIENCY_GROWTH = "post.efficiency", "post.efficiency.per_glide"
# On the strength of the ground that an anchor may pull out with itself.
SOIL_COHESION, SOIL_FRICTION = "soil.cohesion", "soil.friction"
TEST_COUNT = "tests.count"  # of each anchor type in each ground
ACCEPTANCE_TEST = "test.acceptance"  # of every anchor; proof load over design force
MODES = (
    *("tendon", "pull_out", "rope", "compression", "bearing"),
    *("bending", "compression_bending", "sliding", "tension"),
    *("mesh", "connection", "wedge", "direction"),
)
BASES = ("tested", "computed", "declared")
# What no demand lies below: the guideline's load, or nothing.
Floor = Literal["guideline", "none"]
# How the pulls of two guys on one anchor are added.
SharedSum = Literal["vector", "scalar"]

# Accepted values of each file by their ids, with unit and bounds.
_VALUES: Mapping[str, Mapping[str, Mapping[str, Any]]] = tomllib.loads(
    files(__package__).joinpath("values.toml").read_text(encoding="utf-8")
)
LIMIT_UNITS = {name: value["unit"] for name, value in _VALUES["limits"].items()}
# The load model of a guideline.
MODEL_UNITS = {name: value["unit"] for name, value in _VALUES["model"].items()}
# Values by a count, such as the number of tests; the counts need no gap.
TABLE_COUNTS = {name: value["over"] for name, value in _VALUES["tables"].items()}
# What any document has, wide: beyond it a value is a slip, or it needs a reason.
VALUE_BOUNDS: Mapping[str, tuple[float, float]] = {
    name: value["bounds"] for part in _VALUES.values() for name, value in part.items()
}
_PAIRS = (INCLINATIONS, SLOPES, PLAUSIBLE_SLOPES)
# Values that are given all or none.
_GROUPS = (
    *_PAIRS,
    tuple(name for name in MODEL_UNITS if name.startswith("snow.")),
    tuple(name for name in MODEL_UNITS if name.startswith("end.")),
)
# A factor of one mode, or of one mode on one basis: the closer one is used.
FACTOR_IDS = (
    *(name for name in _VALUES["factors"] if name != "resistance"),
    *(f"resistance.{mode}" for mode in MODES),
    *(f"resistance.{mode}.{basis}" for mode in MODES for basis in BASES),
)


class _Table(BaseModel):
    model_config = ConfigDict(
        extra="forbid", frozen=True, strict=True, str_strip_whitespace=True
    )


Text = Annotated[str, Field(min_length=1)]
Status = Literal["read", "secondary", "assumed", "user"]


@dataclass(frozen=True, slots=True, kw_only=True)
class StandardValue:
    """One value of a profile, as its file has it.

    Attributes
    ----------
    id, clause, text, source : str
        What it is and where it comes from; clause "-" where there is none.
    value : float
        As printed, in ``unit``.
    unit : str
        Such as "deg", "m" or "-".
    status : str
        "read" in the document, from a "secondary" source, "assumed", or "user".
    reason_beyond : str
        Why it may lie beyond what any document has, as a factor below 1; else "".
    """

    id: Text
    clause: Text
    text: Text
    value: Annotated[FiniteFloat, Strict()]
    unit: Text
    status: Status
    source: Text
    reason_beyond: str = ""

    @property
    def value_si(self) -> float:
        """The value with degrees as radians; all else as printed."""
        return radian_from_degree(self.value) if self.unit == "deg" else self.value


def _is_of(units: Mapping[str, str]) -> AfterValidator:
    """Refuse a value whose id, unit or size is none that its file may have."""

    def check(entry: StandardValue) -> StandardValue:
        if entry.id not in units:
            raise ContentError(say("standard.id", id=entry.id, accepted=tuple(units)))
        if entry.unit != units[entry.id]:
            needed = units[entry.id]
            raise ContentError(
                say("standard.unit", unit=entry.unit, needed=needed, id=entry.id)
            )
        # some coefficients of a polynomial are negative
        if entry.value <= 0 and not entry.id.startswith("snow.creep."):
            raise ContentError(say("standard.above_zero", value=entry.value))
        _require_bounds(entry.id, entry.value, entry.reason_beyond)
        return entry

    return AfterValidator(check)


class TableRow(_Table):
    """Value [-] from one count to another, both included; ``to`` may be inf."""

    from_: Annotated[int, Field(ge=1, alias="from")]
    to: float
    value: Annotated[FiniteFloat, Field(gt=0)]


class StandardTable(_Table):
    """Values of a profile by a count, such as the number of tests, without a gap.

    Counts outside the rows have no value. ``over`` says what is counted; all else is
    as of a `StandardValue`.
    """

    id: Text
    clause: Text
    text: Text
    over: Text
    unit: Literal["-"]
    status: Status
    source: Text
    reason_beyond: str = ""
    rows: Annotated[list[TableRow], Field(min_length=1)]

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.id not in TABLE_COUNTS:
            accepted = tuple(TABLE_COUNTS)
            raise ContentError(say("standard.id", id=self.id, accepted=accepted))
        needed = TABLE_COUNTS[self.id]
        if self.over != needed:
            raise ContentError(say("standard.over", over=self.over, needed=needed))
        least = float(self.rows[0].from_)
        for number, row in enumerate(self.rows, 1):
            _require_bounds(self.id, row.value, self.reason_beyond)
            is_whole = row.to == math.inf or row.to.is_integer()
            if not (row.from_ == least <= row.to and is_whole):
                place = {"number": number, "start": row.from_, "end": row.to}
                raise ContentError(say("standard.row", **place, least=least))
            least = row.to + 1.0
        return self

    def find(self, count: int) -> float | None:
        """Value at a count [-]; None outside the table: no extrapolation."""
        values = (row.value for row in self.rows if row.from_ <= count <= row.to)
        return next(values, None)

    @property
    def values(self) -> tuple[StandardValue, ...]:
        """Each row as a value of its own, for lists: ``id[from]``."""
        least, most = find_bounds(self.id)
        return tuple(
            StandardValue(
                id=f"{self.id}[{row.from_}]",
                clause=self.clause,
                text=f"{self.text} {self.over.capitalize()}: {row.from_}"
                + (" and more" if row.to == math.inf else f" to {row.to:g}")
                * (row.to != row.from_),
                value=row.value,
                unit=self.unit,
                status=self.status,
                source=self.source,
                reason_beyond="" if least <= row.value <= most else self.reason_beyond,
            )
            for row in self.rows
        )


class LoadTable(_Table):
    """``load``: which load governs; "none" takes a floor away and is written."""

    floor: Floor = "guideline"
    maker: Literal["floor", "none"] = "floor"  # anchor forces that a net's maker states
    governs: Literal["larger", "guideline"] = "larger"  # of guideline and coupled force

    @model_validator(mode="after")
    def _check(self) -> Self:
        if (self.floor, self.governs) == ("none", "guideline"):
            raise ContentError(say("standard.nothing_governs"))
        return self


Checked = Literal["checked", "not checked"]


class ScopeTable(_Table):
    """``scope``: what a study checks beside posts, guys and anchors.

    What is not checked is told on the first page, with who must check it.
    """

    mesh: Checked = "checked"  # of the net, and its border ropes
    connections: Checked = "checked"  # links between ropes and anchors
    anchor_ground: Checked = "checked"  # cover of the bonds, distance to an edge
    corrosion: Checked = "checked"  # of anchors and ropes over the design life


class AnchorsTable(_Table):
    """``anchors``: how the pulls of two guys on one anchor are added."""

    sum: SharedSum = "vector"


NAME = r"^[a-z0-9][a-z0-9._-]*$"  # of a profile, and of a choice


class DocumentFile(_Table):
    """``document.toml``: which document this is, and what it is not."""

    id: Annotated[str, Field(pattern=NAME)]
    version: Annotated[str, Field(pattern=r"^[0-9]+(\.[0-9]+)*$")]
    title: Text
    edition: Text
    language: Text
    transcribed_by: Text
    checked_by: Text
    what_it_is: Text
    what_it_is_not: Text
    choice: str = ""  # one of those in choices.toml
    load: LoadTable = LoadTable()
    scope: ScopeTable = ScopeTable()
    anchors: AnchorsTable = AnchorsTable()


class _ListTable(_Table):
    """A table with lists of values."""

    model_config = ConfigDict(strict=False)  # or values have to be made before


Factor = Annotated[StandardValue, _is_of(dict.fromkeys(FACTOR_IDS, "-"))]


class ChoiceTable(_ListTable):
    """A named set of factors and tables that take the place of their namesakes.

    ``without`` names factors that the set does not have.
    """

    name: Annotated[str, Field(pattern=NAME)]
    text: Text
    factor: list[Factor]
    table: list[StandardTable] = []
    without: list[str] = []

    @model_validator(mode="after")
    def _check(self) -> Self:
        for name in self.without:
            if name not in FACTOR_IDS:
                raise ContentError(say("standard.id", id=name, accepted=FACTOR_IDS))
        return self


class _ListFile(_ListTable):
    """A file with one list, whose entries have ids or names of their own."""

    @model_validator(mode="after")
    def _check(self) -> Self:
        (entries,) = (getattr(self, key) for key in type(self).model_fields)
        ids = [getattr(entry, "id", None) or entry.name for entry in entries]
        twice = tuple(sorted({name for name in ids if ids.count(name) > 1}))
        if twice:
            raise ContentError(say("standard.twice", ids=twice))
        for group in _GROUPS:
            missing = tuple(name for name in group if name not in ids)
            if 0 < len(missing) < len(group):
                given = next(name for name in group if name in ids)
                raise ContentError(
                    say("standard.only_with", given=given, missing=missing)
                )
        values = {entry.id: entry.value for entry in entries if hasattr(entry, "value")}
        for least, most in _PAIRS:
            if least in values and not values[least] < values[most]:
                raise ContentError(say("standard.must_be_less", least=least, most=most))
        return self


class LimitsFile(_ListFile):
    """``limits.toml``: ``[[limit]]`` tables; ``limit = []`` if there are none."""

    limit: list[Annotated[StandardValue, _is_of(LIMIT_UNITS)]]


class FactorsFile(_ListFile):
    """``factors.toml``: ``[[factor]]`` tables; ``factor = []`` if there are none."""

    factor: list[Factor]


class ModelFile(_ListFile):
    """``model.toml``, optional: ``[[value]]`` tables of a guideline's load model."""

    value: list[Annotated[StandardValue, _is_of(MODEL_UNITS)]]


class TablesFile(_ListFile):
    """``tables.toml``, optional: ``[[table]]`` tables of values by a count."""

    table: list[StandardTable]


class ChoicesFile(_ListFile):
    """``choices.toml``, optional: ``[[choice]]`` tables, sets of factors by name."""

    choice: list[ChoiceTable]


def find_bounds(name: str) -> tuple[float, float]:
    """Least and largest value of an id that needs no reason, in its unit."""
    is_of_mode = name.startswith("resistance.")
    return VALUE_BOUNDS["resistance" if is_of_mode else name]


def _require_bounds(name: str, value: float, reason: str) -> None:
    """Refuse a value beyond what any document has, unless it says why."""
    low, high = find_bounds(name)
    if not (low <= value <= high or reason):
        key = "reason_beyond"
        raise ContentError(
            say("standard.beyond", id=name, value=value, low=low, high=high, key=key)
        )


FileT = TypeVar("FileT", bound=_Table)


def check_table(
    shape: type[FileT], table: Mapping[str, object], file_name: str
) -> FileT:
    """Check a parsed TOML file against its shape.

    Parameters
    ----------
    shape : type
        One of the file models of this module.
    table : mapping
        What the TOML parser gave.
    file_name : str
        Name for messages.

    Returns
    -------
    DocumentFile, LimitsFile, FactorsFile, ModelFile, TablesFile or ChoicesFile
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
        lines = [_describe(file_name, shape, detail) for detail in error.errors()]
        raise StandardError(say("text.lines", lines=tuple(lines))) from None


def _describe(file: str, shape: type[BaseModel], detail: ErrorDetails) -> Message:
    """One line from one complaint: where, what is accepted, what stands there."""
    parts = tuple(_name(part) for part in detail["loc"])
    place = say("standard.place", parts=parts or (say("standard.whole_file"),))
    if detail["type"] in ("extra_forbidden", "unexpected_keyword_argument"):
        keys = _list_keys(shape, detail)
        return say("standard.unknown_key", file=file, place=place, accepted=keys)
    if detail["type"] == "missing":
        return say("standard.missing_key", file=file, place=place)
    fault = explain_shape(detail)
    if detail["type"] == "value_error" and isinstance(detail["input"], Mapping):
        # a whole table: too long to repeat
        return say("standard.fault", file=file, place=place, fault=fault)
    value = repr(detail["input"])
    return say("standard.value_fault", file=file, place=place, value=value, fault=fault)


def _list_keys(shape: type[BaseModel], detail: ErrorDetails) -> tuple[str, ...]:
    """Keys accepted at the level of an unknown one."""
    at: Any = shape
    for part in detail["loc"][:-1]:
        at = at.model_fields[part].annotation if isinstance(part, str) else at
        while get_args(at):  # of a list, or of a value with its check
            at = get_args(at)[0]
    if is_dataclass(at):
        return tuple(field.name for field in fields(at))
    return tuple(field.alias or name for name, field in at.model_fields.items())


def _name(part: str | int) -> str | Message:
    if isinstance(part, int):
        return say("standard.entry", number=part + 1)
    return f"'{part}'"
