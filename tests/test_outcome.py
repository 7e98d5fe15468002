from itertools import chain, permutations, product

import pytest

from netdesign.errors import (
    ModelError,
    NetDesignError,
    OutputError,
    SceneFileError,
    SiteDataError,
    SolveError,
    StandardError,
    StudyError,
)
from netdesign.outcome import Outcome, Verdict, merge_verdicts

PASS, FAIL, OPEN = Verdict.PASS, Verdict.FAIL, Verdict.NOT_PROVEN
TOLD = Verdict.DECLARED

# The table of the docstring: parts, whole.
ROWS = [
    ([FAIL, PASS], FAIL),
    ([FAIL], FAIL),
    ([FAIL, OPEN], FAIL),
    ([FAIL, OPEN, PASS], FAIL),
    ([OPEN], OPEN),
    ([OPEN, PASS], OPEN),
    ([OPEN, PASS, PASS], OPEN),
    ([TOLD], TOLD),
    ([TOLD, PASS, PASS], TOLD),
    ([TOLD, OPEN], OPEN),
    ([TOLD, FAIL, PASS], FAIL),
    ([PASS], PASS),
    ([PASS, PASS, PASS], PASS),
    ([], OPEN),
]


@pytest.mark.parametrize(("parts", "whole"), ROWS)
def test_every_row_of_the_table_in_every_order(parts, whole):
    for order in permutations(parts):
        assert merge_verdicts(order) is whole
        assert merge_verdicts(iter(order)) is whole


def test_a_pass_needs_every_part_to_pass():
    lengths = [product(Verdict, repeat=length) for length in range(5)]
    for parts in chain.from_iterable(lengths):
        is_pass = merge_verdicts(parts) is PASS
        assert is_pass == (len(parts) > 0 and all(part is PASS for part in parts))


def test_merging_by_groups_gives_the_same():
    """Checks merge to rows and rows to a study: the grouping must not matter."""
    for parts in product(Verdict, repeat=4):
        whole = merge_verdicts(parts)
        groups = [merge_verdicts(parts[:2]), merge_verdicts(parts[2:])]
        assert merge_verdicts(groups) is whole


def test_words_are_those_of_the_interface():
    words = ["pass", "fail", "not_proven", "declared"]
    assert [verdict.value for verdict in Verdict] == words
    assert Outcome.CONVERGED.value == "converged"


@pytest.mark.parametrize("outcome", Outcome)
def test_every_outcome_owns_a_sentence(outcome):
    assert outcome.sentence[0].isupper()
    assert outcome.sentence.endswith(".")


def test_no_two_outcomes_say_the_same():
    assert len({outcome.sentence for outcome in Outcome}) == len(Outcome)


@pytest.mark.parametrize(
    ("kind", "exit_code"),
    [
        (NetDesignError, 5),
        (ModelError, 3),
        (StandardError, 3),
        (SiteDataError, 3),
        (StudyError, 3),
        (SceneFileError, 3),
        (OutputError, 2),
        (SolveError, 4),
    ],
)
def test_every_error_knows_its_exit_code(kind, exit_code):
    assert kind.exit_code == exit_code


def test_no_error_ends_like_a_verdict():
    """1 means that a check fails and 0 that all pass: no error may say so."""
    kinds = [NetDesignError, *NetDesignError.__subclasses__()]
    assert len(kinds) > 5
    assert not {kind.exit_code for kind in kinds} & {0, 1}


def test_a_solve_error_says_outcome_and_reason():
    error = SolveError(Outcome.DIVERGED, "residual grew")
    assert str(error) == "diverged: residual grew"
    assert SolveError(Outcome.DIVERGED).reason == Outcome.DIVERGED.message


def test_a_site_error_carries_every_finding():
    findings = [NetDesignError("first"), NetDesignError("second")]
    error = SiteDataError(findings)
    assert error.findings == tuple(findings)
    assert str(error) == "first\nsecond"
