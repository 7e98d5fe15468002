"""Winters of thin snow on terminal, page and in the exit code of ``winter``."""

import json

from netdesign.commands.winter import _is_proven
from tests.short_example import write_short_example

QUICK = ("--accuracy", "0.05", "--jobs", "1", "--every", "60", "--quiet")
THIN = [0.0, 0.4, 0.7, 0.8, 0.75, 0.6, 0.3]  # of the largest height


def write_winters(path, tops):
    """Winters with a week of snow in February, covered from autumn to summer."""
    lines = ["date,HS [cm]"]
    for year, top in enumerate(tops, 1981):
        for month, days in ((11, 30), (12, 31), (1, 31), (2, 28), (3, 31), (4, 30)):
            for day in range(1, days + 1):
                share = THIN[(day - 4) % 7] if month == 2 and 4 <= day < 11 else 0.0
                stamp = f"{year + (month < 11)}-{month:02d}-{day:02d}"
                lines.append(f"{stamp},{100 * top * share:.0f}")
    path.write_text("\n".join(lines) + "\n")
    return path


def is_settled(largest, thin):
    winters = [{"is_proven": True}, {"is_proven": thin, "is_below_largest": largest}]
    return _is_proven({"rows": [{"winters": winters}]})


def test_a_bound_below_the_largest_maximum_is_enough():
    found = [is_settled(*one) for one in ((True, False), (False, False), (False, True))]
    assert found == [True, False, True]


def test_page_and_terminal_say_at_most(call, tmp_path):
    site, folder = tmp_path / "site.xlsx", tmp_path / "out"
    write_short_example(site, ["R2"])
    heights = write_winters(tmp_path / "thin.csv", [2.6, 0.9])
    ended = call(
        "winter", site, "--heights", heights, "--out", folder, "--accept-heights",
        *QUICK,
    )  # fmt: skip
    document = json.loads((folder / "winter.json").read_text(encoding="utf-8"))
    (row,) = document["rows"]
    large, thin = row["winters"]
    bound = thin["uniform_at_most_kN_per_m"]
    assert (large["outcome"], thin["outcome"]) == ("solved", "doubtful")
    assert (large["uniform_at_most_kN_per_m"], thin["is_proven"]) == (None, False)
    assert 0.0 < bound < large["uniform_peak_kN_per_m"]
    assert thin["is_below_largest"]
    none = ("foot_peak_kN_per_m", "head_peak_kN_per_m", "uniform_peak_kN_per_m")
    assert [thin[one] is None for one in none] == [thin["governing_date"] is None] * 3
    assert ended.code == 0
    page = (folder / "winter.html").read_text(encoding="utf-8")
    shown = f"{bound:.1f}"
    assert f"≤ {shown}" in page
    assert thin["why"] in ended.out
    assert shown in thin["why"]
    assert row["statistics"] is None
    (lack,) = row["statistics_notes"]
    assert "15" in lack
    assert lack in ended.out
