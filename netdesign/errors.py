"""Exceptions of the package; each class knows the exit code it leads to."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar, Protocol, cast

from netdesign.outcome import Outcome
from netdesign.words.message import Message, say


class Told(Protocol):
    """Anything with a message; ``site.cells.findings.Finding`` is one."""

    @property
    def message(self) -> Message:
        """Message to the user."""

    @property
    def severity(self) -> str:
        """``error`` of a fault, ``note`` of a remark."""


class NetDesignError(Exception):
    """Base of every error that the program raises on purpose.

    Attributes
    ----------
    message : Message
        What the user is told; somebody else's words may be given as they are.
    """

    exit_code: ClassVar[int] = 5

    def __init__(self, message: Message | str) -> None:
        super().__init__(message)
        given = say("text.as_given", text=message) if isinstance(message, str) else None
        self.message = given or cast(Message, message)

    def __str__(self) -> str:
        """The message in English, for logs and for whoever uses the package."""
        return str(self.message)


class ContentError(ValueError):
    """Fault inside a file or value, before its place is known."""

    def __init__(self, message: Message) -> None:
        super().__init__(message)
        self.message = message

    def __str__(self) -> str:
        """The message in English."""
        return str(self.message)


class ModelError(NetDesignError):
    """An input is impossible or outside what the model can represent."""

    exit_code = 3


class StandardError(NetDesignError):
    """A limit profile is missing, malformed or incomplete."""

    exit_code = 3


class SiteDataError(NetDesignError):
    """A site workbook was refused; carries every finding, not the first."""

    exit_code = 3

    def __init__(
        self, findings: Sequence[Told], lines: tuple[Message, ...] = ()
    ) -> None:
        self.findings = tuple(findings)
        told = lines or tuple(finding.message for finding in self.findings)
        super().__init__(say("text.lines", lines=told))
        self.args = (findings, lines)


class StudyError(NetDesignError):
    """A stored study cannot be read."""

    exit_code = 3


class SceneFileError(NetDesignError):
    """A scene file was refused; the message lists every fault."""

    exit_code = 3


class OutputError(NetDesignError):
    """An output cannot be written: it exists already, or the place is unfit."""

    exit_code = 2


class SolveError(NetDesignError):
    """A solve ended without a proven result."""

    exit_code = 4

    def __init__(self, outcome: Outcome, reason: Message | str | None = None) -> None:
        self.outcome = outcome
        given = say("text.as_given", text=reason) if isinstance(reason, str) else reason
        self.reason: Message = given or outcome.message
        super().__init__(say("error.solve", ended=outcome.word, reason=self.reason))
        self.args = (outcome, self.reason)
