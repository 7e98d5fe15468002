"""Resistances of members from their dimensions; own formulas and roots, kN, m, rad."""

import math
from bisect import bisect_right

import numpy as np

# Loss of a face in natural ground [mm] after years (EN 14199, Annex D), and of others.
YEARS = (0.0, 5.0, 25.0, 50.0, 75.0, 100.0)
LOSS = {"natural": (0.0, 0.0, 0.30, 0.60, 0.90, 1.20)}
SHACKLE = ((0, 1.0), (10, 0.85), (20, 0.75), (30, 0.70), (45, 0.60), (55, 0.55),
           (70, 0.50), (90, 0.50))  # fmt: skip
IMPERFECTION = {"a0": 0.13, "a": 0.21, "b": 0.34, "c": 0.49, "d": 0.76}
STEEL = 210e6  # kPa
WATER = 10.0  # kN/m3


def interpolate(x, xs, ys):
    place = min(max(bisect_right(xs, x) - 1, 0), len(xs) - 2)
    share = (x - xs[place]) / (xs[place + 1] - xs[place])
    return ys[place] + share * (ys[place + 1] - ys[place])


def lose(soil, years):
    """Loss of one face [m]."""
    return interpolate(years, YEARS, LOSS[soil]) / 1e3


def weaken_shackle(angle):
    """Share of its strength under a pull at an angle to its line."""
    degrees, shares = zip(*SHACKLE, strict=True)
    return interpolate(math.degrees(angle), degrees, shares)


def find_root(function, low, high):
    """Where a falling function is zero."""
    for _ in range(200):
        middle = (low + high) / 2.0
        low, high = (middle, high) if function(middle) > 0.0 else (low, middle)
    return (low + high) / 2.0


def compute_bar(outer, strength, inner=0.0):
    """N, M and V of a bar or tube, [kN], [kN m], [kN]; strength in kPa."""
    area = math.pi * (outer**2 - inner**2) / 4.0
    modulus = math.pi * (outer**4 - inner**4) / (32.0 * outer)
    sheared = 0.75 * area if inner == 0.0 else 2.0 * area / math.pi
    return area * strength, modulus * strength, sheared * strength / math.sqrt(3.0)


def bend_bar(bar, angle, lever):
    """Pull at an angle to the bar's axis that it holds [kN]."""
    axial, moment, shear = bar

    def rest(pull):
        across = pull * math.sin(angle)
        used = pull * math.cos(angle) / axial + lever * across / moment
        return 1.0 - used - max(2.0 * across / shear - 1.0, 0.0) ** 2

    return find_root(rest, 0.0, axial + moment + shear + 1e3)


def buckle(area, second, length, strength, curve):
    """Characteristic resistance and critical force of a strut [kN]."""
    critical = math.pi**2 * STEEL * second / length**2
    plastic = area * strength
    slender = math.sqrt(plastic / critical)
    phi = (1.0 + IMPERFECTION[curve] * (slender - 0.2) + slender**2) / 2.0
    reduced = 1.0 / (phi + math.sqrt(phi**2 - slender**2))
    return min(reduced, 1.0) * plastic, critical


def combine_moments(snow, first, second):
    """Largest moment of a strut: a parabola of its load on the line of its ends (A6.1).

    M(s) = M_1 + (M_2 - M_1) s + 4 M_s s (1 - s): at its apex, or at an end.
    """
    if snow <= 0.0:
        return max(first, second)
    place = 0.5 + (second - first) / (8.0 * snow)
    if not 0.0 <= place <= 1.0:
        return max(first, second)
    return first + (second - first) * place + 4.0 * snow * place * (1.0 - place)


def compress_bent_post(post, snow, head, foot, factor):
    """Design compression beside the snow's moment and eccentric ends [kN]."""
    buckling, critical, moment = post

    def rest(force):
        bent = combine_moments(snow, force * head, force * foot)
        grown = bent / (moment * (1.0 - force / critical))
        return 1.0 - factor * (force / buckling + grown)

    return find_root(rest, 0.0, critical * (1.0 - 1e-12)) if rest(0.0) > 0.0 else 0.0


def lift_wedge(soil, depth, width, slope, pulls, *, drained):
    """Least pull that lifts a wedge of ground, over its front plane and the pull [kN].

    Two blocks planes through the bond's middle, at theta (front) and theta + 2 phi
    (rear); the wedge moves at theta + phi. ``soil``: c, phi (both design), gamma.
    """
    cohesion, friction, weight = soil
    low, high = pulls

    def resist(theta):
        rear, moves = theta + 2.0 * friction, theta + friction
        area = depth**2 / 2.0 * (1.0 / np.tan(theta) - 1.0 / np.tan(rear))
        planes = depth / np.sin(theta) + depth / np.sin(rear)
        work = weight * np.sin(moves - slope)
        if not drained:
            work -= WATER * math.cos(slope) * np.sin(moves)
        held = width * (cohesion * planes * math.cos(friction) + area * work)
        return divide(held, np.cos(np.clip(moves, low, high) - moves))

    return find_least(resist, (1e-4, math.pi - 2.0 * friction - 1e-4))


def lift_cone(soil, depth, slope, pull, *, drained):
    """Least pull that lifts a cone of ground over a single anchor's bond [kN].

    Its apex is the bond's middle; it opens by phi about the way that it moves, which
    rises at w from the slope and turns by z from the row towards the slope's fall.
    Volume and mantle are those between two lines of the cone's section through its
    axis; ``pull`` is a unit vector (X, Y, Z), Z along the row.
    """
    cohesion, friction, weight = soil
    heavy = weight if drained else weight - WATER

    def resist(rise, turn):
        front, rear = rise - friction, rise + friction
        longer = depth / np.sin(front) + depth / np.sin(rear)
        base = depth / np.tan(front) - depth / np.tan(rear)
        across = depth * math.sin(friction) / np.sqrt(np.sin(front) * np.sin(rear))
        volume = math.pi / 6.0 * depth * base * across
        mantle = math.pi / 2.0 * across * longer
        way = np.cos(rise) * np.sin(turn), np.sin(rise), np.cos(rise) * np.cos(turn)
        held = cohesion * math.cos(friction) * mantle + volume * (
            heavy * math.cos(slope) * way[1] - weight * math.sin(slope) * way[0]
        )
        return divide(held, sum(p * w for p, w in zip(pull, way, strict=True)))

    edge = friction + 1e-4
    return find_least(resist, (edge, math.pi - edge), (-1.57, 1.57), parts=90)


def divide(held, along):
    """Pull that a mechanism bears: none where it slides alone, any where it locks."""
    pull = held / np.where(along > 1e-9, along, np.nan)
    return np.where(held <= 0.0, 0.0, np.nan_to_num(pull, nan=math.inf))


def find_least(function, *spans, parts=2000):
    """Least value: a grid, drawn closer about its least point again and again."""
    for _ in range(12):
        axes = [np.linspace(low, high, parts) for low, high in spans]
        values = function(*np.meshgrid(*axes, indexing="ij"))
        place = np.unravel_index(np.argmin(values), values.shape)
        spans = [
            (axis[max(k - 2, 0)], axis[min(k + 2, parts - 1)])
            for axis, k in zip(axes, place, strict=True)
        ]
    return float(values.min())


def hold_slab(soil, depth, slope, *, drained):
    """Resistance over drive of a slab of ground parallel to the slope."""
    cohesion, friction, weight = soil
    effective = weight if drained else weight - WATER
    holds = cohesion + effective * depth * math.cos(slope) * math.tan(friction)
    return holds / (weight * depth * math.sin(slope))
