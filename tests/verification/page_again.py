"""Figures of a report worked out again by formulas of its own, from its page alone.

Nothing of the program is used here: what is read is the English page, what is known of
the method are the formulas that stand on it.
"""

import math
import re
from dataclasses import dataclass, field

from tests.report.reading import PageReader

FOOT, UP_GUY, UP = "Foot anchor", "Uphill guy", "Uphill anchor"
DOWN_GUY, DOWN, POST, BASE = "Downhill guy", "Downhill anchor", "Post", "Post base"
SLIDING = "Post base, sliding"
ENDS = ("⁻", "", "⁺")  # of a band, as headings mark them
_NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")


def read_number(text):
    """Number of a cell, or None."""
    found = _NUMBER.fullmatch(text.lstrip(">").replace(" ", ""))
    return float(found.group()) if found else None


def list_numbers(text):
    return [float(one) for one in _NUMBER.findall(text)]


def name_symbol(heading):
    """``E s ⁻ [kN]`` as "Es⁻"."""
    return heading.partition("[")[0].replace(" ", "")


@dataclass
class PrintedRow:
    """Tables of one net row as they are printed; numbers by symbols."""

    inputs: dict
    states: list
    floors: list
    held: dict
    widths: dict
    actions: list
    by_panel: list
    checks: list
    resistances: dict
    tests: dict
    turns: list
    told: list
    further: list


@dataclass
class Printed:
    rows: dict
    profile: dict
    ranges: dict


def read_page(page):
    reader = PageReader(page)
    profile = {}
    for _, text, value, *_ in reader.tables["profile"][0][1:]:
        profile.setdefault(text, float(value))
    ranges = {one[0]: read_number(one[2]) for one in reader.tables["ranges"][0][1:]}
    names = sorted({one for one in reader.ids if re.fullmatch(r"row-\d+-figures", one)})
    rows = {name.removesuffix("-figures"): name for name in names}
    return Printed(
        rows={row: _read_row(reader, row) for row in rows},
        profile=profile,
        ranges=ranges,
    )


def _read_row(reader, row):
    found = {}
    for table in reader.tables[f"{row}-figures"]:
        head = [name_symbol(one) for one in table[0]]
        first = head[0]
        symbols = {name_symbol(line[0]) for line in table}
        key = {"k": "held", "Support": "widths", "Member": "actions"}.get(first)
        key = key or {"Check": "checks", "Anchor": "turns"}.get(first)
        key = "by_panel" if first == "Member" and "Es" not in head else key
        if first == "Bringsthelargest":
            key = "floors" if "λ" in symbols else "states"
        if first == "No.":
            key = "tests" if "Rm" in head else "resistances"
        found[key] = _turn(table) if first == "Bringsthelargest" else _line_up(table)
    inputs = {one[0]: one[2] for one in reader.tables[f"{row}-inputs"][0][1:]}
    checks, *further = reader.tables[f"{row}-checks"]
    return PrintedRow(
        inputs=inputs,
        states=found.get("states", []),
        floors=found.get("floors", []),
        held=found["held"][0] if "held" in found else {},
        widths={one["Support"]: one for one in found.get("widths", [])},
        actions=found["actions"],
        by_panel=found.get("by_panel", []),
        checks=found["checks"],
        resistances={one["No."]: one for one in found["resistances"]},
        tests={one["No."]: one for one in found.get("tests", [])},
        turns=found["turns"],
        told=[cells for cells in checks[1:] if len(cells) > 1],
        further=[cells for one in further for cells in one[1:]],
    )


def _line_up(table):
    heads = [name_symbol(one) for one in table[0]]
    return [
        {head: _keep(head, cell) for head, cell in zip(heads, line, strict=True)}
        for line in table[1:]
    ]


def _keep(head, cell):
    text_heads = ("No.", "Type", "Cell", "Rk=", "Mode", "Basis", "Verdict", "Case")
    value = read_number(cell)
    return cell if head in text_heads or (value is None and cell != "-") else value


def _turn(table):
    columns = list(zip(*table, strict=True))
    heads = ["Brings", *(name_symbol(one) for one in columns[0][1:])]
    states = []
    for column in columns[1:]:
        state = {h: _keep(h, c) for h, c in zip(heads, column, strict=True)}
        state["Brings"] = {_name(one) for one in column[0].split("; ")}
        states.append(state)
    return states


def _name(text):
    """Members as they are named, other keys without their table."""
    return re.sub(r" \(\d\)$", "", text)


@dataclass
class Again:
    """Comparisons of printed figures with those worked out again."""

    tolerance: float = 1e-3
    count: int = 0
    wrong: list = field(default_factory=list)

    def same(self, what, printed, again, near=0.0):
        """``near`` is what the last printed digit of others leaves open."""
        self.count += 1
        if printed is None or again is None:
            if printed is not again:
                self.wrong.append((what, printed, again))
        elif not math.isclose(
            printed, again, rel_tol=self.tolerance, abs_tol=max(near, 1e-9)
        ):
            self.wrong.append((what, printed, again))

    def holds(self, what, truth, *numbers):
        self.count += 1
        if not truth:
            self.wrong.append((what, *numbers))


def work_out_page(page):
    return work_out(read_page(page))


def work_out(printed):
    again = Again()
    for name, row in printed.rows.items():
        RowAgain(name, row, printed, again).work_out()
    return again


def cross(a, c):
    return a[0] * c[1] - a[1] * c[0]


def dot(a, c):
    return a[0] * c[0] + a[1] * c[1]


def point_to(start, end):
    x, y = end[0] - start[0], end[1] - start[1]
    return x / math.hypot(x, y), y / math.hypot(x, y)


class RowAgain:
    """One net row; each method works out one table."""

    def __init__(self, name, row, printed, again):
        self.name, self.row, self.again = name, row, again
        self.printed = printed
        self.spacing = self.input("post spacing")
        self.height = self.input("net height")
        self.slope = math.radians(self.input("slope angle"))
        derived = "snow thickness, from the snow height vertical"
        self.thickness = min(
            self.input("snow thickness") or self.input(derived), self.height
        )
        self.share = self.value("Share of the force that may act sideways")

    def input(self, label):
        return read_number(self.row.inputs.get(label, "-"))

    def value(self, start):
        """Value of the profile whose text begins so."""
        found = {v for t, v in self.printed.profile.items() if t.startswith(start)}
        (value,) = found
        return value

    def same(self, what, printed, value, near=0.0):
        self.again.same(f"{self.name}: {what}", printed, value, near)

    def holds(self, what, truth, *numbers):
        self.again.holds(f"{self.name}: {what}", truth, *numbers)

    def work_out(self):
        for state in (*self.row.states, *self.row.floors):
            self.stand(state)
        for state in self.row.floors:
            self.load(state)
        self.hold_sideways()
        self.widen()
        for action in self.row.actions:
            self.act(action)
        for held in self.list_held_ends():
            self.hold_end(held)
        for check in self.row.checks:
            self.judge(check)
        for given in self.row.resistances.values():
            self.resist(given)
        for turn in self.row.turns:
            self.turn(turn)
        for line in self.row.told:
            self.tell(line)
        for _, title, reason in self.row.further:
            self.require(title, reason)

    # 1. and 2. statics

    def place(self, inclination):
        """Head, base, uphill and downhill anchor at an inclination [deg]."""
        head = (self.height * math.tan(math.radians(inclination)), self.height)
        base = self.input("post base distance")
        if base is None:
            tilt = math.radians(self.input("post tilt"))
            base = head[0] - head[1] * math.tan(tilt)
        uphill = -self.input("uphill anchor distance")
        downhill = base + self.input("downhill anchor distance")
        return head, (base, 0.0), (uphill, 0.0), (downhill, 0.0)

    def stand(self, state):
        what = f"{state['Brings']}"
        inclination = state.get("θ")
        if inclination is None:
            inclination = list_numbers(state["Case"])[2]
        head, base, uphill, downhill = self.place(inclination)
        for key, value in (
            ("xH", head[0]), ("yH", head[1]), ("xB", base[0]),
            ("xU", uphill[0]), ("xD", downhill[0]),
        ):  # fmt: skip
            self.same(f"{what} {key}", state[key], value)
        b, (hx, hy) = self.spacing, (state["hx"], state["hy"])
        pull, size = (b * hx, b * hy), b * math.hypot(hx, hy)
        p, u, d = (point_to(head, end) for end in (base, uphill, downhill))
        tensions = [cross(pull, p) / cross(p, g) for g in (u, d)]
        is_uphill = tensions[0] >= 0.0
        g = u if is_uphill else d
        compression = cross(pull, g) / cross(p, g)
        foot = b * math.hypot(state["fx"], state["fy"])
        # what the printed digits leave open of a pull, over the sine between members
        near = 2e-5 * size / abs(cross(p, g))
        self.same(f"{what} |F_f|", state["|Ff|"], foot)
        self.same(f"{what} T_u", state["Tu"], max(tensions[0], 0.0), near)
        self.same(f"{what} T_d", state["Td"], 0.0 if is_uphill else tensions[1], near)
        self.same(f"{what} C", state["C"], compression, near)
        self.same(f"{what} V", state["V"], max(-compression * p[1], 0.0), near)
        state["spread"] = self.spread(state, p, g)

    def spread(self, state, p, g):
        """What the errors of the pulls can do to each member [kN]."""
        if "±h" not in state:
            return {}
        b, of_foot, of_head = self.spacing, state["±f"], state["±h"]
        sine, foot = abs(cross(p, g)), math.hypot(state["fx"], state["fy"])
        tension = b * of_head * (abs(p[0]) + abs(p[1])) / sine
        compression = b * of_head * (abs(g[0]) + abs(g[1])) / sine
        along = b * of_foot * (abs(state["fx"]) + abs(state["fy"])) / foot
        return {"T": tension, "C": compression, "V": -compression * p[1], "F": along}

    def load(self, state):
        """The guideline's load, and the pulls that follow from it."""
        what, value = f"floor {state['Brings']}", self.value
        psi, theta = self.slope, math.radians(state["θ"])
        rho, height, glide = state["ρ"] / 1e3, state["H"], state["N"]
        g = 10.0
        whole = self.thickness / math.cos(psi)
        if state["Case"] == "load case 1":
            highest, known = value("From this altitude on"), self.input("altitude")
            altitude = highest if known is None else min(known, highest)
            above = max(altitude - value("Up to this altitude"), 0.0)
            growth = 1.0 + value("Growth of the altitude factor") * above / 100.0
            self.same(f"{what} rho", rho, growth * value("Mean density at the largest"))
            self.same(f"{what} H", height, whole)
        else:
            self.same(f"{what} rho", rho, value("Load case 2: density"))
            self.same(f"{what} H", height, value("Load case 2: snow height") * whole)
        creep = (
            value("K / sin 2 psi")
            + value("As above: factor of rho.") * rho
            + value("As above: factor of rho squared") * rho**2
            + value("As above: factor of rho cubed") * rho**3
        ) * math.sin(2.0 * psi)
        self.same(f"{what} K", state["K"], creep)
        rigid = 0.5 * rho * g * height**2 * creep * glide
        self.same(f"{what} S'_N", state["S'N"], rigid)
        along = value("Factor f_s on the pressure") * rigid
        self.same(f"{what} f_s S'_N", state["fsS'N"], along)
        across = along * value("a in S'_Q") / (glide * math.tan(psi))
        self.same(f"{what} S'_Q", state["S'Q"], across)
        filled = min(self.height, height * math.cos(psi))
        prism = 0.5 * rho * g * filled**2 * math.tan(theta)
        self.same(f"{what} G'", state["G'"], prism)
        rx = along + prism * math.sin(psi)
        ry = -across - prism * math.cos(psi)
        self.same(f"{what} R_x", state["Rx"], rx)
        self.same(f"{what} R_y", state["Ry"], ry)
        share = min(1.0, height * math.cos(psi) / self.height)
        self.same(f"{what} lambda", state["λ"], share)
        slack, stiffness = self.input("slack"), self.input("net stiffness")
        if slack is not None:
            self.same(f"{what} s", state["s"], slack)
        self.same(f"{what} ES", state["ES"], stiffness)
        tension = self.find_chord(rx, ry, theta, state)
        self.same(f"{what} T", state["T"], tension)
        e, near = (math.sin(theta), math.cos(theta)), 2e-5 * math.hypot(rx, ry)
        for key, part, sign in (("f", 1 - share / 2, 1.0), ("h", share / 2, -1.0)):
            self.same(f"{what} {key}_x", state[f"{key}x"],
                      part * rx + sign * tension * e[0], near)  # fmt: skip
            self.same(f"{what} {key}_y", state[f"{key}y"],
                      part * ry + sign * tension * e[1], near)  # fmt: skip

    def find_chord(self, rx, ry, theta, state):
        """Chord tension from the sag, by bisection."""
        share, slack, stiffness = state["λ"], state["s"], state["ES"]
        across = rx * math.cos(theta) - ry * math.sin(theta)
        v1, v2 = 1 - share / 2, share / 2
        mean = share * (v1**2 - v1 * v2 + v2**2) / 3 + (1 - share) * v2**2
        low, high = 1e-6 * across, 10.0 * max(stiffness, across)
        for _ in range(200):
            middle = 0.5 * (low + high)
            sag = across**2 * mean / (2 * middle**2)
            is_short = sag > slack + (1 + slack) * middle / stiffness
            low, high = (middle, high) if is_short else (low, middle)
        return 0.5 * (low + high)

    def find_states(self, key, states):
        return [one for one in states if key in one["Brings"]]

    # 3. load along the row

    def hold_sideways(self):
        held = self.row.held
        if not held:
            return
        self.same("k", held["k"], self.share)
        self.same("beta", held["β"], self.input("splay of the guys"))
        b = self.spacing
        states = [*self.row.states, *self.row.floors]
        pulls = [
            b * math.hypot(one["hx"], one["hy"])
            for one in self.find_states("pull on a head", states)
        ]
        self.same("P", held["P"], max(pulls))
        self.holds("P ends", held["P⁻"] <= held["P"] <= held["P⁺"])
        (state,) = self.find_states("least tension", self.row.states)
        tension = state["Tu"] + state["Td"]
        least = max(tension - state["spread"]["T"], 0.0)
        self.same("T_s", held["Ts"], least, 2e-5 * held["P"])
        if held["Tg"] is not None:
            (floor,) = self.find_states("least tension", self.row.floors)
            tension = floor["Tu"] + floor["Td"]
            if held["Tg"] == 0.0:  # it changes sides somewhere beside that state
                self.holds("T_g", tension < 0.1 * held["P"], tension)
            else:
                self.same("T_g", held["Tg"], tension, 2e-5 * held["P"])
        found = max(held["Ts"] - held["ΔT"], 0.0)
        found = found if held["Tg"] is None else min(found, held["Tg"])
        if held["Tg"] is not None and self.input("altitude") is None:
            found = 0.0
        self.same("T_min", held["Tmin"], found)
        for key in ("cu", "cd", "w"):
            parts = self.weigh(held[f"θ({key})"])
            self.same(key, held[key], parts[key])
            for inclination in self.list_inclinations():
                value = self.weigh(inclination)[key]
                self.holds(f"{key} largest", held[key] >= value * 0.999, value)

    def list_inclinations(self):
        ends = ("net inclination, low", "net inclination, high")
        return [self.printed.ranges[end] for end in ends]

    def weigh(self, inclination):
        head, *ends = self.place(inclination)
        p, u, d = (point_to(head, end) for end in ends)
        above, below = abs(cross(u, p)), abs(cross(d, p))
        kappa = below / (above + below)
        w = kappa * dot(u, p) + (1 - kappa) * dot(d, p)
        return {"cu": max(0.5, kappa), "cd": max(0.5, 1 - kappa), "w": w}

    # 4. widths

    def widen(self):
        for support, one in self.row.widths.items():
            self.holds("support of widths", support == "end", support)
            self.same("end b", one["b"], self.spacing)
            width, factor, length = max(self.list_end_widths())
            self.same("end b_e", one["be"], width)
            self.same("end f_R", one["fR"], factor)
            self.same("end dl", one["Δl"], length)

    def find_width(self, support):
        """b_e / b of a support."""
        if support == "inside":
            return 1.0
        end = self.row.widths["end"]
        return end["be"] / end["b"]

    def list_end_widths(self):
        glide = self.input("glide factor") or self.row.floors[0]["N"]
        value, gap = self.value, self.input("gap to next work")
        cap = value("f_R is at most cap_constant + cap_per_glide N: the constant")
        cap += glide * value("f_R is at most cap_constant + cap_per_glide N: the part")
        longest = value("That length is at most this share") * self.height
        edge, found = value("From this gap A on a row's end"), []
        if gap is None or gap >= 0.9 * edge:
            found.append((cap, longest))
        if gap is not None and gap <= 1.1 * edge:
            rate = value("f_R = (constant + per_glide N) A / 2: the constant")
            rate += glide * value("f_R = (constant + per_glide N) A / 2: the part")
            length = value("The end effect acts over length A / 2") * gap / 2
            found.append((min(rate * gap / 2, cap), min(length, longest)))
        return [(self.spacing / 2 + f * n, f, n) for f, n in found]

    # 5. actions

    def act(self, one):
        """A base that slides has the forces across it, and t; the others E_k."""
        what = f"{one['Member']} {one['Support']}"
        member = BASE if one["Member"] == SLIDING else one["Member"]
        solved = self.find_force(member, self.row.states)
        self.same(f"{what} E_s", one["Es"], solved)
        self.check_band(what, member, one)
        self.add_sideways(what, member, one)
        is_shared = self.input("uphill anchor distance") == 0.0
        turns = member == FOOT or (is_shared and member == UP)
        lateral = math.hypot(1.0, self.share) if turns else None
        self.same(f"{what} k_q", one.get("kq"), lateral)
        coupled = {end: self.bring(one, one[f"Es{end}"], end) for end in ENDS}
        self.same(f"{what} E_c", one["Ec"], coupled[""])
        self.same(f"{what} E_c+", one["Ec⁺"], coupled["⁺"])
        least = 0.0
        if one.get("Eg0") is not None:
            floor = self.find_force(member, self.row.floors)
            self.same(f"{what} E_g0", one["Eg0"], floor)
            least = self.bring(one, one["Eg0"])
            self.same(f"{what} E_g", one["Eg"], least)
        beside = self.follow_panel(what, member, one)
        slides = one["Member"] == SLIDING
        self.same(f"{what} t", one.get("t"), self.lean() if slides else None)
        along = one["t"] if slides else 1.0
        one["across"] = max(coupled[""], beside[""], least)
        one["ends"] = {
            end: along * max(force, beside[end], least)
            for end, force in coupled.items()
        }
        self.same(f"{what} E_k", one["Ek"], one["ends"][""])

    def bring(self, one, force, end=""):
        """Force on the support from one inside the row: (g E + A) k_q b_e / b."""
        share, lateral = one.get("g") or 1.0, one.get("kq") or 1.0
        added = one.get(f"A{end}") or 0.0
        return (share * force + added) * lateral * self.find_width(one["Support"])

    def follow_panel(self, what, member, one):
        """Force on the support by the panel at each end; 0 in a row without one."""
        found = [
            p for p in self.row.by_panel
            if (p["Member"], p["Support"]) == (one["Member"], one["Support"])
        ]  # fmt: skip
        if not found:
            return dict.fromkeys(ENDS, 0.0)
        (panel,) = found
        states = self.find_states(f"{member} by the panel", self.row.states)
        force = self.read_state(member, states[0]) if states else 0.0
        if member == FOOT and states:
            force = max(force, states[0]["Fm"])
        self.same(f"{what} E_p0", panel["Ep0"], force)
        pushes = dict.fromkeys(ENDS, 0.0)
        if panel.get("Tr") is not None:
            pushes = self.push(what, panel)
        beside = {
            end: self.bring(one, panel[f"Ep0{end}"], end) + pushes[end]
            for end in ("⁻", "")
        }
        self.same(f"{what} E_p", panel["Ep"], beside[""])
        self.holds(f"{what} E_p+", panel["Ep⁺"] >= beside[""], panel["Ep⁺"])
        self.same(f"{what} E_k beside", panel["Ek"], one["Ek"])
        return {**beside, "⁺": panel["Ep⁺"]}

    def push(self, what, panel):
        """What the end guy adds to the end post at each end of its pull."""
        pulls = self.pull_along(what, panel)
        slope = math.tan(math.radians(panel["γ"]))
        pushes = {end: pull * slope for end, pull in pulls.items()}
        for end, push in pushes.items():
            self.same(f"{what} Z{end}", panel[f"Z{end}"], push)
        return pushes

    def pull_along(self, what, panel):
        """H at each end: rope's pull with the end effect, whose angle is an input."""
        end = self.row.widths["end"]
        factor, length = end["fR"], end["Δl"] / end["b"]
        grown = 1.0 + factor * (length if length <= 0.5 else 1.0)
        pulls = {at: panel[f"Tr{at}"] * grown for at in ENDS}
        self.same(f"{what} H", panel["H"], pulls[""])
        if panel["γ"] is not None:
            angle = self.input("angle of the end guy to the row")
            self.same(f"{what} gamma", panel["γ"], angle)
        return pulls

    def hold_end(self, one):
        """Member that holds a border rope at the row's end, and has no other force."""
        what = f"{one['Member']} {one['Support']}"
        along = 1.0 if one["γ"] is None else math.cos(math.radians(one["γ"]))
        pulls = self.pull_along(what, one)
        one["ends"] = {end: pull / along for end, pull in pulls.items()}
        self.same(f"{what} E_k", one["Ek"], one["ends"][""])

    def find_force(self, member, states):
        """Force of the state that brings a member most; 0 of a slack one."""
        found = self.find_states(member, states)
        return self.read_state(member, found[0]) if found else 0.0

    def read_state(self, member, state):
        keys = {FOOT: "|Ff|", UP_GUY: "Tu", UP: "Tu", DOWN_GUY: "Td", DOWN: "Td"}
        keys |= {POST: "C", BASE: "V"}
        if state["xU"] == 0.0 and member in (FOOT, UP):
            return state["|Ff|"] + state["Tu"]
        return state[keys[member]]

    def check_band(self, what, member, one):
        """The printed band holds that of the governing case."""
        parts = {FOOT: "F", POST: "C", BASE: "V"}
        for state in self.find_states(member, self.row.states):
            spread = state["spread"][parts.get(member, "T")]
            if state["xU"] == 0.0 and member in (FOOT, UP):
                spread = state["spread"]["F"] + state["spread"]["T"]
            low, high = one["Es"] - spread, one["Es"] + spread
            is_in = one["Es⁻"] >= low * 0.999 and one["Es⁺"] >= high * 0.999
            self.holds(f"{what} band", is_in and one["Es⁻"] <= one["Es"], low, high)

    def add_sideways(self, what, member, one):
        """Share g, and addition A at each end; none where nothing is added."""
        held, share, added = self.row.held, None, dict.fromkeys(ENDS)
        if held and member in (UP_GUY, UP, DOWN_GUY, DOWN):
            beta = math.radians(held["β"])
            c = held["cu" if member in (UP_GUY, UP) else "cd"]
            share = 0.5 / math.cos(beta)
            added = {
                end: c * held["k"] * held[f"P{end}"] / math.sin(beta) for end in ENDS
            }
        elif held and member != FOOT:
            slope, least = math.tan(math.radians(held["β"])), held["Tmin"]
            added = {
                end: held["w"] * max(held["k"] * held[f"P{end}"] / slope - least, 0)
                for end in ENDS
            }
        self.same(f"{what} g", one.get("g"), share)
        for end in ENDS:
            near = 1e-5 * held.get("P", 0.0)
            self.same(f"{what} A{end}", one.get(f"A{end}"), added[end], near)

    def lean(self):
        """Largest tangent of the post's tilt."""
        places = [self.place(one) for one in self.list_inclinations()]
        return max(abs(head[0] - base[0]) / head[1] for head, base, *_ in places)

    # 6. checks

    def list_held_ends(self):
        """Members that only hold a rope; their other forces are missing."""
        return [one for one in self.row.by_panel if one["Ep0"] is None]

    def find_action(self, title):
        support = "end" if title.endswith(", end of the row") else "inside"
        member = title.split(",")[0]
        member = SLIDING if title.startswith(SLIDING) else member
        for one in (*self.row.actions, *self.list_held_ends()):
            if (one["Member"], one["Support"]) == (member, support):
                return one
        raise AssertionError(title)

    def judge(self, one):
        title = one["Check"]
        action = self.find_action(title)
        snow = "Factor on the characteristic force that the snow"
        self.same(f"{title} gamma_E", one["γE"], self.value(snow))
        for end in ENDS:
            force = one["γE"] * action["ends"][end]
            self.same(f"{title} E_d{end}", one[f"Ed{end}"], force)
        if one["Rd"] is None:
            return
        factors = set(self.printed.profile.values())
        self.holds(f"{title} gamma_R", one["γR"] in factors, one["γR"])
        given = self.row.resistances[one["No."]]
        self.same(f"{title} R_k", one["Rk"], given["Rk"])
        self.same(f"{title} R_d", one["Rd"], one["Rk"] / one["γR"])
        for end in ENDS:
            ratio = one[f"Ed{end}"] / one["Rd"]
            self.same(f"{title} mu{end}", one[f"μ{end}"], ratio)
        if one["Verdict"] == "PASS":
            self.holds(f"{title} passes", one["μ⁺"] <= 1.0005, one["μ⁺"])
        if one["Verdict"] == "FAIL":
            self.holds(f"{title} fails", one["μ⁻"] >= 0.9995, one["μ⁻"])

    # 7. resistances

    def resist(self, given):
        told, what = given["Rk="], f"{given['Mode']} {given['Type']}"
        if told == "as given in the cell":
            return
        works = {
            "tendon": work_out_bar,
            "pull-out": work_out_pull_out,
            "rope": work_out_rope,
            "bearing": work_out_bearing,
            "compression": work_out_buckling,
        }
        mode = given["Mode"]
        if mode in works:
            value = works[mode](told)
        elif mode == "sliding":
            value = self.slide(told)
        elif mode == "bending beside the axis":
            value = self.bend(told, given)
        else:
            value = self.bend_post(told, what)
        self.same(f"{what} R_k", given["Rk"], value)
        tests = self.row.tests.get(given["No."])
        if tests:
            worst = min(tests["Rm"] / tests["ξm"], tests["Rmin"] / tests["ξmin"])
            self.same(f"{what} of tests", given["Rk"], worst)
            self.same(f"{what} of tests, R_k", tests["Rk"], given["Rk"])
            pair = tests["ξm"], tests["ξmin"]
            self.holds(f"{what} factors", pair in self.list_correlations(), *pair)

    def list_correlations(self):
        """Factors on mean and least for each number of tests."""
        start = "Correlation factor on the {} of the tested resistances. Tests: "
        profile = self.printed.profile
        mean, least = (start.format(one) for one in ("mean", "least"))
        counts = [t.removeprefix(mean) for t in profile if t.startswith(mean)]
        return [(profile[mean + one], profile[least + one]) for one in counts]

    def slide(self, told):
        friction, factor, pressing = list_numbers(told)
        slid = [one for one in self.row.actions if one["Member"] == SLIDING]
        bases = [one["across"] for one in slid]
        best = min(bases, key=lambda one: abs(one - pressing))
        self.same("force that presses the base", pressing, best)
        return friction * factor * best

    def bend(self, told, given):
        """(2 c - a) / c^2 or 1 / a, at the worse of two angles."""
        outer = float(re.search(r"D ([\d.]+) mm", told).group(1)) / 1e3
        inner = float(re.search(r"d ([\d.]+) mm", told).group(1)) / 1e3
        strength = float(re.search(r"([\d.]+) MPa", told).group(1)) * 1e3
        lever = float(re.search(r"\+ ([\d.]+) mm · sin", told).group(1)) / 1e3
        area = math.pi * (outer**2 - inner**2) / 4
        axial = area * strength
        moment = math.pi * (outer**4 - inner**4) / (32 * outer) * strength
        sheared = (2 / math.pi if inner else 0.75) * area * strength / math.sqrt(3)
        users = [c["Check"].split(",")[0] for c in self.row.checks
                 if c["No."] == given["No."]]  # fmt: skip
        largest = max(t["δ'"] for t in self.row.turns if t["Anchor"] in users)
        largest = math.radians(largest)
        weakest = min(math.atan(lever * axial / moment), largest)

        def bear(angle):
            a = math.cos(angle) / axial + lever * math.sin(angle) / moment
            c = 2 * math.sin(angle) / sheared
            return (2 * c - a) / c**2 if c > a else 1 / a

        worst = min((largest, weakest), key=bear)
        printed = float(re.search(r"cos ([\d.]+)°", told).group(1))
        self.same("angle of the bent bar", printed, math.degrees(worst))
        return bear(worst)

    def bend_post(self, told, what):
        numbers = list_numbers(told.replace("kN m;", "kN m ;"))
        buckling, action, moment_k, critical = (
            float(re.search(pattern, told).group(1))
            for pattern in (
                r"γ C / ([\d.]+) kN",
                r"γ · ([\d.]+) M",
                r"M / \(([\d.]+) kN m",
                r"1 − C / ([\d.]+) kN",
            )
        )
        factor = float(re.search(r"γ = ([\d.]+)", told).group(1))
        eta, pressure, width, length, moment = map(
            float,
            re.search(
                r"M = ([\d.]+) · ([\d.]+) kPa · ([\d.]+) mm · \(([\d.]+) m\)² / 8 = "
                r"([\d.]+) kN m",
                told,
            ).groups(),
        )
        again = eta * pressure * width / 1e3 * length**2 / 8
        self.same(f"{what} M", moment, again)
        rho, g, height, creep, glide, slope = map(
            float,
            re.search(
                r"= ([\d.]+) kg/m³ · ([\d.]+) m/s² · ([\d.]+) m · ([\d.]+) · ([\d.]+) "
                r"/ \(2 · cos ([\d.]+)°\)",
                told,
            ).groups(),
        )
        presses = rho * g * height * creep * glide / 2e3
        presses /= math.cos(math.radians(slope))
        self.same(f"{what} pressure", pressure, presses)
        self.same(f"{what} eta", eta, self.value("Factor eta of a slender member"))
        modulus, strength = list_numbers(told)[-2:]
        self.same(f"{what} W f_y", moment_k, modulus * strength / 1e3)
        self.holds(f"{what} numbers", len(numbers) > 10)

        def use(c):
            bent = factor * action * again / (moment_k * (1 - c / critical))
            return factor * c / buckling + bent

        low, high = 0.0, critical * (1 - 1e-9)
        for _ in range(200):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if use(middle) < 1.0 else (low, middle)
        return factor * low

    # 9. directions, and what is told beside the numbers

    def turn(self, one):
        anchor = one["Anchor"]
        is_shared = self.input("uphill anchor distance") == 0.0
        both = (FOOT, UP) if is_shared else ()
        found = []
        if anchor == FOOT or anchor in both:
            states = [*self.row.states, *self.row.floors]
            for end in ("least", "largest"):
                at = self.find_states(f"{end} direction at the foot", states)
                found += [math.atan2(s["fy"], s["fx"]) for s in at]
        if anchor != FOOT or is_shared:
            is_splayed = self.input("guys on each side of the post") == 2
            splay = self.input("splay of the guys") if is_splayed else 0.0
            beta, place = math.radians(splay), 3 if anchor == DOWN else 2
            sign = -1.0 if anchor == DOWN else 1.0
            for inclination in self.list_inclinations():
                points = self.place(inclination)
                x, y = (points[0][i] - points[place][i] for i in (0, 1))
                rises = math.sin(math.atan2(y, sign * x)) * math.cos(beta)
                found.append(math.asin(rises))
        least, largest = math.degrees(min(found)), math.degrees(max(found))
        self.same(f"{anchor} least", one["αmin"], least)
        self.same(f"{anchor} largest", one["αmax"], largest)
        name = f"{anchor.lower()} axis"
        axis = self.input(name)
        axis = 0.5 * (least + largest) if axis is None else axis
        self.same(f"{anchor} axis", one["α0"], axis)
        angle = max(abs(one["αmin"] - one["α0"]), abs(one["αmax"] - one["α0"]))
        self.same(f"{anchor} delta", one["δ"], angle, 1e-3)
        share = self.share if anchor == FOOT or anchor in both else 0.0
        cosine = math.cos(math.radians(angle)) / math.hypot(1.0, share)
        turned = math.degrees(math.acos(min(cosine, 1.0)))
        self.same(f"{anchor} delta'", one["δ'"], turned, 1e-3)

    def tell(self, line):
        """The table of checks says the same, rounded."""
        end = ", end of the row"
        titles = {one["Check"].removesuffix(end) for one in self.row.checks}
        title = max((one for one in titles if line[0].startswith(one)), key=len)
        for one in self.row.checks:
            cell = line[3] if one["Check"].endswith(end) else line[2]
            if one["Check"].removesuffix(end) == title and cell != "-":
                self.compare_rounded(line[1], cell, one)

    def require(self, title, reason):
        """Sentences of the further requirements have their numbers."""
        if "The net height" in reason:
            height, needed = list_numbers(reason)[:2]
            ratio = self.value("Net height over snow thickness")
            thickness = self.input("snow thickness") or self.thickness
            self.same("net height", height, self.height)
            self.same("needed", needed, max(1.0, ratio) * thickness)
        if "The pull turns by up to" in reason:
            angle, most = list_numbers(reason)[:2]
            found = [t["δ'"] for t in self.row.turns if title.startswith(t["Anchor"])]
            self.holds("direction", any(abs(t - angle) < 6e-3 for t in found), angle)
            limit = self.value("A rope anchor turns")
            self.same("limit of the direction", most, limit)

    def compare_rounded(self, resistance, cell, one):
        """A cell reads ``symbol verdict ratio low to high E d demand; ...``."""
        before, _, after = cell.partition("E d ")
        demand = after.partition(";")[0]
        for shown, key in ((demand, "Ed"), (resistance, "Rd")):
            near = 0.0501 + 6e-5 * (one[key] or 0.0)
            name = f"{one['Check']} {key} as shown"
            self.same(name, read_number(shown), one[key], near)
        if one["μ"] is not None:
            used = list_numbers(before)[0]
            self.same(f"{one['Check']} mu as shown", used, one["μ"], 0.00056)


def work_out_bar(told):
    *diameters, strength = list_numbers(told.replace("π/4", "π"))
    area = math.pi / 4 * (diameters[0] ** 2 - sum(d**2 for d in diameters[1:]))
    return area * strength / 1e3


def work_out_pull_out(told):
    if told.startswith("min("):
        mean, on_mean, least, on_least = list_numbers(told)[:4]
        return min(mean / on_mean, least / on_least)
    diameter, length, stress = list_numbers(told)[:3]
    return math.pi * diameter / 1e3 * length * stress


def work_out_rope(told):
    factor, diameter, grade, loss = list_numbers(told)[:4]
    return factor * diameter**2 * grade * loss / 1e3


def work_out_bearing(told):
    length, width, stress = list_numbers(told)[:3]
    return length * width * stress


def work_out_buckling(told):
    _, area, strength = list_numbers(told)[:3]
    modulus, second, length = map(
        float,
        re.search(r"π² · ([\d.]+) MPa · ([\d.]+) cm⁴ / \(([\d.]+) m\)²", told).groups(),
    )
    alpha = float(re.search(r"α = ([\d.]+)", told).group(1))
    critical = math.pi**2 * modulus * 1e3 * second * 1e-8 / length**2  # kN
    slender = math.sqrt(area * strength / 10 / critical)
    phi = 0.5 * (1 + alpha * (slender - 0.2) + slender**2)
    root = math.sqrt(max(phi**2 - slender**2, 0.0))
    reduction = min(1.0, 1 / (phi + root)) if slender > 0.2 else 1.0
    return reduction * area * strength / 10
