import re

import pytest

from netdesign.site.anchor_types import name_column
from netdesign.site.columns.fields import find_item
from netdesign.site.template.empty import describe_accepted
from netdesign.structure.members import END_MODES, MEMBER_MODES
from netdesign.words.catalogue import LANGUAGES
from tests.each import each
from tests.make import name_heading
from tests.site.columns.fields import FIELDS, PLANS


@each("table", FIELDS)
def test_no_heading_names_two_fields(table):
    names = [name for field in FIELDS[table] for name in field.names]
    assert len(names) == len(set(names))
    assert all(names)


def test_every_member_and_mode_has_its_column():
    named = {field.key: field for x in ("rows", "net_types") for field in FIELDS[x]}
    for member, mode in (*MEMBER_MODES, *END_MODES):
        table = named[name_column(member)].refers_to
        units = [one.unit for one in FIELDS[table] if one.key == mode]
        assert units == ([] if mode == "compression" else ["kN"])  # by its section


@each("language", LANGUAGES)
@each("table", FIELDS)
def test_what_is_written_as_heading_is_read_as_it(language, table):
    for field in FIELDS[table]:
        heading = name_heading(field, language)
        found = find_item(heading, FIELDS[table])
        assert found is field or PLANS[table].find(heading) is field


@pytest.mark.parametrize("language", LANGUAGES)
def test_numbers_are_the_same_in_every_language(language):
    for fields in FIELDS.values():
        for field in fields:
            told = re.findall(
                r"-?[0-9]+(?:[.,][0-9]+)?", describe_accepted(field, language)
            )
            if field.words or field.bounds[0] == field.bounds[1]:
                continue
            assert "." not in "".join(told[:2]) or language == "en"
            unitless = [float(number.replace(",", ".")) for number in told[:2]]
            assert unitless == pytest.approx(list(field.bounds), rel=1e-9)
