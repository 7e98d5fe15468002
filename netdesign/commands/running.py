"""Parts that all running commands share: command line, time, exit codes, places."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from netdesign.commands.language import tell
from netdesign.commands.usage import UsageRefusal
from netdesign.edge.given_files import make_printable
from netdesign.outcome import Verdict
from netdesign.words.message import say

if TYPE_CHECKING:
    from netdesign.words.catalogue import Language

EXIT_CODES = {Verdict.PASS: 0, Verdict.FAIL: 1, Verdict.NOT_PROVEN: 4}


def own_command() -> str:
    """The command line as it was given."""
    import shlex

    return make_printable(shlex.join(["netdesign", *sys.argv[1:]]))


def tell_time() -> str:
    """Time of the run, or that of SOURCE_DATE_EPOCH for reproducible outputs."""
    from datetime import UTC, datetime

    epoch = os.environ.get("SOURCE_DATE_EPOCH")
    try:
        time = datetime.fromtimestamp(int(epoch), UTC) if epoch else datetime.now(UTC)
    except (ValueError, OverflowError, OSError):
        raise UsageRefusal(say("usage.epoch", epoch=epoch or "")) from None
    return time.isoformat(timespec="seconds")


def report_places(names: list[list[Path]], language: Language, *, quiet: bool) -> None:
    """Tell where outputs were written."""
    for path in [] if quiet else [path for group in names for path in group]:
        tell(say("cli.wrote", path=str(path)), language, err=True)
