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
    "Nets": [
        [
            "id",
            "slope angle [deg]",
            "snow thickness [m]",
            "snow height vertical [m]",
            "upslope length [m]",
            "ground law",
            "slip length [m]",
            "glide factor [-]",
            "net height [m]",
            "net stiffness [kN/m]",
            "post spacing [m]",
            "foot anchor",
            "uphill guy",
            "post",
        ],
        ["R1", 40, 3.0, None, 20, "free", None, None, 3.5, 9000, 3.5, "A1", "G1", "P1"],
        ["R2", 35, 2.5, None, 15, "no-slip", None, None, 3, 8000, 4, "A2", None, None],
    ],
    "Ranges": [
        ["quantity", "low", "high"],
        ["density [kg/m3]", 270, 400],
        ["friction angle [deg]", 15, 45],
    ],
    "Anchors": [
        ["id", "tendon resistance [kN]", "pull-out resistance [kN]", "basis"],
        ["A1", 400, 300, "tested"],
        ["A2", 250, None, None],
    ],
    "Ropes": [["id", "minimum breaking force [kN]"], ["G1", 250]],
    "Posts": [["id", "compression resistance [kN]"], ["P1", 380]],
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
