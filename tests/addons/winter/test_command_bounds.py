"""Winters of thin snow on terminal, page and in the exit code of ``winter``."""

from netdesign.addons.winter.command import _is_proven


def is_settled(largest, thin):
    winters = [{"is_proven": True}, {"is_proven": thin, "is_below_largest": largest}]
    return _is_proven({"rows": [{"winters": winters}]})


def test_a_bound_below_the_largest_maximum_is_enough():
    found = [is_settled(*one) for one in ((True, False), (False, False), (False, True))]
    assert found == [True, False, True]
