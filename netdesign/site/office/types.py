"""Lines of the sheets Anchors, Tests and Parts, with what follows from each."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from netdesign.resistance.products import find_bar
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.all_tables import find_quantity
from netdesign.site.columns.fields import from_si, to_si
from netdesign.site.columns.office import list_derived
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
    check_tests,
    compute_compression,
    compute_tendon,
)
from netdesign.words.message import Message, say

_GRADE = 235.0  # least grade of rolled sections [MPa]
_ABOVE_NET = 0.3  # of a post beyond the net's head, our judgement [m]
_STEEPEST = 20.0  # largest tilt of a post whose cell is empty [deg]
_STEEL = ("bar_diameter", "bar_strength", "inner_diameter")


def _add_derived(line: Row, table: str) -> dict[str, Reading]:
    """Line with empty readings of the quantities that are computed from it later."""
    unknown = {field.key: read_nothing(field, None) for field in list_derived(table)}
    return {**unknown, **line}


def join_anchors(
    lines: Sequence[Row],
    tests: Sequence[Row],
    soils: Sequence[Row],
    project: Row,
    findings: list[Finding],
) -> list[Row]:
    """Anchor types with the results of their tests and the strengths of their ground.

    Parameters
    ----------
    lines, tests, soils : sequence of Row
        Of sheets Anchors, Tests and Parts.
    project : Row
        Lines of sheet Project by key.
    findings : list of Finding
        Appended to.
    """
    by_ground = {soil["ground"].word: soil for soil in soils if soil["ground"].word}
    tested = {(test["type"].word, test["ground"].word) for test in tests}
    anchors: list[Row] = []
    for line in lines:
        name, ground = line["id"].word, line["ground"].word
        soil = by_ground.get(ground, {})
        row = _add_derived(line, "anchor_types") | {
            key: reading for key, reading in soil.items() if key != "ground"
        }
        row["soil"] = project["soil"]
        is_tested = not tested.isdisjoint({(name, ground), (name, "")})
        anchors.append(row if is_tested else row | _read_proof(row))
    return count_in_tests(anchors, tests, findings) if tests else anchors


def _read_proof(line: Row) -> dict[str, Reading]:
    """Pull-out resistance by its proof: the least of tests, or a single number."""
    force, count, mean = (line[key] for key in ("pull_out", "test_count", "test_mean"))
    least = rename(force, line["test_least"].field)
    if force.state != "given":
        return {"test_least": least}
    if line["proven"].word != "tests":
        return {
            "test_count": read_nothing(count.field, None),
            "test_mean": read_nothing(mean.field, None),
        }
    if count.state == "blank":
        count = work_out(force, count.field, 1.0, say("office.one_test"))
    if mean.state == "blank":
        mean = work_out(force, mean.field, force.number, say("office.mean_is_least"))
    nothing = read_nothing(force.field, None)
    return {
        "pull_out": nothing,
        "test_least": least,
        "test_count": count,
        "test_mean": mean,
    }


def complete_anchors(lines: Sequence[Row], findings: list[Finding]) -> list[Row]:
    """Anchor types with their steel; what contradicts itself is refused."""
    anchors: list[Row] = []
    for line in lines:
        refuse_misfits(line, findings)
        anchors.append(_fill_in_steel(line, findings))
        check_tests(anchors[-1], findings)
    return anchors


def _fill_in_steel(row: Row, findings: list[Finding]) -> Row:
    """Line of an anchor with the steel of a bar, and the tendon that it makes.

    The steel follows from the name, or its strength from force and diameter.
    """
    force, diameter = row["tendon"], row["bar_diameter"]
    if row["kind"].word == "rope anchor" or "faulty" in (force.state, diameter.state):
        return row
    product = find_bar(row["id"].word)
    is_whole = diameter.state == force.state == "given"
    if product is not None and not is_whole:
        keys = [key for key in _STEEL if row[key].state != "given"]
        how = say("derivation.named_bar", product=product.id, sources=product.sources)
        steel = name_values(row, keys, product, ("inner_diameter",), how)
        return compute_tendon({**row, **steel}, findings)
    if is_whole:
        area = 0.25 * math.pi * diameter.si**2
        strength, field = from_si(force.si / area, "MPa"), row["bar_strength"].field
        how = say("office.strength_of_force", place=force.place)
        if field.bounds[0] <= strength <= field.bounds[1]:
            return {**row, "bar_strength": work_out(force, field, strength, how)}
    return row


def join_posts(
    lines: Sequence[Row],
    project: Row,
    nets: Sequence[Row],
    findings: list[Finding],
) -> list[Row]:
    """Posts, as long as the net types that name them ask for."""
    joined: list[Row] = []
    for line in lines:
        row = _add_derived(line, "posts")
        row["base_friction"] = project["base_friction"]
        if row["yield_strength"].state == "blank":
            how = say("office.least_grade")
            row["yield_strength"] = _assume(row, "yield_strength", _GRADE, how)
        length = _find_length(row["id"].word, nets)
        if row["buckling_length"].state == "blank" and length is not None:
            how = say("office.length_of_post", above=_ABOVE_NET)
            row["buckling_length"] = _assume(row, "buckling_length", length, how)
        joined.append(compute_compression(fill_in_section(row), findings))
    return joined


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


def join_links(lines: Iterable[Row]) -> list[Row]:
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
