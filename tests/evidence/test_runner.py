"""The runner: turns, and what a piece of work takes."""

from netdesign.evidence.runner import describe_times, measure, run_in_turns


def test_the_last_begins_in_every_second_repeat():
    order, done = [], []

    def work(name):
        order.append(name)
        return len(order)

    works = {name: lambda name=name: work(name) for name in "abc"}
    results = run_in_turns(works, 3, done.append)
    assert "".join(order) == "abccbaabc" == "".join(done)
    assert results == {"a": [1, 6, 7], "b": [2, 5, 8], "c": [3, 4, 9]}


def test_a_result_comes_with_its_times():
    result, time = measure(lambda: sum(range(10**5)))
    assert result == 4999950000
    assert time.cpu_s > 0.0
    assert time.wall_s > 0.0


def test_median_least_and_most():
    assert describe_times([3.0, 5.0, 4.0]) == {"median": 4.0, "least": 3.0, "most": 5.0}
