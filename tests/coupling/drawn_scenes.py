"""Scenes whose every number is untidy: rounding leaves no ratio of them alone."""

import math

import numpy as np

from netdesign.snow.ground import GroundLaw, build_ground_from_glide_factor
from netdesign.snow.snowpack import Layer
from tests.scenes import build_scene

GROUNDS = ("free", "no-slip", "sliding")
HIGH_GLIDE_FACTORS = (2.6, 2.8, 3.0, 3.2)


def draw_net(rng, thickness, stands_out, *, rise, lean, stiff, friction):
    """Net as high as the snow, or up to some share higher."""
    return {
        "height_m": thickness * (rng.uniform(1.0, rise) if stands_out else 1.0),
        "inclination_deg": rng.uniform(*lean),
        "stiffness_kN_per_m": float(np.exp(rng.uniform(*np.log(stiff)))),
        "slack": float(rng.uniform(0.0, 0.08)),
        "friction_deg": rng.uniform(*friction),
    }


def draw_scene(seed, *, ground=None, is_uniform=False):
    """A scene of practical size: d 1.5 to 4.5 m, L 5 to 40 m, any ratio."""
    rng = np.random.default_rng(seed)
    kind = str(rng.choice(GROUNDS)) if ground is None else ground
    thickness = float(rng.uniform(1.5, 4.5))
    slip = float(thickness * np.exp(rng.uniform(math.log(0.05), math.log(8.0))))
    layers = () if is_uniform else draw_layers(rng, thickness)
    density = float(rng.uniform(200.0, 500.0))
    stands_out = bool(rng.integers(2))
    thickness = sum(layer.thickness for layer in layers) or thickness
    return build_scene(
        thickness_m=thickness,
        density_kg_m3=density,
        layers=layers,
        ground=GroundLaw(kind=kind, slip_length=slip if kind == "sliding" else 0.0),
        slope_deg=rng.uniform(28.0, 55.0),
        length_m=float(rng.uniform(5.0, 40.0)),
        gravity="parallel" if rng.integers(2) else "full",
        **draw_net(rng, thickness, stands_out, rise=1.3, lean=(0.0, 35.0),
                   stiff=(2e3, 1e5), friction=(5.0, 45.0)),
    )  # fmt: skip


def draw_smooth_site(seed):
    """A practical scene on ground as smooth as the guideline's tables have it."""
    rng = np.random.default_rng([19, seed])
    thickness = float(rng.uniform(1.5, 4.5))
    stands_out = bool(rng.integers(2))
    return build_scene(
        thickness_m=thickness,
        slope_deg=rng.uniform(30.0, 45.0),
        length_m=float(rng.uniform(10.0, 30.0)),
        density_kg_m3=float(rng.uniform(200.0, 480.0)),
        ground=build_ground_from_glide_factor(HIGH_GLIDE_FACTORS[seed % 4], thickness),
        ground_contact=("two-sided", "one-sided")[seed // 4 % 2],
        **draw_net(rng, thickness, stands_out, rise=1.25, lean=(0.0, 30.0),
                   stiff=(2e3, 5e4), friction=(10.0, 45.0)),
    )  # fmt: skip


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
    layers = split(thickness, parts, density)
    slope, length = rng.uniform(28.0, 50.0), thickness * float(rng.uniform(3.0, 10.0))
    stands_out, glide = bool(rng.integers(2)), float(rng.uniform(1.2, 3.2))
    return build_scene(
        layers=layers,
        slope_deg=slope,
        length_m=length,
        ground=build_ground_from_glide_factor(
            glide, sum(layer.thickness for layer in layers)
        ),
        **draw_net(rng, thickness, stands_out, rise=1.25, lean=(10.0, 35.0),
                   stiff=(2e3, 1e5), friction=(15.0, 45.0)),
    )  # fmt: skip


def split(thickness, parts, densities):
    """Layers of such parts of a thickness, from the ground [m, kg/m3]."""
    return tuple(
        Layer(thickness=float(part), density=float(density))
        for part, density in zip(
            thickness * parts / parts.sum(), densities, strict=True
        )
    )


def draw_layers(rng, thickness):
    """None, or two or three of them, the denser ones below."""
    count = int(rng.integers(1, 4))
    if count == 1:
        return ()
    parts = rng.uniform(0.2, 1.0, count)
    return split(thickness, parts, np.sort(rng.uniform(150.0, 500.0, count))[::-1])
