"""Season of made-up readings, and a stand-in for the chain near its design."""

import math
from dataclasses import dataclass, field, replace

import numpy as np

from netdesign.checks.result import Band
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.snowpack.delta_snow import DELTA_SNOW
from netdesign.snowpack.follow import follow_heights
from netdesign.structure.layout import SupportLayout
from netdesign.winter.day import DaySolver
from netdesign.winter.fit import FitTask, fit_season, list_swings
from netdesign.winter.fit_inputs import (
    PARAMETER_NAMES,
    PRIOR_DEVIATIONS,
    FitReading,
    Noise,
    build_covariance,
    list_parameters,
    vary_day,
    vary_row,
)
from tests.winter.made_up_row import a_solver, read_winter, slides

GOVERNING = 161  # of the made-up winter
MEMBERS = ("foot_anchor", "post")
EXACT = Noise(reading=1e-4, cell=0.0, rope=0.0)
LAYOUT = SupportLayout(
    post_spacing=3.7,
    post_tilt=0.23,
    uphill_anchor_distance=3.1,
    downhill_anchor_distance=2.7,
)


def a_task(places, *, layered, meshes=2, noise=EXACT, known=()):
    """Fit on some days of the made-up winter, without readings so far."""
    solver = replace(
        a_solver(slides(2.2, 2.9), layout=LAYOUT),
        settings=SolverSettings(accuracy=2e-3, levels=MESH_LEVELS[:meshes]),
    )
    packs = follow_heights(read_winter(), DELTA_SNOW)
    wanted = {k: packs[k] for k in sorted({*places, GOVERNING})}
    days = solver.prepare(wanted, layered=layered)
    return FitTask(
        winter="2020/2021",
        solver=solver,
        days={day.index: day for day in days},
        readings=(),
        noise=noise,
        known=frozenset(known),
        governing=GOVERNING,
    )


def solve_truth(task, truth):
    """Forces of each day by some parameters, away from those of the row [N]."""
    row = vary_row(task.row, truth)
    days = [vary_day(day, task.row, truth) for day in task.days.values()]
    return {
        day.index: {name: day.member_forces[name].value for name in MEMBERS}
        for day in replace(task.solver, row=row).solve(days)
        if day.ending == "solved"
    }


def read_forces(task, forces, places, errors=None):
    """Task with readings of some days, each off by an error of its logarithm."""
    readings = [
        FitReading(index=k, member=member, force=forces[k][member])
        for k in places
        for member in MEMBERS
    ]
    errors = np.zeros(len(readings)) if errors is None else errors
    return replace(
        task,
        readings=tuple(
            replace(one, force=one.force * math.exp(error))
            for one, error in zip(readings, errors, strict=True)
        ),
    )


def name_design(task):
    """Parameters of the row as designed, in the units of a fit."""
    scene = task.row.scene
    return {
        "slip_length": math.log(scene.ground.slip_length),
        "density_factor": 0.0,
        "height_factor": 0.0,
        "slack": scene.net.slack,
        "friction_angle": scene.net.friction_angle,
    }


def draw_truth(task, rng):
    """Parameters by the priors of the fit: drawn again where they leave its ends."""
    thickest = max(day.thickness for day in task.days.values())
    truth = {}
    for one in list_parameters(task.row, task.known, thickest):
        low, high = one.ends
        value = math.nan
        while not low <= value <= high:
            value = one.mean + one.deviation * float(rng.normal())
        truth[one.name] = value
    return truth


@dataclass(frozen=True, slots=True, kw_only=True)
class StandInSolver(DaySolver):
    """Chain as a sum of parabolas of each parameter, through three of its solves.

    ``curves`` has of each day and member the logarithm of the force as designed, and
    of each parameter slope and curvature over one deviation of its prior.
    """

    design: dict = field(default_factory=dict)
    thicknesses: dict = field(default_factory=dict)
    densities: dict = field(default_factory=dict)
    curves: dict = field(default_factory=dict)

    def solve(self, days):
        return tuple(self._stand_in(day) if day.is_open else day for day in days)

    def _stand_in(self, day):
        scene = self.row.scene
        values = {
            "slip_length": math.log(scene.ground.slip_length),
            "density_factor": math.log(day.density / self.densities[day.index]),
            "height_factor": math.log(day.thickness / self.thicknesses[day.index]),
            "slack": scene.net.slack,
            "friction_angle": scene.net.friction_angle,
        }
        moves = np.array(
            [
                (values[name] - self.design[name]) / PRIOR_DEVIATIONS[name]
                for name in PARAMETER_NAMES
            ]
        )
        forces = {}
        for member in MEMBERS:
            start, slopes, bends = self.curves[day.index, member]
            force = math.exp(start + slopes @ moves + 0.5 * bends @ moves**2)
            forces[member] = Band(low=force, value=force, high=force)
        return replace(day, ending="solved", member_forces=forces)


def stand_in(task):
    """The task with a stand-in instead of the chain."""
    design = name_design(task)

    def solve(name, count):
        moved = design | {name: design[name] + count * PRIOR_DEVIATIONS[name]}
        return solve_truth(task, moved)

    middle = solve_truth(task, design)
    above = {name: solve(name, 1.0) for name in PARAMETER_NAMES}
    below = {name: solve(name, -1.0) for name in PARAMETER_NAMES}
    curves = {}
    for place in task.days:
        for member in MEMBERS:
            start = math.log(middle[place][member])
            high, low = (
                np.array([math.log(one[name][place][member]) for name in one]) - start
                for one in (above, below)
            )
            curves[place, member] = (start, (high - low) / 2.0, high + low)
    solver = StandInSolver(
        row=task.row,
        settings=task.solver.settings,
        design=design,
        thicknesses={k: day.thickness for k, day in task.days.items()},
        densities={k: day.density for k, day in task.days.items()},
        curves=curves,
    )
    return replace(task, solver=solver)


def fit_seeds(task, places, count, first=7000):
    """Fits of so many seasons: truth by the priors, noise by its covariance.

    Yields of each the fit, and the true force of each member on the governing day. A
    truth that the chain has no forces for is drawn again: no season has it.
    """
    for seed in range(first, first + count):
        rng = np.random.default_rng(seed)
        forces = {}
        while any(len(forces.get(k, ())) < len(MEMBERS) for k in task.days):
            forces = solve_truth(task, draw_truth(task, rng))
        exact = read_forces(task, forces, places)
        noise = build_covariance(exact.readings, task.noise, list_swings(task))
        errors = rng.multivariate_normal(np.zeros(len(exact.readings)), noise)
        fitted = fit_season(read_forces(task, forces, places, errors))
        yield fitted, forces[GOVERNING]


def measure_errors(task, places, count, first=7000):
    """Error of the foot's force in each season that was fitted, by its deviation."""
    found = []
    for fit, truth in fit_seeds(task, places, count, first):
        if fit.is_fitted:
            (force,) = (one for one in fit.forces if one.member == "foot_anchor")
            away = math.log(truth["foot_anchor"] / force.after.value)
            found.append(away / force.deviation_after)
    return np.array(found)
