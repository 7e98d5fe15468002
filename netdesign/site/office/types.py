"""Lines of the sheets Anchors, Tests and Parts, with what follows from each."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from netdesign.resistance.products import find_bar
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.all_tables import find_quantity
from netdesign.site.columns.fields import to_si
from netdesign.site.columns.office import load_plan
from netdesign.site.readings import (
    Reading,
    Row,
    read_nothing,
    refuse_misfits,
    rename,
    work_out,
)
from netdesign.site.type_lines import count_in_tests, fill_in_section, name_values
from netdesign.site.type_resistances import (
    SECTION,
    check_tests,
    describe_steel,
    find_steel,
    resist_buckling,
)
from netdesign.units import kilonewton_from_newton
from netdesign.words.message import Message, say

_GRADE = 235.0  # least grade of rolled sections [MPa]
_ABOVE_NET = 0.3  # of a post beyond the net's head, our judgement [m]
_STEEPEST = 20.0  # largest tilt of a post whose cell is empty [deg]


def join_anchors(
    typed: Mapping[str, Sequence[Row]], project: Row, findings: list[Finding]
) -> list[Row]:
    """Anchor types with the results of their tests and the strengths of their ground.

    Parameters
    ----------
    typed : mapping of str to sequence of Row
        Lines of all sheets by table.
    project : Row
        Lines of sheet Project by key.
    findings : list of Finding
        Appended to.
    """
    unknown = {
        field.key: read_nothing(field, None) for field in load_plan("soils").fields
    }
    by_ground = {
        soil["ground"].word: soil for soil in typed["soils"] if soil["ground"].word
    }
    anchors: list[Row] = []
    for line in typed["anchor_types"]:
        soil = by_ground.get(line["ground"].word, unknown)
        row = {**soil, **line, "soil": project["soil"]}
        anchors.append(row)
    return count_in_tests(anchors, typed["tests"], findings)


def complete_anchors(lines: Sequence[Row], findings: list[Finding]) -> list[Row]:
    """Anchor types with their steel; what contradicts itself is refused."""
    anchors: list[Row] = []
    for line in lines:
        refuse_misfits(line, findings)
        check_tests(line, findings)
        anchors.append(_fill_in_steel(line))
    return anchors


def _fill_in_steel(line: Row) -> Row:
    """Line of an anchor with the bar that its name means, and the tendon it makes."""
    product, force = find_bar(line["id"].word), line["tendon"]
    if product is None or line["kind"].word == "rope anchor":
        return line
    if line["bar_diameter"].state == "blank":
        how = say("derivation.named_bar", product=product.id, sources=product.sources)
        line = {**line, **name_values(line, ("bar_diameter",), product, (), how)}
    steel = find_steel(line)
    if steel is None or force.state != "blank":
        return line
    tendon = replace(
        force,
        state="given",
        value=kilonewton_from_newton(steel.axial_resistance),
        derivation=describe_steel(steel),
        cell=line["bar_diameter"].cell,
    )
    return {**line, "tendon": tendon}


def join_posts(
    lines: Sequence[Row],
    project: Row,
    nets: Sequence[Row],
) -> list[Row]:
    """Posts, as long as the net types that name them ask for."""
    joined: list[Row] = []
    for line in lines:
        row = {**line, "base_friction": project["base_friction"]}
        if row["yield_strength"].state == "blank":
            how = say("office.least_grade")
            row["yield_strength"] = _assume(row, "yield_strength", _GRADE, how)
        length = _find_length(row["id"].word, nets)
        if row["buckling_length"].state == "blank" and length is not None:
            how = say("office.length_of_post", above=_ABOVE_NET)
            row["buckling_length"] = _assume(row, "buckling_length", length, how)
        joined.append(_add_compression(fill_in_section(row)))
    return joined


def _add_compression(row: Row) -> Row:
    """Post with the compression that its section bears; blank without all of it."""
    compression = read_nothing(find_quantity("Posts", "compression"), None)
    if all(row[key].state == "given" for key in SECTION):
        force, how = resist_buckling(row)
        value = kilonewton_from_newton(force)
        compression = work_out(row["area"], compression.field, value, how)
    return {**row, "compression": compression}


def _assume(row: Row, key: str, value: float, how: Message) -> Reading:
    return replace(row[key], state="given", value=value, derivation=how)


def _find_length(post: str, nets: Sequence[Row]) -> float | None:
    """Longest post of a type [m]: D_K / cos(tilt), and its head above the net."""
    lengths = []
    for net in nets:
        height, tilt = net["net_height"], net["post_tilt"]
        if net["post"].word == post and height.state == "given":
            ends = tilt.span or (
                (tilt.number,) if tilt.state == "given" else (_STEEPEST,)
            )
            most = max(abs(to_si(end, "deg")) for end in ends)
            lengths.append(height.si / math.cos(most) + _ABOVE_NET)
    return max(lengths, default=None)


def measure_links(lines: Iterable[Row]) -> list[Row]:
    """Links; bounds and usual values of a force are those of its kind."""
    limit = find_quantity("Links", "working_limit")
    return [
        {**line, "force": rename(line["force"], limit)}
        if line["meaning"].word == "limit"
        else line
        for line in lines
    ]


def list_end_types(lines: Iterable[Row]) -> Mapping[str, Reading]:
    """Types at the row's end, by the types that they replace there."""
    end_types: dict[str, Reading] = {}
    for line in lines:
        if line["at_end"].word:
            end_types.setdefault(line["id"].word, line["at_end"])
    return end_types
