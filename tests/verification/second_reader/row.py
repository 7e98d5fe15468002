"""Checks of a net row redone from plain numbers, with nothing of the program."""

import itertools
import math
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from tests.verification.second_reader import guideline, resistance, statics
from tests.verification.second_reader.cells import Cells
from tests.verification.second_reader.widths import spread_end_effect

FLOORS = {"uphill_anchor": "uphill_guy", "downhill_anchor": "downhill_guy"}
BOUNDS = ("low_kN", "value_kN", "high_kN")


def read_profile(folder):
    """Values by id, and tables by id, of all files of a profile."""
    values, tables = {}, {}
    for path in sorted(Path(folder).glob("*.toml")):
        for kind, listed in tomllib.loads(path.read_text(encoding="utf-8")).items():
            if kind == "anchors":
                values["anchors.sum"] = listed["sum"]
            elif kind == "table":
                tables |= {one["id"]: one["rows"] for one in listed}
            elif kind in ("limit", "factor", "value"):
                values |= {one["id"]: one["value"] for one in listed}
    return values, tables


@dataclass
class Redone:
    """Demand and resistance of one check at low end, value, high end [kN]."""

    demand: np.ndarray  # E_k
    resistance: float | np.ndarray  # R_k
    action: float
    factor: float

    @property
    def design(self):
        return self.action * self.demand

    @property
    def held(self):
        return np.broadcast_to(self.resistance, 3) / self.factor

    @property
    def used(self):
        return self.design / self.held[::-1]


@dataclass
class Row:
    """One net row with its solved forces."""

    cells: Cells
    values: dict
    tables: dict
    study: dict
    net: dict = field(init=False)
    end: dict = field(init=False)
    _floor: dict | None = field(init=False, default=None)

    def __post_init__(self):
        self.net = self.cells.find("Nets", "id", self.study["id"])
        self.end = self.cells.find("Ends", "row", self.study["id"])
        self.solved = {
            one["quantity"]: np.array([one[bound] for bound in BOUNDS])
            for one in self.study["forces"]
        }
        held = self.study["held_sideways"]
        self.head = np.array([held[f"pull{end}_kN"] for end in ("_low", "", "_high")])

    def find_type(self, member, position):
        """Type of a member, by its id: at the row's end that of sheet Ends."""
        if position == "edge" and member in self.end:
            return self.end[member]
        return self.net[member]

    # -- geometry ---------------------------------------------------------------

    def angle(self, key):
        return math.radians(self.net[key])

    @property
    def inclinations(self):
        low, high = self.cells.ranges["inclination"]
        return math.radians(low), math.radians(high)

    @property
    def sections(self):
        """Sections at both ends of the net's inclination."""
        net = self.net
        return [
            statics.place(
                net["net_height"],
                inclination,
                self.angle("post_tilt"),
                net["uphill_anchor_distance"],
                net["downhill_anchor_distance"],
            )
            for inclination in self.inclinations
        ]

    @property
    def snow(self):
        """Vertical height [m]."""
        thick = self.net.get("snow_thickness")
        if thick is None:
            return self.net["snow_height"]
        return thick / math.cos(self.angle("slope_angle"))

    @property
    def glide(self):
        return max(self.net.get("glide_factor", 1.0), 1.2)

    # -- widths -----------------------------------------------------------------

    @property
    def end_effect(self):
        """f_R and l_R [m] of the gap."""
        values, gap = self.values, self.net["gap"]
        cap = values["end.cap_constant"] + values["end.cap_per_glide"] * self.glide
        longest = values["end.length_cap"] * self.net["net_height"]
        if gap >= values["end.isolated_gap"]:
            return cap, longest
        grows = values["end.constant"] + values["end.per_glide"] * self.glide
        return (
            min(grows * gap / 2.0, cap),
            min(values["end.length"] * gap / 2.0, longest),
        )

    @property
    def posts(self):
        """Numbers of posts that the row may have: both ends count in short ones."""
        count = self.net.get("post_count")
        return (2, 3, 4, 5, 99) if count is None else (count,)

    @property
    def widths(self):
        """Loaded widths of the last, the second and the supports inside [m]."""
        spacing = self.net["post_spacing"]
        ratio, length = self.end_effect
        extra = [*spread_end_effect(ratio, length, spacing), *[0.0] * 100]
        found = {
            "edge": spacing / 2.0
            + ratio * length
            + max(extra[count - 1] for count in self.posts),
            "intermediate": spacing,
        }
        longer = [count for count in self.posts if count > 2]
        if longer:
            more = max(extra[count - 2] for count in longer)
            found["second"] = spacing + extra[1] + more
        return found

    @property
    def shared_widths(self):
        """Widths of anchors that two supports share: 0|1, 1|2, inside [m]."""
        last, inside = (self.widths[one] for one in ("edge", "intermediate"))
        second = self.widths.get("second", last)
        extra = [*spread_end_effect(*self.end_effect, inside), *[0.0] * 100]
        third = second
        if 4 not in self.posts:
            (count,) = self.posts
            third = inside + extra[2] + (extra[count - 3] if count > 4 else 0.0)
        return {
            "edge": max(last, (last + second) / 2.0),
            "second": (second + third) / 2.0,
            "intermediate": inside,
        }

    def grow(self, width):
        """Width over the post spacing."""
        return width / self.net["post_spacing"]

    # -- ropes ------------------------------------------------------------------

    def find_end_effect(self, *, ends=1):
        """Share of the end effect in a border rope's pull in the last bay (P8)."""
        ratio, length = self.end_effect
        spacing = self.net["post_spacing"]
        return ends * (ratio * length / spacing if length <= spacing / 2.0 else ratio)

    @property
    def ends(self):
        """Ends of the row that load its last bay."""
        return 2 if min(self.posts) == 2 else 1

    def find_along(self, rope):
        """Pull of a border rope along the row at the end [kN]."""
        inside = self.solved[f"panel_{rope}_along"] * self.floor_scale(rope)
        return inside * (1.0 + self.find_end_effect(ends=self.ends))

    def find_tension(self, rope):
        """Tension of a border rope in the last bay (P9)."""
        ratio, length = self.end_effect
        spacing = self.net["post_spacing"]
        inside = self.solved[f"panel_{rope}_tension"] * self.floor_scale(rope)
        added = 2.0 * ratio * length / spacing if length <= spacing / 2.0 else ratio
        return inside * (1.0 + self.ends * added)

    def floor_scale(self, rope):
        """The guideline's pull on foot or head over the panel's, at least 1 (B4)."""
        name = {"lower": "lower_rope", "upper": "ridge_rope"}[rope]
        return self.study["floor"][name]

    @property
    def unbalanced(self):
        """Pull along the row that the second head and foot hold besides, (A5) [kN]."""
        if self.end.get("ropes_at_supports") == "slide":
            return 0.0, 0.0
        added = self.find_end_effect()
        return tuple(
            self.solved[f"panel_{rope}_along"] * self.floor_scale(rope) * added
            for rope in ("upper", "lower")
        )

    @property
    def end_guy(self):
        """Pull along the row at the end, and angle of the guy to it."""
        return self.find_along("upper"), math.radians(self.end["end_guy_angle"])

    def push(self):
        """What the end guy's pull across the row brings post and uphill guy [kN]."""
        along, angle = self.end_guy
        across = statics.pull_of_end_guy(angle)
        found = [statics.hold(across, section) for section in self.sections]
        post, guy, lower = np.array(found).max(axis=0)
        return along * post, along * guy, along * lower

    # -- demands ----------------------------------------------------------------

    def demand(self, member, law, pushed=0.0):
        """Largest of section, panel and guideline, by a law of force and pull."""
        floor = np.full(3, self.floor[FLOORS.get(member, member)])
        section = law(self.solved[member], self.head, pushed)
        panel = law(self.solved[f"panel_{member}"], self.head, pushed)
        guided = law(floor, np.full(3, self.floor["head"]), pushed)
        return np.max([section, panel, guided], axis=0)

    @property
    def guideline_row(self):
        net = self.net
        return guideline.Row(
            slope=self.angle("slope_angle"),
            height=net["net_height"],
            snow=self.snow,
            glide=self.glide,
            altitude=net["altitude"],
            spacing=net["post_spacing"],
            tilt=self.angle("post_tilt"),
            uphill=net["uphill_anchor_distance"],
            downhill=net["downhill_anchor_distance"],
            slack=net["slack"],
            stiffness=net["net_stiffness"],
            inclination=self.inclinations,
        )

    @property
    def floor(self):
        """The guideline's largest forces on a support inside the row [kN]."""
        if self._floor is None:
            self._floor = guideline.find_floor(
                self.guideline_row, dimensioned="load.dimensioning" in self.values
            )
        return self._floor

    def load_foot(self, position):
        width = self.grow(self.widths[position])
        share = self.values["lateral.share"]
        besides = self.unbalanced[1] if position == "second" else 0.0

        def law(force, _, __):
            return np.hypot(force * width, share * force * width + besides)

        return self.demand("foot_anchor", law)

    def share(self, side):
        """c of (S17), over both ends of the inclination."""
        place = {"uphill": 0, "downhill": 1}[side]
        shares = [statics.share_between_guys(one)[place] for one in self.sections]
        return max(0.5, *shares)

    def push_guy(self, side, position):
        """What the end guy's pull brings one of two guys [kN]."""
        if position != "edge":
            return 0.0
        pushed = self.push()[1 if side == "uphill" else 2]
        return pushed / (2.0 * math.cos(self.angle("guy_splay")))

    def unbalance_guy(self, side, position):
        """What the ropes' unbalanced pull brings one guy [kN]."""
        if position != "second":
            return 0.0
        part = self.share(side) / math.sin(self.angle("guy_splay"))
        return part * self.unbalanced[0]

    def share_by_truss(self, side, position):
        """The outer guy of the end by a linear truss, as the program solved it [kN]."""
        if position != "edge":
            return 0.0
        return self.study["end_guy"][f"{side}_guy_kN"]

    def bracket_truss(self):
        """Outer guys of the end by trusses of the least and the largest pull [kN]."""
        splay, width = self.angle("guy_splay"), self.grow(self.widths["edge"])
        held = self.study["held_sideways"]
        least = held["floor_pull_kN"]  # on a head, (B4)
        most = max(least, held["pull_kN"])
        along, angle = self.end_guy
        pulls = [
            (self.solved[f"{model}uphill_guy"], self.solved[f"{model}post"])
            for model in ("", "panel_")  # by the section, and by the panel
        ]
        hidden = max(one[2] / one[1] for one in (along, *itertools.chain(*pulls)))
        low, high = ({"uphill": [], "downhill": []} for _ in "ab")
        for section in self.sections:
            reach = statics.reach_of_end_guy(section, angle)
            for ropes in self.list_stiffnesses():
                bars = statics.build_end_truss(section, splay, ropes, reach=reach)

                def find(pull, bars=bars, section=section):
                    load = (*(width * pull), along[1])
                    found = statics.solve_truss((*section.head, 0.0), bars, load)
                    return found["outer uphill"], found["outer downhill"]

                for guy, post in pulls:
                    pull = post[1] * np.array(section.post)
                    pull -= guy[1] * np.array(section.guy)
                    raised = max(1.0, least / np.hypot(*pull))
                    low["uphill"].append(find(raised * pull)[0])
                    low["downhill"].append(find(raised * pull)[1])
                # whatever its direction, no pull loads the guy more than along it
                along_guy = -most * np.array(section.guy)
                high["uphill"].append(hidden * find(along_guy)[0])
                high["downhill"].append(hidden * find(0.0 * along_guy)[1])
        return tuple({k: max(one[k]) for k in one} for one in (low, high))

    def list_stiffnesses(self):
        """EA of guys, end guy and post [kN]: ropes whose EA nobody types are alike."""
        members = {
            "uphill": "uphill_guy",
            "downhill": "downhill_guy",
            "end guy": "end_guy",
        }
        typed, force = {}, {}
        for name, member in members.items():
            cells = self.cells.find("Ropes", "id", self.find_type(member, "edge"))
            force[name] = cells["rope"]
            if cells.get("axial_stiffness") is not None:
                typed[name] = cells["axial_stiffness"]
        multiples = [typed[name] / force[name] for name in typed] or [25.0, 160.0]
        post = self.cells.find("Posts", "id", self.find_type("post", "edge"))
        area = post["area"] * 1e-4
        return [
            {name: typed.get(name, one * force[name]) for name in members}
            | {"post": area * resistance.STEEL}
            for one in multiples
        ]

    def load_guy(self, side, position):
        """One of two splayed guys."""
        splay = self.angle("guy_splay")
        width = self.grow(self.widths[position])
        part = self.share(side) / math.sin(splay) * self.values["lateral.share"]
        besides = self.unbalance_guy(side, position)

        def law(force, pull, pushed):
            one = force / (2.0 * math.cos(splay)) + part * pull
            return one * width + besides + pushed

        found = self.demand(f"{side}_guy", law, self.push_guy(side, position))
        return np.maximum(found, self.share_by_truss(side, position))

    @property
    def is_scalar(self):
        return self.values.get("anchors.sum") == "scalar"

    def load_anchor(self, side, position):
        """Anchor that two neighbouring supports share, a guy of each (S20)."""
        splay = self.angle("guy_splay")
        width = self.grow(self.shared_widths[position])
        part = 2.0 * self.share(side) / math.sin(splay) * self.values["lateral.share"]
        besides = self.unbalance_guy(side, position)
        guys = 2.0 if 4 in self.posts else 1.0  # each of the two is beside an end

        def law(force, pull, pushed):
            guy, both = besides + pushed, guys * besides + pushed
            if self.is_scalar:  # the two guys' forces as numbers
                return (force / math.cos(splay) + part * pull) * width + both
            in_section = force * width + both * math.cos(splay)
            return np.hypot(in_section, part * pull * width + guy * math.sin(splay))

        found = self.demand(f"{side}_anchor", law, self.push_guy(side, position))
        return np.maximum(found, self.share_by_truss(side, position))

    def load_post(self, position, member="post"):
        """Post or base: what the load along the row adds is (S18)."""
        splay = self.angle("guy_splay")
        width = self.grow(self.widths[position])
        weight = max(statics.share_between_guys(one)[2] for one in self.sections)
        share = self.values["lateral.share"]
        besides = self.unbalanced[0] if position == "second" else 0.0
        pushed = 0.0
        if position == "edge":
            pushed = self.push()[0]
            if member == "post_base":
                pushed = pushed * math.cos(self.angle("post_tilt"))

        def law(force, pull, push):
            along = (share * pull * width + besides) / math.tan(splay)
            return force * width + weight * along + push

        return self.demand(member, law, pushed)

    def load_mesh(self):
        ratio, _ = self.end_effect
        pulls = max(self.floor["foot_anchor"], self.floor["head"])
        floor = pulls / self.net["post_spacing"]
        forces = self.solved["mesh"], np.full(3, floor)
        return np.max(forces, axis=0) * (1.0 + ratio)
