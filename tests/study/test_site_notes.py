"""Notes of a site that hold for all of its rows."""

from dataclasses import replace
from datetime import date

import pytest

from netdesign.checks import load_standard
from netdesign.envelope.ranges import Interval, Ranges
from netdesign.site.further_sheets import MonitoringSeries
from netdesign.site.model import StationWinter
from netdesign.snow.heights import HeightSeries
from netdesign.study.judge import gather_study
from netdesign.study.notes import list_site_notes
from netdesign.words.catalogue import LANGUAGES, render
from tests.small_site import RANGES, ROWS, RUN, build_site

FINEST = ("0.05 %", "0.1 %"), ("0,05 %", "0,1 %")


def list_of_accuracy(site, accuracy):
    notes = list_site_notes(site, (), RUN.creep_law, accuracy)
    return [one for one in notes if one.key == "note.accuracy_of_cases"]


@pytest.mark.parametrize(("accuracy", "count"), [(5e-4, 1), (1e-3, 0), (0.01, 0)])
def test_an_accuracy_finer_than_the_search_is_told_as_that_of_the_cases(
    accuracy, count
):
    assert len(list_of_accuracy(build_site(*ROWS), accuracy)) == count
    ends = {name: span.low for name, span in RANGES.intervals}
    single = Ranges.of(**{k: Interval(low=end, high=end) for k, end in ends.items()})
    site = build_site(*ROWS, ranges=single)
    assert list_of_accuracy(site, accuracy) == []  # one case has no gap


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_note_says_both_accuracies(language):
    (note,) = list_of_accuracy(build_site(*ROWS), 5e-4)
    told = render(note, language).replace("\N{NO-BREAK SPACE}", " ")
    told = told.replace("\N{NARROW NO-BREAK SPACE}", " ")
    for shown in FINEST[language != "en"]:
        assert shown in told


def test_the_note_stands_in_the_study():
    standard = load_standard("nf-p-95-304-style")
    run = replace(RUN, settings=replace(RUN.settings, accuracy=5e-4))
    site = build_site(*ROWS)
    keys = [one.key for one in gather_study(site, [], standard, run).notes]
    assert "note.accuracy_of_cases" in keys


def test_measured_forces_without_a_winter_say_what_they_need():
    series = MonitoringSeries(
        row_id="R1",
        member="foot_anchor",
        times=(0.0, 43200.0),
        tensions=(10e3, None),
        air_temperatures=(263.15, None),
        source="Monitoring!A2",
    )
    heights = HeightSeries(first_day=date(2003, 1, 1), heights=(0.0,))
    for winter, count in ((None, 1), (StationWinter(series=heights), 0)):
        site = build_site(*ROWS, monitoring=(series,), winter=winter)
        notes = [one.key for one in list_site_notes(site, (), RUN.creep_law, 0.01)]
        assert notes.count("monitoring.needs_winter") == count
