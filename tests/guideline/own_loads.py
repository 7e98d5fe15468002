"""The guideline's load and what it does to a support, worked without the program.

Bisection in the place of Newton's method, two equations in the place of vectors; kN, m
and t, angles in degrees.
"""

import math
from dataclasses import dataclass

TILT = 15.0


@dataclass(frozen=True)
class Row:
    """A net row of the built-in example."""

    slope: float
    typed: float  # snow thickness
    net: float  # D_K
    stiffness: float
    slack: float
    glide: float
    altitude: float
    spacing: float
    uphill: float
    downhill: float

    @property
    def full_height(self) -> float:
        """H_K."""
        return self.net / math.cos(math.radians(self.slope))


ROWS = {
    "R1": Row(30, 2.5, 2.5, 8000, 0.05, 1.2, 1870, 4.0, 2.5, 2.5),
    "R2": Row(35, 2.8, 3.0, 10000, 0.06, 1.2, 1880, 3.5, 3.0, 3.0),
    "R4": Row(
        *(40, 3.9 * math.cos(math.radians(40)), 3.5, 15000, 0.08, 1.8),
        *(1860, 3.0, 4.0, 3.5),
    ),
    "R5": Row(45, 3.5, 4.0, 20000, 0.08, 2.4, 1840, 3.0, 4.5, 4.0),
}


def find_altitude_factor(row):
    return 1.0 + 0.02 * (row.altitude - 1500.0) / 100.0


def press(row, rho, height):
    """S'_N on the net of snow of a density."""
    creep = 0.54 + 1.06 * rho - 1.86 * rho**2 + 2.50 * rho**3
    creep *= math.sin(math.radians(2.0 * row.slope))
    return 0.8 * rho * 10.0 * height**2 / 2.0 * creep * row.glide


def press_by_form(row):
    """S'_N of the dimensioning form."""
    return row.glide * find_altitude_factor(row) * row.full_height**2 * 0.8


def load(row, lean, height, case, form, normal):
    """Resultant downslope and into the ground, and the loaded share of the net."""
    psi, density = math.radians(row.slope), 0.27 * find_altitude_factor(row)
    share = min(height * math.cos(psi) / row.net, 1.0) * (1.0 if case == 1 else 0.77)

    filled = min(row.net, height * math.cos(psi))
    prism = density * 10.0 * filled**2 / 2.0 * math.tan(math.radians(lean))
    along = press(row, density, height)
    if form == "dimensioning":
        along = press_by_form(row)
    down = along * normal / (row.glide * math.tan(psi)) + prism * math.cos(psi)
    return along + prism * math.sin(psi), down, share


def pull(row, lean, along, down, share):
    """Pulls of the foot and of the head, (downslope, out of the ground) each."""
    sine, cosine = math.sin(math.radians(lean)), math.cos(math.radians(lean))
    across = along * cosine + down * sine
    v1, v2 = 1.0 - share / 2.0, share / 2.0
    square = share * (v1**2 - v1 * v2 + v2**2) / 3.0 + (1.0 - share) * v2**2
    low, high = 0.0, 1e5
    for _ in range(100):
        tension = (low + high) / 2.0
        has = row.slack + (1.0 + row.slack) * tension / row.stiffness
        too_little = square * across**2 / 2.0 > tension**2 * has
        low, high = (tension, high) if too_little else (low, tension)
    foot = (v1 * along + tension * sine, -v1 * down + tension * cosine)
    head = (v2 * along - tension * sine, -v2 * down - tension * cosine)
    return foot, head


def support(row, lean, foot, head):
    """Foot anchor, uphill guy, post, downhill guy and pull on the head."""
    x_head = row.net * math.tan(math.radians(lean))
    x_base = x_head - row.net * math.tan(math.radians(TILT))
    px, py = (row.spacing * one for one in head)
    ux, uy = math.sin(math.radians(TILT)), math.cos(math.radians(TILT))
    tensions = []
    for x_anchor in (-row.uphill, x_base + row.downhill):
        length = math.hypot(x_anchor - x_head, row.net)
        gx, gy = (x_anchor - x_head) / length, -row.net / length
        turn = gx * uy - gy * ux
        tensions.append(((py * ux - px * uy) / turn, (gy * px - gx * py) / turn))
    (uphill, post), (downhill, other) = tensions
    if uphill < 0.0:
        uphill, post = 0.0, other
    else:
        downhill = 0.0
    size = row.spacing * math.hypot(*foot)
    return size, uphill, post, downhill, math.hypot(px, py)


def find_largest(row, form, *, cases=(1, 2), normals=(0.35,), heights=None, step=0.25):
    """Largest of each force over the inclinations 25 to 35 degrees."""
    found = [0.0] * 5
    for number in range(round(10.0 / step) + 1):
        lean = 25.0 + number * step
        for height in heights or (row.full_height,):
            for case in cases:
                for normal in normals:
                    ends = pull(row, lean, *load(row, lean, height, case, form, normal))
                    forces = support(row, lean, *ends)
                    found = [max(pair) for pair in zip(found, forces, strict=True)]
    return found
