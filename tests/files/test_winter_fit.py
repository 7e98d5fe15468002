"""The fit in the winter document and on its page: every ending, every language."""

import json
import math
from datetime import date

import numpy as np
import pytest

from netdesign.checks.result import Band
from netdesign.files.winter_fit import write_fit
from netdesign.report.blocks import Figure, Heading, Part, Table
from netdesign.report.page.winter_fit import show_fit
from netdesign.report.words import Words
from netdesign.snowpack.series import HeightSeries
from netdesign.winter.fit import ForceBand, SeasonFit
from netdesign.winter.fit_inputs import FitReading, Noise
from netdesign.winter.gauss_newton import Parameter, fit_gauss_newton
from netdesign.words.catalogue import LANGUAGES
from tests.each import each

SERIES = HeightSeries(first_day=date(2011, 1, 7), heights=(1.3,) * 40)
READINGS = tuple(
    FitReading(index=k, member="post", force=2.1e4 + 70.0 * k) for k in (3, 9, 17)
)
PARAMETERS = (
    Parameter(name="slip_length", mean=math.log(3.1), deviation=1.5, step=0.2),
    Parameter(name="friction_angle", mean=0.5, deviation=0.17, step=0.03),
)
BEFORE = ForceBand(
    case="governing",
    member="post",
    before=Band(low=1.7e4, value=2.3e4, high=3.1e4),
    deviation_before=0.18,
)


def fitted(ending, response=None):
    slopes = np.array([[0.2, 0.01], [0.19, 0.02], [0.21, -0.01], [0.2, 0.0]])
    fit = fit_gauss_newton(
        response or (lambda values: slopes @ values + 9.6),
        np.log([one.force for one in READINGS]),
        0.0025 * np.eye(3),
        PARAMETERS,
    )
    return SeasonFit(
        winter="2010/2011",
        ending=ending,
        readings=READINGS,
        left_out=(4,),
        noise=Noise(),
        known=frozenset({"slack"}),
        parameters=PARAMETERS,
        fit=fit,
        computed=tuple(map(float, np.exp(fit.posterior.response[:3]))),
        deviations=(0.05, 0.06, 0.07),
        rms=0.031,
        misfit=0.62,
        governing=17,
        forces=(BEFORE,),
    )


@each("language", LANGUAGES)
@each("ending", ["fitted", "misfit", "far", "unsettled"])
def test_every_ending_is_written_and_shown(ending, language):
    document = write_fit(fitted(ending), SERIES, language)
    json.dumps(document, allow_nan=False)
    assert document["outcome"] == ending
    assert document["days_left_out"] == ["2011-01-11"]
    assert document["governing_date"] == "2011-01-24"
    slip, friction = document["parameters"]
    assert slip["prior"] == pytest.approx(3.1)
    assert friction["prior_deviation"] == pytest.approx(np.degrees(0.17))
    assert friction["unit"] == "deg"
    assert not friction["is_constrained"]
    assert slip["is_constrained"] == (ending == "fitted")
    words = Words(language)
    blocks = list(show_fit(document, 390.0, words))
    frame = next(one for one in blocks if isinstance(one, Part))
    assert frame.look == ("notes" if ending == "fitted" else "notes open")
    (told,) = frame.blocks
    assert any(words("fit_parameter.slack") in one for one in told.items)
    (figure,) = (one for one in blocks if isinstance(one, Figure))
    assert figure.svg.count("<circle") == 4  # three readings, and their name
    caption = words("fit_page.parameters_caption")
    worth = [row[-1].text for row in list_tables(blocks)[caption].rows]
    assert (words("fit_page.unconstrained") in worth) == (ending == "fitted")


def list_tables(blocks):
    """Tables by their captions."""
    return {one.caption: one for one in blocks if isinstance(one, Table)}


def test_without_an_answer_no_number_is_shown():
    silent = fitted("failed", lambda _: np.full(4, np.nan))
    document = write_fit(silent, SERIES, "en")
    json.dumps(document, allow_nan=False)
    assert (document["residuals"], document["correlations"]) == ([], [])
    assert [one["posterior_deviation"] for one in document["parameters"]] == [None] * 2
    blocks = list(show_fit(document, 390.0, Words("en")))
    assert not any(isinstance(one, Figure) for one in blocks)
    assert Words("en")("fit_page.residuals_caption") not in list_tables(blocks)


def test_few_readings_have_a_sentence_alone():
    few = SeasonFit(winter="", ending="few", readings=READINGS[:1], noise=Noise())
    document = write_fit(few, SERIES, "en")
    assert "1 day with a usable reading" in document["why"]
    blocks = list(show_fit(document, 390.0, Words("en")))
    assert [type(one) for one in blocks] == [Heading, Part]  # which has the sentence
