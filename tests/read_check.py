"""Parts of a check's calculation as its record has them."""

import math

from netdesign.checks import rate_member


def check_member(*args, **kwargs):
    """Check of one member in one mode, as ``rate_member`` rates it."""
    return rate_member(*args, **kwargs).write()


def compare_support(check) -> float:
    """Force on the support over that of the section inside the row [-]."""
    known = {symbol: check.read(symbol) for symbol in ("b", "b_e", "k_q", "f_R")}
    is_end = known["b_e"] is not None
    if not is_end and known["f_R"] is not None:  # of the mesh, which has all of it
        return 1.0 + known["f_R"]
    return (known["b_e"] / known["b"] if is_end else 1.0) * (known["k_q"] or 1.0)


def bring(check, force: float, mark: str = "") -> float:
    """Force of the section on the member and its support [kN].

    With the mark "_g" that of the guideline, which has a load along the row of its own.
    """
    share, added = check.read("g"), check.read(f"A{mark}") or 0.0
    inside = (1.0 if share is None else share) * force + added
    if check.read(f"B{mark}") is not None:  # of two guys on one anchor
        inside = math.hypot(force, check.read(f"B{mark}"))
    return inside * compare_support(check)
