"""Checks of a row by the names that study.json has: demand, resistance, factors."""

import math
from dataclasses import dataclass

import numpy as np

from tests.verification.second_reader import guideline, resistance, statics
from tests.verification.second_reader.row import Redone, Row

SUFFIX = {"intermediate": "", "second": ".second", "edge": ".end"}
ROCKS = {"slate", "limestone", "sandstone", "granite", "gneiss", "rock"}
TUBE_STRENGTH = 235.0  # MPa: S235
ROPE_ENDS = {"included": 1.0, "spelter": 1.0, "swaged": 0.9, "ferrule": 0.9,
             "clips": 0.8, "splice": 0.86, "wedge": 0.75}  # fmt: skip
LOOP, USUAL_LINK = 0.8, 0.5  # of a rope anchor; of steel whose links nobody lists
END_ANCHORS = ("lateral_anchor", "end_guy_anchor")
CONES = {"lateral_anchor.wedge.end", "end_guy_anchor.wedge.end"}
NEAR, NEAR_CONE = 1e-9, 1e-6  # the program's cone is the least of a grid of ways
LEAST_DIP = math.radians(15.0)  # of a bore that nobody gives


def redo_checks(row: Row):
    """Every check of a force, by its id."""
    redone = {}
    for position, suffix in SUFFIX.items():
        if position not in row.widths:  # no second support
            continue
        for name, check in redo_support(row, position):
            redone[name + suffix] = check
    for name, check in redo_end(row):
        redone[f"{name}.end"] = check
    return redone


def redo_support(row, position):
    """Anchors, guys, post and base of one support."""
    loads = {
        "foot_anchor": row.load_foot(position),
        "uphill_anchor": row.load_anchor("uphill", position),
        "downhill_anchor": row.load_anchor("downhill", position),
    }
    for member, load in loads.items():
        name = row.find_type(member, position)
        yield from redo_anchor(row, member, name, load, position)
    for side in ("uphill", "downhill"):
        member = f"{side}_guy"
        angle = find_pulls(row, f"{side}_anchor", position).beside
        load = row.load_guy(side, position)
        name = row.find_type(member, position)
        yield from redo_rope(row, member, name, load, angle)
    yield from redo_post(row, position)


def redo_end(row):
    """Ropes and what holds them along the row."""
    end, net = row.end, row.net
    yield "mesh.mesh", rate(row, row.load_mesh(), net["mesh_strength"], "mesh")
    for rope, name in (("upper", "ridge_rope"), ("lower", "lower_rope")):
        yield from redo_rope(row, name, net[name], row.find_tension(rope), None)
    lateral = row.find_along("lower")
    yield from redo_anchor(row, "lateral_anchor", end["lateral_anchor"], lateral)
    along, angle = row.end_guy
    pull = along / math.cos(angle)
    beside = find_pulls(row, "end_guy_anchor").beside
    yield from redo_rope(row, "end_guy", end["end_guy"], pull, beside)
    yield from redo_anchor(row, "end_guy_anchor", end["end_guy_anchor"], pull)


def rate(row, demand, holds, key):
    return Redone(
        demand, holds, row.values["action.snow"], row.values[f"resistance.{key}"]
    )


def redo_anchor(row, member, name, load, position="edge"):
    cells = row.cells.find("Anchors", "id", name)
    angle = find_pulls(row, member, position).beside
    is_bar = cells["kind"] != "rope anchor"
    steel = "tendon" if is_bar else "rope"
    yield f"{member}.tendon", rate(row, load, find_tendon(row, cells), steel)
    basis = "computed" if cells["basis"] == "computed" else "tested"
    yield (
        f"{member}.pull_out",
        rate(row, load, find_pull_out(row, cells), f"pull_out.{basis}"),
    )
    whole = cells["tendon"] * (1.0 if is_bar else LOOP)
    chain = find_chain(row, name, angle, whole)
    yield f"{member}.connection", rate(row, load, chain, "connection")
    across = cells.get("head_across", math.nan) / max(math.sin(angle), 1e-9)
    head = rate(row, load, across, "direction")
    is_held = "head_across" in cells and head.used[1] <= 1.0
    if is_bar:  # a block that does not hold is none: the bar bends in the ground
        bent = bend_anchor(row, cells, angle, is_held=is_held)
        yield f"{member}.bending", rate(row, load, bent, "bending")
    turns = math.radians(row.values["anchor.angle.rope"])
    if is_held if is_bar else angle > turns:
        yield f"{member}.direction", head
    if "soil_weight" in cells:
        lifted = lift_ground(row, member, cells)
        yield f"{member}.wedge", rate(row, load, lifted, "wedge")


def find_loss(row, cells):
    """Loss of an exposed face over the design life [m]."""
    if cells.get("protection") != "sacrificial":
        return 0.0
    return resistance.lose(cells["soil"], row.net["design_life"])


def find_bar(row, cells):
    """Bar less its loss, as N, M, V."""
    outer = cells["bar_diameter"] / 1e3 - 2.0 * find_loss(row, cells)
    return resistance.compute_bar(outer, cells["bar_strength"] * 1e3)


def find_tendon(row, cells):
    if cells["kind"] == "rope anchor":
        return cells["tendon"] * LOOP
    return find_bar(row, cells)[0]


def find_pull_out(row, cells):
    """Of tests the least and the mean by their number; others as typed (R1)."""
    if cells["basis"] != "tested":
        return cells["pull_out"]
    count = cells.get("test_count", 1)
    least = cells.get("test_least", cells.get("pull_out"))
    tested = {"mean": cells.get("test_mean", least), "least": least}
    return min(
        force / next(one["value"] for one in row.tables[table] if one["to"] >= count)
        for kind, force in tested.items()
        for table in [f"correlation.tests.{kind}"]
    )


def bend_anchor(row, cells, angle, *, is_held):
    """A bar, or the tube at its head, pulled beside its axis (A7)."""
    loss = find_loss(row, cells)
    wall = cells.get("tube_wall")
    if wall is None:
        outer, inner, strength = cells["bar_diameter"] / 1e3, 0.0, cells["bar_strength"]
    else:
        outer, strength = cells["tube_diameter"] / 1e3, TUBE_STRENGTH
        inner = outer - 2.0 * wall / 1e3
    if is_held:  # fixed in a block, which holds what is across
        soft = 0.0
    else:
        many = 1.0 if cells.get("ground") in ROCKS else 3.0
        soft = many * outer * (1.0 - (inner / outer) ** 4) ** 0.25
    bar = resistance.compute_bar(outer - 2.0 * loss, strength * 1e3, inner)
    return resistance.bend_bar(bar, angle, cells["lever_arm"] / 1e3 + soft)


def lift_ground(row, member, cells):
    """Wedge before the bond, of no bond and of one along the whole bore."""
    values, pull = row.values, find_pulls(row, member)
    friction = math.tan(math.radians(cells["soil_friction"]))
    soil = (
        cells["soil_cohesion"] / values["soil.cohesion"],
        math.atan(friction / values["soil.friction"]),
        cells["soil_weight"],
    )
    slope = row.angle("slope_angle") * (-1.0 if member == "downhill_anchor" else 1.0)
    drained = cells.get("soil_water") == "drained"
    pulls = pull.least, pull.largest
    depths = [
        cells["drilled_length"] * math.sin(pull.axis) * part for part in (0.5, 1.0)
    ]
    if resistance.hold_slab(soil, depths[1], abs(slope), drained=drained) < 1.0:
        return 0.0
    if member in END_ANCHORS:
        way = (0.0, 0.0, 1.0) if member == "lateral_anchor" else find_end_guy_way(row)
        return min(
            resistance.lift_cone(soil, depth, abs(slope), way, drained=drained)
            for depth in depths
        )
    width = row.net["post_spacing"]
    return min(
        resistance.lift_wedge(soil, depth, width, slope, pulls, drained=drained)
        for depth in depths
    )


def find_chain(row, name, angle, steel):
    """Weakest link of a type: by its strength, or by its working load limit (R17)."""
    values, found = row.values, []
    for link in row.cells.lines["Links"]:
        if link["type"] != name:
            continue
        strength = link.get("strength")
        if strength is None:
            factors = values["action.snow"] * values["resistance.connection"]
            strength = link["working_limit"] * factors
        count = link.get("count", 1)
        turned = max(math.radians(link.get("angle", 0.0)), angle or 0.0)
        if link["link"] == "shackle":
            strength *= resistance.weaken_shackle(turned)
        found.append(count * strength)
    listed = min(found)
    usual = min(listed, USUAL_LINK * steel)
    return np.array([usual, usual, listed])


def redo_rope(row, member, name, load, angle):
    cells = row.cells.find("Ropes", "id", name)
    holds = cells["rope"] * ROPE_ENDS[cells["termination"]]
    yield f"{member}.rope", rate(row, load, holds, "rope")
    chain = find_chain(row, name, angle, holds)
    yield f"{member}.connection", rate(row, load, chain, "connection")


@dataclass(frozen=True)
class Pulls:
    """Least and largest angle of a pull to the slope, and the bore's axis [rad]."""

    least: float
    largest: float
    axis: float
    dip: float  # of the bore below the horizontal
    beside: float  # largest angle between pull and axis, in space


def find_pulls(row, member, position="intermediate"):
    """Pulls of an anchor: of guys by the geometry, of the foot as they were solved."""
    slope = row.angle("slope_angle")
    if member == "end_guy_anchor":
        return find_end_guy_pull(row)
    if member == "lateral_anchor":  # along the row; axis in the plane across the slope
        flattest = math.asin(math.sin(LEAST_DIP) / math.cos(slope))
        axis = math.radians(row.end.get("lateral_axis", math.degrees(flattest)))
        dip = math.asin(math.sin(axis) * math.cos(slope))
        return Pulls(0.0, 0.0, axis, dip, axis)
    if member == "foot_anchor":
        (solved,) = (
            one
            for one in row.study["pulls"]
            if one["anchor"] == member and one["position"] == "intermediate"
        )
        least, largest = (
            math.radians(solved[f"{k}_deg"]) for k in ("least", "largest")
        )
    else:
        least, largest = find_falls(row, member)
    downhill = member == "downhill_anchor"
    flattest = LEAST_DIP - slope if downhill else slope + LEAST_DIP
    axis = max((least + largest) / 2.0, flattest)
    typed = row.net.get(member.replace("_anchor", "_axis"))
    axis = axis if typed is None else math.radians(typed)
    dip = axis + slope if downhill else axis - slope
    flat = math.cos(max(abs(least - axis), abs(largest - axis)))
    if member == "foot_anchor":
        beside = flat / math.hypot(1.0, find_foot_share(row, position))
    else:  # the axis lies in the section, the guy beside it
        beside = flat * math.cos(row.angle("guy_splay"))
    return Pulls(least, largest, axis, dip, math.acos(beside))


def find_end_guy_way(row):
    """Unit vector along the end guy from its anchor to the head."""
    _, angle = row.end_guy
    x, y = statics.pull_of_end_guy(angle)
    return -x * math.cos(angle), -y * math.cos(angle), math.cos(angle)


def find_end_guy_pull(row):
    """Of the end guy: its bore goes on with it, but dips by 15 degrees at least."""
    slope = row.angle("slope_angle")
    way = -np.array(find_end_guy_way(row))  # into the ground
    down = np.array([math.sin(slope), -math.cos(slope), 0.0])
    dip = math.asin(way @ down)
    bore = way
    if dip < LEAST_DIP:
        level = way - (way @ down) * down
        level /= np.linalg.norm(level)
        bore = math.cos(LEAST_DIP) * level + math.sin(LEAST_DIP) * down
    beside = math.acos(min(1.0, bore @ way))
    fall, axis = math.asin(-way[1]), math.asin(-bore[1])
    return Pulls(fall, fall, axis, max(dip, LEAST_DIP), beside)


def find_falls(row, member):
    """Least and largest fall of a guy to the slope, in the section."""
    falls = []
    for section in row.sections:
        point = section.uphill if member == "uphill_anchor" else section.downhill
        falls.append(math.atan2(section.head[1], abs(point[0] - section.head[0])))
    return min(falls), max(falls)


def find_foot_share(row, position):
    """Pull along the row over that in the section, at the net's foot."""
    share = row.values["lateral.share"]
    if position != "second":
        return share
    if row.end.get("ropes_at_supports") == "slide":
        return share
    (solved,) = (
        one
        for one in row.study["pulls"]
        if (one["anchor"], one["position"]) == ("foot_anchor", "second")
    )
    turned = math.radians(solved["angle_deg"])
    axis = math.radians(solved["axis_deg"])
    flat = max(
        abs(math.radians(solved[f"{k}_deg"]) - axis) for k in ("least", "largest")
    )
    found = math.sqrt((math.cos(flat) / math.cos(turned)) ** 2 - 1.0)
    width = row.grow(row.widths[position])
    forces = [row.solved[f"{model}foot_anchor"] for model in ("", "panel_")]
    largest = row.unbalanced[1] / np.max(forces, axis=0) / width
    if found < share + largest[1]:
        raise ValueError("the second foot turns by less than its largest forces ask")
    return found


def redo_post(row, position):
    cells = row.cells.find("Posts", "id", row.find_type("post", position))
    load = row.load_post(position)
    base = row.load_post(position, "post_base")
    buckling, critical = resistance.buckle(
        cells["area"] * 1e-4,
        cells["second_moment"] * 1e-8,
        cells["buckling_length"],
        cells["yield_strength"] * 1e3,
        cells["buckling_curve"],
    )
    yield "post.compression", rate(row, load, buckling, "compression")
    bent = bend_post(row, position, cells, (buckling, critical))
    yield "post.compression_bending", rate(row, load, bent, "compression_bending")
    yield "post_base.bearing", rate(row, base, cells["bearing"], "bearing")
    tilt = math.tan(row.angle("post_tilt"))
    action = row.values["action.snow"]
    slides = cells["base_friction"] * action * base[1]
    yield "post_base.sliding", rate(row, tilt * base, slides, "sliding")


def bend_post(row, position, cells, strut):
    """R_k beside the moment of the snow and of eccentric ends (A6): least, largest."""
    values = row.values
    moment = cells["section_modulus"] * 1e-6 * cells["yield_strength"] * 1e3
    width = cells["post_width"] / 1e3
    factor = values["resistance.compression_bending"]
    half = 1e3 * width / 2.0  # an HEB is as deep as it is wide
    ends = [cells.get(f"{one}_eccentricity", half) / 1e3 for one in ("head", "foot")]
    found = []
    for efficiency in find_efficiencies(row, position):
        pressed = efficiency * press_on_plane(row) * width
        snow = values["action.snow"] * pressed * cells["buckling_length"] ** 2 / 8.0
        held = resistance.compress_bent_post((*strut, moment), snow, *ends, factor)
        found.append(factor * held)
    return np.array([found[1], found[1], found[0]])


def find_efficiencies(row, position):
    """Line load of the snow on a post over its pressure times the width: both ends."""
    both = (1.0, 1.0 + 2.0 * (row.glide - 1.2))
    if position == "edge":
        return [max(one, 1.0 + row.end_effect[0]) for one in both]
    return both


def press_on_plane(row):
    """Mean pressure of the densest snow, or of the guideline's cases [kPa]."""
    _, density = row.cells.ranges["density"]
    load = row.guideline_row
    settled = guideline.press_plane(load)
    return max(guideline.press_plane(load, density / 1e3), settled)


def list_differences(redone, checks):
    """What differs between the script and the checks of study.json."""
    for check in checks:
        steps = {one["symbol"]: one for one in check["steps"]}
        if "E_k" not in steps:
            continue
        mine = redone.get(check["id"])
        if mine is None:
            yield check["id"], "not redone", None, None
            continue
        near = NEAR_CONE if check["id"] in CONES else NEAR
        numbers = {"E_k": mine.demand, "E_d": mine.design, "R_k": mine.resistance,
                   "γ_R": mine.factor, "R_d": mine.held, "μ": mine.used}  # fmt: skip
        for symbol, own in numbers.items():
            step = steps.get(symbol, {})
            value = step.get("value", math.nan)
            ends = [step.get(end, value) for end in ("low", "value", "high")]
            own = np.broadcast_to(np.asarray(own, float), 3)
            if not np.allclose(own[1], ends[1], rtol=near, equal_nan=True):
                yield check["id"], symbol, ends[1], float(own[1])
            elif not np.allclose(own[2], ends[2], rtol=near, equal_nan=True):
                yield check["id"], f"{symbol} high", ends[2], float(own[2])
