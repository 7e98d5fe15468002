"""Steps that follow a check which fails or leaves something open, in short."""

from __future__ import annotations

import shlex
from collections.abc import Set
from pathlib import Path
from typing import TYPE_CHECKING

from netdesign.commands.language import tell
from netdesign.outcome import Verdict
from netdesign.words.message import Message, say

if TYPE_CHECKING:
    from netdesign.words.catalogue import Language

TUTORIAL = Path(__file__).resolve().parent.parent / "TUTORIAL.md"


def tell_next_steps(
    verdicts: Set[Verdict], site: str, language: Language, *, is_sized: bool
) -> None:
    """Tell what to do about rows that do not pass; nothing where all do.

    ``verdicts`` are those of all rows, ``site`` is what was checked, as on the command
    line.
    """
    for message in list_next_steps(verdicts, site, is_sized=is_sized):
        tell(message, language, err=True)


def list_next_steps(
    verdicts: Set[Verdict], site: str, *, is_sized: bool
) -> list[Message]:
    """Sentences for rows of these verdicts."""
    fails, is_open = Verdict.FAIL in verdicts, Verdict.NOT_PROVEN in verdicts
    if not (fails or is_open):
        return []
    size = shlex.join(["netdesign", "check", site, "--size"])
    told = [say("next.heading"), say("next.inputs")]
    told += [say("next.open")] if is_open else []
    told += [say("next.size", command=size)] if fails and not is_sized else []
    told.append(say("next.again"))
    return [*told, say("next.more", file=str(TUTORIAL))]
