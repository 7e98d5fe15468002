"""Guess of what the net will carry: where iterations and histories begin."""

from __future__ import annotations

import numpy as np

from netdesign.snow.law import FlowLaw


def guess_pressure(law: FlowLaw, aspect: float) -> float:
    """Mean pressure on the net [rho g d]: the snow that its base does not hold."""
    reach = {
        "free": aspect,
        "no-slip": 1.0,
        "sliding": 1.0 + 2.0 * float(np.sqrt(law.slip_ratio)),
    }[law.ground]
    return max(0.05, law.gravity[0]) * min(aspect, reach)
