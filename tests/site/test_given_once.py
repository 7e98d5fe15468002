"""What stands once for all net rows is refused, with where it belongs."""

import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.columns.all_tables import NETS, RANGES
from netdesign.site.reader import read_site
from netdesign.words.catalogue import LANGUAGES
from tests.each import each
from tests.site.conftest import SOUND
from tests.site.csv_folder import write_csv_folder

FIELDS = {one.key: one for one in NETS.fields}
NAMES = [
    (one.label_in(language), sheet)
    for sheet, fields in (("Nets", NETS.fields), ("Ranges", RANGES.items))
    for one in fields
    for language in LANGUAGES
    if one.key != "id" and not (sheet == "Ranges" and one.column)
]


@each("name, sheet", NAMES)
def test_a_line_of_sheet_project_says_where_its_value_belongs(tmp_path, name, sheet):
    path = write_csv_folder(
        tmp_path / "site",
        {"Project": [["item", "value"], [f"{name} [m]", 3.2]], **SOUND},
    )
    with pytest.raises(SiteDataError) as caught:
        read_site(path)
    found = [one for one in caught.value.findings if one.severity == "error"]
    assert [(one.sheet, one.cell) for one in found] == [("Project", "A2")]
    assert str(found[0].rule) == "stands once for all net rows: it is not read there"
    assert f"sheet {sheet}" in str(found[0].accepted)


def test_no_stiffness_is_searched_over_all_that_may_be_typed_without_a_question(
    sheets, save
):
    """Else a net of which nobody knows anything pulls less than a stiff one."""
    column = next(
        k for k, one in enumerate(sheets["Nets"][0]) if one.startswith("net stiffness")
    )
    for line in sheets["Nets"]:
        del line[column]
    site = read_site(save(sheets))
    span = site.at_row(site.rows[0]).ranges["net_stiffness"]
    usual = FIELDS["net_stiffness"].usual
    assert (span.low, span.high) == (1e3 * usual.least, 1e3 * usual.most)
