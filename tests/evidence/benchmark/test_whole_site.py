"""The site of the benchmark: distinct rows, the first ones those of the example."""

from netdesign.evidence.benchmark.whole_site import build_bench_site


def test_rows_are_distinct_and_begin_with_the_example():
    rows = build_bench_site(9).rows
    assert [row.id for row in rows[:2]] == ["R1.1", "R2.1"]
    assert rows[7].id == "R1.2"
    assert rows[7].snow_thickness == 0.97 * rows[0].snow_thickness
    assert len({(row.snow_thickness, row.slope_angle) for row in rows}) == 9
    assert all(row.snow_thickness <= row.net_height for row in rows)
