"""Load cases of the guideline on a net row: load, end pulls and forces of a support."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import product
from typing import Generic

from netdesign.guideline.load_model import (
    LoadModel,
    NetPull,
    SnowLoad,
    compute_altitude_factor,
    compute_net_pull,
    compute_snow_load,
)
from netdesign.numerics.arrays import (
    Number,
    find_cosine,
    find_tangent,
    take_larger,
    take_smaller,
)
from netdesign.outcome import ModelError
from netdesign.snow.ground import DEFAULT_CREEP_LAW, GroundLaw, load_glide_tables
from netdesign.structure.anchors import AnchorForces, compute_anchor_forces
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import SupportLayout, place_support
from netdesign.structure.members import Member
from netdesign.words.message import Message


@dataclass(frozen=True, slots=True, kw_only=True)
class NetGeometry(Generic[Number]):
    """Net row as the guideline needs it, or many that differ in four numbers.

    Attributes
    ----------
    slope_angle : float
        psi [rad].
    inclination : float or ndarray
        Of the net from the slope normal, downslope positive [rad].
    snow_thickness : float or ndarray
        Of the snow that is held, normal to the slope [m].
    net_height : float
        Normal to the slope [m].
    stiffness : float or ndarray
        ES [N/m].
    slack : float or ndarray
        Unstressed length over chord, less 1 [-].
    layout : SupportLayout
        Of its supports.
    """

    slope_angle: float
    snow_thickness: Number
    net_height: float
    inclination: Number
    stiffness: Number
    slack: Number
    layout: SupportLayout


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadCase(Generic[Number]):
    """Load case, on one net or on many.

    Attributes
    ----------
    name : str
        "same_snow", "load_case_1" or "load_case_2".
    density : float or ndarray
        Mean, by which the load is found [kg/m3].
    height_vertical : float or ndarray
        H, by which the load is found [m].
    normal_share : float or ndarray
        a in (G4) [-].
    settled : float or ndarray
        Part of that height on which the load acts [-].
    creep_factor : float, ndarray or None
        K in the place of (G2): of the dimensioning form [-].
    """

    name: str
    density: Number
    height_vertical: Number
    normal_share: Number
    settled: Number
    creep_factor: Number | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class GuidelineResult:
    """Load, pulls and forces under one load case, or why they are missing.

    Attributes
    ----------
    case : LoadCase
        Its snow.
    load, pull : SnowLoad, NetPull or None
        For each metre of width; None where the closed forms do not hold.
    anchors : AnchorForces or None
        For each support; None where it has no equilibrium.
    reason : str
        Why something is None.
    """

    case: LoadCase[float]
    load: SnowLoad[float] | None = None
    pull: NetPull[float] | None = None
    anchors: AnchorForces | None = None
    reason: Message | None = None

    @property
    def foot(self) -> float | None:
        """Force of the foot anchor [N]; None where the support has no equilibrium."""
        if self.anchors is None:
            return None
        return self.anchors.member_forces[Member.FOOT_ANCHOR]


def find_glide_factor(
    ground: GroundLaw, snow_thickness: Number, limits: tuple[float, float]
) -> Number:
    """Glide factor of a ground under snow of one thickness, or of many.

    A slip length [m] goes back through the stored table by which N gives a slip
    length; beyond the table its end is taken.

    Parameters
    ----------
    ground : GroundLaw
        With its slip length.
    snow_thickness : float or ndarray
        Normal to the slope [m].
    limits : tuple of float
        Least and largest N of the guideline [-]: of a ground without slip, and of one
        without friction. No N is less.

    Returns
    -------
    float or ndarray
        N [-].
    """
    least, largest = limits
    if ground.kind != "sliding":
        return 0.0 * snow_thickness + (largest if ground.kind == "free" else least)
    table = load_glide_tables()[DEFAULT_CREEP_LAW]
    return take_larger(
        table.find_glide_factor(ground.slip_length / snow_thickness), least
    )


def compare_with_guideline(
    model: LoadModel,
    net: NetGeometry[float],
    *,
    density: float,
    altitude: float | None,
    glide_factors: tuple[float, float],
) -> tuple[GuidelineResult, ...]:
    """Solve the same snow as the governing case, then load cases 1 and 2.

    The load cases are those for the height of the net, each by the share of the normal
    part and the form that load the foot most.

    Parameters
    ----------
    model : LoadModel
        Numbers of the guideline.
    net : NetGeometry
        Of the net row, at the inclination of the governing case.
    density : float
        Of the governing case [kg/m3].
    altitude : float or None
        Of the row [m]; None is not known, and gets the largest factor.
    glide_factors : tuple of float
        N of the snow of the governing case, and of snow as high as the net [-].

    Returns
    -------
    tuple of GuidelineResult
        Of each load case, in this order.
    """
    same, *cases = list_cases(model, net, density=density, altitude=altitude)
    of_same, of_net = glide_factors
    results = [solve_load_case(model, net, case, of_net) for case in cases]
    first, second = (
        [result for result in results if result.case.name == name]
        for name in LOAD_CASES
    )
    worst = (
        max(of_case, key=lambda two: two.foot or 0.0) for of_case in (first, second)
    )
    return (solve_load_case(model, net, same, of_same), *worst)


def list_cases(
    model: LoadModel,
    net: NetGeometry[float],
    *,
    density: float,
    altitude: float | None,
) -> tuple[LoadCase[float], ...]:
    """Snow of a density on a net row, then the load cases for the net's height.

    Parameters
    ----------
    model : LoadModel
        Numbers of the guideline.
    net : NetGeometry
        Net row.
    density : float
        [kg/m3].
    altitude : float or None
        As `list_load_cases` takes it [m].
    """
    same = LoadCase(
        name="same_snow",
        density=density,
        height_vertical=net.snow_thickness / math.cos(net.slope_angle),
        normal_share=model.normal,
        settled=1.0,
    )
    full = replace(net, snow_thickness=net.net_height)
    return (same, *list_load_cases(model, full, altitude))


LOAD_CASES = ("load_case_1", "load_case_2")


def list_load_cases(
    model: LoadModel, net: NetGeometry[Number], altitude: float | None
) -> tuple[LoadCase[Number], ...]:
    """Load cases of the guideline on a net row, or on each of many; (G4), (G6a).

    Cases 1 and 2 under the net's snow with each share of the normal part, then, where
    it counts, by the dimensioning form for the height of the net.

    Parameters
    ----------
    model : LoadModel
        Numbers of the guideline.
    net : NetGeometry
        Whose snow it is.
    altitude : float or None
        Of the row [m]; None is not known, and gets the largest factor.
    """
    depth = net.snow_thickness
    forms: list[tuple[Number, float | None]] = [(depth, None)]
    if model.dimensioning_creep is not None:
        forms.append((0.0 * depth + net.net_height, model.dimensioning_creep))
    settled = zip(LOAD_CASES, (1.0, model.case_2_height), strict=True)
    shares = (model.normal_loose, model.normal, model.normal_dense)
    density = compute_altitude_factor(model, altitude) * model.density
    return tuple(
        LoadCase(
            name=name,
            density=0.0 * depth + density,
            height_vertical=thickness / math.cos(net.slope_angle),
            normal_share=0.0 * depth + share,
            settled=0.0 * depth + part,
            creep_factor=None if creep is None else 0.0 * depth + creep,
        )
        for (thickness, creep), (name, part), share in product(forms, settled, shares)
    )


def solve_load_case(
    model: LoadModel,
    net: NetGeometry[float],
    case: LoadCase[float],
    glide_factor: float,
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
        load, pull = find_pulls(model, net, case, glide_factor)
        anchors = compute_anchor_forces(
            place_support(net.layout, place_head(net)),
            foot_pull_per_m=pull.foot,
            head_pull_per_m=pull.head,
            post_spacing=net.layout.post_spacing,
        )
    except ModelError as error:
        return GuidelineResult(case=case, reason=error.message)
    if isinstance(anchors, FailedSupport):
        return GuidelineResult(case=case, load=load, pull=pull, reason=anchors.reason)
    return GuidelineResult(case=case, load=load, pull=pull, anchors=anchors)


def find_pulls(
    model: LoadModel,
    net: NetGeometry[Number],
    case: LoadCase[Number],
    glide_factor: Number,
) -> tuple[SnowLoad[Number], NetPull[Number]]:
    """Load of a case on a net, or on each of many, and the pulls of its ends.

    Parameters
    ----------
    model : LoadModel
        Numbers of the guideline.
    net : NetGeometry
        Of the net row.
    case : LoadCase
        Its snow.
    glide_factor : float or ndarray
        N [-].

    Raises
    ------
    ModelError
        If the closed forms do not hold anywhere.
    """
    height = case.height_vertical
    load = compute_snow_load(
        model,
        density=case.density,
        height_vertical=height,
        slope_angle=net.slope_angle,
        glide_factor=glide_factor,
        net_height=net.net_height,
        inclination=net.inclination,
        normal_share=case.normal_share,
        creep_factor=case.creep_factor,
    )
    filled = height * math.cos(net.slope_angle) / net.net_height
    pull = compute_net_pull(
        load.resultant,
        inclination=net.inclination,
        chord=net.net_height / find_cosine(net.inclination),
        loaded_share=case.settled * take_smaller(filled, 1.0),
        stiffness=net.stiffness,
        slack=net.slack,
    )
    return load, pull


def place_head(net: NetGeometry[Number]) -> tuple[Number, Number]:
    """Head of a support, or of each of many, from the net's foot [m]."""
    x_head = net.net_height * find_tangent(net.inclination)
    return x_head, net.net_height + 0.0 * x_head
