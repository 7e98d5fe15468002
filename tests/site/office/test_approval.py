"""Limits and maker's forces of sheet Net types, as the checks take them."""

import pytest

from netdesign.checks import load_standard
from netdesign.outcome import Verdict
from netdesign.site.reader import read_site
from netdesign.snow.creep_law import CREEP_LAWS
from netdesign.study.guideline_load import find_altitude_factor
from netdesign.study.member_force import list_maker_leaves
from netdesign.study.row_checks import check_limits
from netdesign.study.row_to_check import Basis
from tests.each import each
from tests.make import write_site
from tests.site.office.drawn import draw_tables

STANDARD = load_standard("swiss-guideline-2007")
ANCHORS = ("foot", "uphill", "downhill")


@each("seed", range(6203, 6208))
def test_every_row_is_compared_with_the_limits_of_its_net_type(tmp_path_factory, seed):
    tables = draw_tables(seed, rows=6)
    path = tmp_path_factory.mktemp("approved") / f"{seed}.xlsx"
    write_site(path, tables)
    site = read_site(path)
    nets = {one["id"]: one for one in tables["net_types"]}
    for line, row in zip(tables["rows"], site.rows, strict=True):
        net = nets[line["net_type"]]
        basis = Basis(
            site=site, row=row, standard=STANDARD, law=next(iter(CREEP_LAWS.values()))
        )
        (check,) = check_limits(basis)
        beyond = [
            line["glide_factor"] > net["glide_most"],
            find_altitude_factor(row) > net["altitude_most"] * (1.0 + 1e-9),
            line["post_spacing"] > net["spacing_most"],
        ]
        assert check.verdict is (Verdict.FAIL if any(beyond) else Verdict.PASS)
        assert "TA 12-3" in str(check.reason)
        for side in ANCHORS:
            (leaf,) = list_maker_leaves(row, STANDARD, f"{side}_anchor")
            assert leaf.value == pytest.approx(net[f"maker_{side}"], rel=1e-12)
            assert leaf.source.startswith("Net types!")
