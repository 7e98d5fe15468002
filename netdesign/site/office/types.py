"""From lines of the sheets Anchors, Tests and Parts to those of the type sheets."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from netdesign.resistance.products import find_bar
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.all_tables import ANCHORS, LINKS, POSTS
from netdesign.site.columns.fields import Field, SheetPlan, from_si, to_si
from netdesign.site.readings import Reading, Row, read_nothing
from netdesign.site.type_lines import fill_in_section, name_values
from netdesign.site.type_resistances import compute_compression, compute_tendon
from netdesign.words.message import Message, say

_GRADE = 235.0  # least grade of rolled sections [MPa]
_ABOVE_NET = 0.3  # of a post beyond the net's head, our judgement [m]
_STEEL = ("bar_diameter", "bar_strength", "inner_diameter")


def take(plan: SheetPlan, *lines: Row, **others: Reading) -> dict[str, Reading]:
    """Line of a plan: what others give under its keys, the rest not given.

    Its readings are those of the plan's columns: all that follows knows these.
    """
    given = {key: reading for line in lines for key, reading in line.items()} | others
    return {
        one.key: rename(given[one.key], one)
        if one.key in given
        else read_nothing(one, None)
        for one in plan.fields
    }


def find_field(plan: SheetPlan, key: str) -> Field:
    """Column of a plan."""
    return next(one for one in plan.fields if one.key == key)


def rename(reading: Reading, field: Field) -> Reading:
    """Reading as that of another column."""
    return replace(reading, field=field, typed_as=reading.column)


def work_out(
    reading: Reading, field: Field, value: float | str, how: Message
) -> Reading:
    """Reading of a column that follows from another one, in its first unit."""
    named = rename(reading, field)
    return replace(named, state="given", value=value, derivation=how, span=None)


def fold_id(text: str) -> str:
    """Id without case and double spaces."""
    return " ".join(text.casefold().split())


def settle_ids(lines: Iterable[Row], ids: Iterable[str], key: str) -> list[Row]:
    """Lines whose column names an id as its sheet writes it, whatever the case.

    Ids that differ by nothing else are told apart by their case.
    """
    by_fold: dict[str, list[str]] = {}
    for one in dict.fromkeys(ids):
        by_fold.setdefault(fold_id(one), []).append(one)
    settled: list[Row] = []
    for line in lines:
        reading = line[key]
        known = by_fold.get(fold_id(reading.word), ())
        if reading.word and len(known) == 1:
            line = {**line, key: replace(reading, value=known[0])}
        settled.append(line)
    return settled


def join_anchors(
    lines: Sequence[Row],
    tests: Sequence[Row],
    soils: Sequence[Row],
    project: Row,
) -> list[Row]:
    """Lines of sheet Anchors with what sheets Project and Parts say of their ground."""
    by_ground = {one["ground"].word: one for one in soils if one["ground"].word}
    tested = {(one["type"].word, one["ground"].word) for one in tests}
    return [
        _join_anchor(line, by_ground.get(line["ground"].word), project, tested)
        for line in lines
    ]


def _join_anchor(
    line: Row, soil: Row | None, project: Row, tested: set[tuple[str, str]]
) -> Row:
    name = line["id"].word
    has_tests = not tested.isdisjoint({(name, line["ground"].word), (name, "")})
    proven = {} if has_tests else _prove(line)
    return take(
        ANCHORS,
        line,
        {key: one for key, one in (soil or {}).items() if key != "ground"},
        soil=rename(project["soil"], find_field(ANCHORS, "soil")),
        **proven,
    )


def _prove(line: Row) -> dict[str, Reading]:
    """Pull-out resistance by how it is proven: by tests, or as one number."""
    force, how = line["pull_out"], line["proven"]
    if force.state == "blank":
        return {"test_least": rename(force, find_field(ANCHORS, "test_least"))}
    if force.state != "given":
        return {}
    if how.word == "tests":
        count, mean = line["test_count"], line["test_mean"]
        alone = say("office.one_test")
        return {
            "pull_out": read_nothing(find_field(ANCHORS, "pull_out"), None),
            "test_count": count
            if count.state != "blank"
            else work_out(force, find_field(ANCHORS, "test_count"), 1.0, alone),
            "test_least": rename(force, find_field(ANCHORS, "test_least")),
            "test_mean": mean
            if mean.state != "blank"
            else work_out(
                force,
                find_field(ANCHORS, "test_mean"),
                force.number,
                say("office.mean_is_least"),
            ),
        }
    basis = find_field(ANCHORS, "basis")
    said = rename(how, basis) if how.cell else read_nothing(basis, None)
    counted = {"": say("office.worst_basis"), "report": say("office.unnamed_report")}
    given = replace(
        said, state="given", value="computed", derivation=counted.get(how.word)
    )
    nothing = {
        key: read_nothing(find_field(ANCHORS, key), None)
        for key in ("test_count", "test_mean")
    }
    return {"basis": given, **nothing}


def fill_in_anchor(row: Row, findings: list[Finding]) -> Row:
    """Line of sheet Anchors with the steel of a bar, and the tendon that it makes.

    The steel is that of its name, or has the strength that force and diameter say.
    """
    force, diameter = row["tendon"], row["bar_diameter"]
    if row["kind"].word == "rope anchor" or "faulty" in (force.state, diameter.state):
        return row
    product = find_bar(row["id"].word)
    is_open = all(row[key].state == "blank" for key in _STEEL)
    if product is not None and (is_open or force.state != "given"):
        keys = [key for key in _STEEL if row[key].state != "given"]
        how = say("derivation.named_bar", product=product.id, sources=product.sources)
        steel = name_values(row, keys, product, ("inner_diameter",), how)
        return compute_tendon({**row, **steel}, findings)
    if diameter.state == force.state == "given":
        area = 0.25 * math.pi * diameter.si**2
        strength = from_si(force.si / area, "MPa")
        field = find_field(ANCHORS, "bar_strength")
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
    """Lines of sheet Posts: as long as the net types that name them ask for."""
    friction = rename(project["base_friction"], find_field(POSTS, "base_friction"))
    joined: list[Row] = []
    for line in lines:
        row = take(POSTS, line, base_friction=friction)
        row["foot_eccentricity"] = rename(
            row["head_eccentricity"], find_field(POSTS, "foot_eccentricity")
        )
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


_STEEPEST = 20.0  # tilt of a post that nobody gives, at most [deg]


def _find_length(post: str, nets: Sequence[Row]) -> float | None:
    """Longest post of that type: D_K / cos of the tilt, and what stands above [m]."""
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


def join_links(lines: Sequence[Row]) -> list[Row]:
    """Lines of sheet Links; a force of which nobody says what it is is a strength."""
    joined: list[Row] = []
    for line in lines:
        is_limit = line["meaning"].word == "limit"
        key = "working_limit" if is_limit else "strength"
        force = rename(line["force"], find_field(LINKS, key))
        joined.append(take(LINKS, line, **{key: force}))
    return joined


def list_end_types(lines: Iterable[Row]) -> Mapping[str, Reading]:
    """Types that stand at the row's end in the place of others, by these."""
    found: dict[str, Reading] = {}
    for line in lines:
        if line["at_end"].word:
            found.setdefault(line["id"].word, line["at_end"])
    return found


def list_dips(lines: Iterable[Row]) -> Mapping[tuple[str, str], Reading]:
    """Dips of bores below the horizontal by type and ground."""
    return {
        (line["id"].word, line["ground"].word): line["dip"]
        for line in lines
        if line["dip"].state == "given"
    }


def list_ids(lines: Iterable[Row]) -> Iterator[str]:
    """Ids of a sheet of types."""
    return (line["id"].word for line in lines if line["id"].word)
