"""Net types of another workbook: an office's own library."""

import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.reader import read_site
from tests.each import each
from tests.make import write_site
from tests.site.office.drawn import draw_tables

LIBRARY = ("net_types", "ropes", "posts")


def split(tables):
    """Tables of the site alone, and those of a library."""
    site = {name: one for name, one in tables.items() if name not in LIBRARY}
    return site, {name: tables[name] for name in LIBRARY}


def list_numbers(site):
    return [
        (row.id, row.net_height, row.slack, row.layout, row.guys, row.panels)
        for row in site.rows
    ]


@each("seed, language", [(1, "en"), (2, "fr"), (3, "de")])
def test_a_library_is_read_as_if_its_sheets_were_there(tmp_path, seed, language):
    tables = draw_tables(seed)
    for net in tables["net_types"]:
        net["slack"] += 9
    names = ("whole", "bare", "lib")
    whole, bare, library = (tmp_path / f"{one}.xlsx" for one in names)
    of_sag = {("net_types", "slack"): "sag"}
    write_site(whole, tables, language, of_sag)
    site, others = split(tables)
    write_site(bare, site, language)
    write_site(library, others, "en", of_sag)
    joined = read_site(bare, net_types=library)
    assert list_numbers(joined) == list_numbers(read_site(whole))
    assert joined.library_file == "lib.xlsx"
    places = {one.cell for row in joined.rows for one in row.inputs}
    assert any(one.startswith("[lib.xlsx]Net types!") for one in places)


def test_one_id_means_one_thing(tmp_path):
    tables = draw_tables(4)
    path, library = tmp_path / "site.xlsx", tmp_path / "lib.xlsx"
    write_site(path, tables)
    _, others = split(tables)
    write_site(library, others)
    assert read_site(path, net_types=library).rows  # alike, so that nothing is unclear
    others["net_types"][0]["post_tilt"] += 1
    write_site(library, others)
    with pytest.raises(SiteDataError) as refused:
        read_site(path, net_types=library)
    (finding,) = refused.value.findings
    assert finding.text == others["net_types"][0]["id"]


def test_a_fault_in_the_library_names_its_file(tmp_path):
    site, others = split(draw_tables(5))
    others["net_types"][0]["net_height"] = "tall"
    path, library = tmp_path / "site.xlsx", tmp_path / "lib.xlsx"
    write_site(path, site)
    write_site(library, others)
    with pytest.raises(SiteDataError) as refused:
        read_site(path, net_types=library)
    errors = [one for one in refused.value.findings if one.severity == "error"]
    assert {one.file for one in errors} == {"lib.xlsx"}
