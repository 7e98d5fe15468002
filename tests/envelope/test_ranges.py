import pytest

from netdesign.envelope.ranges import Case, Interval, Ranges, build_cases


def test_samples_are_equally_spaced_and_hold_both_ends_exactly():
    samples = Interval(low=0.1, high=0.7, count=4).samples
    assert samples == pytest.approx((0.1, 0.3, 0.5, 0.7), rel=1e-15)
    assert (samples[0], samples[-1]) == (0.1, 0.7)


@pytest.mark.parametrize("count", [1, 2, 5])
def test_a_single_value_is_sampled_once_whatever_the_count(count):
    assert Interval(low=0.5, high=0.5, count=count).samples == (0.5,)


def test_cases_are_the_full_grid_with_the_inclination_fastest():
    ranges = Ranges.of(
        density=Interval(low=250.0, high=450.0, count=3),
        friction_angle=Interval(low=0.2, high=0.4, count=2),
        inclination=Interval(low=0.5, high=0.6, count=2),
    )
    cases = build_cases(ranges)
    assert cases == tuple(
        Case(density=d, friction_angle=f, inclination=i)
        for d in (250.0, 350.0, 450.0)
        for f in (0.2, 0.4)
        for i in (0.5, 0.6)
    )


def test_cases_come_in_ascending_order():
    ranges = Ranges.of(
        density=Interval(low=250.0, high=450.0, count=2),
        friction_angle=Interval(low=0.2, high=0.4, count=3),
        inclination=Interval(low=0.5, high=0.5, count=1),
    )
    cases = build_cases(ranges)
    assert list(cases) == sorted(set(cases))
    assert len(cases) == 2 * 3 * 1
