from netdesign.site.type_resistances import name_column
from netdesign.structure.members import END_MODES, MEMBER_MODES
from tests.each import each
from tests.site.columns.fields import FIELDS


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
