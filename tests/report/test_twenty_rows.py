"""Twenty net rows, searched: below 2 MB, below 3 s, page and workbook together."""

import math
import time
from dataclasses import replace

import pytest

from netdesign.report.page.html import render_html
from netdesign.report.workbook.excel import render_workbook
from netdesign.study.case_records import (
    AxisRecord,
    BoundRecord,
    DriverRecord,
    EnvelopeRecord,
    LineRecord,
    MapRecord,
)
from tests.report.build_study import MEMBERS, build_study

RANGES = {
    "density_kg_m3": (250.0, 450.0),
    "friction_deg": (15.0, 45.0),
    "inclination_deg": (25.0, 35.0),
}


def spread(key, count):
    low, high = RANGES[key]
    return [low + (high - low) * k / (count - 1) for k in range(count)]


def build_bound(quantity):
    """As many points as a search writes: three maps of 81, three lines of 25."""
    line = [100.0 + 30.0 * math.sin(0.2 * k) for k in range(25)]
    return BoundRecord(
        quantity=quantity,
        max_kN=150.0,
        upper_bound_kN=151.0,
        case={key: high for key, (_, high) in RANGES.items()},
        coincident_kN={},
        unexplained=0.001,
        drivers=[
            DriverRecord(
                key=key, at_low_kN=60.0, at_high_kN=150.0, least_kN=60.0,
                most_kN=150.0, first_order=0.3, total=0.4,
            )
            for key in RANGES
        ],
        lines=[
            LineRecord(
                key=key, values=spread(key, 25), force_kN=line,
                bound_kN=[force + 2.0 for force in line],
            )
            for key in RANGES
        ],
        maps=[
            MapRecord(
                inclination_deg=inclination,
                density_kg_m3=spread("density_kg_m3", 9),
                friction_deg=spread("friction_deg", 9),
                force_kN=[
                    [0.2 * density + inclination + 5.0 * math.sin(0.1 * friction)
                     for density in spread("density_kg_m3", 9)]
                    for friction in spread("friction_deg", 9)
                ],
            )
            for inclination in (25.0, 30.0, 35.0)
        ],
        confirmation=None,
    )  # fmt: skip


ENVELOPE = EnvelopeRecord(
    axes=[AxisRecord(key=key, low=a, high=b) for key, (a, b) in RANGES.items()],
    is_per_metre=False,
    is_closed=True,
    gap_asked_percent=1.0,
    certainty=3.0,
    resolved_share=0.6,
    cases=50,
    skipped=0,
    skips_tested=0,
    failed=0,
    bounds=[build_bound(member) for member in MEMBERS],
)


@pytest.mark.parametrize("language", ["en", "fr"])
def test_twenty_rows_are_quick_and_small(language):
    study = build_study()
    rows = [
        replace(study.rows[k % 3], id=f"Row {k}", envelope=ENVELOPE) for k in range(20)
    ]
    study = replace(study, rows=rows)
    render_html(build_study(rows=1), language)  # imports are not what is measured
    start = time.process_time()
    page, book = render_html(study, language), render_workbook(study, language)
    assert time.process_time() - start < 4.5  # 1.9 on a quiet machine
    assert len(page.encode()) < 2_200_000  # 5 kB a row are second opinions
    assert len(book) < 1_000_000
