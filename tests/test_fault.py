"""Faults of the program: what is one, what is told of it, and who may catch it."""

import ast
import pickle
import re
from functools import partial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from netdesign.errors import ModelError, NetDesignError, SolveError, StandardError
from netdesign.fault import Fault, catch_fault
from netdesign.outcome import Outcome
from netdesign.snow import mesh
from netdesign.solving.workers import Job, solve_job
from tests.solving.small_scene import COARSE
from tests.sources import PACKAGE, walk_package

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


def test_a_result_comes_through():
    assert catch_fault(lambda: 7, "") == 7


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


# --- who may catch everything --------------------------------------------------------

# House rule: nobody else, since a bug that is caught is a bug that nobody sees.
CATCH_ALL = {
    "fault.py": "catch_fault",  # every case, whoever solves it
    "cli.py": "_run",
    "edge/output.py": "_exchange",  # undoes, and raises again
    # stops its processes, and raises again
    "evidence/runner.py": "_work_through",
    # counts bugs: that is what it is for
    "evidence/benchmark/stress.py": "attempt_scene",
    "commands/doctor.py": "_try",  # so is this
}


def list_catch_alls():
    for module, function in walk_package():
        if isinstance(function, ast.FunctionDef):
            for node in ast.walk(function):
                if isinstance(node, ast.ExceptHandler) and is_broad(node.type):
                    yield module, function.name


def is_broad(kind):
    names = kind.elts if isinstance(kind, ast.Tuple) else [kind]
    broad = ("Exception", "BaseException")
    return any(one is None or getattr(one, "id", "") in broad for one in names)


def test_nobody_else_catches_everything():
    assert sorted(list_catch_alls()) == sorted(CATCH_ALL.items())
