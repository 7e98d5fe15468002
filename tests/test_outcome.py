"""How things end: outcomes, verdicts, faults, guards."""

from __future__ import annotations

import math
import pickle
import re
from functools import partial
from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from netdesign.outcome import (
    Fault,
    InputError,
    ModelError,
    NetDesignError,
    Outcome,
    OutputError,
    SceneFileError,
    SiteDataError,
    SolveError,
    StandardError,
    StudyError,
    Verdict,
    catch_fault,
    merge_verdicts,
    require_count,
    require_one_of,
    require_positive,
    require_within,
)
from netdesign.snow import mesh
from netdesign.solving.workers import Job, solve_job
from tests.each import each
from tests.solving.small_scene import COARSE
from tests.sources import PACKAGE

TOLD = Verdict.DECLARED
PASS, FAIL, OPEN = Verdict.PASS, Verdict.FAIL, Verdict.NOT_PROVEN


@each("length", range(6))
def test_a_whole_is_no_better_than_its_parts(length):
    """Every row of the table of the docstring, in every order."""
    for parts in product(Verdict, repeat=length):
        by_worst = (FAIL in parts, OPEN in parts or not parts, TOLD in parts, True)
        worst = (FAIL, OPEN, TOLD, PASS)[by_worst.index(True)]
        assert merge_verdicts(parts) is merge_verdicts(iter(parts)) is worst


def test_words_are_those_of_the_interface():
    words = ["pass", "fail", "not_proven", "declared"]
    assert [verdict.value for verdict in Verdict] == words
    assert Outcome.CONVERGED.value == "converged"


@each("outcome", Outcome)
def test_every_outcome_has_a_name_and_a_meaning(outcome):
    assert str(outcome.message) != str(outcome.word)


@each(
    "kind, exit_code",
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
    bases = (NetDesignError, InputError)
    kinds = [
        NetDesignError,
        *(kind for base in bases for kind in base.__subclasses__()),
    ]
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


BUGS = (
    *(ValueError, TypeError, IndexError, KeyError, AssertionError, AttributeError),
    *(ZeroDivisionError, FloatingPointError, OverflowError, RecursionError),
    *(np.linalg.LinAlgError, NotImplementedError, OSError, StopIteration),
    *(NetDesignError, StandardError),
)


def raise_one(error):
    raise error


@given(kind=st.sampled_from(BUGS), text=st.text(max_size=40), case=st.text(max_size=9))
def test_whatever_is_not_raised_on_purpose_is_a_fault(kind, text, case):
    fault = catch_fault(partial(raise_one, kind(text)), case)
    assert isinstance(fault, Fault)
    assert (fault.kind, fault.case) == (kind.__name__, case)
    assert fault.message == str(kind(text))
    assert pickle.loads(pickle.dumps(fault)) == fault


@pytest.mark.parametrize(
    "error",
    [
        SolveError(Outcome.DIVERGED),
        ModelError("refused"),
        MemoryError(),
        KeyboardInterrupt(),
        SystemExit(3),
    ],
    ids=lambda error: type(error).__name__,
)
def test_what_is_meant_is_no_fault(error):
    with pytest.raises(type(error)) as caught:
        catch_fault(partial(raise_one, error), "")
    assert caught.value is error


def test_the_place_is_the_line_of_the_package_that_was_at_work():
    """Where numpy raises, it is the line that called it."""
    fault = catch_fault(partial(mesh.build_template, 5.0, None), "")
    name, line = re.fullmatch(r"(snow/\w+\.py):(\d+)", fault.place).groups()
    assert 0 < int(line) <= len((PACKAGE / name).read_text().splitlines())
    assert fault.place.replace(":", '", line ') in fault.trace
    assert str(fault).endswith(f", in {fault.place}")


def test_a_long_message_is_cut():
    fault = catch_fault(partial(raise_one, ValueError("x" * 10**6)), "")
    assert len(fault.message) == 500


# --- what a worker makes of exceptions -----------------------------------------------


@pytest.fixture
def end_of(monkeypatch, a_scene):
    def solve(error):
        monkeypatch.setattr(
            "netdesign.solving.workers.solve_scene", lambda *_: raise_one(error)
        )
        return solve_job(Job(scene=a_scene(), settings=COARSE))

    return solve


@pytest.mark.parametrize("kind", BUGS)
def test_a_bug_in_a_worker_is_a_fault_of_the_program(end_of, kind):
    end = end_of(kind("17 of 4"))
    assert end.outcome is Outcome.PROGRAM_FAULT
    assert end.fault.kind == kind.__name__
    assert "17" not in str(end.reason)
    assert "friction 30 deg, inclination 0 deg, slope 40 deg" in end.fault.case


@pytest.mark.parametrize(
    ("error", "outcome"),
    [
        (SolveError(Outcome.DIVERGED, "rose"), Outcome.DIVERGED),
        (ModelError("two-sided only"), Outcome.OUT_OF_VALIDITY),
        (MemoryError(), Outcome.WORKER_FAILED),
    ],
    ids=lambda one: type(one).__name__,
)
def test_what_a_solver_means_keeps_its_outcome(end_of, error, outcome):
    end = end_of(error)
    assert (end.outcome, end.fault) == (outcome, None)
    assert end.reason


NO_NUMBERS = (math.nan, math.inf, -math.inf)
WITHIN, WORDS = (-1.0, 2.0, "rad"), (("free", "no-slip"),)


@each(
    "require, value, beside",
    [
        *((require_positive, x, ()) for x in (math.ulp(0.0), 1e-300, 1, 1e300)),
        *((require_within, x, WITHIN) for x in (-1.0, -0.9, 0.0, 2.0)),
        *((require_one_of, x, WORDS) for x in WORDS[0]),
        *((require_count, x, ()) for x in (1, 80)),
    ],
)
def test_what_is_within_is_taken(require, value, beside):
    assert require("slack", value, *beside) is None


BEYOND = (math.nextafter(-1.0, -2.0), math.nextafter(2.0, 3.0), *NO_NUMBERS)
NO_COUNTS = (0, -1, 1.5, 2.0, math.nan, math.inf, "3", None)


@each(
    "require, value, beside, accepted",
    [
        *((require_positive, x, ("m",), "be a finite number above 0")
          for x in (0.0, -0.0, -math.ulp(0.0), -1, *NO_NUMBERS)),
        *((require_within, x, WITHIN, "lie between -1 and 2 rad") for x in BEYOND),
        (require_within, math.inf, (0.0, math.inf), "lie between 0 and"),
        *((require_one_of, x, WORDS, "be one of free, no-slip$")
          for x in ("Free", "", "free ", "slip")),
        *((require_count, x, (), "be a whole number above 0") for x in NO_COUNTS),
    ],
)  # fmt: skip
def test_what_is_beyond_is_refused_with_what_is_accepted(
    require, value, beside, accepted
):
    with pytest.raises(ModelError, match=rf"^slack = .*must {accepted}"):
        require("slack", value, *beside)


def test_a_value_without_a_unit_is_told_without_one():
    told = []
    for unit in ("m", ""):
        with pytest.raises(ModelError) as refused:
            require_positive("post spacing", -1.7, unit)
        told.append(str(refused.value))
    assert told[1] == told[0].removesuffix(" m")
    assert told[1] != told[0]
