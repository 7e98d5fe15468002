"""``netdesign layout``: rows proposed for a starting zone, checked, with their cost."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.options import (
    DEFAULT_STANDARD,
    accuracy_option,
    force_option,
    json_option,
    language_option,
    out_option,
    quiet_option,
    solving_options,
)
from netdesign.commands.running import (
    find_exit_code,
    format_time,
    open_run,
    own_command,
    print_document,
    print_faults,
)
from netdesign.commands.usage import UsageRefusal, tell
from netdesign.words.catalogue import Language
from netdesign.words.message import say

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from netdesign.checks import Standard
    from netdesign.numerics.arrays import Floats
    from netdesign.solving.runner import Runner
    from netdesign.study.check_run import CheckRun
    from netdesign.study.check_site import Watch
    from netdesign.study.cost import Prices
    from netdesign.study.records import RowStudy, Study
    from netdesign.terrain.constructions import Catalogue
    from netdesign.terrain.coverage import Coverage
    from netdesign.terrain.grid import Grid
    from netdesign.terrain.layout import ProposedRow
    from netdesign.terrain.measure import MeasuredRow
    from netdesign.terrain.plan import Plan
    from netdesign.terrain.surface import Surface

DEFAULT_FOLDER = "netdesign-layout"
_GUIDELINE = "swiss-guideline-2007"
_SITE, _ROWS, _DRAWN, _PLAN = "site.xlsx", "rows.geojson", "plan.geojson", "plan.json"
_FILE = click.Path(path_type=Path, dir_okay=False)


@click.command()
@click.argument("grid", type=_FILE)
@click.argument("zone", type=_FILE)
@click.option(
    "--types",
    type=_FILE,
    metavar="SITE",
    required=True,
    help="Workbook: the nets that may be built on sheet Nets, all types, ranges.",
)
@click.option("--snow", type=click.FloatRange(0.1, 20.0), help="Vertical height [m].")
@click.option("--snow-altitude", type=float, help="Where that height holds [m].")
@click.option(
    "--snow-gradient",
    type=click.FloatRange(-1.0, 1.0),
    help="Its change in 100 m of altitude [m].",
)
@click.option("--snow-grid", type=_FILE, help="Grid of vertical heights instead [m].")
@click.option("--prices", type=_FILE, help="csv of type, price, per: the cheapest.")
@click.option(
    "--standard", metavar="ID", default=DEFAULT_STANDARD, help="Limit profile."
)
@click.option(
    "--spacing-standard",
    metavar="ID",
    default=_GUIDELINE,
    show_default=True,
    help="Limit profile of the distance of rows.",
)
@accuracy_option("Relative error allowed in every end force of the net.", default=0.01)
@solving_options
@out_option(f"Folder of the outputs [{DEFAULT_FOLDER}].")
@language_option("Of workbook and messages.")
@json_option("plan")
@force_option
@quiet_option
def layout(grid: Path, zone: Path, **asked: Any) -> None:
    """Propose net rows for a starting zone, and check each of them.

    \b
    netdesign layout grid.asc zone.geojson --types types.xlsx --snow 3.8
    netdesign layout grid.asc zone.geojson --types types.xlsx --snow 3.2 \\
        --snow-altitude 1850 --snow-gradient 0.15 --prices prices.csv

    Rows of 12 to 60 m follow the contours, as far apart as the guideline allows on the
    steepest slope between them. Each has the lowest net of sheet Nets that is as high
    as its snow, and the smallest or cheapest types of the workbook that pass.
    """
    task = _read(grid, zone, asked)
    folder: Path = asked["out"] or Path(DEFAULT_FOLDER)
    _require_free(folder, asked)
    plan, rows = _propose(task)
    measured = _measure(task, plan)
    studied = _check(task, rows, measured, asked)
    document = _describe(task, rows, measured, studied)
    _write(task, folder, measured, studied, document, asked)
    if asked["as_json"]:
        print_document(document)
    else:
        _tell_plan(document, asked["language"])
    failed = print_faults(studied.faults, asked["language"])
    raise SystemExit(failed or find_exit_code([studied.study]))
