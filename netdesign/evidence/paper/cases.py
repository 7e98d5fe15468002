"""Runs of the source paper's study."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

from netdesign.coupling.history.settings import TRANSIENT_LEVELS, Start
from netdesign.coupling.scene import Scene
from netdesign.coupling.solution import Method
from netdesign.evidence.scene import build_scene
from netdesign.snow.creep_law import ICE_DENSITY, PAPER_FLUIDITY
from netdesign.snow.mesh import MeshSize
from netdesign.snow.snowpack import GravityMode
from netdesign.units import second_from_day

# The paper's: 20 m long, 4 m high, relative density 0.4. Slope and stiffness are not
# in it; these are assumed.
LENGTH, THICKNESS, RELATIVE_DENSITY = 20.0, 4.0, 0.4
ASSUMED_SLOPE_DEG, ASSUMED_STIFFNESS = 40.0, 2e7
PAPER_TIME = 8.0  # [s] that its computations covered
FRICTIONS_DEG = (15.0, 30.0, 45.0)
INCLINATIONS_DEG = (25.0, 30.0, 35.0)
NORMAL_NET_DEG, DESIGN_NET_DEG = 0.0, 30.0
MIDDLE_FRICTION_DEG = 30.0


@dataclass(frozen=True, slots=True, kw_only=True)
class PaperCase:
    """One run; angles in degrees, as the paper gives them.

    ``drag`` is the base drag of a staggered run; ``is_coarse`` takes the coarsest mesh
    alone, to compare with staggered runs, which have no other. ``until`` ends a run
    at a time of its own [s]; 0 takes that of the settings.
    """

    method: Method
    inclination_deg: float
    friction_deg: float
    gravity: GravityMode = "full"
    start: Start = "straight"
    densifies: bool = True
    drag: float = 0.0
    is_coarse: bool = False
    until: float = 0.0

    @property
    def scene(self) -> Scene:
        """Scene of the run."""
        scene = build_scene(
            (THICKNESS, RELATIVE_DENSITY * ICE_DENSITY),
            slope=ASSUMED_SLOPE_DEG,
            length=LENGTH,
            lean=self.inclination_deg,
            friction=self.friction_deg,
            stiffness=ASSUMED_STIFFNESS,
            gravity=self.gravity,
        )
        return replace(scene, fluidity=PAPER_FLUIDITY)


@dataclass(frozen=True, slots=True, kw_only=True)
class PaperSettings:
    """Settings of the runs; a thinned study takes less of each.

    Attributes
    ----------
    levels : tuple of MeshSize
        Meshes of the histories; their difference gives the stated error.
    horizon : float
        Of the histories with densification [s].
    undensified_horizon : float
        Of those without: they lean over the head and end [s].
    exchange_drag, exchange_time : float
        Base drag and creep time of the staggered runs that are drawn [-].
    drags : tuple of float
        Of the staggered runs that show the trend, descending [-].
    trend_time : float
        Creep time at which these are compared [-].
    """

    levels: tuple[MeshSize, ...] = field(default=TRANSIENT_LEVELS[:2])
    horizon: float = second_from_day(30.0)
    undensified_horizon: float = second_from_day(0.1)
    exchange_drag: float = 0.05
    exchange_time: float = 0.36
    drags: tuple[float, ...] = (0.2, 0.1, 0.05, 0.02)
    trend_time: float = 0.06


def find_history(
    inclination_deg: float, friction_deg: float = MIDDLE_FRICTION_DEG
) -> PaperCase:
    """History from a straight net, densifying: the paper's own run."""
    return PaperCase(
        method="transient", inclination_deg=inclination_deg, friction_deg=friction_deg
    )


def find_exchange(
    inclination_deg: float,
    settings: PaperSettings,
    friction_deg: float = MIDDLE_FRICTION_DEG,
) -> PaperCase:
    """Staggered run that is drawn."""
    return PaperCase(
        method="staggered",
        inclination_deg=inclination_deg,
        friction_deg=friction_deg,
        drag=settings.exchange_drag,
    )


def find_steady(case: PaperCase) -> PaperCase:
    """Steady state of a run's scene."""
    return PaperCase(
        method="steady",
        inclination_deg=case.inclination_deg,
        friction_deg=case.friction_deg,
        gravity=case.gravity,
    )


def find_trend(settings: PaperSettings) -> list[PaperCase]:
    """Staggered runs whose drag shrinks; a history on their mesh comes last."""
    scene = find_history(NORMAL_NET_DEG)
    return [
        *(replace(scene, method="staggered", drag=drag) for drag in settings.drags),
        replace(scene, is_coarse=True),
    ]


def find_paper_time(friction_deg: float = MIDDLE_FRICTION_DEG) -> PaperCase:
    """History that ends where the paper's computations did."""
    return replace(find_history(NORMAL_NET_DEG, friction_deg), until=PAPER_TIME)


def list_cases(settings: PaperSettings) -> list[PaperCase]:
    """All runs of the study, the long ones first, each once."""
    nets = (NORMAL_NET_DEG, DESIGN_NET_DEG)
    histories = [find_history(net, phi) for net in nets for phi in FRICTIONS_DEG]
    histories += [find_history(net) for net in INCLINATIONS_DEG]
    for net in nets:
        middle = find_history(net)
        histories += [
            replace(middle, start="sagged"),
            replace(middle, densifies=False),
            replace(middle, start="sagged", densifies=False),
            replace(middle, gravity="parallel"),
        ]
    exchanges = [find_exchange(NORMAL_NET_DEG, settings, phi) for phi in FRICTIONS_DEG]
    exchanges.append(find_exchange(DESIGN_NET_DEG, settings))
    steady = [find_steady(case) for case in histories]
    return list(
        dict.fromkeys(
            [
                *exchanges,
                *histories,
                find_paper_time(),
                *find_trend(settings),
                *steady,
            ]
        )
    )


def horizon_of(case: PaperCase, settings: PaperSettings) -> float:
    """Time that a run follows [s]."""
    scale = case.scene.time_scale
    if case.until:
        return case.until
    if case.is_coarse:
        return settings.trend_time * scale
    if case.method == "staggered":
        is_drawn = math.isclose(case.drag, settings.exchange_drag)
        time = settings.exchange_time if is_drawn else settings.trend_time
        return time * scale
    return settings.horizon if case.densifies else settings.undensified_horizon
