"""Leaves of a study by the place at which they stand, and what must never move."""

from collections import Counter

import numpy as np

DIGITS = 11
LONG = 12  # numbers of a list, beyond which their count and sums stand for them
# What follows from the program, the file and the machine, not from the site.
LEFT_OUT = ("provenance", "digest", "schema")
# What names a part of a list, so that another part may go without moving its place.
NAMES = ("id", "name", "quantity", "label", "part", "anchor", "rope", "source", "cell")


def state_places(document):
    """Numbers and words of a study's document, by their place."""
    return flatten({k: v for k, v in document.items() if k not in LEFT_OUT})


def state_verdicts(document):
    """Forces, floor, utilisations and verdicts of a study's document."""
    rows = {row["id"]: state_row(row) for row in document["rows"]}
    return flatten({"verdict": document["verdict"], "rows": rows})


def state_row(row):
    return {
        "verdict": row["verdict"],
        "checks": {check["id"]: state_check(check) for check in row["checks"]},
        "forces": {force["quantity"]: state_force(force) for force in row["forces"]},
        "floor": {
            f"{one['member']} {one['load_case']} {one['inclination_deg']:g}": {
                "force_kN": one["force_kN"]
            }
            for one in row["floor"]["forces"]
        },
    }


def state_check(check):
    kept = ("verdict", "utilisation", "demand_kN", "resistance_kN", "case")
    return {name: check[name] for name in kept}


def state_force(force):
    """Upper ends stand in the other record."""
    names = ("low_kN", "value_kN", "case")
    return {name.removesuffix("_kN"): force[name] for name in names}


def flatten(value, place=""):
    """Leaves of a document by place; words of messages are left to other tests."""
    if isinstance(value, dict):
        if value.keys() == {"key", "arguments"}:
            return {place: value["key"]}
        parts = value.items()
    elif isinstance(value, list):
        parts = name_parts(sum_up(value))
    else:
        return {place: round_off(value)}
    found = {}
    for key, part in parts:
        found |= flatten(part, f"{place}/{key}")
    return found


def name_parts(values):
    """Parts of a list by their names; messages by their keys, told how many times."""
    if not values or not all(isinstance(value, dict) for value in values):
        return enumerate(values)
    if all(value.keys() == {"key", "arguments"} for value in values):
        return Counter(value["key"] for value in values).items()
    for name in NAMES:
        names = [flatten(value.get(name)).get("") for value in values]
        if len(set(names)) == len(names) and None not in names:
            return zip(names, values, strict=True)
    return enumerate(values)


def sum_up(values):
    """List as it is; of a long one of numbers, or of points, its count and sums."""
    flat = np.ravel(values) if is_numeric(values) else values
    if len(flat) <= LONG or flat is values:
        return values
    weights = np.linspace(1.0, 2.0, len(flat))
    return [len(flat), float(np.abs(flat).sum()), float(weights @ flat)]


def is_numeric(values):
    try:
        return np.asarray(values).dtype.kind == "f"
    except ValueError:  # of unlike lengths
        return False


def round_off(value):
    return float(f"{value:.{DIGITS}g}") if isinstance(value, float) else value
