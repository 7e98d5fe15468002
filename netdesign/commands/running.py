"""Parts that all running commands share: command line, time, exit codes, places."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from netdesign.commands.language import tell
from netdesign.commands.usage import UsageRefusal
from netdesign.edge.given_files import make_printable
from netdesign.outcome import Verdict, merge_verdicts
from netdesign.words.message import say

if TYPE_CHECKING:
    from collections.abc import Sequence

    from netdesign.study.records import Study
    from netdesign.words.catalogue import Language

EXIT_CODES = {
    Verdict.PASS: 0,
    Verdict.FAIL: 1,
    Verdict.NOT_PROVEN: 4,
    Verdict.DECLARED: 6,  # no pass: a script that knows nothing of it stops
}


def find_exit_code(studies: Sequence[Study]) -> int:
    """Exit code of the worst verdict; a what-if that passes proves nothing: 4."""
    verdict = merge_verdicts(study.verdict for study in studies)
    if verdict is not Verdict.FAIL and any(study.what_if for study in studies):
        verdict = Verdict.NOT_PROVEN
    return EXIT_CODES[verdict]


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
