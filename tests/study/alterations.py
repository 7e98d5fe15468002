"""Alterations of a stored study, as a slip or a hand makes them.

Each takes the JSON document of a study whose checks all pass, and changes it in place.
"""

import math

from netdesign.words.message import restore

MEMBERS = ("foot_anchor", "uphill_guy", "downhill_guy", "post")
KINDS = {}


def alteration(function):
    """Register a kind of alteration under its name."""
    KINDS[function.__name__.replace("_", " ")] = function
    return function


def as_given(text):
    """Somebody's own words, as a document has them."""
    return {"key": "text.as_given", "arguments": {"text": text}}


SOLVED = ("E_s", "V_s", "E_p0", "V_p0", "T_r", "T_b", "P", "T_min")
FLOOR = ("E_g0", "V_g0")


def forces(study):
    """Checks of forces that carry something, of every row."""
    return [c for row in study["rows"] for c in row["checks"] if c["demand_kN"]]


def find_step(check, symbol):
    return next((one for one in check["steps"] if one["symbol"] == symbol), None)


def scale_steps(check, symbols, factor):
    """Scale some steps of a calculation."""
    for step in check["steps"]:
        if step["symbol"] in symbols:
            for end in ("low", "value", "high"):
                if end in step:
                    step[end] *= factor


def scale_demand(check, factor):
    """Scale the coupled part; the guideline's load stays."""
    scale_steps(check, SOLVED, factor)


def scale_forces(row, factor):
    """Scale the forces that the checks rest on."""
    for force in row["forces"]:
        scale_all(force, ("low_kN", "value_kN", "high_kN"), factor)


def scale_extremes(row, factor):
    panel = row["panel"] or {"extremes": [], "ropes": []}
    for rope in panel["ropes"]:
        scale_all(rope, ("along_kN", "tension_kN"), factor)
    bounds = row["envelope"]["bounds"]
    for extreme in (*row["extremes"], *bounds, *panel["extremes"]):
        for key in ("max_kN", "low_kN", "high_kN", "upper_bound_kN"):
            if key in extreme:
                extreme[key] *= factor
        scale_all(extreme["coincident_kN"], extreme["coincident_kN"], factor)


def scale_all(part, keys, factor):
    for key in keys:
        part[key] = part[key] and part[key] * factor


def scale_drawn(row, factor):
    for arrow in row["drawing"]["arrows"]:
        scale_all(arrow, ("force_x_kN", "force_y_kN"), factor)
    for anchor in row["anchors"]:
        keys = ("force_x_kN", "force_y_kN", "lateral_kN", "size_kN")
        scale_all(anchor, keys, factor)
    for one in row["head"]:
        scale_all(one, ("x_kN", "y_kN"), factor)


def scale_guideline(record, factor):
    scale_all(record, ("solved_foot_anchor_kN", "solved_load_kN_per_m"), factor)
    for case in record["cases"]:
        for key in ("foot_difference_percent", "load_difference_percent"):
            case[key] = 100.0 * (factor * (1.0 + case[key] / 100.0) - 1.0)
    told = record["sentence"]["arguments"]
    told["coupled"] *= factor
    sizes = sorted((told["coupled"], told["guideline"]))
    told["percent"] = 100.0 * (sizes[1] / sizes[0] - 1.0)


@alteration
def demands_halved(study):
    for check in forces(study):
        scale_demand(check, 0.5)


@alteration
def demands_and_largest_forces_halved(study):
    demands_halved(study)
    for row in study["rows"]:
        scale_forces(row, 0.5)
        scale_extremes(row, 0.5)


@alteration
def every_force_a_tenth_smaller(study):
    for check in forces(study):
        scale_demand(check, 0.9)
    for row in study["rows"]:
        scale_forces(row, 0.9)
        scale_extremes(row, 0.9)
        scale_drawn(row, 0.9)
        for case in row["cases"]:
            scale_all(case, [f"{member}_kN" for member in MEMBERS], 0.9)
        scale_guideline(row["guideline"], 0.9)
        for bound in row["envelope"]["bounds"]:
            again = bound["confirmation"]
            if again:
                scale_all(again, ("screened_kN", "confirmed_kN"), 0.9)


@alteration
def the_least_tension_of_guys_raised_above_every_state(study):
    held = study["rows"][0]["held_sideways"]
    held["least_tension_kN"] *= 1.5


@alteration
def a_row_dropped(study):
    study["rows"].pop()


@alteration
def rows_reordered(study):
    study["rows"].reverse()


@alteration
def a_row_renamed(study):
    study["rows"][0]["id"] = "R99"


@alteration
def the_governing_check_dropped(study):
    checks = study["rows"][0]["checks"]
    checks.remove(max(checks, key=lambda check: check["utilisation"] or 0.0))


@alteration
def a_check_of_geometry_dropped(study):
    study["rows"][0]["checks"].pop()


@alteration
def checks_reordered(study):
    study["rows"][0]["checks"].reverse()


@alteration
def a_check_twice(study):
    checks = study["rows"][0]["checks"]
    checks.append(dict(checks[0]))


@alteration
def a_check_between_others(study):
    checks = study["rows"][0]["checks"]
    checks[0], checks[1] = checks[1], checks[0]


def law(study, name):
    found = (one for one in study["rows"][0]["independent"] if one["name"] == name)
    return next(found)


@alteration
def a_law_above_its_limit_and_met(study):
    one = law(study, "friction_excess")
    one["value"] = one["limit"] * 3.7


@alteration
def a_law_below_its_limit_and_not_met(study):
    one = law(study, "end_direction")
    one["is_met"] = False
    name = {"key": f"law.{one['name']}", "arguments": {}}
    reason = {"key": "row.law_not_met", "arguments": {"law": name}}
    study["rows"][0]["reasons"].append(reason)
    study["verdict"] = study["rows"][0]["verdict"] = "not_proven"


@alteration
def a_limit_raised_over_a_large_value(study):
    one = law(study, "global_balance")
    one["value"], one["limit"] = 0.031, 0.05


@alteration
def a_ratio_of_tensions_raised(study):
    law(study, "capstan_ratio")["value"] *= 1.4


@alteration
def a_law_dropped(study):
    study["rows"][0]["independent"].pop(2)


@alteration
def a_resistance_doubled(study):
    scale_steps(forces(study)[0], ("R_k", "R_m", "R_min"), 2.0)


@alteration
def a_factor_of_a_resistance_lowered(study):
    scale_steps(forces(study)[1], ("γ_R",), 1 / 1.3)


@alteration
def a_formula_altered(study):
    check = forces(study)[0]
    step = find_step(check, "E_d")
    step["formula"] = f"({step['formula']}) * 0.8"


@alteration
def a_step_dropped(study):
    check = forces(study)[0]
    check["steps"].remove(find_step(check, "γ_R"))


@alteration
def a_step_alone_altered(study):
    find_step(forces(study)[0], "E_k")["value"] *= 0.93


@alteration
def a_demand_alone_altered(study):
    forces(study)[0]["demand_kN"] *= 0.93


@alteration
def a_factor_lowered_in_profile_and_checks(study):
    lower_action_factor(study)


@alteration
def a_factor_lowered_with_another_hash(study):
    lower_action_factor(study)
    study["profile"]["sha256"] = "5" * 64


def lower_action_factor(study):
    for value in study["profile"]["values"]:
        if value["id"] == "action.snow":
            value["value"] /= 1.5
    for check in (c for row in study["rows"] for c in row["checks"]):
        if check["demand_kN"]:
            scale_steps(check, ("γ_E",), 1 / 1.5)
        elif check["demand_kN"] == 0.0:
            find_step(check, "γ_E")["value"] /= 1.5


@alteration
def an_assumed_value_said_to_be_read(study):
    values = study["profile"]["values"]
    next(v for v in values if v["status"] == "assumed")["status"] = "read"


@alteration
def a_value_of_the_profile_dropped(study):
    study["profile"]["values"].pop()


@alteration
def another_edition_of_the_profile(study):
    study["profile"]["edition"] += ", second"


@alteration
def a_pass_held_back(study):
    study["verdict"] = study["rows"][0]["verdict"] = "not_proven"


@alteration
def a_check_said_to_fail(study):
    row = study["rows"][0]
    check = row["checks"][0]
    check["verdict"] = row["verdict"] = study["verdict"] = "fail"
    check["reason"] = {"key": "check.fails", "arguments": {}}
    title = {
        "key": "check.title",
        "arguments": {
            "member": {"key": f"member.{check['member']}", "arguments": {}},
            "mode": {"key": f"mode.{check['mode']}", "arguments": {}},
        },
    }
    arguments = {"check": title, "reason": check["reason"]}
    row["reasons"].append({"key": "row.check_reason", "arguments": arguments})


@alteration
def a_case_dropped(study):
    row = study["rows"][0]
    row["cases"].pop(3)
    row["envelope"]["cases"] -= 1


@alteration
def a_case_added(study):
    row = study["rows"][0]
    case = dict(row["cases"][3])
    case["case"] = dict(case["case"], friction_deg=15.671)
    row["cases"].append(case)
    row["envelope"]["cases"] += 1


@alteration
def the_case_of_the_largest_foot_force_dropped(study):
    row = study["rows"][0]
    row["cases"].remove(max(row["cases"], key=lambda case: case["foot_anchor_kN"]))
    row["envelope"]["cases"] -= 1


@alteration
def a_force_of_one_case_lowered(study):
    study["rows"][0]["cases"][5]["post_kN"] *= 0.93


@alteration
def an_error_of_a_case_lowered(study):
    study["rows"][0]["cases"][5]["error_percent"] *= 0.2


@alteration
def a_case_without_balance(study):
    study["rows"][0]["cases"][5]["balance_residual"] = 3e-4


@alteration
def a_case_without_a_result(study):
    row = study["rows"][0]
    case = min(row["cases"], key=lambda case: case["foot_anchor_kN"])
    case.update({f"{member}_kN": None for member in MEMBERS})
    case.update(outcome="diverged", reason=as_given("lost"), error_percent=None)
    row["envelope"]["failed"] += 1


@alteration
def a_case_moved_out_of_the_ranges(study):
    study["rows"][0]["cases"][2]["case"]["density_kg_m3"] = 133.7


@alteration
def a_density_said_to_be_in_the_law_s_range(study):
    for case in study["rows"][0]["cases"]:
        case["is_calibrated"] = True


@alteration
def an_upper_bound_lowered(study):
    row = study["rows"][0]
    hidden = [one["upper_bound_kN"] - one["max_kN"] for one in row["extremes"]]
    place = hidden.index(max(hidden))
    assert hidden[place] > 0.0
    for one in (row["extremes"][place], row["envelope"]["bounds"][place]):
        one["upper_bound_kN"] = one["max_kN"]


@alteration
def the_high_end_of_a_band_lowered(study):
    row = study["rows"][0]
    extreme = row["extremes"][0]
    extreme["high_kN"] = extreme["upper_bound_kN"]
    row["forces"][0]["high_kN"] = extreme["high_kN"]
    for check in row["checks"][:2]:
        find_step(check, "E_s")["high"] = extreme["high_kN"]


@alteration
def a_lifted_post_without_a_check_of_its_foot(study):
    force = next(f for f in study["rows"][0]["forces"] if f["quantity"] == "post_foot")
    force["high_kN"] = 5.0


@alteration
def a_largest_force_at_another_case(study):
    row = study["rows"][0]
    row["extremes"][0]["case"] = dict(row["cases"][1]["case"])


@alteration
def forces_beside_the_largest_lowered(study):
    beside = study["rows"][0]["extremes"][0]["coincident_kN"]
    scale_all(beside, beside, 0.8)


@alteration
def a_range_narrowed(study):
    for echo in study["range_inputs"]:
        if str(restore(echo["label"])) == "density, low":
            echo["value"], echo["text"] = 255.0, "255"
    for row in study["rows"]:
        row["envelope"]["axes"][0]["low"] = 255.0


@alteration
def an_input_altered(study):
    row = study["rows"][0]
    for echo in row["inputs"]:
        if str(restore(echo["label"])) == "slope angle":
            echo["value"], echo["text"] = 33.5, "33.5"
    row["drawing"]["slope_deg"] = 33.5


@alteration
def the_cell_of_an_input_altered(study):
    study["rows"][0]["inputs"][1]["cell"] = "Nets!Z9"


@alteration
def arrows_shrunk(study):
    for arrow in study["rows"][0]["drawing"]["arrows"]:
        scale_all(arrow, ("force_x_kN", "force_y_kN"), 0.6)


@alteration
def forces_on_the_ground_shrunk(study):
    scale_drawn(study["rows"][0], 0.6)


@alteration
def a_force_turned(study):
    row = study["rows"][0]
    for one in (row["anchors"][0], row["drawing"]["arrows"][0]):
        x, y = one["force_x_kN"], one["force_y_kN"]
        one["force_x_kN"], one["force_y_kN"] = y, x
    row["anchors"][0]["direction_deg"] = math.degrees(math.atan2(x, y))


@alteration
def the_post_head_left_open(study):
    study["rows"][0]["head"][0]["x_kN"] *= 1.7


@alteration
def no_load_along_the_row(study):
    for anchor in study["rows"][0]["anchors"]:
        anchor["lateral_kN"] = 0.0


@alteration
def an_anchor_moved(study):
    row = study["rows"][0]
    row["drawing"]["uphill_anchor_m"][0] -= 1.3
    row["drawing"]["arrows"][1]["x_m"] -= 1.3


@alteration
def the_net_drawn_straighter(study):
    for point in study["rows"][0]["drawing"]["net_m"][1:-1]:
        point[0] *= 0.9


@alteration
def sticking_points_drawn_as_sliding(study):
    sticks = study["rows"][0]["drawing"]["sticks"]
    sticks[:] = [not stick for stick in sticks]


@alteration
def the_guideline_s_forces_raised(study):
    case = study["rows"][0]["guideline"]["cases"][0]
    scale_all(case, ("load_kN_per_m", "foot_anchor_kN"), 1.5)


@alteration
def the_model_form_narrowed(study):
    record = study["rows"][0]["model_form"]
    record["low_ratio"] = 0.999 * record["high_ratio"]


@alteration
def a_difference_from_the_guideline_altered(study):
    case = study["rows"][0]["guideline"]["cases"][0]
    case["foot_difference_percent"] = 0.7


@alteration
def notes_cleared(study):
    study["notes"] = []


@alteration
def a_note_of_a_row_altered(study):
    study["rows"][0]["notes"] = [as_given("the base plate was proven by hand")]


@alteration
def another_author(study):
    study["project"]["author"] = "B. Forger"


@alteration
def a_checker_added(study):
    study["project"]["checker"] = "C. Nobody"


@alteration
def started_in_the_future(study):
    study["provenance"]["started"] = "9999-01-02T03:04:05+00:00"


@alteration
def started_without_a_digest(study):
    study["provenance"]["started"] = "2019-01-02T03:04:05+00:00"
    study["digest"] = ""


@alteration
def other_libraries(study):
    study["provenance"]["libraries"]["numpy"] = "1.0.1"


@alteration
def another_version_of_the_program(study):
    study["provenance"]["version"] = "9.9"


@alteration
def another_hash_of_the_site(study):
    study["provenance"]["site_sha256"] = "a" * 64


@alteration
def another_name_of_the_site(study):
    study["provenance"]["site_file"] = "sight.xlsx"


@alteration
def looser_tolerances_hidden(study):
    study["provenance"]["settings"]["balance_tolerance"] = "1e-12"


@alteration
def another_method(study):
    settings = study["provenance"]["settings"]
    settings["method"] = "transient from a sagged net"


@alteration
def a_tighter_gap_asked_for(study):
    for row in study["rows"]:
        row["envelope"]["gap_asked_percent"] = 0.01


@alteration
def a_search_said_to_be_open(study):
    study["rows"][0]["envelope"]["is_closed"] = False


@alteration
def a_confirmation_moved_to_its_case(study):
    again = study["rows"][0]["envelope"]["bounds"][0]["confirmation"]
    again["confirmed_kN"], again["difference_percent"] = again["screened_kN"], 0.0


@alteration
def a_confirmation_dropped(study):
    study["rows"][0]["envelope"]["bounds"][0]["confirmation"] = None


@alteration
def drivers_altered(study):
    find_drawn(study)["drivers"][0]["total"] = 0.11


def find_drawn(study):
    """Bound of the member that is drawn in the first row."""
    return next(one for one in study["rows"][0]["envelope"]["bounds"] if one["lines"])


@alteration
def a_line_flattened(study):
    (line, *_) = find_drawn(study)["lines"]
    line["force_kN"] = [line["force_kN"][0]] * len(line["force_kN"])


@alteration
def a_map_lowered(study):
    (drawn, *_) = find_drawn(study)["maps"]
    drawn["force_kN"] = [[0.5 * one for one in line] for line in drawn["force_kN"]]


@alteration
def the_case_of_an_unchecked_force_moved(study):
    force = next(x for x in study["rows"][0]["forces"] if x["quantity"] == "post_foot")
    force["case"]["density_kg_m3"] *= 0.73


@alteration
def parts_of_the_interval_dropped(study):
    for check in study["rows"][0]["checks"]:
        check["spreads"] = []


@alteration
def a_loaded_width_narrowed(study):
    for check in forces(study):
        scale_steps(check, ("f_R", "Δl"), 0.7)


@alteration
def a_share_along_the_row_left_out(study):
    for check in forces(study):
        scale_steps(check, ("k",), 0.0)


@alteration
def an_interval_narrowed(study):
    for check in forces(study):
        for spread in check["spreads"]:
            spread["low"] = spread["high"] = check["utilisation"]


@alteration
def another_creep_law_brought_near(study):
    for one in study["rows"][0]["model_form"]["variants"]:
        one["ratio"] = 1.0


@alteration
def a_change_that_flips_a_check_added(study):
    forces(study)[0]["changes"].append({
        "quantity": {"key": "change.post_spacing", "arguments": {}},
        "unit": "m", "now": 3.5, "bound": 9.0,
        "sense": "at most", "note": None,
    })  # fmt: skip


@alteration
def another_type_of_anchor(study):
    forces(study)[0]["resistance_type"] = "A40-tested"


@alteration
def a_computed_resistance_said_to_be_tested(study):
    check = forces(study)[0]
    check["resistance_basis"] = "tested"


@alteration
def another_clause(study):
    forces(study)[0]["clause"] = "6.2 (3)"


@alteration
def another_reason(study):
    forces(study)[0]["reason"] = as_given("The demand stays within by far.")


@alteration
def a_measurement_added(study):
    study["rows"][0]["monitoring"] = [{
        "member": "foot_anchor", "source": "Monitoring!A2", "times_d": [0.0],
        "tensions_kN": [3.0], "air_temperatures_C": [None], "model": as_given("none"),
    }]  # fmt: skip


@alteration
def a_layer_of_the_drawing_thinner(study):
    study["rows"][0]["drawing"]["snow_thickness_m"] *= 0.8


def loaded_by_floor(study):
    """A check whose demand is the guideline's, of any row."""
    return next(c for c in forces(study) if c["governs"] == "guideline")


@alteration
def the_floor_dropped_from_a_row(study):
    study["rows"][0]["floor"] = None


@alteration
def the_floor_dropped_from_the_profile_too(study):
    study["profile"]["floor"] = "none"
    for row in study["rows"]:
        row["floor"] = None


@alteration
def a_force_of_the_floor_lowered(study):
    force = study["rows"][0]["floor"]["forces"][0]
    force["force_kN"] *= 0.83


@alteration
def a_force_of_the_floor_lowered_wherever_it_stands(study):
    row = study["rows"][0]
    for force in row["floor"]["forces"]:
        force["force_kN"] *= 0.5
    for check in row["checks"]:
        if check["demand_kN"]:
            scale_steps(check, FLOOR, 0.5)


@alteration
def a_member_of_the_floor_dropped(study):
    study["rows"][0]["floor"]["forces"].pop(2)


@alteration
def a_floor_said_to_be_unknown(study):
    study["rows"][0]["floor"]["reason"] = as_given("not known")


@alteration
def a_load_of_the_floor_altered(study):
    study["rows"][0]["floor"]["forces"][1]["load_along_kN_per_m"] *= 0.91


@alteration
def a_check_without_its_floor(study):
    check = forces(study)[0]
    for symbol in ("E_g0", "E_g"):
        check["steps"].remove(find_step(check, symbol))
    find_step(check, "E_k")["formula"] = "E_c"
    check.update(load_case="", load_inclination_deg=None, governs="coupled")


@alteration
def the_other_load_said_to_govern(study):
    check = forces(study)[0]
    other = {"coupled": "guideline", "guideline": "coupled"}
    check["governs"] = other[check["governs"]]


@alteration
def a_force_of_a_check_lowered(study):
    scale_steps(forces(study)[1], ("E_s",), 0.71)


@alteration
def the_checks_of_the_end_dropped(study):
    for row in study["rows"]:
        row["checks"] = [one for one in row["checks"] if one["position"] != "edge"]


@alteration
def an_end_loaded_like_a_support_inside(study):
    row = study["rows"][0]
    inside = {c["id"]: c for c in row["checks"]}
    for check in row["checks"]:
        name = check["id"].removesuffix(".end")
        if check["position"] == "edge" and name in inside:
            like = inside[name]
            kept = {key: check[key] for key in ("id", "position", "reason")}
            check.update({**like, **kept})


def call_declared(study):
    """A check, its row and the study take the verdict of a declaration."""
    row = study["rows"][0]
    for part in (row["checks"][0], row, study):
        part["verdict"] = "declared"
    return row["checks"][0]


@alteration
def a_check_declared_by_nobody(study):
    call_declared(study)


@alteration
def a_declaration_forged(study):
    check = call_declared(study)
    check["declared"] = {
        "document": "Report 4", "author": "N. N.", "date": "", "cell": "Declared!B2"
    }  # fmt: skip
    proof = {"document": "Report 4", "author": "N. N.", "cell": "Declared!B2"}
    check["reason"] = {"key": "check.declared", "arguments": {
        "proof": {"key": "check.proof_undated", "arguments": proof},
        "reason": check["reason"],
    }}  # fmt: skip


@alteration
def another_creep_law_accepted(study):
    study["project"]["accepted_law"] = "boutillier-2004"


@alteration
def light_snow_called_that_of_the_law(study):
    for case in study["rows"][0]["cases"]:
        case["is_calibrated"] = True
