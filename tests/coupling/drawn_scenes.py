"""Scenes whose every number is untidy: rounding leaves no ratio of them alone."""

import math

import numpy as np

from netdesign.cable.net import Net
from netdesign.coupling.scene import Scene
from netdesign.snow.ground import GroundLaw, build_ground_from_glide_factor
from netdesign.snow.snowpack import Layer, Snowpack, build_layered_snowpack

GROUNDS = ("free", "no-slip", "sliding")
HIGH_GLIDE_FACTORS = (2.6, 2.8, 3.0, 3.2)


def draw_scene(seed, *, ground=None, is_uniform=False):
    """A scene of practical size: d 1.5 to 4.5 m, L 5 to 40 m, any ratio."""
    rng = np.random.default_rng(seed)
    kind = str(rng.choice(GROUNDS)) if ground is None else ground
    thickness = float(rng.uniform(1.5, 4.5))
    slip = float(thickness * np.exp(rng.uniform(math.log(0.05), math.log(8.0))))
    layers = () if is_uniform else draw_layers(rng, thickness)
    density = float(rng.uniform(200.0, 500.0))
    if layers:
        thickness = sum(layer.thickness for layer in layers)
        mass = sum(layer.thickness * layer.density for layer in layers)
        density = mass / thickness
    stands_out = bool(rng.integers(2))
    return Scene(
        snowpack=Snowpack(
            slope_angle=math.radians(rng.uniform(28.0, 55.0)),
            thickness=thickness,
            upslope_length=float(rng.uniform(5.0, 40.0)),
            density=density,
            layers=layers,
            gravity="parallel" if rng.integers(2) else "full",
        ),
        ground=GroundLaw(kind=kind, slip_length=slip if kind == "sliding" else 0.0),
        net=Net(
            height_normal=thickness * (rng.uniform(1.0, 1.3) if stands_out else 1.0),
            inclination=math.radians(rng.uniform(0.0, 35.0)),
            stiffness_per_m=float(np.exp(rng.uniform(math.log(2e6), math.log(1e8)))),
            slack=float(rng.uniform(0.0, 0.08)),
            friction_angle=math.radians(rng.uniform(5.0, 45.0)),
        ),
    )


def draw_smooth_site(seed):
    """A practical scene on ground as smooth as the guideline's tables have it."""
    rng = np.random.default_rng([19, seed])
    thickness = float(rng.uniform(1.5, 4.5))
    stands_out = bool(rng.integers(2))
    return Scene(
        snowpack=Snowpack(
            slope_angle=math.radians(rng.uniform(30.0, 45.0)),
            thickness=thickness,
            upslope_length=float(rng.uniform(10.0, 30.0)),
            density=float(rng.uniform(200.0, 480.0)),
        ),
        ground=build_ground_from_glide_factor(HIGH_GLIDE_FACTORS[seed % 4], thickness),
        net=Net(
            height_normal=thickness * (rng.uniform(1.0, 1.25) if stands_out else 1.0),
            inclination=math.radians(rng.uniform(0.0, 30.0)),
            stiffness_per_m=float(np.exp(rng.uniform(math.log(2e6), math.log(5e7)))),
            slack=float(rng.uniform(0.0, 0.08)),
            friction_angle=math.radians(rng.uniform(10.0, 45.0)),
        ),
        ground_contact=("two-sided", "one-sided")[seed // 4 % 2],
    )


def draw_layered_site(seed, *, is_denser_below):
    """A practical scene of 2 to 4 layers on ground that glides.

    The source paper has phi (design range) and ES; the guideline N and the nets'
    heights of 1.5 to 4.5 m. Chosen here, within what is usual: psi to 50 degrees,
    L / d, theta (design range 25 to 35 degrees), slack to 0.08, densities of layers.
    """
    rng = np.random.default_rng([17, seed])
    thickness = float(rng.uniform(1.5, 4.5))
    count = int(rng.integers(2, 5))
    parts = rng.uniform(0.2, 1.0, count)
    density = rng.uniform(150.0, 450.0, count)
    if is_denser_below:
        density = np.sort(density)[::-1]
    layers = tuple(
        Layer(thickness=float(high), density=float(rho))
        for high, rho in zip(thickness * parts / parts.sum(), density, strict=True)
    )
    pack = build_layered_snowpack(
        layers,
        slope_angle=math.radians(rng.uniform(28.0, 50.0)),
        upslope_length=thickness * float(rng.uniform(3.0, 10.0)),
    )
    stands_out = bool(rng.integers(2))
    return Scene(
        snowpack=pack,
        ground=build_ground_from_glide_factor(
            float(rng.uniform(1.2, 3.2)), pack.thickness
        ),
        net=Net(
            height_normal=pack.thickness
            * (rng.uniform(1.0, 1.25) if stands_out else 1.0),
            inclination=math.radians(rng.uniform(10.0, 35.0)),
            stiffness_per_m=float(np.exp(rng.uniform(math.log(2e6), math.log(1e8)))),
            slack=float(rng.uniform(0.0, 0.08)),
            friction_angle=math.radians(rng.uniform(15.0, 45.0)),
        ),
    )


def draw_layers(rng, thickness):
    """None, or two or three of them, the denser ones below."""
    count = int(rng.integers(1, 4))
    if count == 1:
        return ()
    parts = rng.uniform(0.2, 1.0, count)
    densities = np.sort(rng.uniform(150.0, 500.0, count))[::-1]
    return tuple(
        Layer(thickness=float(part), density=float(density))
        for part, density in zip(
            thickness * parts / parts.sum(), densities, strict=True
        )
    )
