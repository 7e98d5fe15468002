"""Points of the first design, and the choice of the next ones."""

from dataclasses import replace

import numpy as np

from netdesign.search.upper_bound import (
    Bounds,
    Wanted,
    choose_questions,
    list_first_design,
)


def list_wanted(*entries):
    """Points that may be asked for: excess, point, quantity of each."""
    return Wanted(*map(np.array, zip(*entries, strict=True)))


# Of two watched quantities, in tolerances above what is allowed.
WANTED = (
    (9.0, (0.25, 0.25), 0),
    (8.1, (0.3125, 0.25), 0),
    (3.3, (0.75, 0.5), 0),
    (-0.4, (0.75, 1.0), 1),
)
OPEN = Bounds(
    best=np.array([7.3, 2.9]),
    tolerance=np.array([0.04, 0.04]),
    upper=np.array([7.7, 2.91]),
    watched=(0, 1),
    deciding=(0, 1),
    summits=((0.0, 0.4375), (0.5, 1.0)),
    wanted=list_wanted(*WANTED),
)
CLOSED = replace(OPEN, upper=np.array([7.33, 2.93]))


def test_first_design_holds_corners_centre_and_the_parts_between():
    assert list_first_design(1) == ((0.0,), (0.25,), (0.5,), (0.75,), (1.0,))
    for dimension in (2, 3, 4, 5, 6):
        points = list_first_design(dimension)
        assert len(set(points)) == len(points)
        assert {(0.5,) * dimension, (0.0,) * dimension, (1.0,) * dimension} <= set(
            points
        )
        assert (0.25,) * dimension in points
    assert len(list_first_design(3)) == 3**3 + 2**3
    assert len(list_first_design(6)) == 2**6 + 1 + 12 + 2**6


def test_where_a_quantity_could_exceed_is_asked_first_and_apart():
    chosen = choose_questions(OPEN, [(0.0, 0.0)], batch=6, room=90)
    assert chosen == [(0.25, 0.25), (0.75, 0.5)]


def test_where_all_that_could_exceed_is_known_the_like_of_it_is_asked():
    known = [(0.25, 0.25), (0.3125, 0.25), (0.75, 0.5)]
    negative = replace(OPEN, wanted=list_wanted(*WANTED, (-0.6, (0.75, 0.9375), 0)))
    assert choose_questions(negative, known, batch=6, room=90) == [(0.75, 0.9375)]


def test_closed_bounds_are_tested_beside_their_maxima_inside_the_box():
    chosen = choose_questions(CLOSED, [(0.0, 0.5)], batch=2, room=90)
    assert chosen == [
        (0.0625, 0.4375),
        (0.0, 0.375),
        (0.4375, 1.0),
        (0.5625, 1.0),
        (0.5, 0.9375),
    ]
    assert choose_questions(CLOSED, [(0.0, 0.5)], batch=2, room=3) == chosen[:3]
