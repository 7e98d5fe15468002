"""A small sound site, written with openpyxl, to be spoilt test by test."""

from __future__ import annotations

import copy
from collections.abc import Callable
from pathlib import Path

import openpyxl
import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.cells.findings import Finding
from netdesign.site.reader import read_site

SOUND = {
    "Project": [
        ["item", "value", "unit"],
        ["density of the snow", "270 to 400", "kg/m3"],
        ["friction angle net/snow", "15 to 45", "deg"],
    ],
    "Rows": [
        [
            *("row", "slope ψ [deg]", "snow height [m normal]", "glide factor N"),
            *("upslope length L [m]", "net type", "post spacing b [m]"),
            *("net anchor (foot)", "posts", "ground"),
        ],
        ["R1", 40, 3.0, "free", 20, "N1", 3.5, "A1", 11, None],
        ["R2", 35, 2.5, 1.0, 15, "N2", 4, "A2", None, None],
    ],
    "Net types": [
        [
            *("net type", "effective height D_K [m]", "net stiffness [kN/m]"),
            *("uphill guy", "post"),
        ],
        ["N1", 3.5, 9000, "G1", "P1"],
        ["N2", 3, 8000, None, None],
    ],
    "Anchors": [
        ["anchor type", "tendon R_k [kN]", "pull-out [kN]", "how proven"],
        ["A1", 400, 300, "tests"],
        ["A2", 250, None, None],
    ],
    "Parts": [
        ["rope", "breaking force [kN]"],
        ["G1", 250],
        [],
        ["post", "base R_k [kN]"],
        ["P1", 380],
    ],
}

Sheets = dict[str, list[list[object]]]
Save = Callable[..., Path]
Refused = Callable[[Path], list[Finding]]


@pytest.fixture
def sheets() -> Sheets:
    return copy.deepcopy(SOUND)


@pytest.fixture
def save(tmp_path: Path) -> Save:
    """Write sheets as a workbook; ``edit`` may do more to it before."""

    def save_sheets(
        sheets: Sheets, edit: Callable[[openpyxl.Workbook], object] | None = None
    ) -> Path:
        workbook = openpyxl.Workbook()
        workbook.remove(workbook.active)
        for name, rows in sheets.items():
            sheet = workbook.create_sheet(name)
            for row in rows:
                sheet.append(row)
        if edit:
            edit(workbook)
        path = tmp_path / "site.xlsx"
        workbook.save(path)
        workbook.close()
        return path

    return save_sheets


@pytest.fixture
def refused() -> Refused:
    """Findings of a refused workbook; each must point at the text that it quotes."""

    def read_refused(path: Path) -> list[Finding]:
        with pytest.raises(SiteDataError) as caught:
            read_site(path)
        workbook = openpyxl.load_workbook(path)
        for finding in caught.value.findings:
            if finding.cell:
                held = workbook[finding.sheet][finding.cell].value
                assert finding.text == ("" if held is None else str(held))
        return list(caught.value.findings)

    return read_refused
