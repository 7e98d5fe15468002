"""What nobody typed, as the first page and the assumptions tell it."""

from dataclasses import replace

from netdesign.outcome import Verdict
from netdesign.report.sections.basis import (
    anchor_rows,
    name_rows,
)
from netdesign.report.sections.decision import ALTITUDE, list_assumed
from netdesign.report.words import ENGLISH
from netdesign.site.model import InputEcho
from tests.report.build_study import build_study
from tests.turn import turn_row


def with_altitude(value, text=""):
    study = build_study()
    echo = InputEcho(label=ALTITUDE, unit="m", text=text, value=value, cell="")
    rows = [replace(row, inputs=[echo]) for row in study.rows]
    return replace(study, rows=rows)


def test_altitude_that_is_not_given_is_an_assumption():
    study, altitude = with_altitude(""), ENGLISH.show(ALTITUDE)
    (line,) = [one for one in list_assumed(study, ENGLISH) if one.name == altitude]
    assert line.value == ENGLISH("show.largest_altitude_factor")
    assert line.rows == ()  # all of them
    given = list_assumed(with_altitude(1873.0, "1873"), ENGLISH)
    assert not any(one.name == altitude for one in given)


def name_of(missing, rows=23):
    """Names of all rows of a site but some."""
    (row,) = build_study(rows=1).rows
    ids = [f"W{number}" for number in range(rows)]
    study = replace(build_study(rows=1), rows=[replace(row, id=one) for one in ids])
    named = [one for number, one in enumerate(ids) if number not in missing]
    return name_rows(named, study, ENGLISH), named


def test_each_row_is_named_where_a_phrase_would_not_be_shorter():
    """Of few rows, and where many are left out: no name is lost."""
    few, named = name_of((3,), rows=8)
    assert few.split(", ") == named
    assert name_of((), rows=8)[0] == "all 8 net rows"
    half, named = name_of(range(0, 23, 2))
    assert half.split(", ") == named


def test_rows_alike_but_for_their_names_share_a_place():
    study = build_study(rows=1)
    (row,) = study.rows
    moved = [replace(one, cell=f"{one.cell}7") for one in row.inputs]
    other = replace(turn_row(row, Verdict.NOT_PROVEN), id="other")
    again = replace(row, id="again", inputs=moved)
    several = replace(study, rows=[row, other, again])
    anchors = {row.id: "row-1", "other": "row-2", "again": "row-1"}
    assert anchor_rows(several) == anchors
