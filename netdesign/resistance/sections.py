"""Area, second moments and section moduli of hollow sections from their dimensions."""

from __future__ import annotations

import math


def compute_tube(diameter: float, wall: float) -> dict[str, float]:
    """Values of a round tube, the quantities of `Product`; THEORY.md, (R7).

    Parameters
    ----------
    diameter, wall : float
        Outer diameter and wall [m].

    Returns
    -------
    dict of str to float
        In m, m2, m3, m4.
    """
    inner = diameter - 2.0 * wall
    area = math.pi / 4.0 * (diameter**2 - inner**2)
    second = math.pi / 64.0 * (diameter**4 - inner**4)
    ends = {"outer_diameter": diameter, "inner_diameter": inner}
    return ends | _name(diameter, diameter, area, second, second)


def compute_box(
    depth: float, width: float, wall: float, *, outer: float, inner: float
) -> dict[str, float]:
    """Values of a rectangular tube with round corners; THEORY.md, (R13) and (R14).

    Parameters
    ----------
    depth, width, wall : float
        Outer sides and wall [m].
    outer, inner : float
        Radii of the corners [m].

    Returns
    -------
    dict of str to float
        As of `compute_tube`.
    """
    whole = _compute_rounded(depth, width, outer)
    hole = _compute_rounded(depth - 2.0 * wall, width - 2.0 * wall, inner)
    area, strong, weak = (a - b for a, b in zip(whole, hole, strict=True))
    return _name(depth, width, area, strong, weak)


def _compute_rounded(depth: float, width: float, radius: float) -> list[float]:
    """A, I_y and I_z of a rectangle with round corners, eq. (R13)."""
    cut = (1.0 - math.pi / 4.0) * radius**2
    distance = (10.0 - 3.0 * math.pi) / (12.0 - 3.0 * math.pi) * radius
    own = 1.0 / 3.0 - math.pi / 16.0 - 1.0 / (36.0 - 9.0 * math.pi)
    return [depth * width - 4.0 * cut] + [
        b * h**3 / 12.0 - 4.0 * (own * radius**4 + cut * (h / 2.0 - distance) ** 2)
        for h, b in ((depth, width), (width, depth))
    ]


def _name(
    depth: float, width: float, area: float, strong: float, weak: float
) -> dict[str, float]:
    return {
        "depth": depth,
        "width": width,
        "area": area,
        "second_moment_strong": strong,
        "second_moment_weak": weak,
        "section_modulus_strong": 2.0 * strong / depth,
        "section_modulus_weak": 2.0 * weak / width,
    }
