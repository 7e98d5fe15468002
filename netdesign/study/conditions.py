"""What has to hold beside the numbers: statements that the workbook leaves open.

A statement is no number that could be searched. What a workbook says of it is a check;
what it leaves open is a condition, which office, supplier or site fulfil. Each stands
once for all net rows, with the number that the worst of them needs.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import ClassVar, Literal

from netdesign.checks.schema import ANCHOR_DISTANCE, MAX_GAP
from netdesign.edge.json_text import Items
from netdesign.resistance.steel import Wear
from netdesign.site.model import NetRow, Resistance
from netdesign.study.anchor_ground import list_bonds
from netdesign.study.anchor_pulls import USUAL_DIP
from netdesign.study.member_force import RowForces
from netdesign.units import given_degree_from_radian
from netdesign.words.message import Text, say

Who = Literal["office", "supplier", "ground", "site"]
# Who sees to each condition, in the order of the reports.
_WHO: Mapping[str, Who] = {
    "snow_height": "office",
    "glide_factor": "office",
    "ground": "ground",
    "cover": "ground",
    "natural_ground": "ground",
    "protected": "supplier",
    "basis": "ground",
    "sleeve": "supplier",
    "rectangular": "supplier",
    "hangs_free": "supplier",
    "one_construction": "supplier",
    "axes": "site",
    "edge": "site",
    "apart": "site",
    "row_above": "site",
    "gap": "site",
}
_DECIMALS = {"snow_height": 2, "cover": 1, "edge": 1}  # of metres, rounded up
_LEAST_COUNTS = ("cover", "gap")  # of all others the largest number


@dataclass(frozen=True, kw_only=True)
class Condition:
    """One statement that has to hold.

    Attributes
    ----------
    key : str
        Which one it is, as in "cover".
    who : str
        Who sees to it: ``office``, ``supplier``, ``ground`` (the geotechnical
        engineer) or ``site``.
    message : Message
        The statement, with its number.
    value : float or None
        That number, in the unit of the message; None of a statement without one.
    rows : list of str
        Ids of the net rows that need it.
    """

    LEAVES_OUT_NONE: ClassVar[tuple[str, ...]] = ("value",)

    key: str
    who: Who
    message: Text
    value: float | None = None
    rows: Items[str] = field(default_factory=list)


def list_conditions(forces: RowForces) -> list[Condition]:
    """Conditions of one net row at one corner of its statics."""
    return [
        replace(condition, rows=[forces.row.id])
        for part in (_list_of_snow, _list_of_types, _list_of_ground, _list_of_bores)
        for condition in part(forces)
    ]


def merge_conditions(conditions: Iterable[Condition]) -> list[Condition]:
    """Conditions by key, each with the number of the row that needs most."""
    merged: dict[str, Condition] = {}
    for condition in conditions:
        before = merged.setdefault(condition.key, condition)
        rows = [*dict.fromkeys([*before.rows, *condition.rows])]
        worse = condition if _is_worse(condition, before) else before
        merged[condition.key] = replace(worse, rows=rows)
    order = {key: place for place, key in enumerate(_WHO)}
    return sorted(merged.values(), key=lambda each: order.get(each.key, len(order)))


def _is_worse(condition: Condition, other: Condition) -> bool:
    if condition.value is None or other.value is None:
        return other.value is None and condition.value is not None
    is_less = condition.value < other.value
    return is_less if condition.key in _LEAST_COUNTS else condition.value > other.value


def _state(key: str, value: float | None = None) -> Condition:
    text = say(f"condition.{key}")
    if value is not None:
        scale = 10.0 ** _DECIMALS.get(key, 6)
        shown = math.ceil(value * scale - 1e-6) / scale
        text = say(f"condition.{key}_of", value=shown)
    return Condition(key=key, who=_WHO[key], message=text, value=value)


def _list_of_snow(forces: RowForces) -> Iterator[Condition]:
    """List the snow height and glide factor that a document confirms."""
    row, ranges, project = forces.row, forces.site.ranges, forces.site.project
    if not project.snow_document:
        yield _state("snow_height", row.snow_thickness / math.cos(row.slope_angle))
    glide = row.glide_factor
    if "glide_factor" in ranges.further:
        glide = ranges["glide_factor"].high
    is_known = glide is not None and row.find_assumed("glide_factor") is None
    if glide is not None and is_known and not project.glide_document:
        yield _state("glide_factor", glide)


def _list_of_types(forces: RowForces) -> Iterator[Condition]:
    """List what the types of a row leave open of corrosion, grounds and sleeves."""
    row, left_out = forces.row, forces.standard.not_checked
    for resistance in _list_resistances(row):
        if resistance.wear is not None and "corrosion" not in left_out:
            yield from _list_of_wear(resistance.wear, row.design_life)
        if resistance.mode == "pull_out" and (
            resistance.value is not None or resistance.tests
        ):
            if not (row.ground_type and resistance.ground):
                yield _state("ground")
            if resistance.is_basis_assumed:
                yield _state("basis")
            if not resistance.tests:
                yield _state("sleeve")
    yield _state("rectangular")
    yield _state("hangs_free")  # of the panels that may be built, those count
    if row.row_end and row.guys.count > 1 and len(row.row_end.stiffnesses) > 1:
        yield _state("one_construction")


def _list_resistances(row: NetRow) -> Iterator[Resistance]:
    yield from row.resistances
    yield from row.end_resistances or ()
    yield from row.row_end.resistances if row.row_end else ()
    yield from row.net_parts


def _list_of_wear(wear: Wear, life: int) -> Iterator[Condition]:
    if wear.is_bare:
        yield from () if wear.soil else (_state("natural_ground"),)
    else:
        yield _state("protected", float(life))


def _list_of_ground(forces: RowForces) -> Iterator[Condition]:
    """List the covers and edge distances that the ground has to have."""
    if "anchor_ground" in forces.standard.not_checked:
        return
    for bond in list_bonds(forces.row, forces.pulls):
        if not bond.has_soil and not bond.leaves_ground:
            yield _state("cover", bond.cover)
        yield _state("edge", bond.length)


def _list_of_bores(forces: RowForces) -> Iterator[Condition]:
    """List the axes and places of the bores, and the distances beside the row."""
    row, standard = forces.row, forces.standard
    if any(not pull.is_axis_given for pull in forces.pulls):
        yield _state("axes", given_degree_from_radian(USUAL_DIP))
    apart, gap = standard.find(ANCHOR_DISTANCE), standard.find(MAX_GAP)
    if apart is not None and row.row_end is not None:
        yield _state("apart", apart.value)
    is_open = row.has_row_above and row.find_assumed("upslope_length") is not None
    if apart is not None and is_open:
        yield _state("row_above", apart.value)
    if gap is not None and math.isinf(row.gap):
        yield _state("gap", gap.value)
