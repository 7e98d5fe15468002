"""From lines of sheets Rows and Net types to those of net rows and of their ends."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from netdesign.cable.sag import find_slack
from netdesign.checks import Approval, StatedValue
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.all_tables import ENDS, NETS
from netdesign.site.columns.fields import from_si
from netdesign.site.columns.office import list_measures
from netdesign.site.office.types import (
    find_field,
    fold_id,
    rename,
    take,
    work_out,
)
from netdesign.site.readings import Reading, Row, read_nothing, refuse
from netdesign.structure.members import EndMember, Member
from netdesign.structure.row_position import find_axis_at_dip
from netdesign.words.message import say

Dips = Mapping[tuple[str, str], Reading]
_ENDS = 2  # of a row
# Columns of which a row shows what they are turned into; of all others the cell itself.
_TURNED = ("snow", "end_anchor", "end_guy", "end_guy_angle", "ropes_at_supports")
_AXES = {
    "foot_axis": (Member.FOOT_ANCHOR, "foot_anchor"),
    "uphill_axis": (Member.UPHILL_ANCHOR, "uphill_anchor"),
    "downhill_axis": (Member.DOWNHILL_ANCHOR, "downhill_anchor"),
}
_AT_ENDS = (
    *("foot_anchor", "uphill_anchor", "downhill_anchor"),
    *("uphill_guy", "downhill_guy", "post"),
)
_SNOW = {"vertical": "snow_height", "normal": "snow_thickness"}
_LAYERED = ("layered", "layered with temperatures")


def join_net(line: Row, measure: str, findings: list[Finding]) -> Row:
    """Line of sheet Net types whose sag is the slack that it makes."""
    slack = line["slack"]
    if slack.state != "given" or measure == "slack":
        return line
    if not measure:
        _refuse_unit(slack, "sag_unit", findings)
        return {**line, "slack": replace(slack, state="faulty")}
    sags = slack.span or (slack.number, slack.number)
    low, high = map(find_slack, sags)
    how = say("office.slack_of_sag", low=100.0 * sags[0], high=100.0 * sags[1])
    worked = work_out(slack, slack.field, low, how)
    span = None if slack.span is None else (low, high)
    return {**line, "slack": replace(worked, field=slack.field, span=span)}


def _refuse_unit(reading: Reading, choice: str, findings: list[Finding]) -> None:
    """Refuse a number whose unit cell does not say what it measures."""
    texts = tuple(say(f"choice.{choice}.{one}") for one in list_measures(choice))
    accepted = say("accepted.words", words=texts)
    refuse(reading, say("office.no_measure"), accepted, findings)


def join_rows(
    lines: Sequence[Row],
    nets: Mapping[str, Row],
    layers: Mapping[str, Sequence[Row]],
    project: Row,
    dips: Dips,
    measure: str,
    findings: list[Finding],
) -> list[Row]:
    """Lines of sheet Nets: each row with its net type, and what the site says.

    Parameters
    ----------
    lines : sequence of Row
        Of sheet Rows.
    nets : mapping of str to Row
        Of sheet Net types, by id.
    layers : mapping of str to sequence of Row
        Of sheet Snow, by row.
    project : Row
        Lines of sheet Project by key.
    dips : mapping
        Of bores, by anchor type and ground.
    measure : str
        Of the snow: ``vertical`` or ``normal``; empty where the unit cell does not say.
    findings : list of Finding
        Appended to.
    """
    joined = find_joined(lines)
    rows: list[Row] = []
    for line in lines:
        net = nets.get(line["net_type"].word, {})
        row = take(
            NETS,
            net,
            line,
            id=line["id"],
            post=net.get("post") or read_nothing(find_field(NETS, "post"), None),
            design_life=rename(project["design_life"], find_field(NETS, "design_life")),
            **_say_ground(line),
            **_say_ends(line, joined[line["id"].word]),
            **_say_snow(line, measure, findings),
            **_say_layers(line, layers),
            **_say_axes(line, dips),
        )
        if not net:  # a finding already
            row["net_height"] = replace(row["net_height"], state="faulty")
        row["net_type"] = line["net_type"]
        typed = {**net, **line}
        rows.append(
            row | {key: typed[key] for key in typed if key not in (*row, *_TURNED)}
        )
    return rows


def _say_ground(line: Row) -> dict[str, Reading]:
    """Ground law and glide factor: a word for free gliding, or a number."""
    glide = line["glide_factor"]
    if not glide.word:
        return {}
    law = replace(rename(glide, find_field(NETS, "ground_law")), value="free")
    return {"ground_law": law, "glide_factor": read_nothing(glide.field, None)}


def find_joined(lines: Sequence[Row]) -> Mapping[str, tuple[str, ...]]:
    """Rows into which each row's nets go on, whichever of the two says so."""
    ids = {fold_id(line["id"].word): line["id"].word for line in lines}
    found: dict[str, dict[str, None]] = {line["id"].word: {} for line in lines}
    for line in lines:
        own = line["id"].word
        for typed in filter(None, map(str.strip, line["gap"].word.split(","))):
            other = ids.get(fold_id(typed), typed)
            found[own][other] = None
            found.setdefault(other, {})[own] = None
    return {own: tuple(others) for own, others in found.items()}


def _say_ends(line: Row, others: tuple[str, ...]) -> dict[str, Reading]:
    """Gap, end and neighbours: nets that go on at one end have another, free one."""
    gap, said = line["gap"], find_field(NETS, "row_end")
    if len(others) < _ENDS:
        return {"gap": read_nothing(gap.field, None)} if gap.word else {}
    how = say("office.goes_on", ids=others)
    here = gap if gap.cell else line["id"]
    return {
        "gap": read_nothing(gap.field, None),
        "row_end": work_out(here, said, "continuous", how),
        "neighbour": work_out(
            here, find_field(NETS, "neighbour"), ", ".join(others), how
        ),
    }


def _say_snow(line: Row, measure: str, findings: list[Finding]) -> dict[str, Reading]:
    snow = line["snow"]
    if measure:
        key = _SNOW[measure]
        return {key: rename(snow, find_field(NETS, key))}
    if snow.state == "given":
        _refuse_unit(snow, "snow_unit", findings)
        snow = replace(snow, state="faulty")
    return {"snow_height": rename(snow, find_field(NETS, "snow_height"))}


def _say_layers(line: Row, layers: Mapping[str, Sequence[Row]]) -> dict[str, Reading]:
    """Layers of the snow: those of sheet Snow, if it has some of the row."""
    lines = layers.get(line["id"].word)
    if not lines:
        return {}
    word = _LAYERED[any(one["temperature"].state == "given" for one in lines)]
    field = find_field(NETS, "snow_layers")
    how = say("office.layers_there")
    return {"snow_layers": work_out(lines[0]["row"], field, word, how)}


def _say_axes(line: Row, dips: Dips) -> dict[str, Reading]:
    """Axes of the anchors against the slope, of bores that dip by type."""
    axes: dict[str, Reading] = {}
    for key, (member, column) in _AXES.items():
        found = _find_axis(line, column, member, dips)
        if found is not None:
            dip, axis = found
            how = say("office.axis_of_dip", dip=dip.number, place=dip.place)
            axes[key] = work_out(dip, find_field(NETS, key), axis, how)
    return axes


def _find_axis(
    line: Row, column: str, member: str, dips: Dips
) -> tuple[Reading, float] | None:
    """Dip of the bore of an anchor's type, and its axis against the slope [deg]."""
    name, ground = line[column].word, line["ground"].word
    dip = dips.get((name, ground)) or dips.get((name, ""))
    if dip is None and not ground:
        dip = next((one for (own, _), one in dips.items() if own == name), None)
    if dip is None or line["slope_angle"].state != "given":
        return None
    axis = find_axis_at_dip(dip.si, line["slope_angle"].si, member)
    return dip, from_si(axis, "deg")


def join_ends(
    lines: Sequence[Row],
    rows: Sequence[Row],
    nets: Mapping[str, Row],
    at_end: Mapping[str, Reading],
    dips: Dips,
) -> list[Row]:
    """Lines of sheet Ends: what stands at the last post, and holds the row there.

    Parameters
    ----------
    lines, rows : sequence of Row
        Of sheet Rows, and as they are joined.
    nets : mapping of str to Row
        Of sheet Net types, by id.
    at_end : mapping of str to Reading
        Types at the row's end in the place of others.
    dips : mapping
        Of bores, by anchor type and ground.
    """
    ends: list[Row] = []
    for line, row in zip(lines, rows, strict=True):
        if row["row_end"].word == "continuous":
            continue
        net = nets.get(line["net_type"].word, {})
        anchor = line["end_anchor"]
        given: dict[str, Reading] = {
            one: rename(anchor, find_field(ENDS, one))
            for one in (EndMember.LATERAL_ANCHOR, EndMember.END_GUY_ANCHOR)
        }
        found = _find_axis(line, "end_anchor", EndMember.LATERAL_ANCHOR, dips)
        if found is not None:
            how = say("office.axis_of_dip", dip=found[0].number, place=found[0].place)
            field = find_field(ENDS, "lateral_axis")
            given["lateral_axis"] = work_out(found[0], field, found[1], how)
        named = {
            key: net[key]
            for key in ("end_guy", "end_guy_angle", "ropes_at_supports")
            if key in net
        }
        ends.append(
            take(
                ENDS,
                row=rename(line["id"], find_field(ENDS, "row")),
                **named,
                **given,
                **_say_types(row, at_end),
            )
        )
    return ends


def _say_types(row: Row, at_end: Mapping[str, Reading]) -> dict[str, Reading]:
    """Types at the end: those that others name in their place, else those inside."""
    others = {key: at_end[row[key].word] for key in _AT_ENDS if row[key].word in at_end}
    if not others:
        field = find_field(ENDS, "support_types")
        how = say("office.same_at_end")
        return {"support_types": work_out(row["id"], field, "as inside", how)}
    return {
        key: rename(others.get(key, row[key]), find_field(ENDS, key))
        for key in _AT_ENDS
    }


def read_approval(net: Row) -> Approval | None:
    """Type approval of a net type, with the maker's forces; None of neither."""
    numbers = {
        "glide_factor": "glide_most",
        "altitude_factor": "altitude_most",
        "spacing": "spacing_most",
        "foot_force": "maker_foot",
        "uphill_force": "maker_uphill",
        "downhill_force": "maker_downhill",
    }
    document = net["approval"]
    stated = {
        name: StatedValue(value=net[key].si, cell=net[key].place)
        for name, key in numbers.items()
        if net[key].state == "given"
    }
    if not document.word and not stated:
        return None
    height = net["net_height"]
    if document.word and height.state == "given":
        stated["height"] = StatedValue(value=height.si, cell=height.place)
    place = document.place if document.word else ""
    return Approval(document=document.word, cell=place, **stated)
