"""A site as the program understands it: SI values, each with its source cell."""

from __future__ import annotations

import math
from collections.abc import Container, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from netdesign.checks import Approval, Declaration, GivenResistance
from netdesign.coupling.scene import is_overtopped
from netdesign.envelope.ranges import NO_RANGES, Case, Ranges
from netdesign.panel.inputs import Panel
from netdesign.resistance.ground import AnchorType
from netdesign.resistance.post import PostSection
from netdesign.resistance.steel import Link, Wear
from netdesign.site.assumed import Assumed
from netdesign.site.cells.cells import UNDECLARED, TextFormat
from netdesign.site.cells.findings import Finding
from netdesign.snow.ground import GroundLaw, build_ground_from_glide_factor
from netdesign.snow.snowpack import (
    Layer,
    compute_mean_density,
    compute_thickness,
    scale_layers,
)
from netdesign.structure.layout import SupportLayout
from netdesign.structure.members import EndMember, Member, NetPart
from netdesign.structure.row_position import Position
from netdesign.structure.splay import EndGuy, Guys
from netdesign.words.message import Message, Text, say

# What a row takes of a case, beside the usual three; glide if its ground slides.
_GLIDE = frozenset(("slip_length", "glide_factor"))
_OF_ROW = _GLIDE | {
    *("thickness", "snow_height", "upslope_length", "slack", "net_stiffness")
}


@dataclass(frozen=True, slots=True, kw_only=True)
class InputEcho:
    """One input as typed and as understood; for the report."""

    label: Text
    unit: str
    text: str  # as typed, "" for a default
    value: float | str  # as understood, in the unit above
    cell: str  # "Rows!C5", or "default"
    derivation: Text | None = None  # how it follows from what was typed


@dataclass(frozen=True, slots=True, kw_only=True)
class ReplacedCell:
    """A cell that is read as if another text were typed there: a what-if."""

    cell: str  # "Rows!P8"
    was: str  # as typed in the workbook, "" where nothing is
    now: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Resistance(GivenResistance):
    """Characteristic resistance of one member in one mode.

    ``value`` is None where the workbook gives none, and where it follows the demand,
    from ``dimensions``: of a base that slides, its coefficient of friction [-].
    """

    member: Member | EndMember | NetPart
    derivation: Message | None = None  # how it follows from dimensions
    dimensions: AnchorType | PostSection | Link | float | None = None
    buckling_length: float | None = None  # of a post, with which it was computed [m]
    drilled_length: float | None = None  # of an anchor, where given [m]
    ground: str = ""  # of an anchor type: where it was tested or computed; "" unknown
    wear: Wear | None = None  # of steel that corrodes
    # said where an assumption decides: between value and best, or without a best
    open: Message | None = None
    proof_limit: float | None = None  # of a test, by the tendon that it pulls [N]
    is_basis_assumed: bool = False  # how it is known is not given: as computed


@dataclass(frozen=True, slots=True, kw_only=True)
class RowEnd:
    """Members that hold a row of panels along itself, at its end.

    Attributes
    ----------
    guy_angle : float
        Between the end guy and the row [rad]; where none is given the largest.
    stiffnesses : tuple of tuple of float, shape (n, 4)
        EA that uphill guy, downhill guy, end guy and post there may have together [N].
    ropes_slide : bool or None
        The border ropes slide at the supports; None where it is not given: the worse
        of both counts.
    lateral_axis : float or None
        Of the lateral anchor against the slope [rad]; None where none is given.
    resistances : tuple of Resistance
        Of all ``END_MODES``, given or not, and what follows the demand.
    anchors : tuple of (EndMember, AnchorType)
        Those that have a type.
    """

    guy_angle: float
    stiffnesses: tuple[tuple[float, ...], ...] = ()
    ropes_slide: bool | None = None
    lateral_axis: float | None = None
    resistances: tuple[Resistance, ...]
    anchors: tuple[tuple[EndMember, AnchorType], ...] = ()

    @property
    def guy(self) -> EndGuy:
        """End guy in space."""
        return EndGuy(angle=self.guy_angle)

    def find_anchor_type(self, anchor: str) -> AnchorType | None:
        """Type of one of its anchors; None where it is not given."""
        return next(
            (anchor_type for member, anchor_type in self.anchors if member == anchor),
            None,
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class NetRow:
    """One row of nets. SI units; angles in radians.

    What ranges over the whole site has its severe end here.
    """

    id: str
    slope_angle: float
    snow_thickness: float  # normal to the slope
    upslope_length: float
    ground: GroundLaw
    net_height: float  # normal to the slope
    net_stiffness_per_m: float
    slack: float
    layout: SupportLayout
    # long tuples stay out of the hash, which cases are looked up by, not of equality
    resistances: tuple[Resistance, ...] = field(hash=False)
    inputs: tuple[InputEcho, ...] = field(default=(), hash=False)
    layers: tuple[Layer, ...] = ()  # from the ground up; empty: uniform snow
    post_count: int | None = None
    gap: float = math.inf  # free distance beside the row [m]; infinite for none given
    altitude: float | None = None  # [m]
    ground_type: str = ""  # where its anchors stand; "" where not given
    design_life: int = 100  # [years]
    glide_factor: float | None = None  # as typed, of sliding ground
    guys: Guys = field(default_factory=Guys)
    has_row_above: bool = True  # built alike, the upslope length away
    # of anchors, where given [rad]; others are drilled along the pull
    axes: tuple[tuple[Member, float], ...] = ()
    # those that have a type
    anchors: tuple[tuple[Member, AnchorType], ...] = field(default=(), hash=False)
    # of the first and last support; None: those of all others
    end_resistances: tuple[Resistance, ...] | None = field(default=None, hash=False)
    end_anchors: tuple[tuple[Member, AnchorType], ...] | None = field(
        default=None, hash=False
    )
    # Between two posts, as they may be built, of which the worst counts: no cell says
    # the cut of a net.
    panels: tuple[Panel, ...] = ()
    row_end: RowEnd | None = None  # of a row with panel and end
    # mesh, and border ropes where there are some
    net_parts: tuple[Resistance, ...] = field(default=(), hash=False)
    ranges: Ranges = NO_RANGES  # in the place of those of the site
    assumed: tuple[Assumed, ...] = field(default=(), hash=False)  # of empty columns
    # numbers that can hardly be meant, on which it rests: it is not proven
    questions: tuple[Message, ...] = field(default=(), hash=False)
    approval: Approval | None = None  # of its net type

    def find_assumed(self, key: str) -> Assumed | None:
        """What is assumed of an empty column; None where it is given."""
        return next((assumed for assumed in self.assumed if assumed.key == key), None)

    def find_axis(self, anchor: str) -> float | None:
        """Given inclination of an anchor's axis [rad]."""
        if anchor == EndMember.LATERAL_ANCHOR:
            return self.row_end.lateral_axis if self.row_end else None
        return next((axis for member, axis in self.axes if member == anchor), None)

    def find_anchor_type(
        self, anchor: str, position: Position = "intermediate"
    ) -> AnchorType | None:
        """Type of an anchor; None where it is not given."""
        if self.row_end is not None and anchor in tuple(EndMember):
            return self.row_end.find_anchor_type(anchor)
        at_end = position == "edge" and self.end_anchors is not None
        types = self.end_anchors or () if at_end else self.anchors
        return next(
            (anchor_type for member, anchor_type in types if member == anchor), None
        )

    def list_missing_bore(self, anchor: str, position: Position) -> tuple[Message, ...]:
        """Name of an anchor's drilled length, where it is not given."""
        anchor_type = self.find_anchor_type(anchor, position)
        is_given = anchor_type is not None and anchor_type.drilled is not None
        name = say("column.anchor_types.drilled_length")
        column = say("check.on_sheet", name=name, sheet=say("sheet.anchor_types"))
        return () if is_given else (column,)

    @property
    def length(self) -> float | None:
        """Length from the first post to the last [m]; None without their number."""
        count = self.post_count
        return None if count is None else (count - 1.0) * self.layout.post_spacing

    @property
    def has_end(self) -> bool:
        """Whether the row has an end: not where the next work goes on without a gap."""
        return self.gap > 0.0

    def resistances_at(self, position: Position) -> tuple[Resistance, ...]:
        """Resistances of a support inside the row, or of its first and last one."""
        if position == "edge" and self.end_resistances is not None:
            return self.end_resistances
        return self.resistances

    def has_same_type_at_end(self, member: str) -> bool:
        """Whether a member is of one type at the row's end and inside it."""
        places = (self.resistances, self.resistances_at("edge"))
        inside, end = (
            {
                resistance.type_id
                for resistance in resistances
                if resistance.member == member
            }
            for resistances in places
        )
        return inside == end and "" not in inside

    @property
    def is_overtopped(self) -> bool:
        """Whether the snow is thicker than the net is high."""
        return is_overtopped(self.net_height, self.snow_thickness)

    @property
    def held_thickness(self) -> float:
        """Thickness of the snow that is solved [m]: all of it, or up to the head."""
        return self.net_height if self.is_overtopped else self.snow_thickness

    @property
    def mean_density(self) -> float:
        """Mean density of layered snow [kg/m3]."""
        return compute_mean_density(self.layers)

    def layers_at(self, density: float) -> tuple[Layer, ...]:
        """Layers scaled to a mean density [kg/m3] and to the thickness that is solved.

        None for uniform snow; density and thickness keep their proportions.
        """
        if not self.layers:
            return ()
        return scale_layers(self.layers, self.held_thickness, density)

    def at(self, case: Case) -> NetRow:
        """Row with the values of a case in the place of its own.

        Raises
        ------
        ValueError
            If a quantity of the case has no place in a row: a fault of the program.
        """
        values = dict(case.others)
        if not values:
            return self
        can_glide = self.ground.kind == "sliding" or self.glide_factor is not None
        unknown = values.keys() - (_OF_ROW if can_glide else _OF_ROW - _GLIDE)
        if unknown:
            raise ValueError(f"a net row does not take {sorted(unknown)} of a case")
        if "snow_height" in values:
            height = values["snow_height"]
            values["thickness"] = compute_thickness(height, self.slope_angle)
        row = replace(
            self,
            snow_thickness=values.get("thickness", self.snow_thickness),
            upslope_length=values.get("upslope_length", self.upslope_length),
            slack=values.get("slack", self.slack),
            net_stiffness_per_m=values.get("net_stiffness", self.net_stiffness_per_m),
            glide_factor=values.get("glide_factor", self.glide_factor),
        )
        return replace(row, ground=row._find_ground(values))

    def _find_ground(self, values: Mapping[str, float]) -> GroundLaw:
        """Ground of a case: of its slip length, or of a factor and its thickness."""
        if "slip_length" in values:
            return GroundLaw(kind="sliding", slip_length=values["slip_length"])
        is_other = "thickness" in values or "glide_factor" in values
        if self.glide_factor is None or not is_other:
            return self.ground
        return build_ground_from_glide_factor(self.glide_factor, self.snow_thickness)


@dataclass(frozen=True, slots=True, kw_only=True)
class Project:
    """Identification printed on every output.

    The documents say where snow heights, glide factors and the ground come from.
    """

    name: str = ""
    number: str = ""
    author: str = ""
    checker: str = ""
    revision: str = ""
    standard: str = ""
    snow_document: str = ""
    glide_document: str = ""
    ground_document: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Site:
    """Everything read from one workbook."""

    project: Project
    ranges: Ranges
    rows: tuple[NetRow, ...]
    file_name: str
    sha256: str
    notes: tuple[Message, ...] = ()  # e.g. columns that were not understood
    findings: tuple[Finding, ...] = ()  # the same, with their cells
    range_inputs: tuple[InputEcho, ...] = ()
    project_cells: Mapping[str, str] = field(default_factory=dict)
    declared: tuple[Declaration, ...] = ()
    confirmed: tuple[str, ...] = ()  # cells of numbers, on sheet Declared
    map_file: str = ""  # answers to headings, where there are any
    map_sha256: str = ""
    library_file: str = ""  # of further net types, where there is one
    library_sha256: str = ""
    text_format: TextFormat = UNDECLARED  # with which the file was read
    catalogue: tuple[Resistance, ...] = ()  # of every type, whether used or not
    links: Mapping[str, tuple[Link, ...]] = field(default_factory=dict)  # by type
    what_if: tuple[ReplacedCell, ...] = ()  # empty: the site as its workbook has it
    left_out: tuple[str, ...] = ()  # ids of net rows that are not to be checked
    # what add-ons read, by sheet
    of_addons: Mapping[str, Any] = field(default_factory=dict)

    def take_rows(self, ids: Container[str]) -> Site:
        """Site with some of its net rows; it says which were left out."""
        kept = tuple(row for row in self.rows if row.id in ids)
        left_out = tuple(row.id for row in self.rows if row.id not in ids)
        return replace(self, rows=kept, left_out=(*self.left_out, *left_out))

    def at_row(self, row: NetRow) -> Site:
        """Site with the ranges that count for one of its rows."""
        if not row.ranges.intervals:
            return self
        return replace(self, ranges=self.ranges.replaced_by(row.ranges))

    @property
    def questions(self) -> tuple[Message, ...]:
        """Numbers that can hardly be meant; their net rows are not proven."""
        questions = (
            finding for finding in self.findings if finding.severity == "question"
        )
        return tuple(finding.message for finding in questions)

    def find_declaration(
        self, row: NetRow, member: str, mode: str, position: str = ""
    ) -> Declaration | None:
        """Declaration of a check of a net row; None if there is none.

        ``position`` is that of its support. A declaration without a position does not
        hold for an anchor of another type at the row's end.
        """
        by_position = {
            declaration.position: declaration
            for declaration in self.declared
            if declaration.row_id in ("", row.id)
            and (declaration.member, declaration.mode) == (member, mode)
        }
        if position != "edge":
            return by_position.get("")
        general = by_position.get("") if row.has_same_type_at_end(member) else None
        return by_position.get("edge", general)
