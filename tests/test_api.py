"""The door from Python: a workbook to reports, and the parts of a solve."""

import json
import sys
from dataclasses import replace
from math import radians
from pathlib import Path

import pytest

import netdesign as nd
from netdesign.outcome import NetDesignError
from netdesign.words.catalogue import LANGUAGES
from tests.short_example import write_short_example

LAYOUT = nd.SupportLayout(
    post_spacing=3.5, uphill_anchor_distance=3.0, downhill_anchor_distance=2.5
)


def build_scene(**snow):
    pack = {"slope_angle": radians(40), "thickness": 3.0, "upslope_length": 20.0}
    net = nd.Net(
        height_normal=3.0,
        inclination=radians(30),
        stiffness_per_m=2e7,
        slack=0.05,
        friction_angle=radians(30),
    )
    return nd.Scene(
        snowpack=nd.Snowpack(**{**pack, "density": 300.0, **snow}),
        ground=nd.build_ground_from_glide_factor(1.8, 3.0),
        net=net,
    )


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    path = tmp_path_factory.mktemp("site") / "site.xlsx"
    write_short_example(path, ["R1", "R6"])
    return nd.check(str(path), accuracy=0.05)


def test_a_site_is_checked_by_its_path_as_by_what_was_read(study, tmp_path):
    write_short_example(tmp_path / "site.xlsx", ["R1", "R6"])
    site = nd.read_site(str(tmp_path / "site.xlsx"))
    again = nd.check(site, nd.load_standard("nf-p-95-304-style"), accuracy=0.05)
    assert again.rows == study.rows
    assert [row.id for row in study.rows] == ["R1", "R6"]


def test_reliability_is_worked_out_where_it_is_asked_for(study, tmp_path):
    write_short_example(tmp_path / "site.xlsx", ["R1", "R6"])
    path = str(tmp_path / "site.xlsx")
    again = nd.check(path, accuracy=0.05, reliability=True)
    first, second = (row.reliability for row in again.rows)
    assert first.beta is not None or first.reason is not None
    assert second.reason is not None  # a resistance is missing
    assert all(row.reliability is None for row in study.rows)
    assert [replace(row, reliability=None) for row in again.rows] == study.rows


def test_the_frame_has_every_check_once(study):
    frame = study.to_frame()
    checks = [(row.id, one) for row in study.rows for one in row.checks]
    assert len(frame) == len(checks)
    for (_, line), (row, check) in zip(frame.iterrows(), checks, strict=True):
        assert (line["row"], line["member"], line["mode"]) == (
            *(row, check.member, check.mode),
        )
        assert line["verdict"] == check.verdict.value
        if check.utilisation is not None:
            assert line["utilisation"] == pytest.approx(check.utilisation)
            assert line["demand_kN"] == pytest.approx(check.demand_kN)
    assert not frame.duplicated(["row", "member", "mode", "position"]).any()


@pytest.mark.parametrize("language", LANGUAGES)
def test_reports_are_written_read_again_and_replaced(study, tmp_path, language):
    folder = str(tmp_path / "out")
    written = nd.write_reports(study, folder, language=language)
    names = ["study.json", "report.html", "report.xlsx"]
    assert [path.name for path in written] == names
    assert nd.read_study(folder + "/study.json").rows == study.rows
    assert nd.write_reports(study, folder, language=language, kinds=["csv"])
    page = tmp_path / "out" / "report.html"
    page.write_text("mine", encoding="utf-8")
    with pytest.raises(nd.NetDesignError, match="exists already"):
        nd.write_reports(study, folder, language=language)
    assert page.read_text(encoding="utf-8") == "mine"


def test_a_kind_that_is_none_is_named_with_those_there_are(study, tmp_path):
    with pytest.raises(nd.NetDesignError, match="html, xlsx, docx"):
        nd.write_reports(study, tmp_path, kinds=["word"])
    assert list(tmp_path.iterdir()) == []


def test_forces_of_a_support_balance_the_net(tmp_path):
    solution = nd.solve_steady(build_scene())
    forces = nd.find_anchor_forces(solution, LAYOUT)
    on_ground = forces.on_ground.values()
    for axis in ("x", "y"):
        pulls = getattr(solution.foot, axis) + getattr(solution.head, axis)
        total = sum(getattr(one, axis) for one in on_ground)
        assert total == pytest.approx(3.5 * pulls, rel=1e-9)
    figure = solution.plot(tmp_path / "net.png")
    assert (tmp_path / "net.png").read_bytes().startswith(b"\x89PNG")
    assert figure.axes[0].get_xlabel() == "downslope [m]"


def test_a_picture_without_matplotlib_says_what_to_install(monkeypatch):
    solution = nd.solve_steady(build_scene())
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(NetDesignError, match=r'pip install "netdesign\[plot\]"'):
        solution.plot()


def test_the_envelope_bounds_the_cases_in_it():
    scene = build_scene()
    ranges = nd.Ranges.of(density=nd.Interval(low=250.0, high=400.0))
    found = nd.find_envelope(scene, ranges, LAYOUT, accuracy=0.02)
    assert not found.gap
    bound = found.extremes["foot_anchor"].widened.high
    for density in (250.0, 317.0, 400.0):
        solution = nd.solve_steady(build_scene(density=density))
        forces = nd.find_anchor_forces(solution, LAYOUT).member_forces
        assert forces["foot_anchor"] <= 1.001 * bound


def test_the_load_of_the_guideline_follows_its_formula():
    load = nd.find_guideline_load(build_scene(), glide_factor=1.8)
    height = 3.0 / 0.766044443
    rigid = 300.0 * 10.0 * height**2 / 2.0 * load.creep_factor * 1.8
    assert load.rigid == pytest.approx(rigid, rel=1e-3)


@pytest.mark.parametrize(
    ("snow", "told"), [({"density": 0.38}, "kg/m³"), ({"slope_angle": 40}, "rad")]
)
def test_slips_of_a_unit_are_caught_where_they_are_typed(snow, told):
    with pytest.raises(nd.NetDesignError, match=told):
        build_scene(**snow)


def test_kilonewtons_for_newtons_are_caught():
    with pytest.raises(nd.NetDesignError, match="net stiffness = 20000"):
        nd.Net(
            height_normal=3.0,
            inclination=0.5,
            stiffness_per_m=20000.0,
            slack=0.0,
            friction_angle=0.5,
        )


def test_the_notebook_runs_from_its_first_cell_to_its_last(tmp_path, monkeypatch):
    path = Path(nd.__file__).with_name("examples") / "site.ipynb"
    book = json.loads(path.read_text(encoding="utf-8"))
    monkeypatch.chdir(tmp_path)
    names = {}
    cells = [one for one in book["cells"] if one["cell_type"] == "code"]
    for cell in cells:
        exec("".join(cell["source"]), names)
    assert len(cells) > 4
    assert {path.name for path in (tmp_path / "reports").iterdir()} >= {
        *("study.json", "report.html", "report.xlsx"),
    }
