"""Alters stored studies value by value, as a slip or a hand would."""

from netdesign.calculation.quantity import Kind
from netdesign.outcome import Outcome, Verdict

OBJECTS = (
    "action",
    "case",
    "declared",
    "drawing",
    "guideline",
    "floor",
    "envelope",
    "confirmation",
    "note",
    "reason",
    "model",
    "resistance_derivation",
    "derivation",
    "sideways",
    "load",
    "held_sideways",
    "panel",
    "tests",
)
WORDS = ([*Verdict], [*Outcome], [*Kind])


def list_leaves(part, path=()):
    """Path of every value of a JSON document that is no list and no object.

    The key of a message is none: another one is refused.
    """
    if not isinstance(part, dict | list):
        return [] if part is None and path[-1] in OBJECTS else [path]
    members = part.items() if isinstance(part, dict) else enumerate(part)
    if isinstance(part, dict) and set(part) == {"key", "arguments"}:
        members = [("arguments", part["arguments"])]  # another key has no text
    return [leaf for key, one in members for leaf in list_leaves(one, (*path, key))]


def alter_leaf(document, path, draw):
    """Put another value of the same kind in the place of one; how far it moved."""
    *parents, key = path
    for parent in parents:
        document = document[parent]
    before = document[key]
    document[key] = after = _alter(before, str(key), draw)
    is_number = isinstance(before, float) and isinstance(after, float)
    return abs(after - before) if is_number else float("inf")


# Another value of a field that takes only a few.
_OTHERS = {
    "sense": {"at least": "has", "has": "at least"},
    "position": {"intermediate": "edge", "edge": "intermediate"},
    "anchor": {
        "foot_anchor": "downhill_anchor",
        "uphill_anchor": "foot_anchor",
        "downhill_anchor": "foot_anchor",
    },
}


def _alter(value, key, draw):
    if isinstance(value, bool):
        return not value
    if value is None:
        if key.endswith(("count", "years")):
            return draw.randint(1, 9)
        return "x" if key.endswith(("reason", "text")) else draw.uniform(0.1, 9.0)
    if isinstance(value, int):
        return value + draw.randint(1, 5)
    if isinstance(value, float):
        return value * draw.uniform(0.3, 0.97) if value else draw.uniform(0.01, 3.0)
    if value in _OTHERS.get(key, ()):
        return _OTHERS[key][value]
    if key == "started":
        return value.replace("20", "19", 1)
    for words in WORDS:
        if value in words and key in ("verdict", "outcome", "kind"):
            return draw.choice([word for word in words if word != value])
    return value + "x"
