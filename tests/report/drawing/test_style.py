import random
from dataclasses import replace
from xml.etree import ElementTree

from netdesign.report.drawing.plain_svg import BLUE
from netdesign.report.drawing.section_figure import draw_section
from netdesign.report.words import ENGLISH, show_member
from tests.each import each
from tests.report.build_study import build_section, build_study
from tests.report.drawing.drawn import build_forces, build_pulls

ROW = build_study().rows[1]
TEXT = "{http://www.w3.org/2000/svg}text"


def texts(svg):
    return [element.text for element in ElementTree.fromstring(svg).iter(TEXT)]


@each("slope", [5.0, 25.0, 40.0, 60.0])
@each("seed", [1, 2])
def test_section_names_every_force_once(slope, seed):
    drawing = replace(build_section(random.Random(seed)), slope_deg=slope)
    forces = build_forces(random.Random(5))
    shown = texts(draw_section(drawing, build_pulls(random.Random(7)), forces))
    for member, (_, text) in forces.items():
        assert shown.count(show_member(ENGLISH, member)) == 1
        assert text in shown
    assert f"{slope:g}°" in shown


def test_an_anchor_without_a_force_has_no_arrow_and_no_number():
    pulls, forces = build_pulls(random.Random(7)), {"foot_anchor": (37.1, "37.1 kN")}
    alone = draw_section(ROW.drawing, pulls, forces)
    assert "Downhill anchor" not in texts(alone)
    assert "0.00 kN" not in alone
    more = forces | {"uphill_anchor": (11.3, "11.3 kN")}
    assert draw_section(ROW.drawing, pulls, more).count(BLUE) > alone.count(BLUE)
