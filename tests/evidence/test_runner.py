"""The runner: turns, and what a piece of work takes."""

from netdesign.evidence.runner import measure, run_in_turns


def test_the_last_begins_in_every_second_repeat():
    order, done = [], []

    def work(name):
        order.append(name)
        return len(order)

    works = {name: lambda name=name: work(name) for name in "abc"}
    results = run_in_turns(works, 3, done.append)
    assert "".join(order) == "abccbaabc" == "".join(done)
    assert results == {"a": [1, 6, 7], "b": [2, 5, 8], "c": [3, 4, 9]}


def test_a_piece_of_work_takes_time():
    done = []
    assert measure(lambda: done.append(sum(range(10**5)))) > 0.0
    assert done == [4999950000]
