from dataclasses import replace
from xml.etree import ElementTree

from netdesign.report.drawing.charts import (
    describe_monitoring,
    draw_monitoring,
)
from netdesign.report.page.html import render_html
from netdesign.study.document import read_document, write_document
from netdesign.study.records import MonitoringRecord
from netdesign.words.message import say
from tests.report.build_study import build_study
from tests.report.reading import PageReader

RECORD = MonitoringRecord(
    member="uphill_guy",
    source="Monitoring!A2",
    times_d=[0.0, 1.0, 2.0],
    tensions_kN=[10.0, None, 12.0],
    air_temperatures_C=[-5.0, -8.0, None],
    model=say("monitoring.needs_winter"),
)
TEXT = "{http://www.w3.org/2000/svg}text"


def texts(svg):
    return [element.text for element in ElementTree.fromstring(svg).iter(TEXT)]


def test_readings_are_drawn_and_the_model_is_told_of():
    shown = texts(draw_monitoring([RECORD]))
    assert {"measured", "air", "Uphill guy, tension [kN]"} <= set(shown)
    assert "sheet Winter" in describe_monitoring([RECORD, RECORD])
    assert describe_monitoring([RECORD, RECORD]).count("sheet Winter") == 1


def test_page_has_the_drawing_only_where_something_was_measured():
    study = build_study(rows=2)
    assert draw_monitoring([]) == ""
    assert "row-1-monitoring" not in PageReader(render_html(study)).ids
    rows = [replace(study.rows[0], monitoring=[RECORD]), study.rows[1]]
    page = PageReader(render_html(replace(study, rows=rows)))
    assert "row-1-monitoring" in page.ids
    assert "row-2-monitoring" not in page.ids
    assert "sets them beside each other" in "".join(page.text)


def test_document_keeps_the_series():
    study = build_study(rows=1)
    measured = replace(study, rows=[replace(study.rows[0], monitoring=[RECORD])])
    back = read_document(write_document(measured))
    assert replace(back, digest="") == measured
