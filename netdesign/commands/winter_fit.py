"""``netdesign winter --fit``: options, solves and lines of fits to measured forces."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import wraps
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.language import tell
from netdesign.errors import ModelError
from netdesign.words.message import say

if TYPE_CHECKING:
    from netdesign.files.winter import WinterRun
    from netdesign.site.model import Site
    from netdesign.solving.runner import Runner
    from netdesign.words.catalogue import Language

SOLVES = 600  # of a fit, about
FIT_NAMES = ("noise", "cell_error", "rope_kelvin", "known")  # of its parameters
_PARAMETERS = {
    "slip": "slip_length",
    "density": "density_factor",
    "height": "height_factor",
    "slack": "slack",
    "friction": "friction_angle",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class FitChoice:
    """Noise and surveyed parameters of a fit, as typed.

    Attributes
    ----------
    noise, cell_error : float
        Relative [-].
    rope_kelvin : float
        [K].
    known : tuple of str
        Keys of ``_PARAMETERS``.
    """

    noise: float
    cell_error: float
    rope_kelvin: float
    known: tuple[str, ...]


def fit_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add ``--fit`` and what it takes: one argument, ``fit``, None without it."""

    @wraps(command)
    def packed(*arguments: Any, is_fitted: bool, **given: Any) -> Any:
        choice = FitChoice(**{name: given.pop(name) for name in FIT_NAMES})
        return command(*arguments, fit=choice if is_fitted else None, **given)

    for option in (
        click.option(
            "--known",
            multiple=True,
            type=click.Choice(tuple(_PARAMETERS)),
            help="Surveyed: not fitted.",
        ),
        click.option(
            "--rope-kelvin",
            type=click.FloatRange(0.0, 30.0),
            default=5.0,
            show_default=True,
            help="Amplitude of the ropes' daily wave [K]: noise.",
        ),
        click.option(
            "--cell-error",
            type=click.FloatRange(0.0, 0.5),
            default=0.05,
            show_default=True,
            help="Noise common to all readings of a member.",
        ),
        click.option(
            "--noise",
            type=click.FloatRange(0.001, 0.5),
            default=0.05,
            show_default=True,
            help="Noise of each reading, relative.",
        ),
        click.option(
            "--fit", "is_fitted", is_flag=True, help="Fit to sheet Monitoring."
        ),
    ):
        packed = option(packed)
    return packed


def require_measured_forces(site: Site) -> None:
    """Refuse a fit of rows on which nothing was measured.

    Raises
    ------
    ModelError
        If no row has a force with a date.
    """
    from netdesign.study.measured_pulls import list_measured_pulls

    if not any(list_measured_pulls(site, row.id) for row in site.rows):
        raise ModelError(say("fit.no_measured_forces"))


def fit_rows(run: WinterRun, choice: FitChoice | None, runner: Runner) -> WinterRun:
    """Run with the fit of each row with measured forces; as it is without a choice."""
    if choice is None:
        return run
    from netdesign.study.measured_pulls import list_measured_pulls
    from netdesign.winter.day import DaySolver
    from netdesign.winter.fit import FIT_SETTINGS, fit_season
    from netdesign.winter.fit_readings import Noise
    from netdesign.winter.fit_task import choose_fit

    stated = Noise(
        reading=choice.noise, cell=choice.cell_error, rope=choice.rope_kelvin
    )
    fits = {}
    for row, result in zip(run.rows, run.results, strict=True):
        measured = list_measured_pulls(run.site, row.id)
        if not measured:
            continue
        task = choose_fit(
            result,
            run.packs,
            measured,
            DaySolver(row=row, settings=FIT_SETTINGS, runner=runner),
            noise=stated,
            known=[_PARAMETERS[one] for one in choice.known],
            design_density=run.site.ranges["density"].high,
        )
        fits[row.id] = fit_season(task)
    return replace(run, fits=fits)


def tell_fit(row: str, fit: Mapping[str, Any], language: Language) -> None:
    """Print what a fit says, and the bands that follow from it."""
    tell(
        say(
            "fit.line",
            row=row,
            winter=fit["winter"] or "-",
            readings=fit["readings"],
            days=fit["days"],
            why=fit["why"],
        ),
        language,
    )
    for force in fit["forces"] if fit["outcome"] == "fitted" else ():
        tell(
            say(
                "fit.force_line",
                row=row,
                case=say(f"fit_case.{force['case']}"),
                member=say(f"member.{force['member']}"),
                before_low=force["before_kN"]["low"],
                before_high=force["before_kN"]["high"],
                after_low=force["after_kN"]["low"],
                after_high=force["after_kN"]["high"],
            ),
            language,
        )
