"""Type approval of a net: the document that proves its structure within its limits."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from netdesign.checks.check import Check, judge
from netdesign.checks.comparison import compare
from netdesign.checks.result import Proof
from netdesign.outcome import SEVERITY, Verdict
from netdesign.words.message import Message, say


@dataclass(frozen=True, slots=True, kw_only=True)
class StatedValue:
    """A number of an approval or of its maker, with its cell; SI."""

    value: float
    cell: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Approval:
    """Limits of a type approval, and what the maker states beside them.

    A limit that it does not state is None: it proves nothing then. So is a force.

    Attributes
    ----------
    document, cell : str
        What approves the net, and where that stands; "" where only the maker's forces
        are given.
    height : StatedValue or None
        Largest D_K, normal to the slope [m].
    glide_factor : StatedValue or None
        Largest N [-].
    altitude_factor : StatedValue or None
        Largest f_c [-].
    spacing : StatedValue or None
        Largest distance of the posts [m].
    foot_force, uphill_force, downhill_force : StatedValue or None
        Characteristic force on the anchor, as the maker states it [N].
    """

    document: str = ""
    cell: str = ""
    height: StatedValue | None = None
    glide_factor: StatedValue | None = None
    altitude_factor: StatedValue | None = None
    spacing: StatedValue | None = None
    foot_force: StatedValue | None = None
    uphill_force: StatedValue | None = None
    downhill_force: StatedValue | None = None

    def prove(self) -> Proof:
        """Document as the proof of what it approves."""
        return Proof(document=self.document, author="", date="", cell=self.cell)


MODE = "approval"
# What an approval limits, with its name and unit.
_LIMITS = {
    "height": ("approval.height", " m"),
    "glide_factor": ("approval.glide_factor", ""),
    "altitude_factor": ("approval.altitude_factor", ""),
    "spacing": ("approval.spacing", " m"),
}
_ROUNDING = 1e-9  # relative, of a factor that is worked out


def check_approval(
    approval: Approval, actual: Mapping[str, tuple[float, float]]
) -> Check:
    """Check of a row against the limits of the approval of its net type.

    Parameters
    ----------
    approval : Approval
        With a document.
    actual : mapping of str to tuple of float
        Least and largest value of the row by the limits' names in `Approval`, SI.

    Returns
    -------
    Check
        It fails where a value surely exceeds its limit. A limit that the approval does
        not state is not proven, and neither is a value that may exceed its own.
    """
    beyond: dict[Verdict, list[Message]] = {}
    for of, (text, unit) in _LIMITS.items():
        limit: StatedValue | None = getattr(approval, of)
        name, (low, high) = say(text), actual[of]
        if limit is None:
            message = say("approval.unstated", name=name)
            beyond.setdefault(Verdict.NOT_PROVEN, []).append(message)
            continue
        most = limit.value * (1.0 + _ROUNDING)
        met = judge(low, high, least=0.0, most=most)
        key = "approval.beyond" if low == high else "approval.may_be_beyond"
        if met is Verdict.PASS:
            key = "approval.within"
        message = say(key, name=name, low=low, high=high, limit=limit.value, unit=unit)
        beyond.setdefault(met, []).append(message)
    met = next(verdict for verdict in SEVERITY if verdict in beyond)
    by_verdict = {Verdict.PASS: "approval.inside", Verdict.FAIL: "approval.outside"}
    finding = say(
        by_verdict.get(met, "approval.open"),
        values=tuple(beyond[met]),
        document=approval.document,
    )
    return compare(MODE, met, finding)
