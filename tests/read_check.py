"""Parts of a check's calculation as its record has them, and spoilt ones."""

import math
from dataclasses import replace


def compare_support(check) -> float:
    """Force on the support over that of the section inside the row [-]."""
    known = {symbol: check.read(symbol) for symbol in ("b", "b_e", "k_q", "f_R")}
    is_end = known["b_e"] is not None
    if not is_end and known["f_R"] is not None:  # of the mesh, which has all of it
        return 1.0 + known["f_R"]
    return (known["b_e"] / known["b"] if is_end else 1.0) * (known["k_q"] or 1.0)


def bring(check, force: float) -> float:
    """Force of the section on the member and its support [kN]."""
    share, added = check.read("g"), check.read("A") or 0.0
    inside = (1.0 if share is None else share) * force + added
    if check.read("B") is not None:  # of two guys on one anchor
        inside = math.hypot(force, check.read("B"))
    return inside * compare_support(check)


def scale_step(study, check_id, symbol, share, ends=("value", "low", "high")):
    """Study whose step of one check is changed, in its value and its ends."""
    row = study.rows[0]
    (check,) = (one for one in row.checks if one.id == check_id)
    old = check.known[symbol]
    known = zip(("low", "value", "high"), old.ends, strict=True)
    new = replace(old, **{end: share * force for end, force in known if end in ends})
    steps = [new if one is old else one for one in check.steps]
    checks = [replace(one, steps=steps) if one is check else one for one in row.checks]
    return replace(study, rows=[replace(row, checks=checks)])


def scale_force(study, quantity, share, ends=("value_kN", "low_kN", "high_kN")):
    """Study one of whose largest solved forces is changed."""
    row = study.rows[0]
    (old,) = (one for one in row.forces if one.quantity == quantity)
    new = replace(old, **{end: share * getattr(old, end) for end in ends})
    forces = [new if one is old else one for one in row.forces]
    return replace(study, rows=[replace(row, forces=forces)])
