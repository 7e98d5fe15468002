"""Lines of the sheets Rows, Net types and Snow, joined to lines of net rows."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import chain

from netdesign.cable.net import find_slack
from netdesign.checks import Approval, StatedValue
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.all_tables import find_quantity
from netdesign.site.columns.office import Column, list_measures, load_columns, load_plan
from netdesign.site.office.sheets import OfficeTables
from netdesign.site.readings import (
    Reading,
    Row,
    read_nothing,
    refuse,
    rename,
    work_out,
)
from netdesign.words.message import say


def measure_lines(
    table: str, lines: Sequence[Row], tables: OfficeTables, findings: list[Finding]
) -> list[Row]:
    """Lines whose numbers are what the unit cells of their columns say.

    Parameters
    ----------
    table : str
        Name of the lines; those of rows may have the columns of a net, too.
    lines : sequence of Row
        As read.
    tables : OfficeTables
        With the unit cells.
    findings : list of Finding
        Appended to: a number whose unit cell says nothing.
    """
    measured = list(lines)
    columns = dict.fromkeys(("net_types", table))
    for column in chain.from_iterable(map(load_columns, columns)):
        key = column.field.key
        if column.choice and lines and key in lines[0]:
            measure = tables.find_measure(table, key)
            measured = [
                {**line, key: _measure(line[key], column, measure, findings)}
                for line in measured
            ]
    return measured


def _measure(
    reading: Reading, column: Column, measure: str, findings: list[Finding]
) -> Reading:
    """Number as what its unit cell says: of vertical snow, of a sag."""
    if reading.state == "given" and not measure:
        choices = (f"choice.{column.choice}.{x}" for x in list_measures(column.choice))
        accepted = say("accepted.words", words=tuple(map(say, choices)))
        refuse(reading, say("office.no_measure"), accepted, findings)
        reading = replace(reading, state="faulty")
    if reading.state == "given" and measure == "sag":
        return _turn_sag(reading)
    quantity = column.measured.get(measure or list_measures(column.choice)[-1], "")
    sheet, _, key = quantity.rpartition(".")
    return rename(reading, find_quantity(sheet, key)) if quantity else reading


def _turn_sag(sag: Reading) -> Reading:
    """Slack that a sag makes."""
    sags = sag.span or (sag.number, sag.number)
    low, high = map(find_slack, sags)
    how = say("office.slack_of_sag", low=100.0 * sags[0], high=100.0 * sags[1])
    worked = work_out(sag, sag.field, low, how)
    return replace(worked, span=None if sag.span is None else (low, high))


def count_posts(length: float, spacing: float) -> int:
    """Posts that stand on the length of a row [m]: a part of a bay has none."""
    return max(2, 1 + math.floor(length / spacing + 1e-6))


def _count_posts(line: Row) -> Reading:
    """Posts of a row; where a list gives its length alone, those that stand on it."""
    count, spacing = line["post_count"], line["post_spacing"]
    length = line.get("row_length")
    if length is None or not length.given_si or not spacing.given_si:
        return count
    if count.state != "blank":
        return count
    posts = float(count_posts(length.si, spacing.si))
    how = say("office.posts_of_length", length=length.si, spacing=spacing.si)
    return replace(work_out(length, count.field, posts, how), field=count.field)


def join_rows(
    lines: Sequence[Row],
    nets: Mapping[str, Row],
    project: Row,
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
    """
    unknown = {
        field.key: read_nothing(field, None) for field in load_plan("net_types").fields
    }
    height = replace(unknown["net_height"], state="faulty")
    rows: list[Row] = []
    for line in lines:
        named = nets.get(line["net_type"].word) or {**unknown, "net_height": height}
        net = line if "net_height" in line else named
        glide = line["glide_factor"]
        rows.append(
            {
                **line,
                **net,
                "id": line["id"],
                "post_count": _count_posts(line),
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
