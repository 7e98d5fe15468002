"""Page of a winter: days without a force, the trend of the maxima."""

from netdesign.report.page.winter_page import (
    _list_failed,
    _list_unproven,
    _show_trend,
)
from netdesign.report.words import Words


def build_day(date, outcome, reason=""):
    return {"date": date, "outcome": outcome, "reason": reason}


def test_days_of_one_reason_stand_together():
    curve = [
        build_day("2021-01-04", "failed", "the net folds"),
        build_day("2021-01-08", "solved"),
        build_day("2021-01-12", "failed", "the net folds"),
        build_day("2021-01-16", "solved", "the net folds"),
        build_day("2021-01-20", "failed", "the snow lifts"),
    ]
    assert _list_failed({"curve": curve}, Words("en")) == [
        "2 × without a force (the net folds): 2021-01-04, 2021-01-12",
        "1 × not solvable in layers, calculated as uniform snow (the net folds): "
        "2021-01-16",
        "1 × without a force (the snow lifts): 2021-01-20",
    ]


def test_a_trend_is_set_off_and_none_is_plain():
    shown, plain = (
        _show_trend({"why": "The maxima", "is_shown": one}) for one in (True, False)
    )
    assert (shown.look, plain.look) == ("notes open", "")
    assert "The maxima" in str(shown)
    assert plain.text == "The maxima"


def test_a_day_without_a_reason_has_no_brackets():
    curve = [build_day("2021-04-06", "overtopped")]
    (told,) = _list_failed({"curve": curve}, Words("en"))
    assert told.endswith(": 2021-04-06")
    assert "(" not in told


def test_winters_of_one_reason_stand_together():
    whys = {"2019/2020": "too high", "2020/2021": "a gap", "2021/2022": "too high"}
    winters = [
        {"name": name, "why": why, "is_proven": False, "is_below_largest": False}
        for name, why in whys.items()
    ]
    winters.append(
        {"name": "2022/2023", "why": "", "is_proven": True, "is_below_largest": False}
    )
    below = {"name": "2023/2024", "why": "thin", "is_proven": False}
    winters.append(below | {"is_below_largest": True})
    assert _list_unproven({"winters": winters}, Words("en")) == [
        "2019/2020, 2021/2022: too high",
        "2020/2021: a gap",
    ]
