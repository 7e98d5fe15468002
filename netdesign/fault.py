"""Faults of the program: caught in one place, and told as what they are.

A fault is whatever the package does not raise on purpose. It is no answer to an
engineer's question: whoever has one leaves the case without a result, tells the fault
on stderr, keeps it from the store, and ends with ``EXIT_CODE``.
"""

from __future__ import annotations

import traceback
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from netdesign.errors import ModelError, SolveError
from netdesign.words.message import say

EXIT_CODE = 5
# What a report says: the rest is of use to those only who can mend it.
SENTENCE = say("fault.sentence")
_LONGEST = 500  # signs of a message

Result = TypeVar("Result")


@dataclass(frozen=True, slots=True, kw_only=True)
class Fault:
    """An exception that nobody meant to raise.

    Attributes
    ----------
    kind, message : str
        Its type and text.
    place : str
        Where, in the package: ``snow/body.py:88``.
    case : str
        What was being solved, in engineer's units.
    trace : str
        The whole way to it.
    """

    kind: str
    message: str
    place: str
    case: str = ""
    trace: str = ""

    def __str__(self) -> str:
        """``ValueError: array is empty, in snow/body.py:88``."""
        return f"{self.kind}: {self.message}, in {self.place}"


def catch_fault(solve: Callable[[], Result], case: str) -> Result | Fault:
    """Result of a solve, or the fault that ended it.

    Parameters
    ----------
    solve : callable
        Takes nothing.
    case : str
        What it solves, as the fault shall name it.

    Raises
    ------
    SolveError, ModelError, MemoryError
        As raised: none of them is a fault of the program.
    """
    try:
        return solve()
    except (SolveError, ModelError, MemoryError):
        raise
    except Exception as error:  # a bug in one case must not hide the others
        return describe_fault(error, case)


def describe_fault(error: Exception, case: str = "") -> Fault:
    """Facts on an exception, as texts that go from process to process."""
    return Fault(
        kind=type(error).__name__,
        message=str(error)[:_LONGEST],
        place=_find_place(error),
        case=case,
        trace="".join(traceback.format_exception(error)),
    )


def _find_place(error: Exception) -> str:
    """Line of the package that was at work: its own, or that which called another's."""
    package = Path(__file__).parent
    frames = traceback.extract_tb(error.__traceback__)
    places = [
        f"{Path(one.filename).relative_to(package).as_posix()}:{one.lineno}"
        for one in frames
        if Path(one.filename).is_relative_to(package)
    ]
    return places[-1] if places else "unknown"
