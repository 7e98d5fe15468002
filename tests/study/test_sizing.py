"""Smallest types that pass, tried cell by cell; what-ifs that are solved again."""

from dataclasses import replace
from functools import cache
from typing import NamedTuple

import numpy as np
import pytest

from netdesign.checks import load_standard
from netdesign.envelope.rows import RowEnvelope
from netdesign.outcome import SiteDataError, Verdict
from netdesign.site import reader
from netdesign.site.model import Site
from netdesign.site.reader import read_site
from netdesign.study.cases import search_site
from netdesign.study.sizing import size_site
from netdesign.words.message import say
from tests.make import find_cell, load_rows, write_rows, write_site
from tests.small_site import RUN

PROFILE = load_standard("nf-p-95-304-style")
FOOT, UPHILL = (find_cell("rows", f"{one}_anchor") for one in ("foot", "uphill"))
# R7 with strong parts, of which only the foot anchor fails.
STRONG = {
    **{"snow": 2.0, "net_height": 2.1, "post_spacing": 2.3, "upslope_length": 14},
    **{"uphill_anchor": "A63-tested", "downhill_anchor": "A40-tested"},
    **{"end_anchor": "A63-tested", "end_guy": "E40", "uphill_guy": "B28"},
    **{"ridge_rope": "B44", "lower_rope": "B44", "downhill_guy": "G28"},
}


class Nobody:
    def enter(self, key, words=None):
        """No phase is told."""

    def count_piece(self):
        """Nor a check."""


class Solved(NamedTuple):
    """A site, and the envelopes of its rows."""

    site: Site
    rows: list[RowEnvelope]


def solve(site):
    return Solved(site, search_site(site, RUN))


@pytest.fixture(scope="module", autouse=True)
def _read_once():
    """Workbooks stay as they are: each is opened once, and read again with changes."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(reader, "read_cells", cache(reader.read_cells))
        yield


@pytest.fixture(scope="module")
def example(tmp_path_factory):
    """Site, its workbook, and its rows solved; judged without what would turn it."""
    path = tmp_path_factory.mktemp("site") / "site.xlsx"
    return path, solve(read_site(write_rows(path, ["R7"], cells={"R7": STRONG})))


def name_type(key, line):
    """Cell of an anchor type."""
    return find_cell("anchor_types", key, line)


def judge(solved):
    from netdesign.study.judge import judge_site

    return judge_site(solved.site, solved.rows, PROFILE, RUN)


def size(example, **changes):
    path, solved = example
    read = lambda instead: read_site(path, instead={**changes, **instead})  # noqa: E731
    site = read({}) if changes else solved.site
    solved = solved._replace(site=site)
    study = judge(solved)
    return study, size_site(*solved, study, PROFILE, RUN, read), read


@pytest.mark.slow
def test_the_type_that_is_found_passes_and_every_smaller_one_does_not(example):
    """Each type of the sheet is judged here again, one at a time.

    ``python -m pytest -m slow tests/study/test_sizing.py``
    """
    study, cells, read = size(example)
    assert study.verdict is Verdict.FAIL
    assert [(one.row_id, one.column, one.cell) for one in cells] == [
        ("R7", "foot_anchor", FOOT)
    ]
    for one in cells:
        uses = {}
        for kind in {other.type_id for other in read({}).catalogue}:
            if not kind.startswith("A") or kind == one.was:
                continue
            again = judge(example[1]._replace(site=read({one.cell: kind})))
            (row,) = [row for row in again.rows if row.id == one.row_id]
            checks = [c for c in row.checks if c.member == "foot_anchor"]
            assert len(checks) >= 4
            if all(check.verdict is Verdict.PASS for check in checks):
                uses[kind] = max(c.utilisation_band[1] or 0.0 for c in checks)
        assert one.now == max(uses, key=uses.get)
        assert one.used == pytest.approx(uses[one.now], rel=1e-12)
        assert one.used <= 1.0


def test_a_type_that_is_offered_brings_its_own_dip(example):
    """A flat bore of the type itself, and of the type that it replaces."""
    dips = {line: name_type("dip", line) for line in range(8)}
    _, built, _ = size(example, **{dips[3]: "5"})
    (usual,) = [one.now for one in built if one.column == "foot_anchor"]
    assert usual == "A57-tested"
    flat = {dips[line]: "5" for line in (0, 1, 2, 4, 5, 6)} | {dips[7]: "20"}
    _, cells, read = size(example, **flat)
    (now,) = [one.now for one in cells if one.column == "foot_anchor"]
    assert now in ("", "A63-tested")
    again = judge(example[1]._replace(site=read({FOOT: "A57-tested"})))
    checks = [one for one in again.rows[0].checks if one.member == "foot_anchor"]
    assert any(one.verdict is not Verdict.PASS for one in checks)


def test_without_a_type_that_does_nothing_is_claimed(example):
    """Every type of the sheet too weak for the free ground of R7."""
    weak = {
        name_type(key, line): str(23.5 + line)
        for key in ("pull_out", "test_mean")
        for line in (0, 1, 2, 5, 6, 7)
    }
    weak[name_type("pull_out", 3)] = "26.5"  # worked out, without tests
    _, cells, _ = size(example, **weak)
    (last,) = [
        one for one in cells if (one.row_id, one.column) == ("R7", "foot_anchor")
    ]
    assert (last.now, last.used) == ("", None)
    assert last.tried == 7


# Cells of the grounds: of A28-computed, which is built, of A57-tested, the smallest
# that passes, and of A63-tested, the next one.
BUILT, A57, A63 = (name_type("ground", line) for line in (3, 6, 7))


@pytest.mark.parametrize(
    ("grounds", "now", "left_out"),
    [
        ({}, "A57-tested", 0),
        ({A57: "rock"}, "A63-tested", 1),
        ({A57: "rock", A63: ""}, "", 2),
        ({A57: ""}, "A63-tested", 1),
        ({BUILT: ""}, "A57-tested", 0),
    ],
)
def test_a_type_is_found_for_the_ground_of_the_row_alone(
    example, grounds, now, left_out
):
    _, cells, _ = size(example, **grounds)
    (found,) = [one for one in cells if one.column == "foot_anchor"]
    assert (found.now, found.left_out) == (now, left_out)
    assert found.tried == 7 - left_out


def test_a_type_of_a_cell_of_two_rows_passes_in_both_of_them(tmp_path):
    """Rows of one net type: what its cell names, both have."""
    tables = load_rows(["R1", "R2"], leans=False)
    for row in tables["rows"]:
        row["net_type"] = "N2"
    (net,) = (one for one in tables["net_types"] if one["id"] == "N2")
    net["end_guy"] = "G18"
    path = write_site(tmp_path / "site.xlsx", tables)
    _, cells, read = size((path, solve(read_site(path))))
    (found,) = [one for one in cells if one.column == "end_guy"]
    assert found.row_id == "R1, R2"
    site = read({found.cell: found.now})
    again = judge(solve(site))
    checks = [
        one for row in again.rows for one in row.checks if one.member == "end_guy"
    ]
    assert {one.verdict for one in checks} == {Verdict.PASS}
    assert found.used == max(one.utilisation_band[1] for one in checks)


def test_no_type_takes_the_place_of_one_whose_ground_has_a_strength(tmp_path):
    """A57-tested passes in R7 where nobody gives it: the ground is known to be weak."""
    tables = load_rows(["R7"], leans=False, cells={"R7": STRONG})
    weak = {"soil_cohesion": 9, "soil_friction": 36, "soil_weight": 19.3}
    tables["soils"] = [{"ground": "till", **weak}]
    path = write_site(tmp_path / "site.xlsx", tables)
    _, cells, _ = size((path, solve(read_site(path))))
    (foot,) = (one for one in cells if one.column == "foot_anchor")
    assert (foot.was, foot.now) == ("A28-computed", "")


def test_a_site_that_passes_has_nothing_to_replace(example):
    study, cells, _ = size(example, **{FOOT: "A57-tested"})
    assert study.verdict is Verdict.PASS
    assert cells == []
    assert [one.cell for one in study.what_if] == [FOOT]


# --- fault 17: a question, or a refusal, of one cell is not that of another -----------


@pytest.fixture(scope="module")
def two_open_cells(example):
    """Cells of foot and uphill anchor of R7, neither of which passes; both solved."""
    path, solved = example
    changes = {UPHILL: "A25-untested"}
    read = lambda instead: read_site(path, instead={**changes, **instead})  # noqa: E731
    solved = solved._replace(site=read({}))
    study = judge(solved)
    return solved, study, read, find_types(solved, study, read)


def find_types(solved, study, read):
    cells = size_site(*solved, study, PROFILE, RUN, read)
    return {one.column: one for one in cells}


@pytest.mark.parametrize("seed", range(3))
def test_a_question_of_one_cell_leaves_the_types_of_the_other(two_open_cells, seed):
    """Drawn types are asked about, or refused, in one of two cells."""
    rng = np.random.default_rng([61, 17, seed])
    solved, study, read, found = two_open_cells
    asked, other = ("foot_anchor", "uphill_anchor")[:: (-1) ** seed]
    some = rng.choice(found[asked].types, 3, replace=False)
    beside = found[asked].types[found[other].types.index(found[other].now)]
    drawn = {*map(str, some), found[asked].now, beside}

    def read_asking(instead):
        site = read(instead)
        if instead.get(found[asked].cell) not in drawn:
            return site
        if seed == 2:
            raise SiteDataError([])
        row = replace(site.rows[0], questions=(say("panel.steady_only"),))
        return replace(site, rows=(row,))

    again = find_types(solved, study, read_asking)
    assert found[other].now
    assert (again[other].now, again[other].used) == (
        found[other].now,
        found[other].used,
    )
    assert again[asked].now not in drawn
