"""The paper's statements, and what the runs say of them, in sentences."""

from __future__ import annotations

import re
from dataclasses import dataclass

from netdesign.evidence.paper.findings import Finding

_AGREES = {"agrees": "✓", "does not agree": "✗", "not decided": "?"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Claim:
    """One statement with its call, the numbers and the reason."""

    said: str
    call: str
    symbol: str
    differs: bool
    found: str
    reason: str


@dataclass(frozen=True, slots=True, kw_only=True)
class _Wording:
    said: str
    found: str
    reason: str


_WORDINGS = {
    "growth": _Wording(
        said="The forces at each node increase with increase of the friction.",
        found=(
            "Net normal to the slope, 15° to 45°, implicit history: of {forces:.0f} "
            "forces {growing:.0f} grow by more than 1%, {level:.0f} stay level, "
            "{falling:.0f} fall; foot {foot:+.1%}, head {head:+.1%}. In the staggered "
            "exchange {exchange_growing:.0f} of {exchange_forces:.0f} grow."
        ),
        reason=(
            "With the net normal to the slope the shear on it stays small beside the "
            "pressure: the snow sticks at 15° already, and more friction changes "
            "nothing. At 30° inclination snow slips at 15°, and the table of forces "
            "shows which grow there. Balance along the slope fixes the sum of all "
            "forces, whatever the friction."
        ),
    ),
    "oscillation": _Wording(
        said="After a transient phase, with oscillations, a plateau is reached.",
        found=(
            "Staggered exchange: the foot's pull turns back {exchange_swings:.0f} "
            "times by more than 1% and is smooth after {swings_until:.0f} s; plateau "
            "from {exchange_plateau:.0f} s. Implicit history of the same snow: "
            "{history_swings:.0f} such turns after the first {settled:.1f} s, plateau "
            "from {history_plateau:.0f} s."
        ),
        reason=(
            "The oscillation belongs to the exchange, as the paper says too: with the "
            "base drag (and the step in proportion) reduced from {largest_drag:g} to "
            "{smallest_drag:g} it ends after {swings_last:.0f} s instead of "
            "{swings_first:.0f} s, and the implicit history has none."
        ),
    ),
    "settlement": _Wording(
        said="The settlement normal to the slope has no significant effect.",
        found=(
            "Gravity along the slope only, against full gravity, on the plateau: "
            "history foot {history_foot_0:+.1%}, head {history_head_0:+.1%}; steady "
            "state foot {steady_foot_0:+.1%}, head {steady_head_0:+.1%}."
        ),
        reason=(
            "Little is below {little:.0%} for the paper's net, normal to the slope. At "
            "30° inclination a wedge of snow rests on the net: "
            "history foot {history_foot_30:+.1%}, head {history_head_30:+.1%}; steady "
            "state foot {steady_foot_30:+.1%}, head {steady_head_30:+.1%}. Later the "
            "two drift apart: foot {late_foot_0:+.1%} normal to the slope at the end "
            "of the histories."
        ),
    ),
    "density": _Wording(
        said="Densification takes place softly during the calculations (8 seconds).",
        found=(
            "After 8 s the mean density has risen by {rise:.2%} from {first:.0f} "
            "kg/m³; after {days:.0f} days it is {late:.0f} kg/m³."
        ),
        reason=(
            "8 s are nothing to snow of this fluidity. At the net's ends, where "
            "stresses have no bound, a triangle may be at {largest_early:.0f} kg/m³ "
            "by then."
        ),
    ),
    "densification": _Wording(
        said="The densification of the snowpack has no effect in the interaction.",
        found=(
            "Foot's pull with densification against without: {straight:+.1%} from a "
            "straight net (at its plateau, {straight_time:.0f} s), {sagged:+.1%} from "
            "a sagged one (at {sagged_time:.0f} s)."
        ),
        reason=(
            "A straight net must be pushed to its sag: the snow beside its ends is "
            "sheared and densified on the way and stays stiffer. Snow that lies "
            "against a sagged net from the start has no such past."
        ),
    ),
    "swelling": _Wording(
        said="The downstream part of the mesh blows up with increase of the friction.",
        found=(
            "Sag of the net at the end, 15° to 45°: {low_0:.3f} to {high_0:.3f} m "
            "({change_0:+.1%}) normal to the slope; {low_30:.3f} to {high_30:.3f} m "
            "({change_30:+.1%}) at 30° inclination."
        ),
        reason="A net that the snow sticks to takes the same shape at any friction.",
    ),
    "seconds": _Wording(
        said="The asymptotic state is reached within the 8 seconds computed.",
        found=(
            "At 8 s the foot carries {share:.0%} of its plateau, which begins at "
            "{plateau:.0f} s: {ratio:.0f} times as long."
        ),
        reason=(
            "Time enters only as fluidity times time. With 20 MPa⁻³ a⁻¹ eight seconds "
            "do not suffice: the paper's unit of time or of fluidity is another, or "
            "its net was stiffer than assumed here."
        ),
    ),
}


def word_finding(finding: Finding) -> Claim:
    """Sentences of a finding with its numbers put in."""
    wording = _WORDINGS[finding.key]
    if finding.call == "not decided":
        found, reason = "A run that it needs gave no result: see the runs below.", ""
    else:
        found = wording.found.format(**finding.numbers)
        reason = wording.reason.format(**finding.numbers)
    return Claim(
        said=wording.said,
        call=finding.call,
        symbol=_AGREES[finding.call],
        differs=finding.call != "agrees",
        found=_write_minus(found),
        reason=_write_minus(reason),
    )


def _write_minus(text: str) -> str:
    """Proper minus signs before digits; none before a rounded zero."""
    return re.sub(r"-(?=\d)", "−", re.sub(r"[+-](?=0\.0%)", "", text))
