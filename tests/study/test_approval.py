"""Type approval: inside its limits it proves the structure, outside siting fails."""

from dataclasses import replace
from itertools import product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from netdesign.checks import Approval, Declaration, Proof, StatedValue, load_standard
from netdesign.outcome import Verdict
from netdesign.site.assumed import load_assumed
from netdesign.snow.ground import GroundLaw
from netdesign.study.guideline_load import load_glide_limits
from netdesign.study.judge import judge_site
from netdesign.study.scopes import SCOPES, Scope, list_of_scope
from tests.grid import solve_site, wrap_results
from tests.small_site import (
    ROWS,
    RUN,
    STRONG,
    WEAK,
    build_row,
    build_site,
    list_net_parts,
    resist,
)

LINKS = build_site(ROWS[0]).links
# Keys of an approval, and of what the row below has of each.
HAS = {
    "height": 2.5,
    "glide_factor": 1.87,
    "altitude_factor": 1.31,
    "spacing": 3.5,
}
ANCHORS = ("foot_anchor", "uphill_anchor", "downhill_anchor")
WIDE = {key: 1.07 * value for key, value in HAS.items()}
DOCUMENT = "EX-TA 12-3"


def approve(**limits):
    stated = {
        key: value if value is None else StatedValue(value=value, cell="Net types!D4")
        for key, value in (WIDE | limits).items()
    }
    return Approval(document=DOCUMENT, cell="Net types!C4", **stated)


@pytest.fixture(scope="module")
def results():
    return solve_site(build_site(ROWS[0]), RUN)[0].results


@pytest.fixture(scope="module")
def judge(results):
    """Judge row R1 with the forces of its grid; no force depends on an approval."""
    standard = load_standard("nf-p-95-304-style")

    def judge_row(*declared, links=LINKS, **changes):
        given_row = {"glide_factor": 1.87, "altitude": 3050.0} | changes
        row = build_row("R1", **given_row)
        site = build_site(row, links=links, declared=declared)
        solved = wrap_results(site, site.rows[0], results, RUN)
        return judge_site(site, [solved], standard, RUN).rows[0]

    return judge_row


def take_away(resistance):
    return replace(resistance, value=None, type_id="", wear=None)


# A row of which nobody knows more than its anchors.
BARE = {
    "resistances": tuple(
        one if one.member in ANCHORS else take_away(one) for one in resist()
    ),
    "net_parts": tuple(map(take_away, list_net_parts(has_ropes=False))),
    "links": {},
}


def find_check(row, name):
    return next((one for one in row.checks if one.id == name), None)


def test_inside_its_limits_one_document_proves_the_structure(judge):
    row = judge(approval=approve(), **BARE)
    assert row.scopes[Scope.ANCHORS].verdict is Verdict.PASS
    assert row.scopes[Scope.SITING].verdict is Verdict.PASS
    structure = row.scopes[Scope.STRUCTURE]
    assert structure.verdict is row.verdict is Verdict.DECLARED
    assert structure.governing == "structure.approval"
    proof = find_check(row, "structure.approval").declared
    assert (proof.document, proof.cell) == (DOCUMENT, "Net types!C4")
    # one point, not forty checks
    listed = [one.id for one in list_of_scope(row.checks, Scope.STRUCTURE)]
    assert listed == ["post.lateral", "structure.approval"]


@pytest.mark.parametrize("key", HAS)
def test_beyond_one_limit_siting_fails_and_the_structure_is_not_proven(judge, key):
    limits = {key: 0.93 * HAS[key] if key != "altitude_factor" else 1.02}
    row = judge(approval=approve(**limits), **BARE)
    assert row.scopes[Scope.ANCHORS].verdict is Verdict.PASS
    assert row.scopes[Scope.SITING].verdict is Verdict.FAIL
    assert row.scopes[Scope.STRUCTURE].verdict is Verdict.NOT_PROVEN
    told = str(find_check(row, "geometry.approval").reason)
    assert DOCUMENT in told
    assert f"{limits[key]:.6g}" in told


@pytest.mark.parametrize("key", HAS)
def test_a_limit_that_an_approval_does_not_state_helps_nothing(judge, key):
    row = judge(approval=approve(**{key: None}), **BARE)
    assert row.scopes[Scope.SITING].verdict is Verdict.NOT_PROVEN
    assert row.scopes[Scope.STRUCTURE].verdict is Verdict.NOT_PROVEN


def test_what_nobody_says_of_the_row_may_be_beyond_a_limit(judge):
    unknown = {"altitude": None, "glide_factor": None, "ground": GroundLaw(kind="free")}
    most = load_glide_limits()[1]
    row = judge(approval=approve(glide_factor=most, altitude_factor=1.02), **unknown)
    assert row.scopes[Scope.SITING].verdict is Verdict.NOT_PROVEN
    row = judge(approval=approve(glide_factor=most, altitude_factor=9.0), **unknown)
    assert row.scopes[Scope.SITING].verdict is Verdict.PASS


def test_what_is_calculated_of_an_approved_structure_is_information(judge):
    """Emptying a cell of the structure makes no verdict better: it decides nothing."""
    weak = resist(post__compression=WEAK, uphill_guy__rope=WEAK)
    row = judge(approval=approve(), resistances=weak)
    post = find_check(row, "post.compression")
    assert post.utilisation > 1.0
    assert post.verdict is Verdict.DECLARED
    assert row.verdict is judge(approval=approve(), **BARE).verdict
    assert row.scopes[Scope.STRUCTURE].governing == "structure.approval"
    assert judge(resistances=weak).scopes[Scope.STRUCTURE].verdict is Verdict.FAIL


def test_an_overtopped_net_is_none_that_was_approved(judge):
    row = judge(approval=approve(), net_height=2.3, **BARE)
    assert row.scopes[Scope.SITING].verdict is Verdict.FAIL
    assert row.scopes[Scope.STRUCTURE].verdict is Verdict.NOT_PROVEN


def test_without_approval_and_resistances_there_is_one_line(judge):
    row = judge(**BARE)
    listed = list_of_scope(row.checks, Scope.STRUCTURE)
    assert [one.id for one in listed] == ["post.lateral", "structure.resistances"]
    assert row.scopes[Scope.STRUCTURE].verdict is Verdict.NOT_PROVEN
    assert row.scopes[Scope.ANCHORS].verdict is Verdict.PASS
    proof = Proof(document="Report 7", author="A. B.", date="", cell="Declared!B2")
    said = Declaration(row_id="", member="structure", mode="resistances", proof=proof)
    by_check = replace(said, member="post_base", mode="bearing")
    listed = list_of_scope(judge(by_check, **BARE).checks, Scope.STRUCTURE)
    assert {one.member for one in listed} == {"post", "post_base", "structure"}
    declared = judge(said, **BARE)
    assert declared.scopes[Scope.STRUCTURE].verdict is Verdict.DECLARED


def test_forces_of_a_maker_alone_approve_nothing(judge):
    forces = Approval(foot_force=StatedValue(value=1.0, cell="Net types!H4"))
    assert judge(approval=forces, **BARE).scopes == judge(**BARE).scopes


PARTS = st.sampled_from([WEAK, STRONG, None])
GIVEN = st.fixed_dictionaries(
    {
        "anchors": st.fixed_dictionaries(
            {
                f"{one}__{mode}": PARTS
                for one, mode in product(ANCHORS, ("tendon", "pull_out"))
            }
        ),
        "structure": st.fixed_dictionaries(
            {
                name: PARTS
                for name in (
                    *("uphill_guy__rope", "downhill_guy__rope"),
                    *("post__compression", "post_base__bearing"),
                )
            }
        ),
        "mesh": PARTS,
        "factor": st.sampled_from([0.9, 1.1, None]),
        "approved": st.booleans(),
    }
)
OF = {
    Scope.ANCHORS: ("anchors",),
    Scope.STRUCTURE: ("structure", "mesh", "factor", "approved"),
    Scope.SITING: ("factor", "approved"),
}


@settings(max_examples=15, deadline=None)
@given(first=GIVEN, second=GIVEN)
def test_a_scope_depends_on_its_own_inputs_alone(judge, first, second):
    row = _judge_given(judge, first)
    for scope in SCOPES:
        mine = {key: first[key] for key in OF[scope]}
        other = _judge_given(judge, {**second, **mine})
        assert row.scopes[scope] == other.scopes[scope]


def _judge_given(judge, chosen):
    factor, approval = chosen["factor"], None
    if chosen["approved"]:
        approval = approve(glide_factor=factor and factor * HAS["glide_factor"])
    return judge(
        approval=approval,
        resistances=resist(**chosen["anchors"], **chosen["structure"]),
        net_parts=list_net_parts(chosen["mesh"], has_ropes=False),
    )


def test_a_scope_counts_what_its_forces_were_searched_over(judge):
    some = tuple(load_assumed()[key] for key in ("slack", "post_tilt"))
    row = judge(assumed=some)
    assert [one.source for one in row.assumed] == [one.why for one in some]
    counted = {scope: one.assumed for scope, one in row.scopes.items()}
    assert counted == {Scope.ANCHORS: 2, Scope.STRUCTURE: 2, Scope.SITING: 0}
    proven = judge(assumed=some, approval=approve(), **BARE).scopes
    assert proven[Scope.ANCHORS].assumed == 2
    assert proven[Scope.STRUCTURE].assumed == 0  # by a document, not by forces
