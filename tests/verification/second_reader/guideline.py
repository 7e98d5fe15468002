"""The guideline's load on a net as a closed form of its own: forces on one support."""

import math
from dataclasses import dataclass

from tests.verification.second_reader import statics

GRAVITY = 10.0
SETTLED = 0.77  # of the height, in load case 2
FLEXIBLE = 0.8
SHARES = (0.2, 0.35, 0.5)  # of S'_Q


@dataclass(frozen=True)
class Row:
    """What the guideline's load of a row follows from."""

    slope: float
    height: float  # D_K, normal to the slope
    snow: float  # H, vertical
    glide: float
    altitude: float
    spacing: float
    tilt: float
    uphill: float
    downhill: float
    slack: float
    stiffness: float
    inclination: tuple

    @property
    def factor(self):
        """f_c of the altitude [m]."""
        return 1.0 + 0.02 * (min(max(self.altitude, 1500.0), 3000.0) - 1500.0) / 100.0

    @property
    def full(self):
        """H_K [m]."""
        return self.height / math.cos(self.slope)


def creep(density, slope):
    cubic = 0.54 + density * (1.06 + density * (-1.86 + density * 2.50))
    return cubic * math.sin(2.0 * slope)


def press_along(row, snow):
    """Pressure of the snow along the slope on a net [kN/m]."""
    own = 0.27 * row.factor * GRAVITY * snow**2 / 2.0
    return FLEXIBLE * own * creep(0.27 * row.factor, row.slope) * row.glide


def press(row, snow, inclination, share, *, dimensioned=False):
    """Resultant (X, Y) per metre of row [kN/m]."""
    density = 0.27 * row.factor
    if dimensioned:
        snow = row.full
        along = row.glide * row.factor * snow**2 * FLEXIBLE
    else:
        along = press_along(row, snow)
    towards = along * share / (row.glide * math.tan(row.slope))
    deep = min(row.height, snow * math.cos(row.slope))
    prism = density * GRAVITY * deep**2 / 2.0 * math.tan(inclination)
    return (
        along + prism * math.sin(row.slope),
        -towards - prism * math.cos(row.slope),
    )


def find_tension(row, load, inclination, part):
    """Chord tension of a cable of slack and stretch, load on a lower part [kN/m]."""
    across = load[0] * math.cos(inclination) - load[1] * math.sin(inclination)
    first, last = 1.0 - part / 2.0, part / 2.0  # shear over Q at foot and head
    mean = part * (first**2 - first * last + last**2) / 3.0 + (1.0 - part) * last**2
    low, high = 0.0, abs(across) * math.sqrt(mean / (2.0 * row.slack))
    for _ in range(200):  # bisection
        tension = (low + high) / 2.0
        needs = mean * across**2 / (2.0 * tension**2)
        gets = row.slack + (1.0 + row.slack) * tension / row.stiffness
        low, high = (tension, high) if needs > gets else (low, tension)
    return (low + high) / 2.0


def pull(row, load, inclination, part):
    """Pulls of the net on foot and head per metre of row, (X, Y) each [kN/m]."""
    tension = find_tension(row, load, inclination, part)
    chord = (math.sin(inclination), math.cos(inclination))
    foot = [
        (1.0 - part / 2.0) * one + tension * e
        for one, e in zip(load, chord, strict=True)
    ]
    head = [part / 2.0 * one - tension * e for one, e in zip(load, chord, strict=True)]
    return foot, head


def bring(row, load, inclination, part):
    """Forces that one metre's pulls bring a support inside the row [kN]."""
    foot, head = pull(row, load, inclination, part)
    section = statics.place(row.height, inclination, row.tilt, row.uphill, row.downhill)
    on_head = [row.spacing * one for one in head]
    post, up, down = statics.hold(on_head, section)
    return {
        "foot_anchor": row.spacing * math.hypot(*foot),
        "head": math.hypot(*on_head),
        "uphill_guy": up,
        "downhill_guy": down,
        "post": post,
        "post_base": max(-post * section.post[1], 0.0),
    }


def find_largest(row, *, heights, shares=SHARES, parts=(1.0, SETTLED),
                 dimensioned=False, turns=41):  # fmt: skip
    """Largest force of each member over inclinations, heights, load cases [kN]."""
    largest = {}
    low, high = row.inclination
    for turn in range(turns):
        inclination = low + (high - low) * turn / (turns - 1)
        for snow in heights:
            filled = min(1.0, snow * math.cos(row.slope) / row.height)
            for share in shares:
                load = press(row, snow, inclination, share, dimensioned=dimensioned)
                for part in parts:
                    found = bring(row, load, inclination, part * filled)
                    for name, force in found.items():
                        largest[name] = max(largest.get(name, 0.0), float(force))
    return largest


def find_floor(row, *, dimensioned, parts=8):
    """Largest force of each member: heights up to H_K, both load cases, both forms."""
    top = max(row.snow, row.full)
    heights = [row.snow + (top - row.snow) * k / parts for k in range(parts + 1)]
    found = [find_largest(row, heights=heights)]
    if dimensioned:
        found.append(find_largest(row, heights=[row.full], dimensioned=True))
    return {name: max(one[name] for one in found) for name in found[0]}


def press_plane(row, density=None):
    """Mean pressure on a plane across the slope, without f_s [kPa]."""
    snow, part = (row.full, SETTLED) if density is None else (row.snow, 1.0)
    density = density or 0.27 * row.factor
    weight = density * GRAVITY * snow**2 / 2.0
    along = weight * creep(density, row.slope) * row.glide
    return along / (part * snow * math.cos(row.slope))
