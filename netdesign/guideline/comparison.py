"""Guideline's member forces for a net row: load, end pulls, support."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from netdesign.errors import ModelError
from netdesign.guideline.load_model import (
    LoadModel,
    SnowLoad,
    compute_altitude_factor,
    compute_snow_load,
)
from netdesign.guideline.net_pull import NetPull, compute_net_pull
from netdesign.snow.ground import DEFAULT_CREEP_LAW, GroundLaw, load_glide_tables
from netdesign.structure.anchors import AnchorForces, compute_anchor_forces
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import SupportLayout, place_support
from netdesign.words.message import Message


@dataclass(frozen=True, slots=True, kw_only=True)
class NetGeometry:
    """Net row as the guideline needs it.

    Attributes
    ----------
    slope_angle, inclination : float
        psi, and of the net from the slope normal, downslope positive [rad].
    snow_thickness, net_height : float
        Normal to the slope [m].
    stiffness : float
        ES [N/m].
    slack : float
        Unstressed length over chord, less 1 [-].
    layout : SupportLayout
        Of its supports.
    """

    slope_angle: float
    snow_thickness: float
    net_height: float
    inclination: float
    stiffness: float
    slack: float
    layout: SupportLayout


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadCase:
    """Snow of one load case.

    Attributes
    ----------
    name : str
        "same_snow", "load_case_1" or "load_case_2".
    density : float
        Mean [kg/m3].
    height_vertical : float
        H [m].
    """

    name: str
    density: float
    height_vertical: float


@dataclass(frozen=True, slots=True, kw_only=True)
class GuidelineResult:
    """One load case of the guideline.

    Attributes
    ----------
    name : str
        Of the load case.
    density : float
        Mean, of the snow [kg/m3].
    height_vertical : float
        H [m].
    load, pull : SnowLoad, NetPull or None
        For each metre of width; None where the closed forms do not hold.
    anchors : AnchorForces or None
        For each support; None where it has no equilibrium.
    reason : str
        Why something is None.
    """

    name: str
    density: float
    height_vertical: float
    load: SnowLoad | None = None
    pull: NetPull | None = None
    anchors: AnchorForces | None = None
    reason: Message | None = None


def find_glide_factor(
    ground: GroundLaw, snow_thickness: float, largest: float
) -> float:
    """Glide factor of a ground.

    A slip length [m] goes back through the stored table by which N gives a slip
    length; beyond the table its end is taken.

    Parameters
    ----------
    ground : GroundLaw
        With its slip length.
    snow_thickness : float
        Normal to the slope [m].
    largest : float
        N of a ground without friction [-].

    Returns
    -------
    float
        N [-].
    """
    if ground.kind == "free":
        return largest
    if ground.kind == "no-slip":
        return 1.0
    table = load_glide_tables()[DEFAULT_CREEP_LAW]
    ratio = ground.slip_length / snow_thickness
    ratios, factors = (0.0, *table.slip_ratios), (1.0, *table.glide_factors)
    return float(np.interp(ratio, ratios, factors))


def compare_with_guideline(
    model: LoadModel,
    net: NetGeometry,
    *,
    density: float,
    altitude: float | None,
    glide_factor: float,
) -> tuple[GuidelineResult, ...]:
    """Solve the same snow as the governing case, then load cases 1 and 2.

    Parameters
    ----------
    model : LoadModel
        Numbers of the guideline.
    net : NetGeometry
        Of the net row, at the inclination of the governing case.
    density : float
        Of the governing case [kg/m3].
    altitude : float or None
        Of the row [m]; None is taken as below the base altitude.
    glide_factor : float
        N [-].

    Returns
    -------
    tuple of GuidelineResult
        Of each load case, in this order.
    """
    height = net.snow_thickness / math.cos(net.slope_angle)
    same = LoadCase(name="same_snow", density=density, height_vertical=height)
    cases = (same, *list_load_cases(model, net, altitude))
    return tuple(solve_load_case(model, net, case, glide_factor) for case in cases)


def list_load_cases(
    model: LoadModel, net: NetGeometry, altitude: float | None
) -> tuple[LoadCase, LoadCase]:
    """Load cases 1 and 2 of the guideline on a net row.

    Parameters
    ----------
    model : LoadModel
        Numbers of the guideline.
    net : NetGeometry
        Whose snow it is.
    altitude : float or None
        Of the row [m]; None is taken as below the base altitude.
    """
    height = net.snow_thickness / math.cos(net.slope_angle)
    factor = 1.0 if altitude is None else compute_altitude_factor(model, altitude)
    return (
        LoadCase(
            name="load_case_1", density=factor * model.density, height_vertical=height
        ),
        LoadCase(
            name="load_case_2",
            density=model.case_2_density,
            height_vertical=model.case_2_height * height,
        ),
    )


def solve_load_case(
    model: LoadModel, net: NetGeometry, case: LoadCase, glide_factor: float
) -> GuidelineResult:
    """Forces of one load case; a reason where the closed forms do not hold.

    Parameters
    ----------
    model : LoadModel
        Numbers of the guideline.
    net : NetGeometry
        Of the net row.
    case : LoadCase
        Its snow.
    glide_factor : float
        N [-].
    """
    try:
        return _solve_case(model, net, case, glide_factor)
    except ModelError as error:
        return GuidelineResult(
            name=case.name,
            density=case.density,
            height_vertical=case.height_vertical,
            reason=error.message,
        )


def _solve_case(
    model: LoadModel, net: NetGeometry, case: LoadCase, glide_factor: float
) -> GuidelineResult:
    height = case.height_vertical
    load = compute_snow_load(
        model,
        density=case.density,
        height_vertical=height,
        slope_angle=net.slope_angle,
        glide_factor=glide_factor,
        net_height=net.net_height,
        inclination=net.inclination,
    )
    filled = height * math.cos(net.slope_angle) / net.net_height
    pull = compute_net_pull(
        load.resultant,
        inclination=net.inclination,
        chord=net.net_height / math.cos(net.inclination),
        loaded_share=min(1.0, filled),
        stiffness=net.stiffness,
        slack=net.slack,
    )
    head = (net.net_height * math.tan(net.inclination), net.net_height)
    anchors = compute_anchor_forces(
        place_support(net.layout, head),
        foot_pull_per_m=pull.foot,
        head_pull_per_m=pull.head,
        post_spacing=net.layout.post_spacing,
    )
    if isinstance(anchors, FailedSupport):
        reason, found = anchors.reason, None
    else:
        reason, found = None, anchors
    return GuidelineResult(
        name=case.name,
        density=case.density,
        height_vertical=height,
        load=load,
        pull=pull,
        anchors=found,
        reason=reason,
    )
