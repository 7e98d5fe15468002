from dataclasses import replace
from xml.etree import ElementTree

from netdesign.report.drawing.section_figure import draw_section
from tests.digits import write_force
from tests.each import each
from tests.report.build_study import build_drawing, build_row

ROW = build_row("A", 3, scale=0.72, failed_case=True)
TEXT = "{http://www.w3.org/2000/svg}text"


def texts(svg):
    return [element.text for element in ElementTree.fromstring(svg).iter(TEXT)]


@each("slope", [5.0, 25.0, 40.0, 60.0])
@each("tilt", [0.0, 30.0])
def test_section_names_every_force(slope, tilt):
    drawing = build_drawing(ROW.member_forces[0], slope=slope, tilt=tilt)
    shown = texts(draw_section(drawing, "x"))
    for name in ("Net anchor (foot)", "Uphill anchor", "Downhill anchor", "Post"):
        assert name in shown
    assert f"{write_force(ROW.member_forces[0].value_kN)} kN" in shown
    assert f"ψ = {slope:.1f}°" in shown


def test_slack_anchor_keeps_its_place_in_the_section():
    arrows = [
        replace(a, force_x_kN=0.0, force_y_kN=0.0) for a in ROW.drawing.arrows[3:]
    ]
    arrows = [*ROW.drawing.arrows[:3], *arrows]
    shown = texts(draw_section(replace(ROW.drawing, arrows=arrows), "x"))
    assert "Downhill anchor" in shown
    assert "0.00 kN" not in shown  # fault 22: no arrow, no number
