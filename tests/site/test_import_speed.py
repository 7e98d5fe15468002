"""How long the import of 1,000 net rows takes: shown, never asserted.

``pytest -m slow tests/site/test_import_speed.py -s`` prints the times.
"""

import sys
import time

import pytest
import xlsxwriter

from netdesign.site.columns.all_tables import NETS
from netdesign.site.reader import read_site
from tests.site.csv_folder import write_csv_folder

ROWS = 1000
TYPED = {
    **{"slope_angle": "38,5", "snow_thickness": 3.0, "upslope_length": 20},
    **{"ground_law": "free", "net_height": 3.5, "net_stiffness": 9000, "slack": 0.03},
    **{"post_spacing": 3.5, "post_tilt": 5, "uphill_anchor_distance": 3},
    **{"downhill_anchor_distance": 3, "foot_anchor": "A1", "uphill_anchor": "A1"},
    **{"downhill_anchor": "A1", "uphill_guy": "G1", "downhill_guy": "G1", "post": "P1"},
}


def build_sheets(sheets):
    lines = [
        [f"R{number}" if f.key == "id" else TYPED.get(f.key) for f in NETS.fields]
        for number in range(ROWS)
    ]
    return {
        **sheets,
        "Nets": [[field.heading_for("en") for field in NETS.fields], *lines],
    }


def write_xlsx(path, sheets):
    with xlsxwriter.Workbook(path) as workbook:
        for name, rows in sheets.items():
            sheet = workbook.add_worksheet(name)
            for number, row in enumerate(rows):
                sheet.write_row(number, 0, row)
    return path


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "write"), [("xlsx", write_xlsx), ("csv", write_csv_folder)]
)
def test_a_thousand_rows(sheets, tmp_path, capsys, kind, write):
    path = write(tmp_path / f"site.{kind}", build_sheets(sheets))
    times = []
    for _ in range(3):  # the first one also imports what reads the file
        start, cpu_start = time.perf_counter(), time.process_time()
        site = read_site(path)
        wall, cpu = time.perf_counter() - start, time.process_time() - cpu_start
        times.append(f"{wall:.2f} s ({cpu:.2f} s of processor)")
    assert len(site.rows) == ROWS
    with capsys.disabled():
        sys.stdout.write(f"\n{kind}: {ROWS} rows in {', '.join(times)}\n")
