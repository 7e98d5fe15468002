"""What holds for all net rows may stand once: nothing that is read differs."""

import random
from dataclasses import replace

import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.columns.all_tables import NETS
from netdesign.site.reader import read_site
from tests.site_lines import write_lines
from tests.study.knowing_less.drawn_site import draw_lines

KEYS = [one.key for one in NETS.list_site_wide()]
FIELDS = {one.key: one for one in NETS.fields}


def forget_places(row):
    """Net row without the cells that its values stand in."""
    resistances, parts = (
        tuple(replace(one, source="") for one in given)
        for given in (row.resistances, row.net_parts)
    )
    return replace(
        row,
        inputs=(),
        resistances=resistances,
        net_parts=parts,
        questions=(),
        unsaid=(),
    )


def show(key, value):
    return f"{FIELDS[key].label} [{FIELDS[key].unit}]".removesuffix(" []"), value


def move_to_project(lines, keys):
    """Lines of the sheets with some columns once on sheet Project."""
    (first, *_) = lines["Nets"]
    items = [show(key, first[key]) for key in keys]
    return {
        **lines,
        "Project": [
            *lines["Project"],
            *({"item": item, "value": value} for item, value in items),
        ],
        "Nets": [
            {key: value for key, value in line.items() if key not in keys}
            for line in lines["Nets"]
        ],
    }


@pytest.mark.parametrize("seed", range(12))
def test_a_column_that_stands_once_reads_as_one_in_every_row(tmp_path, seed):
    lines = draw_lines(seed, is_placed=True)
    given = [key for key in KEYS if key in lines["Nets"][0]]
    keys = random.Random(seed).sample(given, k=min(4, len(given)))
    moved = move_to_project(lines, keys)
    sites = []
    for name, table in (("in_rows", lines), ("once", moved)):
        write_lines(tmp_path / f"{name}.xlsx", table)
        sites.append(read_site(tmp_path / f"{name}.xlsx"))
    in_rows, once = sites
    assert list(map(forget_places, once.rows)) == list(map(forget_places, in_rows.rows))
    assert [one.unsaid for one in once.rows] == [one.unsaid for one in in_rows.rows]
    cells = {one.cell for row in once.rows for one in row.inputs}
    assert sum(cell.startswith("Project!") for cell in cells) >= len(keys) - 1


def test_a_row_keeps_its_own_value_and_that_is_told(sheets, save):
    sheets["Project"] = [["item", "value"], ["slack", "5 %"]]
    column = (
        sheets["Nets"][0].index("slack [-]")
        if "slack [-]" in sheets["Nets"][0]
        else None
    )
    if column is None:
        sheets["Nets"][0].append("slack [-]")
        sheets["Nets"][1].append(0.03)
    site = read_site(save(sheets))
    assert site.rows[0].slack == pytest.approx(0.03)
    (told,) = [one for one in site.findings if one.rule.key == "item.own_value"]
    assert "Project!B2" in str(told.rule)


@pytest.mark.parametrize(
    ("line", "told"),
    [
        (["net stiffness", "9500"], "has no unit"),
        (["net stiffness [kN/m]", "stiff"], "is not a number"),
        (["net stiffness [kN]", "9500"], "has an unknown unit"),
        (["slack", "80 %"], "0 to 0.3"),
        (["ground law", "swamp"], "is not a known word"),
        (["snow height vertical [m]", "3.2"], "is no known item"),
    ],
)
def test_what_cannot_be_read_once_is_refused_in_its_cell(sheets, save, line, told):
    sheets["Project"] = [["item", "value"], line]
    with pytest.raises(SiteDataError) as caught:
        read_site(save(sheets))
    found = [one for one in caught.value.findings if one.severity == "error"]
    assert {one.sheet for one in found} == {"Project"}
    assert any(told in str(one) for one in found), list(map(str, found))


def test_no_stiffness_is_searched_over_all_that_may_be_typed_without_a_question(
    sheets, save
):
    """Else a net of which nobody knows anything pulls less than a stiff one."""
    column = next(
        k for k, one in enumerate(sheets["Nets"][0]) if one.startswith("net stiffness")
    )
    for line in sheets["Nets"]:
        del line[column]
    span = read_site(save(sheets)).ranges["net_stiffness"]
    usual = FIELDS["net_stiffness"].usual
    assert (span.low, span.high) == (1e3 * usual.least, 1e3 * usual.most)
