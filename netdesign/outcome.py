"""Outcomes of solves, verdicts, errors, faults, and guards of values: how things end.

An *outcome* is the end of a solve. An *error* is raised on purpose, for the user. A
*fault* is any other exception: a bug. Its case has no result and is not stored; the
run shows it on stderr and ends with ``EXIT_CODE``. A *guard* refuses a value that is
out of range; all are written in the positive, so that NaN fails them.
"""

from __future__ import annotations

import math
import re
import traceback
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import ClassVar, NoReturn, Protocol, TypeVar

from netdesign.units import given_degree_from_radian, given_kilonewton_from_newton
from netdesign.words.message import Message, say


class Outcome(StrEnum):
    """End of one solve. Only ``CONVERGED`` carries numbers that may be used."""

    CONVERGED = "converged"
    MAX_ITERATIONS = "max_iterations"
    DIVERGED = "diverged"
    NONFINITE = "nonfinite"
    BALANCE_VIOLATED = "balance_violated"
    NO_EQUILIBRIUM = "no_equilibrium"
    PLATEAU_NOT_REACHED = "plateau_not_reached"
    OUT_OF_VALIDITY = "out_of_validity"
    WORKER_FAILED = "worker_failed"
    PROGRAM_FAULT = "program_fault"

    @property
    def message(self) -> Message:
        """Meaning of the outcome, for a report."""
        return say(f"outcome.{self.value}")

    @property
    def word(self) -> Message:
        """Its name, before a reason."""
        return say(f"ended.{self.value}")


class Verdict(StrEnum):
    """Conclusion of a check, of a net row or of a whole study."""

    PASS = "pass"
    FAIL = "fail"
    NOT_PROVEN = "not_proven"
    DECLARED = "declared"  # a document proves it elsewhere: never a pass


EXIT_CODES = {
    Verdict.PASS: 0,
    Verdict.FAIL: 1,
    Verdict.NOT_PROVEN: 4,
    Verdict.DECLARED: 6,  # no pass: a script that knows nothing of it stops
}
# Worst first.
SEVERITY = (Verdict.FAIL, Verdict.NOT_PROVEN, Verdict.DECLARED, Verdict.PASS)


def merge_verdicts(verdicts: Iterable[Verdict]) -> Verdict:
    """Verdict of a whole from the verdicts of its parts.

    ==============  ===================  =================  ===========
    any part fails  any part not proven  any part declared  whole
    ==============  ===================  =================  ===========
    yes             no or yes            no or yes          fail
    no              yes                  no or yes          not proven
    no              no                   yes                declared
    no              no                   no                 pass
    no part at all                                          not proven
    ==============  ===================  =================  ===========

    Examples
    --------
    >>> merge_verdicts([Verdict.PASS, Verdict.NOT_PROVEN]).value
    'not_proven'
    >>> merge_verdicts([]).value
    'not_proven'
    """
    parts = set(verdicts)
    if Verdict.FAIL in parts:
        return Verdict.FAIL
    if not parts or Verdict.NOT_PROVEN in parts:
        return Verdict.NOT_PROVEN
    return Verdict.DECLARED if Verdict.DECLARED in parts else Verdict.PASS


class Remark(Protocol):
    """Message with its severity, as ``site.cells.findings.Finding`` has it."""

    @property
    def message(self) -> Message:
        """Message to the user."""

    @property
    def severity(self) -> str:
        """``error`` of a fault, ``note`` of a remark."""


def as_message(text: Message | str) -> Message:
    """The message itself; a text of another program as it stands, in any language."""
    return say("text.as_given", text=text) if isinstance(text, str) else text


class NetDesignError(Exception):
    """Base of every error that the program raises on purpose.

    Attributes
    ----------
    message : Message
        To the user; a text of another program or of the system may stand as it is.
    """

    exit_code: ClassVar[int] = 5

    def __init__(self, message: Message | str) -> None:
        super().__init__(message)
        self.message = as_message(message)

    def __str__(self) -> str:
        """Message in English, for logs and for use from Python."""
        return str(self.message)


class ContentError(ValueError):
    """Fault inside a file or value, before its place is known."""

    def __init__(self, message: Message) -> None:
        super().__init__(message)
        self.message = message

    def __str__(self) -> str:
        """The message in English."""
        return str(self.message)


class InputError(NetDesignError):
    """What the user gave is refused."""

    exit_code = 3


class ModelError(InputError):
    """An input is impossible or outside what the model can represent."""


class StandardError(InputError):
    """A limit profile is missing, malformed or incomplete."""


class SiteDataError(InputError):
    """A site workbook was refused; carries every finding, not the first."""

    def __init__(
        self, findings: Sequence[Remark], lines: tuple[Message, ...] = ()
    ) -> None:
        # each once: a cell may be read for two columns
        by_text = {str(finding.message): finding for finding in findings}
        self.findings = tuple(by_text.values())
        shown = lines or tuple(finding.message for finding in self.findings)
        super().__init__(say("text.lines", lines=shown))
        self.args = (findings, lines)


class StudyError(InputError):
    """A stored study cannot be read."""


class SceneFileError(InputError):
    """A scene file was refused; the message lists every fault."""


class TerrainError(InputError):
    """A grid, lines on it, or prices were refused; the message lists every fault."""


class AddonError(NetDesignError):
    """An add-on is needed that the installation lacks."""

    exit_code = 2


class OutputError(NetDesignError):
    """An output cannot be written: it exists already, or the place is unfit."""

    exit_code = 2


class SolveError(NetDesignError):
    """A solve ended without a proven result."""

    exit_code = 4

    def __init__(self, outcome: Outcome, reason: Message | str | None = None) -> None:
        self.outcome = outcome
        self.reason = as_message(reason or outcome.message)
        super().__init__(say("error.solve", ended=outcome.word, reason=self.reason))
        self.args = (outcome, self.reason)


EXIT_CODE = 5
# What a report says: the rest is of use to those only who can mend it.
SENTENCE = say("fault.sentence")
_LONGEST = 500  # signs of a message

Result = TypeVar("Result")


@dataclass(frozen=True, slots=True, kw_only=True)
class Fault:
    """An exception that the program does not raise on purpose.

    Attributes
    ----------
    kind, message : str
        Its type and text.
    place : str
        Where, in the package: ``snow/mesh.py:88``.
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
        """``ValueError: array is empty, in snow/mesh.py:88``."""
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
    except Exception as error:  # a bug in one case must not hide the others  # noqa: BLE001
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
        f"{Path(frame.filename).relative_to(package).as_posix()}:{frame.lineno}"
        for frame in frames
        if Path(frame.filename).is_relative_to(package)
    ]
    return places[-1] if places else "unknown"


def _refuse(key: str, name: str, **details: float | str | tuple[str, ...]) -> NoReturn:
    raise ModelError(say(key, name=name_quantity(name), **details))


def require_positive(name: str, value: float, unit: str = "") -> None:
    """Refuse anything but a finite number above zero."""
    if not (math.isfinite(value) and value > 0):
        _refuse("guard.positive", name, value=float(value), unit=_in(unit))


def require_count(name: str, value: int) -> None:
    """Refuse anything but a whole number above zero."""
    if not (isinstance(value, int) and value > 0):
        _refuse("guard.count", name, value=value)


def require_within(
    name: str, value: float, low: float, high: float, unit: str = ""
) -> None:
    """Refuse anything but a finite number with ``low <= value <= high``."""
    if not (math.isfinite(value) and low <= value <= high):
        span = {"low": low, "high": high}
        _refuse("guard.within", name, value=value, **span, unit=_in(unit))


def require_one_of(name: str, value: str, accepted: tuple[str, ...]) -> None:
    """Refuse a word that is not one of the accepted ones."""
    if value not in accepted:
        _refuse("guard.one_of", name, value=value, accepted=accepted)


def name_quantity(name: str) -> Message:
    """Name of a quantity in refusals: ``quantity.slope_angle`` of ``slope angle``."""
    return say(f"quantity.{re.sub('[^a-z]+', '_', name)}")


# Units inside, and what an engineer gives: the conversion and the unit's sign.
_SHOWN = {
    " rad": (given_degree_from_radian, " deg"),
    " N/m": (given_kilonewton_from_newton, " kN/m"),
}


def show_given_units(refusal: Message) -> Message:
    """Refusal of a number in the unit in which it was given; any other as it is."""
    unit = refusal.arguments.get("unit")
    if not isinstance(unit, str) or unit not in _SHOWN:
        return refusal
    convert, shown_unit = _SHOWN[unit]
    numbers = {
        name: convert(value)
        for name, value in refusal.arguments.items()
        if isinstance(value, int | float)
    }
    return say(refusal.key, **{**refusal.arguments, **numbers, "unit": shown_unit})


def _in(unit: str) -> str:
    return f" {unit}" if unit else ""
