"""Exceptions of the package; each class knows the exit code it leads to."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

from netdesign.outcome import Outcome


class NetDesignError(Exception):
    """Base of every error that the program raises on purpose."""

    exit_code: ClassVar[int] = 5


class ModelError(NetDesignError):
    """An input is impossible or outside what the model can represent."""

    exit_code = 3


class StandardError(NetDesignError):
    """A limit profile is missing, malformed or incomplete."""

    exit_code = 3


class SiteDataError(NetDesignError):
    """A site workbook was refused; carries every finding, not the first."""

    exit_code = 3

    def __init__(self, findings: Sequence[object]) -> None:
        self.findings = tuple(findings)
        super().__init__("\n".join(str(finding) for finding in self.findings))


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

    def __init__(self, outcome: Outcome, reason: str = "") -> None:
        self.outcome = outcome
        self.reason = reason or outcome.sentence
        super().__init__(f"{outcome.value}: {self.reason}")
