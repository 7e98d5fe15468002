from xml.etree import ElementTree

import pytest

from netdesign.report.blocks import write_csv
from netdesign.report.drawing.charts import Line, Mark, Panel, draw_panels, spread

TEXT = "{http://www.w3.org/2000/svg}text"
MINUTE = 1.0 / 1440.0


def texts(svg):
    return [element.text for element in ElementTree.fromstring(svg).iter(TEXT)]


def panel(**changes):
    lines = [
        Line(label="foot", x=[MINUTE, 1.0, 30.0], y=[0.0, 200.0, 300.0]),
        Line(label="head", x=[MINUTE, 1.0, 30.0], y=[0.0, 200.0, 299.0], style=1),
    ]
    return Panel(**{"title": "Pull [kN/m]", "lines": lines, **changes})


def draw(panels, title="t"):
    return draw_panels(panels, title, time_label="time")


def test_names_ticks_and_marks_are_readable():
    svg = draw([panel(marks=[Mark(x=0.5, label="plateau from")])], "Pulls")
    shown = texts(svg)
    assert {"foot", "head", "plateau from", "Pull [kN/m]"} <= set(shown)
    assert {"1 min", "1 h", "1 d", "10 d"} <= set(shown)
    assert "1 s" not in shown  # before the first time
    assert 'aria-label="Pulls"' in svg


def test_same_bytes_each_time():
    assert draw([panel()]) == draw([panel()])


def test_drawing_without_a_second_time_is_still_drawn():
    line = Line(label="foot", x=[1.0], y=[2.0])
    assert "foot" in texts(draw([panel(lines=[line])]))


@pytest.mark.parametrize(
    ("heights", "expected"),
    [
        ([0.0, 1.0], [0.0, 1.0]),
        ([0.5, 0.5], [0.45, 0.55]),
        ([0.5, 0.5, 0.58], [0.4267, 0.5267, 0.6267]),
        ([], []),
    ],
)
def test_labels_are_moved_apart_about_their_mean(heights, expected):
    assert spread(heights, 0.1) == pytest.approx(expected, abs=1e-4)


def test_csv_keeps_every_digit_and_leaves_gaps_empty():
    content = write_csv(["a", "b"], [[0.1 + 0.2, None]])
    assert content == b"a,b\n0.30000000000000004,\n"
