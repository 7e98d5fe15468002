"""A site of many distinct net rows: those of the example, again with less snow."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path

from netdesign.site.model import NetRow, Site
from netdesign.site.reader import read_site
from netdesign.site.template.workbook import write_site_workbook

_STANDARD = "nf-p-95-304-style"
_LESS_SNOW = 0.03  # of the snow of the example's row, each time it is used again


def build_bench_site(count: int) -> Site:
    """Site of so many distinct net rows: the example's, again with less snow."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "example.xlsx"
        write_site_workbook(path, example=True)
        site = read_site(path)
    rows = [
        _vary_row(site.rows[k % len(site.rows)], k // len(site.rows))
        for k in range(count)
    ]
    return replace(site, rows=tuple(rows))


def _vary_row(row: NetRow, again: int) -> NetRow:
    share = 1.0 - _LESS_SNOW * again
    return replace(
        row,
        id=f"{row.id}.{again + 1}",
        snow_thickness=share * row.snow_thickness,
        upslope_length=share * row.upslope_length,
    )
