"""Checks of a study told in the fields of schema netdesign.study/2.

The stored numbers were made by a program that kept a check's load in fields of its own.
They follow from the steps of today, so that the old numbers still prove the new ones.
"""

ROPES = ("lateral_anchor", "end_guy", "end_guy_anchor")
# Fields that nothing rests on any more, or that a calculation may do without.
DROPPED = ("action/foot_part_kN", "action/guy_part_kN", "action/other_width_m")
OPTIONAL = ("post_spacing_m", "loaded_width_m", "end_length_m")
# The calculation itself shows these ways to a resistance.
SHOWN = ("check.from_tests", "derivation.sliding")
NOTHING = (None, None, None)
MISSING = "(no such field)"


def state_document(document):
    """Document of a study whose rows have the fields of then."""
    for row in document["rows"]:
        row.pop("forces", None)
        row.pop("tilt", None)
        row["checks"] = [state_check(check) for check in row["checks"]]
    return document


def state_check(check):
    """Record of a check with its load in ``action``."""
    steps = {step["symbol"]: step for step in check["steps"]}
    gone = ("steps", "governs", "load_case", "load_inclination_deg")
    stated = {name: value for name, value in check.items() if name not in gone}
    low, _, high = read_ends(steps, "E_d")
    return stated | {
        "demand_low_kN": low,
        "demand_high_kN": high,
        "action_kN": read(steps, "E_k"),
        "action_factor": read(steps, "γ_E"),
        "resistance_characteristic_kN": read(steps, "R_k"),
        "resistance_factor": read(steps, "γ_R"),
        "action": state_action(check, steps) if check["governs"] and steps else None,
    }


def state_action(check, steps):
    if check["member"] in ROPES:
        return state_pull_of_rope(steps)
    letter = "V" if "V_k" in steps else "E"
    tilt = read(steps, "t") if letter == "V" else 1.0
    by_section = f"{letter}_c" if f"{letter}_c" in steps else f"{letter}_k"
    spacing = read(steps, "b")
    return {
        **name_ends(read_ends(steps, f"{letter}_s"), "solved_kN"),
        "position": check["position"],
        "post_spacing_m": spacing,
        "loaded_width_m": (
            read(steps, "b_e") if check["position"] == "edge" else spacing
        ),
        "end_factor": read(steps, "f_R") or 0.0,
        "end_length_m": read(steps, "Δl") or 0.0,
        "lateral_factor": read(steps, "k_q") or 1.0,
        "coupled_kN": read_ends(steps, by_section)[2] * tilt,
        "floor_kN": read(steps, f"{letter}_g0"),
        "guideline_kN": times(read(steps, f"{letter}_g"), tilt),
        "floor_case": check["load_case"],
        "floor_inclination_deg": check["load_inclination_deg"],
        "governs": check["governs"],
        "share": (read(steps, "g") or 1.0) * tilt,
        **name_ends(or_zero(read_ends(steps, "A"), tilt), "added_kN"),
        "panel_kN": read(steps, f"{letter}_p0"),
        "panel_low_kN": read_ends(steps, f"{letter}_p0")[0],
        "panel_support_kN": times(read_ends(steps, f"{letter}_p")[2], tilt),
        **name_ends(or_zero(read_ends(steps, "Z"), tilt), "along_kN"),
        "sideways": state_sideways(steps, tilt) if "A" in steps else None,
    }


def state_sideways(steps, tilt):
    part = read(steps, "c") if "c" in steps else read(steps, "w") * tilt
    return {
        "part": part,
        "share": read(steps, "k"),
        "pull_kN": read(steps, "P"),
        "splay_deg": read(steps, "β"),
        "least_tension_kN": read(steps, "T_min"),
    }


def state_pull_of_rope(steps):
    """Load of a member that holds a border rope at the row's end."""
    spacing, rope, pull = (read(steps, symbol) for symbol in ("b", "T_r", "H"))
    return {
        **name_ends((None, rope, None), "solved_kN"),
        "panel_kN": None,
        "panel_low_kN": None,
        **name_ends((0.0, 0.0, 0.0), "added_kN"),
        **name_ends((0.0, 0.0, 0.0), "along_kN"),
        "position": "edge",
        "post_spacing_m": spacing,
        "loaded_width_m": pull / rope * spacing if rope and spacing else None,
        "end_factor": read(steps, "f_R"),
        "end_length_m": read(steps, "Δl"),
        "lateral_factor": 1.0,
        "coupled_kN": read_ends(steps, "E_k")[2],
        "share": read(steps, "E_k") / pull if rope else None,
        "governs": "panel",
        "floor_kN": None,
        "guideline_kN": None,
        "floor_case": "",
        "floor_inclination_deg": None,
        "panel_support_kN": None,
        "sideways": None,
    }


def read_ends(steps, symbol):
    """Low end, value and high end of a step."""
    step = steps.get(symbol)
    if step is None or step.get("value") is None:
        return NOTHING
    value = step["value"]
    return step.get("low", value), value, step.get("high", value)


def read(steps, symbol):
    return read_ends(steps, symbol)[1]


def name_ends(ends, name):
    what, unit = name.rsplit("_", 1)
    names = (f"{what}_low_{unit}", name, f"{what}_high_{unit}")
    return dict(zip(names, ends, strict=True))


def or_zero(ends, factor):
    return tuple(0.0 if end is None else end * factor for end in ends)


def times(value, factor):
    return None if value is None else value * factor


def may_differ(key, then, now):
    """A field of then without which the steps of today do."""
    if key.endswith(DROPPED) or then in SHOWN:
        return True
    return now in (None, MISSING) and key.endswith(OPTIONAL)
