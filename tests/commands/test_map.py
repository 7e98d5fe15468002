"""``netdesign map`` from the command line, in three languages."""

from netdesign.site.template.office_workbook import write_site_workbook
from tests.site.office.old_template import load_example, write_old


def test_a_workbook_of_the_template_leaves_nothing_to_answer(call, tmp_path):
    write_site_workbook(tmp_path / "site.xlsx", example=True)
    refused = call("map", "site.xlsx")
    assert refused.code == 2
    assert "nothing is to be answered" in refused.err
    assert not (tmp_path / "site.map.toml").exists()


def test_a_workbook_of_version_01_is_written_again(call, tmp_path):
    old, new = tmp_path / "old.xlsx", tmp_path / "old-new.xlsx"
    write_old(old, load_example(), "fr")
    for command in (("check", old, "--dry-run"), ("map", old)):
        refused = call(*command)
        assert refused.code == 3
        assert f"netdesign map {old} --out {new}" in refused.err
        assert len(refused.err.splitlines()) < 4  # and nothing else is said
    written = call("map", old, "--out", new, "--language", "fr")
    assert written.code == 0, written.err
    assert len(written.out.splitlines()) > 5  # what was done
    assert call("check", new, "--dry-run").code == 0
    again = call("map", new, "--out", tmp_path / "other.xlsx")
    assert again.code == 2
    assert "no workbook of version 0.1" in again.err
