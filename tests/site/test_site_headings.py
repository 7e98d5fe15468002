"""Headings that are merged, grouped, unclear or nearly right; notes below tables."""

import pytest

from netdesign.site.reader import read_site

GROUPED = {  # column: group, own heading
    "snow thickness [m]": ("snow", "thickness [m]"),
    "snow height vertical [m]": ("snow", "height vertical [m]"),
    "net height [m]": ("net", "height [m]"),
    "net stiffness [kN/m]": ("net", "stiffness [kN/m]"),
}


def group(sheets):
    """Two rows of headings in place of one; gives the places to merge."""
    headings = sheets["Nets"][0]
    above = [GROUPED.get(text, (None,))[0] for text in headings]
    below = [GROUPED.get(text, (None, text))[1] for text in headings]
    # only the first cell of a merged group keeps its text
    shown = [
        name if k == 0 or above[k - 1] != name else None for k, name in enumerate(above)
    ]
    sheets["Nets"][:1] = [shown, below]
    return ["C1:D1", "I1:J1"]


def test_groups_merged_above_headings_complete_them(sheets, save):
    places = group(sheets)

    def merge(workbook):
        for place in places:
            workbook["Nets"].merge_cells(place)

    row = read_site(save(sheets, merge)).rows[0]
    assert (row.snow_thickness, row.net_height) == (3.0, 3.5)
    assert row.net_stiffness_per_m == 9e6


def test_a_group_that_is_not_merged_says_nothing(sheets, save, refused):
    group(sheets)
    rules = {
        (f.cell, str(f.rule)) for f in refused(save(sheets)) if f.severity == "error"
    }
    assert (
        "I2",
        "is ambiguous: "
        + " or ".join(
            f'"{name}"'
            for name in (
                "snow thickness [m]",
                "snow height vertical [m]",
                "net height [m]",
            )
        ),
    ) in rules


def test_a_heading_merged_over_two_columns_of_numbers_is_refused(sheets, save, refused):
    sheets["Nets"][0][3] = None
    sheets["Nets"][1][3] = 3.5

    def merge(workbook):
        workbook["Nets"].merge_cells("C1:D1")

    (finding,) = refused(save(sheets, merge))
    assert (finding.cell, str(finding.rule)) == (
        *("D2", "stands below a heading merged over C1:D1"),
    )


@pytest.mark.parametrize("heading", ["snow depth [m]", "hauteur [m]", "Höhe [m]"])
def test_a_heading_with_several_meanings_is_refused_with_them(
    sheets, save, refused, heading
):
    sheets["Nets"][0][2] = heading
    findings = refused(save(sheets))
    finding = next(one for one in findings if one.cell == "C1")
    assert str(finding.rule).startswith(
        'is ambiguous: "snow thickness [m]" or "snow height vertical [m]"'
    )


@pytest.mark.parametrize("heading", ["slak [-]", "slack value"])
def test_an_optional_heading_nearly_right_is_refused_not_defaulted(
    sheets, save, refused, heading
):
    sheets["Nets"][0].append(heading)
    for line in sheets["Nets"][1:]:
        line.append(0.1)
    if heading == "slak [-]":
        (finding,) = refused(save(sheets))
        assert str(finding.rule) == (
            'is no known heading, but close to "slack [-]", which is missing'
        )
    else:  # quite another name: read as what it is, a column of somebody else's
        site = read_site(save(sheets))
        assert site.rows[0].slack == 0.02
        assert any("slack value" in note for note in map(str, site.notes))


def test_notes_below_a_table_are_listed_and_not_read(sheets, save):
    sheets["Nets"] += [
        [None],
        ["* heights from the survey of 2023"],
        [None, "Bemerkung: R2 im Wald"],
    ]
    site = read_site(save(sheets))
    assert len(site.rows) == 2
    notes = [note for note in map(str, site.notes) if "is a note below" in note]
    assert notes == [
        'site.xlsx › Nets › B6: "Bemerkung: R2 im Wald" is a note below the table: it '
        'is not read; likewise A5 "* heights from the survey of 2023"'
    ]


@pytest.mark.parametrize("line", [["R3"], ["R3 new"], [None, 40], ["R3", 40]])
def test_a_line_begun_is_no_note(sheets, save, refused, line):
    sheets["Nets"].append(line)
    assert {f.cell for f in refused(save(sheets))} >= {"C4", "E4"}


def test_a_note_between_lines_is_refused(sheets, save, refused):
    sheets["Nets"].insert(2, ["these rows are to be checked again"])
    assert {f.cell for f in refused(save(sheets))} >= {"B3", "C3"}


def test_a_hidden_column_is_read_and_noted(sheets, save):
    def hide(workbook):
        workbook["Nets"].column_dimensions["B"].hidden = True

    site = read_site(save(sheets, hide))
    (note,) = map(str, site.notes)
    assert 'Nets › B1: "slope angle [deg]" is in a hidden column' in note
    assert site.rows[0].inputs[1].value == 40.0


def test_macros_are_ignored_with_a_remark(sheets, save):
    import zipfile

    path = save(sheets)
    with zipfile.ZipFile(path, "a") as archive:
        archive.writestr("xl/vbaProject.bin", b"macros")
    (note,) = map(str, read_site(path.rename(path.with_suffix(".xlsm"))).notes)
    assert note == "site.xlsm: the file holds macros: they are ignored"
