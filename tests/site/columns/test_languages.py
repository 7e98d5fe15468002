import re

import pytest

from netdesign.site.columns.all_tables import (
    PROJECT_ITEMS,
    RANGE_QUANTITIES,
    SHEETS,
)
from netdesign.site.columns.fields import split_heading
from netdesign.site.template.workbook import describe_accepted
from netdesign.words.catalogue import LANGUAGES
from tests.each import each

TABLES = {
    **{plan.name: plan.fields for plan in SHEETS},
    "quantities": RANGE_QUANTITIES,
    "items": PROJECT_ITEMS,
}

# Signs of the trade, the same in every language.
SIGNS = {
    ("Anchors", "grouting"),
    ("Ropes", "construction"),
    ("Posts", "buckling_curve"),
}


@each("language", LANGUAGES)
@each("table", TABLES)
def test_what_is_written_as_heading_is_read_as_it(language, table):
    for field in TABLES[table]:
        name, unit = split_heading(field.heading_for(language))
        assert name in field.names
        assert unit == field.unit


@pytest.mark.parametrize("language", LANGUAGES)
def test_numbers_are_the_same_in_every_language(language):
    for fields in TABLES.values():
        for field in fields:
            told = re.findall(
                r"-?[0-9]+(?:[.,][0-9]+)?", describe_accepted(field, language)
            )
            if field.words or field.bounds[0] == field.bounds[1]:
                continue
            assert "." not in "".join(told[:2]) or language == "en"
            unitless = [float(number.replace(",", ".")) for number in told[:2]]
            assert unitless == pytest.approx(list(field.bounds), rel=1e-9)
