"""Lists of offices answer what is asked of their anchors, with what they have."""

from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.outcome import Verdict
from netdesign.site.reader import read_site
from netdesign.structure.members import EndMember, Member
from netdesign.study.judge import judge_site
from netdesign.study.row_to_check import CheckRun
from netdesign.study.scopes import STRUCTURE
from netdesign.study.to_do import list_to_do
from tests.grid import solve_site
from tests.site.lists.answer import answer_list
from tests.site.lists.offices import OFFICES

RUN = CheckRun(settings=SolverSettings(accuracy=0.05, levels=MESH_LEVELS[:2]))
PROFILE = "swiss-guideline-2007"
IN_ROW = (Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR, Member.DOWNHILL_ANCHOR)
BEYOND = (EndMember.LATERAL_ANCHOR, EndMember.END_GUY_ANCHOR)
MODES = ("tendon", "pull_out", "bending")
INSIDE = "intermediate"


def check_list(office, folder, rows):
    """Study of some rows of a list, by its answered headings alone."""
    path = office.write(folder)
    answer_list(office, path)
    site = read_site(path)
    site = replace(site, rows=site.rows[rows])
    standard = load_standard(PROFILE)
    solved = solve_site(site, RUN, samples=2)  # of all that the list leaves open
    return site, judge_site(site, solved, standard, RUN)


def list_given(row):
    """Members and modes at each place of which the list gives a resistance."""
    ends = row.row_end.resistances if row.row_end else ()
    places = (("", row.resistances), ("end", (*(row.end_resistances or ()), *ends)))
    for place, resistances in places:
        for one in resistances:
            if one.value is not None and one.mode in MODES:
                yield place, one.member, one.mode


def has_answer(check):
    """Demand over resistance, or no bound at all of what cannot be held."""
    return check.is_unbounded or check.utilisation is not None


def assert_answered(site, study):
    """Each anchor has its forces, and what is said of it is compared with them."""
    for given, row in zip(site.rows, study.rows, strict=True):
        checks = {one.id: one for one in row.checks}
        of_force = [
            one
            for one in row.checks
            if one.member in (*IN_ROW, *BEYOND) and one.mode in MODES
        ]
        for member in IN_ROW:
            found = {one.position for one in of_force if one.member == member}
            assert found == {INSIDE, "second", "edge"}, member
        assert {one.member for one in of_force} == {*IN_ROW, *BEYOND}
        for one in of_force:
            assert one.demand_kN is not None, one.id
            assert one.demand_kN > 0.0, one.id
            assert one.verdict in Verdict, one.id
        for place, member, mode in list_given(given):
            name = ".".join(filter(None, (member, mode, place)))
            if name in checks and member in (*IN_ROW, *BEYOND):
                assert has_answer(checks[name]), name


def assert_plausible(row):
    """Inside a row the coupled force is of the guideline's size on its anchors.

    What is shown by the guideline alone is its force over the resistance, also where
    its load raises the pull of a rope that comes to the coupled force.
    """
    for one in row.checks:
        if one.read("E_g") is not None and one.read("R_d"):
            used = one.read("γ_E") * one.read("E_g") / one.read("R_d")
            assert one.utilisation_by_guideline == pytest.approx(used), one.id
        if one.member in IN_ROW and one.mode == "tendon" and one.position == INSIDE:
            by_guideline, demand = one.read("E_g"), one.read("E_k")
            assert 0.9 * by_guideline <= demand <= 2.0 * by_guideline, one.id


@pytest.mark.parametrize(
    "rows",
    [
        pytest.param(slice(1), id="one row"),
        pytest.param(slice(None), id="every row", marks=pytest.mark.long),
    ],
)
@pytest.mark.parametrize("office", OFFICES, ids=lambda one: one.file)
def test_an_office_s_list_is_answered(office, rows, tmp_path):
    site, study = check_list(office, tmp_path, rows)
    assert_answered(site, study)
    lines = list_to_do(study)
    assert all(one.text.key != "to_do.more" for one in lines), lines
    for row in study.rows:
        assert_plausible(row)
        of_structure = [x for x in row.checks if x.member == STRUCTURE]
        assert len(of_structure) == 1  # nothing is given of it, or an approval
