"""Tables of the whole site: a line or a column for every row."""

from dataclasses import replace

from netdesign.report.view.check_view import SEVERITY
from netdesign.report.view.site_tables import build_matrix, build_site_inputs
from netdesign.report.words import ENGLISH, VERDICTS
from tests.report.build_study import build_study

STUDY = build_study()


def test_the_matrix_shows_the_worst_verdict_of_each_member():
    table = build_matrix(STUDY, ENGLISH)
    assert [cells[0].text for cells in table.rows] == [row.id for row in STUDY.rows]
    for row, cells in zip(STUDY.rows, table.rows, strict=True):
        worst = min((one.verdict for one in row.checks), key=SEVERITY.index)
        symbols = {cell.text.split()[0] for cell in cells[1:]} - {"-"}
        assert VERDICTS[worst].symbol in symbols
        used = [one.utilisation for one in row.checks if one.utilisation is not None]
        shown = [float(c.text.split()[1]) for c in cells[1:] if " " in c.text]
        assert max(shown) == round(max(used), 3)


def test_inputs_of_all_rows_stand_beside_each_other():
    many = replace(STUDY, rows=[replace(STUDY.rows[0], id=f"N{k}") for k in range(17)])
    tables = build_site_inputs(many, ENGLISH)
    headings = [
        c.heading for table in tables for c in table.columns if c.heading[:1] == "N"
    ]
    assert headings == [f"N{k}" for k in range(17)]
    lines = {cells[0].text: cells for cells in tables[0].rows}
    for echo in STUDY.rows[0].inputs:
        label = ENGLISH.show(echo.label)
        if echo.value == "":
            assert label not in lines
            continue
        text = (
            echo.value
            if isinstance(echo.value, str)
            else ENGLISH.show_given(echo.value)
        )
        assert lines[label][3].text.startswith(text)
        assert lines[label][3].text.endswith("*") is (echo.cell == "default")
