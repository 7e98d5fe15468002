"""The page of the paper's study: complete, safe, and true to the runs."""

import csv
import io
from xml.etree import ElementTree

import pytest

from netdesign.evidence.paper.page import PAGE_FILE, name_history, render_paper
from netdesign.evidence.paper.runs import find_history
from tests.build_paper import build_study
from tests.report.reading import PageReader


@pytest.fixture(scope="module")
def study():
    return build_study(lambda case: 3e5 + 1e3 * case.friction_deg)


@pytest.fixture(scope="module")
def files(study):
    return render_paper(study)


def read_csv(content):
    return list(csv.DictReader(io.StringIO(content.decode())))


def test_page_is_self_contained_and_without_script(files):
    page = files[PAGE_FILE].decode()
    reader = PageReader(page)
    assert "default-src 'none'" in page
    assert not {"script", "iframe", "object", "img", "link"} & set(reader.tags)
    for loading in ("src=", "@import", "url(http", 'href="http'):
        assert loading not in page
    assert len(reader.ids) == len(set(reader.ids))


def test_every_drawing_stands_on_the_page_and_as_a_file(files):
    page = files[PAGE_FILE].decode()
    drawings = [name for name in files if name.endswith(".svg")]
    assert len(drawings) == 4
    for name in drawings:
        ElementTree.fromstring(files[name])
        assert f'id="plate-{name.removesuffix(".svg")}"' in page


def test_every_history_is_a_file_with_its_numbers(study, files):
    names = [name_history(run) for run in study.runs.values() if run.track]
    assert len(names) == len(set(names))
    run = study[find_history(0.0, 45.0)]
    rows = read_csv(files[f"{name_history(run)}.csv"])
    assert len(rows) == len(run.track.times)
    assert float(rows[-1]["foot_kN_per_m"]) == pytest.approx(run.track.foot[-1] / 1e3)
    assert float(rows[-1]["node_at_1.00m_x_kN_per_m"]) == pytest.approx(
        run.track.lower[0, -1] / 1e3
    )


def test_plateau_table_has_the_runs_values(study, files):
    rows = read_csv(files["plateau.csv"])
    assert len(rows) == 8
    straight = next(row for row in rows if row["method"] == "history, straight start")
    assert float(straight["foot_kN_per_m"]) * 1e3 == study[find_history(0.0)].foot
    assert float(straight["plateau_from_s"]) >= 1000.0


def test_friction_table_tells_the_change_from_the_least_angle(files):
    rows = read_csv(files["friction.csv"])
    assert len(rows) == 2 * (6 + 2) + 6
    foot = next(row for row in rows if row["method"] == "steady")
    change = 100.0 * (3.45e5 / 3.15e5 - 1.0)
    assert float(foot["change_percent"]) == pytest.approx(change)


def test_same_study_gives_the_same_bytes(study, files):
    assert render_paper(study) == files


def test_failed_runs_are_told_and_leave_their_cells_empty():
    failed = render_paper(build_study(failing=[find_history(0.0)]))
    assert "1 run gave no result" in failed[PAGE_FILE].decode()
    row = next(
        row
        for row in read_csv(failed["plateau.csv"])
        if row["method"] == "history, straight start"
    )
    assert row["foot_kN_per_m"] == row["plateau_from_s"] == ""
