"""A site on which more than three quantities range: cases, document, audit, outputs."""

import csv
import json
from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.envelope.ranges import Case, Interval, Ranges
from netdesign.report.files import ReportStyle, render_kind
from netdesign.report.page import render_html
from netdesign.site.model import InputEcho
from netdesign.snow.ground import build_ground_from_glide_factor
from netdesign.snow.snowpack import Layer
from netdesign.study.case_records import read_point, record_point
from netdesign.study.cases import search_site
from netdesign.study.document import read_document, write_document
from netdesign.study.judge import judge_site
from netdesign.study.row_to_check import CaseSolver
from netdesign.words.message import say
from tests.small_site import RUN, build_row, build_site

RANGES = Ranges.of(
    density=Interval(low=283.0, high=371.0),
    friction_angle=Interval(low=0.43, high=0.43),
    inclination=Interval(low=0.52, high=0.52),
    thickness=Interval(low=2.13, high=2.5),
    slack=Interval(low=0.021, high=0.073),
    glide_factor=Interval(low=1.23, high=1.77),
)
LAYERS = (
    Layer(thickness=0.9, density=377.0),
    Layer(thickness=1.4, density=291.0),
)


def sliding(name, **changes):
    ground = build_ground_from_glide_factor(1.77, 2.5)
    return build_row(name, ground=ground, glide_factor=1.77, slack=0.021, **changes)


def echo(quantity, end, value):
    label = say(f"column.{end}_end", name=say(f"column.quantities.{quantity}"))
    return InputEcho(label=label, unit="-", text=str(value), value=value, cell="B9")


@pytest.fixture(scope="module")
def site():
    rows = (sliding("uniform"), sliding("layered", layers=LAYERS))
    ends = [(end, getattr(RANGES["slack"], end)) for end in ("low", "high")]
    inputs = tuple(echo("slack", end, value) for end, value in ends)
    return build_site(*rows, ranges=RANGES, range_inputs=inputs)


@pytest.fixture(scope="module")
def envelopes(site):
    return search_site(site, RUN)


@pytest.fixture(scope="module")
def standard():
    return load_standard("nf-p-95-304-style")


@pytest.fixture(scope="module")
def study(site, envelopes, standard):
    solver = CaseSolver(RUN.settings, RUN.creep_law)
    return judge_site(site, envelopes, standard, RUN, solver)


def test_points_go_to_records_and_back():
    values = RANGES.place((0.3, 0.7, 0.2, 0.9))
    case = Case.of(values)
    point = record_point(case)
    assert (point.thickness_m, point.slack) == (values["thickness"], values["slack"])
    assert point.upslope_length_m is None
    again = read_point(point)
    assert again.others == case.others
    assert again.inclination == pytest.approx(case.inclination, rel=1e-9)


def test_the_document_holds_what_ranges_and_nothing_else(study):
    text = write_document(study)
    document = json.loads(text)
    keys = ["density_kg_m3", "friction_deg", "inclination_deg", "thickness_m", "slack"]
    for row in document["rows"]:
        assert all([*case["case"]] == [*keys, "glide_factor"] for case in row["cases"])
        assert [*row["checks"][0]["case"]] == [*keys, "glide_factor"]
    assert read_document(text) == replace(study, digest=document["digest"])


def test_outputs_have_a_column_for_what_ranges(study):
    text = render_kind(".csv", study, ReportStyle()).decode()
    lines = list(csv.DictReader(text.splitlines()))
    assert {"thickness_m", "slack", "glide_factor"} <= set(lines[0])
    assert "slip_length_m" not in lines[0]
    assert all(0.021 <= float(line["slack"]) <= 0.073 for line in lines)
    page = render_html(study)
    assert "Glide factor" in page
    assert "d 2.5 m, s 0.021, N 1.77" in page.replace("\N{NO-BREAK SPACE}", " ")
