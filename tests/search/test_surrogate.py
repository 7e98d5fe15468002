import numpy as np
import pytest

from netdesign.search.surrogate import (
    FAR_SHARE,
    REACH,
    count_trend_terms,
    fit_surrogate,
    supports_model,
    weigh_axes,
)

RNG = np.random.default_rng(5)
PLACES = RNG.uniform(0.0, 1.0, (24, 3))
KINKED = np.column_stack([np.abs(PLACES @ [1.0, -2.0, 0.5]), np.exp(PLACES[:, 0])])


def test_a_quadratic_is_met_everywhere():
    def quadratic(at):
        return (1.0 + at @ [2.0, -1.0, 3.0] + at[:, 0] * at[:, 1] - 4 * at[:, 2] ** 2)[
            :, None
        ]

    model = fit_surrogate(PLACES, quadratic(PLACES))
    elsewhere = RNG.uniform(0.0, 1.0, (50, 3))
    mean, claim, _ = model.predict(elsewhere)
    assert mean == pytest.approx(quadratic(elsewhere), abs=1e-8)
    assert claim == pytest.approx(0.0, abs=1e-8)
    assert model.held_out == pytest.approx(0.0, abs=1e-8)


def test_held_out_errors_are_those_of_models_without_the_case():
    """The short cut of the module against its definition."""
    model = fit_surrogate(PLACES, KINKED)
    for k in range(len(PLACES)):
        others = np.arange(len(PLACES)) != k
        without = fit_surrogate(PLACES[others], KINKED[others])
        error = KINKED[k] - without.predict(PLACES[[k]]).mean[0]
        assert model.held_out[k] == pytest.approx(error, rel=1e-3, abs=1e-5)


def test_a_score_fades_by_the_distance_of_its_neighbour():
    """Beyond three parameters: (M5) with (M5a), by the ratio of two quantities."""
    places = np.vstack([RNG.uniform(0.0, 1.0, (40, 4)), np.full((2, 4), 0.5)])
    places[-1, 2] += 0.2 * REACH
    kinks = np.abs(places @ [[1.0, 0.2], [-2.0, 0.9], [0.5, 1.1], [0.3, -1.7]])
    model = fit_surrogate(places, kinks)
    apart = np.linalg.norm(places[:, None] - places[None], axis=2)
    np.fill_diagonal(apart, np.inf)
    spacing = apart.min(axis=1)
    assert model.spacings == pytest.approx(spacing, rel=1e-6)
    at = RNG.uniform(0.0, 1.0, (50, 4))
    d = np.linalg.norm(at[:, None] - places[None], axis=2)
    far = FAR_SHARE * np.minimum(1.0, spacing / REACH) ** 1.5
    near = np.exp(-((d / REACH) ** 2)) * np.minimum(1.0, spacing / d) ** 1.5
    share = np.maximum(near, far)
    scale = np.max(share[:, :, None] * model.scores[None], axis=1)
    claim = model.predict(at).standard_error
    assert claim[:, 0] / claim[:, 1] == pytest.approx(scale[:, 0] / scale[:, 1])


def test_an_axis_that_hardly_matters_makes_neighbours():
    """The third one: a step of a thousandth; the others bend."""
    places = RNG.uniform(0.0, 1.0, (75, 5))
    bent = 1.0 / (0.3 + places[:, 0]) + np.sin(3.0 * places[:, 3] * places[:, 4])
    values = np.column_stack([bent + 1e-3 * (places[:, 2] > 0.4), bent**2])
    weights = weigh_axes(places, values, 0.005 * values.max(axis=0))
    assert weights[2] < 1.0
    assert weights[0] == 1.0


def test_the_sway_is_the_sum_of_what_each_doubt_does_to_the_mean():
    """Eq. (M3a), against models of values that are moved by their doubts."""
    doubts = np.zeros_like(KINKED)
    doubts[[3, 11, 20]] = [[0.31, 0.02], [0.07, 0.0], [0.0, 0.13]]
    model = fit_surrogate(PLACES, KINKED, 0.0, doubts)
    elsewhere = RNG.uniform(0.0, 1.0, (30, 3))
    mean = model.predict(elsewhere).mean
    moved = np.zeros_like(mean)
    for place in (3, 11, 20):
        values = KINKED.copy()
        values[place] += doubts[place]
        moved += np.abs(fit_surrogate(PLACES, values).predict(elsewhere).mean - mean)
    assert moved.max() > 0.05
    assert model.select((1, 0)).predict(elsewhere).sway == pytest.approx(moved[:, ::-1])


@pytest.mark.parametrize("dimension", [1, 2, 3, 5])
def test_cases_on_a_face_alone_support_no_model(dimension):
    """Where the others failed; nor do those on two faces across each other."""
    count = 3 * count_trend_terms(dimension)
    places = RNG.uniform(0.0, 1.0, (count, dimension))
    assert supports_model(places)
    assert not supports_model(places[: count_trend_terms(dimension)])
    places[:, 0] = 0.0
    assert not supports_model(places)
    places[::2, 0] = 1.0
    assert not supports_model(places)
