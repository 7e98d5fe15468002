"""The page of the paper's study: complete, safe, and true to the runs."""

import csv
import io
import re
from dataclasses import replace
from xml.etree import ElementTree

import pytest

from netdesign import __version__
from netdesign.evidence.paper.findings import list_findings, word_finding
from netdesign.evidence.paper.page import PAGE_FILE, name_history, render_paper
from netdesign.evidence.paper.runs import find_history
from netdesign.evidence.paper.tables import list_tables
from netdesign.report.words import Words
from netdesign.words.message import say
from tests.build_paper import build_study
from tests.commands.every_command import read_page
from tests.report.reading import PageReader
from tests.words.english import list_vocabulary, list_words


@pytest.fixture(scope="module")
def study():
    return build_study(lambda case: 3e5 + 1e3 * case.friction_deg, swings=9)


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


def test_page_has_every_statement_with_its_call(study, files):
    text = " ".join("".join(PageReader(files[PAGE_FILE].decode()).text).split())
    findings = list_findings(study)
    assert len(findings) == 7
    for finding in findings:
        claim = word_finding(finding)
        assert claim.text[0].text in text
        assert claim.text[1].text in text
    agreed = sum(finding.call == "agrees" for finding in findings)
    assert f"Of 7 statements of the paper, the runs agree with {agreed}." in text


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


def test_trend_table_gives_the_distance_from_the_implicit_history(files):
    rows = read_csv(files["staggered-trend.csv"])
    assert [float(row["base_drag"]) for row in rows] == [0.2, 0.1, 0.05, 0.02]
    assert all(row["against_implicit_percent"] for row in rows)


def test_same_study_gives_the_same_bytes(study, files):
    assert render_paper(study) == files


def test_failed_runs_are_named_and_their_statements_open():
    failing = [find_history(0.0)]
    page = render_paper(build_study(failing=failing))[PAGE_FILE].decode()
    assert "1 of the runs gave no result" in page
    assert "made to fail" in page
    assert "not decided" in page


def test_signs_are_minus_signs_and_no_zero_has_one():
    study = build_study(lambda case: 3e5 * (0.9 if case.gravity != "full" else 1.0))
    claim = word_finding(next(f for f in list_findings(study) if f.key == "settlement"))
    assert "foot −10.0%" in claim.text[1].text
    flat = next(f for f in list_findings(build_study()) if f.key == "settlement")
    assert "foot 0.0%" in word_finding(flat).text[1].text


@pytest.fixture(scope="module", params=["fr", "de"])
def told(request, study):
    """Words of a language, and the files in it."""
    return Words(request.param), render_paper(study, request.param)


def tell_open(words):
    """Statements and tables of a study with a failed run and one that ended early."""
    study, case = build_study(failing=[find_history(0.0)]), find_history(0.0, 45.0)
    reason = say("staggered.no_increment", time=0.37)
    track = replace(study[case].track, ended=reason)
    study = replace(study, runs={**study.runs, case: replace(study[case], track=track)})
    told = [
        word_finding(finding, words).text[1].text for finding in list_findings(study)
    ]
    tables = [listed.table for listed in list_tables(study, words)]
    told += [cell.text for table in tables for row in table.rows for cell in row]
    assert words.show(reason) in " ".join(told)
    return told


def test_no_english_stands_on_the_page(told):
    words, files = told
    english = list_vocabulary("en") - list_vocabulary(words.language)
    shown = [
        read_page(content.decode())
        for name, content in files.items()
        if name.endswith((".html", ".svg"))
    ]
    text = " ".join((*shown, *tell_open(words)))
    text = text.replace(f"netdesign paper · {__version__}", "")
    text = text.replace("made to fail", "")  # somebody's own words
    assert len(list_words(text)) > 200
    assert list_words(text) & english == set()
    assert f'<html lang="{words.language}">' in files[PAGE_FILE].decode()
    assert re.findall(r"\d\.\d", text) == []
    assert len(re.findall(r"\d,\d", text)) > 60


def test_statements_are_told_in_the_language(study, told):
    words, files = told
    text = " ".join(read_page(files[PAGE_FILE].decode()).split())
    for finding in list_findings(study):
        claim = word_finding(finding, words)
        assert " ".join(claim.text[1].text.split()) in text
        assert claim.name in text


def test_tables_for_programs_are_the_same_in_every_language(files, told):
    _, in_language = told
    tables = [name for name in files if name.endswith(".csv")]
    assert len(tables) > 20
    assert {one: in_language[one] for one in tables} == {
        one: files[one] for one in tables
    }


@pytest.mark.parametrize("language", ["fr", "de"])
def test_signs_are_those_of_the_language(language):
    study = build_study(lambda case: 3e5 * (0.9 if case.gravity != "full" else 1.0))
    pages = {}
    for name, one in (("change", study), ("none", build_study())):
        finding = next(f for f in list_findings(one) if f.key == "settlement")
        pages[name] = word_finding(finding, Words(language)).text[1].text
    assert " −10,0\u00a0%" in pages["change"]
    assert " 0,0\u00a0%" in pages["none"]
    assert not re.search(r"[+-]\d", pages["change"] + pages["none"])
