"""The door from Python: a workbook to reports, and the parts of a solve."""

import json
import math
import re
import sys
from dataclasses import replace
from math import radians
from pathlib import Path

import pandas as pd
import pytest

import netdesign as nd
from netdesign.outcome import SEVERITY, NetDesignError
from netdesign.site.reader import read_frames
from netdesign.site.template.office_workbook import load_input_example
from netdesign.study.scopes import Scope, list_of_scope
from tests.make import write_rows

ADDRESS = re.compile("![A-Z]{1,2}[0-9]+$")
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
    write_rows(path, ["R1", "R6"])
    return nd.check(str(path), accuracy=0.05)


def test_a_site_is_checked_by_its_path_as_by_what_was_read(study, tmp_path):
    write_rows(tmp_path / "site.xlsx", ["R1", "R6"])
    site = nd.read_site(str(tmp_path / "site.xlsx"))
    again = nd.check(
        site, standard=nd.load_standard("nf-p-95-304-style"), accuracy=0.05
    )
    assert again.rows == study.rows
    assert [row.id for row in study.rows] == ["R1", "R6"]


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


def test_the_anchors_are_those_of_the_checks(study):
    frame = study.anchors
    assert not frame.duplicated(["row", "anchor", "position"]).any()
    for _, line in frame.iterrows():
        (row,) = (one for one in study.rows if one.id == line["row"])
        checks = [
            one
            for one in list_of_scope(row.checks, Scope.ANCHORS)
            if one.is_of_force
            and (one.member, one.position) == (line["anchor"], line["position"])
        ]
        worst = min((one.verdict for one in checks), key=SEVERITY.index)
        assert line["verdict"] == worst.value
        told = {str(point.message) for one in checks for point in one.open}
        assert all(one in line["missing"] for one in told)
        if line["utilisation"] == line["utilisation"] != math.inf:
            ratio = line["E_d_kN"] / line["R_d_kN"]
            assert line["utilisation"] == pytest.approx(ratio)
            assert line["E_k_kN"] <= line["E_d_kN"]
    missing = frame[frame["row"] == "R6"]["R_d_kN"].isna()
    assert missing.any()  # a force that was calculated is shown
    assert frame["E_d_kN"].notna().all()


def test_open_points_and_forces_are_those_of_the_rows(study):
    points = [(row.id, one.needs_kN) for row in study.rows for one in row.open]
    assert list(study.open["row"]) == [one for one, _ in points]
    assert list(study.open["needs_kN"].dropna()) == [one for _, one in points if one]
    forces = [one.value_kN for row in study.rows for one in row.forces]
    assert list(study.forces["value_kN"]) == forces
    empty = replace(study, rows=[])
    for name in ("anchors", "open", "forces"):
        frame = getattr(empty, name)
        assert len(frame) == 0
        assert list(frame.columns) == list(getattr(study, name).columns)


def test_a_study_is_shown_in_short_and_without_markup_of_the_site(study):
    rows = [replace(row, id="<b>&R1") for row in study.rows[:1]]
    name = "<script>alert(1)</script>"
    other = replace(study, rows=rows, project=replace(study.project, name=name))
    assert len(repr(study)) < 200
    assert len(repr(study.rows[0])) < 100
    shown = other._repr_html_()
    assert "<script" not in shown
    assert "<b>" not in shown
    assert "&lt;b&gt;&amp;R1" in shown


def give_frames():
    """Lines of the example as frames, with what is missing left empty."""
    tables = load_input_example()
    names = {"rows": "Rows", "net_types": "Net types", "anchor_types": "Anchors"}
    frames = {
        names.get(table, table): pd.DataFrame(
            [
                {k: x["en"] if isinstance(x, dict) else x for k, x in line.items()}
                for line in lines
            ]
        ).replace("", None)
        for table, lines in tables.items()
    }
    (project,) = frames.pop("project").to_dict("records")
    return {**frames, "Project": project}


def test_frames_are_read_as_the_workbook_with_the_same_lines(tmp_path):
    nd.write_site_workbook(tmp_path / "site.xlsx", example=True)
    of_file = nd.read_site(tmp_path / "site.xlsx")
    of_frames = read_frames(give_frames())
    assert of_frames.project == of_file.project
    assert of_frames.ranges == of_file.ranges
    assert len(of_frames.catalogue) == len(of_file.catalogue)
    for one, other in zip(of_frames.rows, of_file.rows, strict=True):
        typed = [(str(x.label), x.value) for x in one.inputs]
        assert typed == [(str(x.label), x.value) for x in other.inputs]
        assert one.layout == other.layout
        assert not [x.cell for x in one.inputs if ADDRESS.search(x.cell)]


def test_a_changed_value_is_that_of_a_frame_and_of_a_file_alike(tmp_path):
    nd.write_site_workbook(tmp_path / "site.xlsx", example=True)
    change = {"A1": {"post_spacing": 2.93}, "B2": {"slope_angle": 36.4, "gap": 0.7}}
    frames = give_frames()
    typed = frames["Rows"].astype(object).set_index("id")
    for row, values in change.items():
        for key, value in values.items():
            typed.loc[row, key] = value
    direct = read_frames({**frames, "Rows": typed.reset_index()})
    for changed in (
        read_frames(frames, change),
        nd.read_site(tmp_path / "site.xlsx", change=change),
    ):
        assert len(changed.what_if) == 3
        for one, other in zip(changed.rows, direct.rows, strict=True):
            assert one.layout == other.layout
            assert [x.value for x in one.inputs] == [x.value for x in other.inputs]


@pytest.mark.parametrize(
    ("change", "named"),
    [
        ({"A1": {"slack": 20.0}}, "A3, A4"),  # they have the net type, too
        ({"Q7": {"post_spacing": 3.0}}, "Q7"),
        ({"A1": {"nothing": 3.0}}, "nothing"),
        ({"A1": {"post_spacing": "wide"}}, "A1, post_spacing"),
        ({x: {"slack": 19.0 + (x == "A4")} for x in ("A1", "A3", "A4")}, "slack"),
    ],
)
def test_a_change_that_cannot_be_is_refused_by_its_names(change, named):
    with pytest.raises(nd.NetDesignError, match=named):
        nd.check(give_frames(), change=change)


def test_faults_of_frames_name_line_and_column():
    frames = give_frames()
    rows = frames["Rows"].astype(object)
    rows.loc[2, "slope_angle"] = "steep"
    with pytest.raises(nd.NetDesignError, match="A3, slope_angle"):
        nd.check({**frames, "Rows": rows})
    with pytest.raises(nd.NetDesignError, match="Wrong"):
        nd.check({**frames, "Wrong": rows})
    with pytest.raises(nd.NetDesignError, match="A9"):
        nd.check(frames, rows=["A9"])


def test_a_net_type_is_changed_for_all_rows_that_have_it():
    rows = ("A1", "A3", "A4")
    site = read_frames(give_frames(), {row: {"slack": 16.5} for row in rows})
    (replaced,) = site.what_if
    assert (replaced.was, replaced.now) == ("14", "16.5")


def test_reports_are_written_read_again_and_replaced(study, tmp_path):
    folder = str(tmp_path / "out")
    written = nd.write_reports(study, folder, language="de")
    names = ["study.json", "report.html", "report.xlsx"]
    assert [path.name for path in written] == names
    assert nd.read_study(folder + "/study.json").rows == study.rows
    assert 'lang="de"' in written[1].read_text(encoding="utf-8")
    assert nd.write_reports(study, folder, kinds=["csv"])
    page = tmp_path / "out" / "report.html"
    page.write_text("mine", encoding="utf-8")
    with pytest.raises(nd.NetDesignError, match="exists already"):
        nd.write_reports(study, folder)
    assert page.read_text(encoding="utf-8") == "mine"


def test_a_kind_that_is_none_is_named_with_those_there_are(study, tmp_path):
    with pytest.raises(nd.NetDesignError, match="html, pdf, docx, xlsx, csv"):
        nd.write_reports(study, tmp_path, kinds=["word"])
    assert list(tmp_path.iterdir()) == []


@pytest.fixture(scope="module")
def solution():
    return nd.solve_steady(build_scene())


def test_forces_of_a_support_balance_the_net(solution, tmp_path):
    forces = nd.find_anchor_forces(solution, LAYOUT)
    places = ("foot_anchor", "uphill_anchor", "downhill_anchor", "post_base")
    on_ground = [getattr(forces, place) for place in places]
    for axis in ("x", "y"):
        pulls = getattr(solution.foot, axis) + getattr(solution.head, axis)
        total = sum(getattr(one, axis) for one in on_ground)
        assert total == pytest.approx(3.5 * pulls, rel=1e-9)
    figure = solution.plot(tmp_path / "net.png")
    assert (tmp_path / "net.png").read_bytes().startswith(b"\x89PNG")
    assert figure.axes[0].get_xlabel() == "downslope [m]"


def test_a_picture_without_matplotlib_says_what_to_install(solution, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(NetDesignError, match=r'pip install "netdesign\[plot\]"'):
        solution.plot()


@pytest.mark.parametrize(
    ("snow", "told"), [({"density": 0.38}, "kg/m³"), ({"slope_angle": 40}, "rad")]
)
def test_slips_of_a_unit_are_caught_where_they_are_typed(snow, told):
    with pytest.raises(nd.NetDesignError, match=told):
        build_scene(**snow)


def run_notebook(name, folder, monkeypatch):
    """Names that a notebook has after its last cell."""
    path = Path(nd.__file__).with_name("examples") / name
    book = json.loads(path.read_text(encoding="utf-8"))
    monkeypatch.chdir(folder)
    names = {}
    cells = [one for one in book["cells"] if one["cell_type"] == "code"]
    for cell in cells:
        exec("".join(cell["source"]), names)
    assert len(cells) > 4
    return names


@pytest.mark.long
def test_the_notebook_runs_from_its_first_cell_to_its_last(tmp_path, monkeypatch):
    run_notebook("site.ipynb", tmp_path, monkeypatch)
    assert {path.name for path in (tmp_path / "reports").iterdir()} >= {
        *("study.json", "report.html", "report.xlsx"),
    }


@pytest.mark.long
def test_the_notebook_on_the_spacing_loads_anchors_the_more_the_wider(
    tmp_path, monkeypatch
):
    names = run_notebook("spacing.ipynb", tmp_path, monkeypatch)
    assert list(names["studies"]) == names["spacings"]
    assert names["used"].loc["foot_anchor"].is_monotonic_increasing
    assert all(study.what_if for study in names["studies"].values())
    assert names["passing"] == names["spacings"][: len(names["passing"])]
