"""A small sound site, written with openpyxl, to be spoilt test by test."""

import copy

import openpyxl
import pytest

from netdesign.outcome import SiteDataError
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


class Book(dict):
    """Sheets of a sound site; what a test is about, it spoils itself."""

    def __init__(self, path):
        super().__init__(copy.deepcopy(SOUND))
        self.path = path

    def put(self, heading, value, line=1, sheet="Rows"):
        """Value in the column whose heading starts so."""
        self[sheet][line][self.find(heading, sheet)] = value

    def find(self, heading, sheet="Rows"):
        return next(k for k, x in enumerate(self[sheet][0]) if x.startswith(heading))

    def save(self, edit=None):
        """Write a workbook; ``edit`` may do more to it before."""
        workbook = openpyxl.Workbook()
        workbook.remove(workbook.active)
        for name, rows in self.items():
            sheet = workbook.create_sheet(name)
            for row in rows:
                sheet.append(row)
        if edit:
            edit(workbook)
        workbook.save(self.path)
        workbook.close()
        return self.path

    def read(self, edit=None):
        return read_site(self.save(edit))

    def refuse(self, edit=None):
        return list_findings(self.save(edit))


def list_findings(path):
    """Findings of a refused workbook; each must point at the text that it quotes."""
    with pytest.raises(SiteDataError) as caught:
        read_site(path)
    workbook = openpyxl.load_workbook(path)
    for finding in caught.value.findings:
        if finding.cell:
            held = workbook[finding.sheet][finding.cell].value
            assert finding.text == ("" if held is None else str(held))
    return list(caught.value.findings)


@pytest.fixture
def book(tmp_path):
    return Book(tmp_path / "site.xlsx")
