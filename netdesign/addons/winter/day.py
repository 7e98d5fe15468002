"""One day of a winter on a net row: its layers, its scene, how its solve ended.

Theory: addons/winter/THEORY.md, section 1.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Literal

import numpy as np

from netdesign.addons.winter.settling import DayPack
from netdesign.addons.winter.winter_sheet import StationWinter
from netdesign.checks.inputs import Band
from netdesign.coupling.scene import Scene, SolverSettings, is_overtopped
from netdesign.envelope.panel_forces import spread_out
from netdesign.envelope.ranges import Case
from netdesign.envelope.run import CaseResult, CaseTask, build_task, run_cases
from netdesign.outcome import ModelError, require_within
from netdesign.site.model import NetRow, Site
from netdesign.snow.creep_law import BOUTILLIER_2004, ICE_DENSITY
from netdesign.snow.snowpack import Layer, build_layered_snowpack
from netdesign.solving.runner import Runner
from netdesign.structure.layout import SupportLayout
from netdesign.structure.members import NetPart
from netdesign.study.row_to_check import build_scene
from netdesign.words.message import Message, say

LEAST_DENSITY = 100.0  # [kg/m3]; the default creep law is refused below 89
THINNEST_SHARE = 0.06  # of the thickness
MOST_LAYERS = 4


def merge_layers(
    thicknesses: Sequence[float],
    densities: Sequence[float],
    most: int = MOST_LAYERS,
) -> tuple[Layer, ...]:
    """Layers from the ground up with neighbours joined; thickness and mass are kept.

    First layers that are too light join the one below, then thin ones the neighbour
    most like them, then the pair that matters least, eq. (Y2).

    Parameters
    ----------
    thicknesses : sequence of float
        Normal to the slope [m], from the ground up, at least one.
    densities : sequence of float
        [kg/m3].
    most : int
        Number of layers that may be left.
    """
    layers = [
        Layer(thickness=float(d), density=float(rho))
        for d, rho in zip(thicknesses, densities, strict=True)
    ]
    thin = THINNEST_SHARE * sum(layer.thickness for layer in layers)
    while (place := _find_pair(layers, thin, most)) is not None:
        layers[place : place + 2] = [_join(layers[place], layers[place + 1])]
    return tuple(layers)


@lru_cache(maxsize=4096)
def _merge_pack(pack: DayPack) -> tuple[Layer, ...]:
    """Joined layers of a station's day: all rows have them, each as thick as it is."""
    return merge_layers(pack.heights.tolist(), pack.densities.tolist())


def _scale_layers(layers: Sequence[Layer], factor: float) -> tuple[Layer, ...]:
    """Layers with their thicknesses times ``factor``; none for a single layer."""
    if len(layers) == 1:
        return ()
    return tuple(replace(layer, thickness=factor * layer.thickness) for layer in layers)


def _find_pair(layers: list[Layer], thin: float, most: int) -> int | None:
    """Lower one of the pair that is joined next; None where all may stay."""
    if len(layers) == 1:
        return None
    lightest = min(range(len(layers)), key=lambda k: layers[k].density)
    if layers[lightest].density < LEAST_DENSITY:
        return max(lightest - 1, 0)
    thinnest = min(range(len(layers)), key=lambda k: layers[k].thickness)
    if layers[thinnest].thickness < thin:
        pairs = [k for k in (thinnest - 1, thinnest) if 0 <= k < len(layers) - 1]
        return min(pairs, key=lambda k: _compare(layers, k))
    if len(layers) > most:
        return min(range(len(layers) - 1), key=lambda k: _weigh(layers, k))
    return None


def _weigh(layers: list[Layer], place: int) -> float:
    """Cost of joining a layer with the next, eq. (Y2) [m]."""
    low, high = layers[place].thickness, layers[place + 1].thickness
    return low * high / (low + high) * _compare(layers, place) ** 2


def _compare(layers: list[Layer], place: int) -> float:
    return abs(math.log(layers[place].density / layers[place + 1].density))


def _join(low: Layer, high: Layer) -> Layer:
    thickness = low.thickness + high.thickness
    mass = low.thickness * low.density + high.thickness * high.density
    return Layer(thickness=thickness, density=mass / thickness)


HEIGHT_FACTORS = (0.2, 5.0)
LEAST_THICKNESS = 0.25  # [m]; thinner snow is not solved, its force counts as 0
UNIFORM_SHARE = 0.35  # of the net's height; thinner snow is taken as uniform

Ending = Literal["open", "solved", "bare", "thin", "overtopped", "failed"]


@dataclass(frozen=True, slots=True, kw_only=True)
class WinterRow:
    """Net row on which a winter's snow lies.

    Attributes
    ----------
    id : str
        Name of the row.
    scene : Scene
        Net, ground, slope and creep law; its snowpack is replaced day by day.
    layout : SupportLayout or None
        Support, for forces per anchor; None follows the net alone.
    height_factor : float
        f_H, snow height at the row over that of the station [-].
    """

    id: str
    scene: Scene
    layout: SupportLayout | None = None
    height_factor: float = 1.0

    def __post_init__(self) -> None:
        """Refuse a factor that no exposure explains, and a law that clamps density.

        Raises
        ------
        ModelError
            If either is so.
        """
        require_within(
            "snow height over that of the station", self.height_factor, *HEIGHT_FACTORS
        )
        law = self.scene.creep_law
        if law.clamp * ICE_DENSITY > LEAST_DENSITY:
            raise ModelError(say("winter.clamped_law", law=law.name))

    def find_thickness(self, height: float) -> float:
        """Thickness normal to the slope of a station's snow height, eq. (Y1).

        Parameters
        ----------
        height : float
            HS [m].

        Returns
        -------
        float
            d [m].
        """
        along = self.scene.snowpack.slope_angle
        return self.height_factor * height * float(np.cos(along))

    def holds(self, thickness: float) -> bool:
        """The net is as high as the snow.

        Parameters
        ----------
        thickness : float
            Of the snow [m].
        """
        return not is_overtopped(self.scene.net.height_normal, thickness)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RowDay:
    """Snow on a net row on one day, and the forces it gives at rest.

    Attributes
    ----------
    index : int
        Place in the series of heights.
    thickness : float
        d, normal to the slope [m].
    density : float
        Mean [kg/m3]; 0 of bare ground.
    layers : tuple of Layer
        As solved, from the ground up; empty for uniform snow.
    ending : str
        ``open`` before it is solved, then ``solved`` or ``failed``; ``bare`` and
        ``thin`` count as force 0; ``overtopped`` has no force.
    reason : Message or None
        Why it failed, or why it was solved as uniform snow.
    foot, head : Band or None
        Pulls of the net with their numerical band [N/m].
    member_forces : mapping of str to Band
        Per anchor [N]; empty without a layout.
    """

    index: int
    thickness: float
    density: float
    layers: tuple[Layer, ...] = ()
    ending: Ending
    reason: Message | None = None
    foot: Band | None = None
    head: Band | None = None
    member_forces: Mapping[str, Band] = field(default_factory=dict)

    @property
    def pull(self) -> float | None:
        """Foot's pull [N/m]; None where nothing is known of it."""
        if self.ending in ("bare", "thin"):
            return 0.0
        return self.foot.value if self.foot else None

    @property
    def bands(self) -> Mapping[str, Band]:
        """Forces of net and members by their names; empty without any."""
        if not self.foot or not self.head:
            return {}
        return {"net foot": self.foot, "net head": self.head, **self.member_forces}

    @property
    def unsolved(self) -> RowDay:
        """The day before it was solved, with the layers that its solve had."""
        return replace(self, ending="open", foot=None, head=None, member_forces={})

    def reopen(self, thickness: float, density: float) -> RowDay:
        """Uniform snow of another thickness [m] and density [kg/m3], to be solved."""
        return replace(self.unsolved, thickness=thickness, density=density, layers=())


# Days of a curve have so many times the error of its largest forces, up to a limit
# that is less than what the snow's mass leaves open (THEORY, section 5; assumed).
CURVE_SHARE = 3.0
COARSEST_CURVE = 0.05


@dataclass(frozen=True, slots=True, kw_only=True)
class DaySolver:
    """Solver of the days of a row.

    Attributes
    ----------
    row : WinterRow
        Whose snow is replaced.
    settings : SolverSettings
        Accuracy of each day.
    runner : Runner
        Where days are solved and kept.
    """

    row: WinterRow
    settings: SolverSettings
    runner: Runner = field(default_factory=Runner)

    @property
    def coarse(self) -> DaySolver:
        """Solver of days that are not the largest: to a lower accuracy."""
        fine = self.settings.accuracy
        accuracy = max(fine, min(CURVE_SHARE * fine, COARSEST_CURVE))
        return replace(self, settings=replace(self.settings, accuracy=accuracy))

    def prepare(
        self, packs: Mapping[int, DayPack], *, layered: bool
    ) -> tuple[RowDay, ...]:
        """Days before they are solved: ``open``, or ended without a solve.

        Parameters
        ----------
        packs : mapping of int to DayPack
            Snowpack of the station by its place in the series.
        layered : bool
            Whether layers are taken where the snow is thick enough for them.
        """
        return tuple(self._prepare(k, pack, layered) for k, pack in packs.items())

    def solve(self, days: Sequence[RowDay]) -> tuple[RowDay, ...]:
        """Days in their order; a layered one that fails is tried as uniform snow.

        Parameters
        ----------
        days : sequence of RowDay
            Those that are not ``open`` stay as they are.
        """
        first = {
            day.index: day for day in self._run([d for d in days if d.ending == "open"])
        }
        failed = [day for day in first.values() if day.ending == "failed"]
        again = [replace(day, layers=(), ending="open") for day in failed if day.layers]
        second = {
            day.index: replace(day, reason=first[day.index].reason)
            for day in self._run(again)
        }
        ended = first | second
        return tuple(ended.get(day.index, day) for day in days)

    def _prepare(self, index: int, pack: DayPack, layered: bool) -> RowDay:
        thickness = self.row.find_thickness(pack.height)
        ending = self._judge(thickness)
        layers: tuple[Layer, ...] = ()
        thick = UNIFORM_SHARE * self.row.scene.net.height_normal
        if ending == "open" and layered and thickness >= thick:
            layers = _scale_layers(_merge_pack(pack), thickness / pack.height)
        return RowDay(
            index=index,
            thickness=thickness,
            density=pack.density,
            layers=layers,
            ending=ending,
        )

    def _judge(self, thickness: float) -> Ending:
        if thickness <= 0.0:
            return "bare"
        if not self.row.holds(thickness):
            return "overtopped"
        return "thin" if thickness < LEAST_THICKNESS else "open"

    def _run(self, days: Sequence[RowDay]) -> list[RowDay]:
        results = run_cases([self._build_task(day) for day in days], self.runner)
        return [_end(day, result) for day, result in zip(days, results, strict=True)]

    def _build_task(self, day: RowDay) -> CaseTask:
        net = self.row.scene.net
        case = Case(
            density=day.density,
            friction_angle=getattr(net, "friction_angle", None) or 0.0,
            inclination=net.inclination,
        )
        layouts = () if self.row.layout is None else (self.row.layout,)
        return build_task(
            case,
            lambda _: build_day_scene(self.row.scene, day),
            layouts,
            self.settings,
        )


def build_day_scene(scene: Scene, day: RowDay) -> Scene:
    """Scene of a row with the snow of one day.

    Parameters
    ----------
    scene : Scene
        Of the row.
    day : RowDay
        Thickness, density, layers.

    Raises
    ------
    ModelError
        If the model refuses that snow.
    """
    pack = scene.snowpack
    if day.layers:
        snow = build_layered_snowpack(
            day.layers,
            slope_angle=pack.slope_angle,
            upslope_length=pack.upslope_length,
            gravity=pack.gravity,
        )
    else:
        snow = replace(pack, thickness=day.thickness, density=day.density, layers=())
    return replace(scene, snowpack=snow)


def _end(day: RowDay, result: CaseResult) -> RowDay:
    """Day with the forces of its solve, or with the reason why there are none."""
    if not result.is_converged or result.solution is None:
        reason = result.reason or result.outcome.message
        return replace(day, ending="failed", reason=reason)
    foot, head = result.solution.foot, result.solution.head
    forces = dict(result.member_forces)
    forces.pop(NetPart.MESH, None)  # the net's own ends are told
    return replace(
        day,
        ending="solved",
        foot=spread_out(foot.size, foot.error),
        head=spread_out(head.size, head.error),
        member_forces={} if "rope" in forces else forces,
    )


ASSUMED_FACTOR = 1.0  # snow height at the rows over the station's, where none is given
# Largest height of a series over the design height: beyond, metres may be centimetres.
_PLAUSIBLE = (0.15, 15.0)


def build_winter_row(site: Site, row: NetRow, winter: StationWinter) -> WinterRow:
    """Row with the middle of friction angle and inclination of the site's ranges.

    Raises
    ------
    ModelError
        If the model refuses the row.
    """
    names = ("density", "friction_angle", "inclination")
    ranges = (site.ranges[name] for name in names)  # of all rows
    density, friction, inclination = ((x.low + x.high) / 2.0 for x in ranges)
    case = Case(density=density, friction_angle=friction, inclination=inclination)
    # winters are compared with what was measured: on the ground as it is
    scene = replace(build_scene(row, case, BOUTILLIER_2004), ground=row.ground)
    return WinterRow(
        id=row.id,
        scene=scene,
        layout=row.layout,
        height_factor=winter.find_factor(row.id) or ASSUMED_FACTOR,
    )


def require_plausible_heights(
    rows: Sequence[WinterRow], designed: Sequence[NetRow], winter: StationWinter
) -> None:
    """Refuse heights of which metres may have been taken for centimetres.

    Raises
    ------
    ModelError
        Naming the first row that they do not fit.
    """
    highest = max(winter.series.heights)
    for row, net_row in zip(rows, designed, strict=True):
        share = row.find_thickness(highest) / net_row.snow_thickness
        if not _PLAUSIBLE[0] <= share <= _PLAUSIBLE[1]:
            raise ModelError(
                say(
                    "winter_sheet.unlikely_heights",
                    highest=highest,
                    row=row.id,
                    share=share,
                )
            )
