"""Ranges without a sheet of their own: answered."""

import random

import openpyxl
import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.reader import read_site
from netdesign.site.titles import name_map
from netdesign.words.catalogue import LANGUAGES
from tests.site_lines import write_lines
from tests.study.knowing_less.drawn_site import draw_lines

TO = {"en": "to", "de": "bis", "fr": "à"}


def write(path):
    write_lines(path, draw_lines(3))
    book = openpyxl.load_workbook(path)
    del book["Ranges"]
    book.save(path)
    return path


def ends(site):
    return {
        name: (one.low, one.high)
        for name, one in site.ranges.intervals
        if name in ("density", "friction_angle")
    }


@pytest.mark.parametrize("language", LANGUAGES)
def test_they_are_assumed_or_answered(tmp_path, language):
    draw = random.Random(language)
    path = write(tmp_path / "site.xlsx")
    assert {one.key for one in read_site(path).rows[0].assumed} > {
        *("density", "friction_angle", "inclination"),
    }
    low, high = draw.randint(210, 290), draw.randint(350, 480)
    answers = (
        f'"density [kg/m3]" = "{low} {TO[language]} {high}"',
        f'"friction angle [deg]" = "12.5 {TO[language]} 37.5"',
    )
    head = 'schema = "netdesign.map/1"\n[ranges]\n'
    name_map(path).write_text(head + "\n".join(answers), encoding="utf-8")
    site = read_site(path)
    assert ends(site)["density"] == (low, high)
    assert ends(site)["friction_angle"] == pytest.approx((0.2181662, 0.6544985))
    places = [one.cell for one in site.range_inputs if "range" in one.cell.lower()]
    assert places  # where an answer stands is told


def test_they_are_refused_beside_a_sheet_of_ranges(tmp_path):
    path = tmp_path / "site.xlsx"
    write_lines(path, draw_lines(3))
    answers = 'schema = "netdesign.map/1"\n[ranges]\n"density [kg/m3]" = "200 to 300"\n'
    name_map(path).write_text(answers, encoding="utf-8")
    with pytest.raises(SiteDataError, match="has a sheet of ranges"):
        read_site(path)
