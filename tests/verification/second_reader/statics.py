"""Equilibrium of one support, from points in space; own derivation, no program code.

X down the slope, Y out of the ground, Z along the row; kN, m, rad. The net's foot is
the origin, the head stands D_K above it and leans by the net's inclination.
"""

import itertools
import math
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Section:
    """Points of a support in the plane across the row, [m]."""

    head: tuple
    base: tuple
    uphill: tuple
    downhill: tuple

    def towards(self, point):
        """Unit vector from the head to a point."""
        x, y = point[0] - self.head[0], point[1] - self.head[1]
        return x / math.hypot(x, y), y / math.hypot(x, y)

    @property
    def post(self):
        return self.towards(self.base)

    @property
    def guy(self):
        return self.towards(self.uphill)

    @property
    def lower_guy(self):
        return self.towards(self.downhill)


def place(height, inclination, tilt, uphill, downhill):
    """Section of a net at an inclination, its post at a tilt from the slope normal."""
    head = (height * math.tan(inclination), height)
    base = (head[0] - height * math.tan(tilt), 0.0)
    return Section(head, base, (-uphill, 0.0), (base[0] + downhill, 0.0))


def cross(one, other):
    return one[0] * other[1] - one[1] * other[0]


def dot(one, other):
    return one[0] * other[0] + one[1] * other[1]


def hold(pull, section):
    """Compression, uphill and downhill tension that hold a pull on the head [kN].

    P = C p - T g, with one guy g that pulls and the post p (both from the head).
    """
    for place_, guy in ((1, section.guy), (2, section.lower_guy)):
        matrix = np.array([section.post, [-guy[0], -guy[1]]]).T
        compression, tension = np.linalg.solve(matrix, pull)
        if tension >= -1e-12 * math.hypot(*pull):
            forces = [compression, 0.0, 0.0]
            forces[place_] = max(tension, 0.0)
            return tuple(forces)
    raise ValueError("no guy holds this pull")


def share_between_guys(section):
    """Weights of a load along the row that one guy of each side and the post hold.

    Of H = S cot(beta) the two loaded guys have in-plane parts t_u + t_d = H with no
    force across the post: t_u (u x p) + t_d (d x p) = 0. The post gets what they
    press on it along its axis.
    """
    post = section.post
    up, down = (abs(cross(guy, post)) for guy in (section.guy, section.lower_guy))
    uphill, downhill = down / (up + down), up / (up + down)
    pressed = uphill * dot(section.guy, post) + downhill * dot(section.lower_guy, post)
    return uphill, downhill, pressed


def pull_of_end_guy(angle):
    """Pull (X, Y) on the head of an end guy that holds 1 kN along the row [kN]."""
    return 0.0, -math.tan(angle)


def reach_of_end_guy(section, angle):
    """Distance of the end guy's anchor, abreast of the head, along the row [m]."""
    return section.head[1] / math.tan(angle)


@dataclass(frozen=True)
class Bar:
    """Bar from the head to an anchor in space; a rope carries no compression."""

    name: str
    end: tuple
    stiffness: float  # EA [kN]
    is_rope: bool = True


def solve_truss(head, bars, load):
    """Forces of the bars, tension positive [kN]: the set whose ropes all pull."""
    spans = np.array([bar.end for bar in bars], float) - np.array(head, float)
    lengths = np.linalg.norm(spans, axis=1)
    units = spans / lengths[:, None]
    springs = np.array([bar.stiffness for bar in bars]) / lengths
    is_post = np.array([not bar.is_rope for bar in bars])
    choices = [(True, False) if bar.is_rope else (True,) for bar in bars]
    for works in map(np.array, itertools.product(*choices)):
        matrix = (units[works].T * springs[works]) @ units[works]
        if np.linalg.cond(matrix) > 1e9:
            continue
        stretch = -units @ np.linalg.solve(matrix, load)
        if (((stretch >= -1e-12) == works) | is_post).all():
            forces = np.where(works, springs * stretch, 0.0)
            return dict(zip((bar.name for bar in bars), forces, strict=True))
    raise ValueError("no set of ropes holds this head")


def build_end_truss(section, splay, ropes, *, reach):
    """Bars of the support at the end of a row, which goes on towards +Z."""
    bars = []
    for name, point in (("uphill", section.uphill), ("downhill", section.downhill)):
        flat = math.hypot(point[0] - section.head[0], section.head[1])
        for side, word in ((-1.0, "outer"), (1.0, "inner")):
            end = (point[0], 0.0, side * flat * math.tan(splay))
            bars.append(Bar(f"{word} {name}", end, ropes[name]))
    bars.append(Bar("end guy", (section.head[0], 0.0, -reach), ropes["end guy"]))
    bars.append(Bar("post", (*section.base, 0.0), ropes["post"], is_rope=False))
    return bars
