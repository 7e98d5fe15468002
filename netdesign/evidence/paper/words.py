"""The paper's statements, and what the runs say of them, in sentences."""

from __future__ import annotations

import re
from dataclasses import dataclass

from netdesign.evidence.paper.findings import Call, Finding
from netdesign.report.words import ENGLISH, Words

_SYMBOLS: dict[Call, str] = {"agrees": "✓", "does not agree": "✗", "not decided": "?"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Claim:
    """One statement with its call, the numbers and the reason."""

    said: str
    call: str
    symbol: str
    differs: bool
    found: str
    reason: str


def word_finding(finding: Finding, words: Words = ENGLISH) -> Claim:
    """Sentences of a finding with its numbers put in."""
    key, call = finding.key, finding.call
    if call == "not decided":
        found, reason = words("paper.no_run"), ""
    else:
        found = words(f"paper_found.{key}", **finding.numbers)
        reason = words(f"paper_reason.{key}", **finding.numbers)
    return Claim(
        said=words(f"paper_said.{key}"),
        call=words(f"paper_call.{call.replace(' ', '_')}"),
        symbol=_SYMBOLS[call],
        differs=call != "agrees",
        found=_write_minus(found),
        reason=_write_minus(reason),
    )


def _write_minus(text: str) -> str:
    """Proper minus signs before digits; none before a rounded zero."""
    return re.sub(r"-(?=\d)", "−", re.sub(r"[+-](?=0[.,]0\s?%)", "", text))
