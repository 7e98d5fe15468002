"""Effects that turn a solved force into those of the supports of a row."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import product

from netdesign.checks import Check, OpenKind, Standard
from netdesign.checks.comparison import leave_open
from netdesign.checks.schema import GLIDE_FACTORS, LATERAL_SHARE
from netdesign.envelope.ranges import USUAL, Case, Ranges
from netdesign.guideline.comparison import find_glide_factor
from netdesign.guideline.load_model import (
    compute_altitude_factor,
    load_guideline,
    read_end_effect,
    read_load_model,
)
from netdesign.numerics.arrays import Number
from netdesign.site.model import NetRow
from netdesign.snow.creep_law import CreepLaw
from netdesign.snow.ground import (
    DEFAULT_CREEP_LAW,
    LARGEST_GLIDE_FACTOR,
    GroundLaw,
    compute_slip_length,
    load_glide_tables,
)
from netdesign.structure.row_position import (
    LoadedWidth,
    compute_edge_width,
    list_supports,
)
from netdesign.words.message import Message, say


def list_corners(row: NetRow, ranges: Ranges) -> list[NetRow]:
    """Rows at all ends of what ranges beside the usual three and is in the load.

    The load knows no length of the snowpack.
    """
    names = [name for name in ranges.further if name != "upslope_length"]
    usual = {name: ranges[name].low for name in USUAL}
    ends = product(*({ranges[name].low, ranges[name].high} for name in names))
    return [
        row.at(Case.of({**usual, **dict(zip(names, one, strict=True))})) for one in ends
    ]


@dataclass(frozen=True, slots=True, kw_only=True)
class RowEffects:
    """Loaded widths and lateral load of the supports of a row.

    Attributes
    ----------
    supports : tuple of LoadedWidth
        One inside the row, and where the row has an end the one beside it and its
        first or last one.
    lateral_share : float
        Share of the load along the row [-].
    missing : tuple of Message
        What the profile does not say.
    end_lack : Message or None
        Why nothing is known of the forces at an end that the row has.
    """

    supports: tuple[LoadedWidth, ...]
    lateral_share: float
    missing: tuple[Message, ...]
    end_lack: Message | None = None

    def find_support(self, position: str) -> LoadedWidth:
        """Support at a position; the one inside the row where it has no other."""
        found = [one for one in self.supports if one.position == position]
        return (found or self.supports)[0]


def find_row_glide_factor(row: NetRow) -> float:
    """Glide factor by which the guideline loads a row; THEORY of the guideline.

    As typed [-], or that of its ground; never less than the least of the
    guideline's tables.
    """
    return find_glide_factors(row, row.snow_thickness)


def find_glide_factors(row: NetRow, snow_thickness: Number) -> Number:
    """Glide factor of a row under snow of another thickness, or of many [-]."""
    limits = load_glide_limits()
    if row.glide_factor is not None:
        return 0.0 * snow_thickness + max(row.glide_factor, limits[0])
    return find_glide_factor(row.ground, snow_thickness, limits)


def find_solved_ground(row: NetRow, law: CreepLaw) -> GroundLaw:
    """Ground that a row's forces are solved with; THEORY of the guideline, (G11).

    It slips at least as far as the least glide factor of the guideline's tables says,
    by the table of the creep law, or of the usual one where that has none.
    """
    if row.ground.kind == "free":
        return row.ground
    table = law.name if law.name in load_glide_tables() else DEFAULT_CREEP_LAW
    least = compute_slip_length(load_glide_limits()[0], row.snow_thickness, table)
    return GroundLaw(kind="sliding", slip_length=max(row.ground.slip_length, least))


def find_altitude_factor(row: NetRow) -> float:
    """Factor on the density of load case 1 at a row [-]; the largest if not known."""
    return compute_altitude_factor(read_load_model(load_guideline()), row.altitude)


def list_assumed(row: NetRow) -> list[Message]:
    """What the guideline's load takes for granted about a row."""
    found = []
    if row.altitude is None:
        found.append(say("row.altitude_assumed", factor=find_altitude_factor(row)))
    glide = row.glide_factor
    if glide is None:
        anything = (1.0, LARGEST_GLIDE_FACTOR)
        glide = find_glide_factor(row.ground, row.snow_thickness, anything)
    least = load_glide_limits()[0]
    if glide < least:
        found.append(say("row.glide_assumed", glide=glide, least=least))
    return found


@lru_cache(maxsize=1)
def load_glide_limits() -> tuple[float, float]:
    """Least and largest glide factor of the guideline's tables [-]."""
    tables = [one for one in load_guideline().tables if one.id in GLIDE_FACTORS]
    found = [value for table in tables for _, _, value in table.rows]
    return min(found), max(found)


def find_effects(row: NetRow, standard: Standard, ranges: Ranges) -> RowEffects:
    """Effects of the row's ends and of the load along the row, by the profile.

    At an end the largest N of all ranges counts; on ground of one slip length that is
    the N of the thinnest snow.
    """
    spacing = row.layout.post_spacing
    rule, share = read_end_effect(standard), standard.find(LATERAL_SHARE)
    edge = None
    if rule is not None and row.has_end:
        edge = compute_edge_width(
            rule,
            post_spacing=spacing,
            net_height=row.net_height,
            gap=row.gap,
            glide_factor=max(map(find_row_glide_factor, list_corners(row, ranges))),
        )
    lacks = [say("ends.no_end_effect")] if rule is None else []
    end_lack = lacks[0] if lacks and row.has_end else None
    if share is None:
        lacks.append(say("ends.no_lateral_load", value=LATERAL_SHARE))
    return RowEffects(
        supports=list_supports(spacing, edge, row.post_count),
        lateral_share=share.value if share else 0.0,
        missing=tuple(lacks),
        end_lack=end_lack,
    )


def check_ends(effects: RowEffects) -> Check | None:
    """Not proven where the profile does not say how the ends of a row are loaded."""
    if not effects.missing:
        return None
    return leave_open("ends", OpenKind.RESISTANCE_MISSING, *effects.missing)
