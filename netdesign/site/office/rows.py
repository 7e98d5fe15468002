"""Lines of the sheets Rows, Net types and Snow, joined to lines of net rows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from netdesign.cable.net import find_slack
from netdesign.checks import Approval, StatedValue
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.all_tables import find_quantity
from netdesign.site.columns.office import list_measures, load_plan
from netdesign.site.readings import (
    Reading,
    Row,
    read_nothing,
    refuse,
    rename,
    work_out,
)
from netdesign.words.message import say

# What a number measures, as its unit cell says.
_SNOW = {"vertical": "snow_height", "normal": "snow_thickness"}
_LAYER = {"vertical": "height", "normal": "thickness"}


def measure_slack(line: Row, measure: str, findings: list[Finding]) -> Row:
    """Line of a net whose sag is the slack that it makes."""
    slack = line.get("slack")
    if slack is None or slack.state != "given" or measure == "slack":
        return line
    if not measure:
        return {**line, "slack": _refuse_unit(slack, "sag_unit", findings)}
    sags = slack.span or (slack.number, slack.number)
    low, high = map(find_slack, sags)
    how = say("office.slack_of_sag", low=100.0 * sags[0], high=100.0 * sags[1])
    span = None if slack.span is None else (low, high)
    worked = work_out(slack, slack.field, low, how)
    return {**line, "slack": replace(worked, span=span)}


def _refuse_unit(reading: Reading, choice: str, findings: list[Finding]) -> Reading:
    """Refuse a number whose unit cell does not say what it measures."""
    texts = tuple(
        say(f"choice.{choice}.{measure}") for measure in list_measures(choice)
    )
    accepted = say("accepted.words", words=texts)
    refuse(reading, say("office.no_measure"), accepted, findings)
    return replace(reading, state="faulty")


def measure_layers(
    lines: Sequence[Row], measure: str, findings: list[Finding]
) -> list[Row]:
    """Layers of sheet Snow, vertical or normal as their unit cell says."""
    if lines and not measure:
        refuse(lines[0]["thickness"], say("office.no_measure"), "", findings)
    field = find_quantity("Snow", _LAYER[measure or "normal"])
    return [{**line, "thickness": rename(line["thickness"], field)} for line in lines]


def join_rows(
    lines: Sequence[Row],
    nets: Mapping[str, Row],
    project: Row,
    measure: str,
    findings: list[Finding],
) -> list[Row]:
    """Rows, each with the columns of its net type and of sheet Project.

    Parameters
    ----------
    lines : sequence of Row
        Of sheet Rows.
    nets : mapping of str to Row
        Of sheet Net types, by id.
    project : Row
        Lines of sheet Project by key.
    measure : str
        Of the snow: ``vertical`` or ``normal``; empty where the unit cell does not say.
    findings : list of Finding
        Appended to.
    """
    unknown = {
        field.key: read_nothing(field, None) for field in load_plan("net_types").fields
    }
    height = replace(unknown["net_height"], state="faulty")
    rows: list[Row] = []
    for line in lines:
        named = nets.get(line["net_type"].word) or {**unknown, "net_height": height}
        net = line if "net_height" in line else named
        snow, glide = line["snow"], line["glide_factor"]
        if snow.state == "given" and not measure:
            snow = _refuse_unit(snow, "snow_unit", findings)
        rows.append(
            {
                **line,
                **net,
                "id": line["id"],
                "snow": rename(snow, find_quantity("Nets", _SNOW[measure or "normal"])),
                "glide_factor": replace(glide, value="free") if glide.word else glide,
                "design_life": project["design_life"],
            }
        )
    return rows


_STATED = {
    "glide_factor": "glide_most",
    "altitude_factor": "altitude_most",
    "spacing": "spacing_most",
    "foot_force": "maker_foot",
    "uphill_force": "maker_uphill",
    "downhill_force": "maker_downhill",
}


def read_approval(net: Row) -> Approval | None:
    """Type approval of a net type with the maker's forces; None without either."""
    document, height = net["approval"], net["net_height"]
    stated = {
        name: StatedValue(value=net[key].si, cell=net[key].place)
        for name, key in _STATED.items()
        if net[key].state == "given"
    }
    if not document.word and not stated:
        return None
    if document.word and height.state == "given":
        stated["height"] = StatedValue(value=height.si, cell=height.place)
    place = document.place if document.word else ""
    return Approval(document=document.word, cell=place, **stated)
