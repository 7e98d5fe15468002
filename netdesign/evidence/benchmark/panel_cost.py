"""Cost of a panel in a search: the example's rows with one against without.

Processor time, in turn with and without, so that a busy machine slows both.
"""

from __future__ import annotations

import tempfile
from dataclasses import replace
from functools import partial
from pathlib import Path
from statistics import median
from typing import Any

from netdesign.coupling.scene import SolverSettings
from netdesign.envelope.rows import RowEnvelope
from netdesign.evidence.runner import measure, run_in_turns
from netdesign.panel.inputs import Panel, Rope
from netdesign.site.model import BorderRope, NetRow, RowPanel, Site
from netdesign.site.reader import read_site
from netdesign.site.template.workbook import write_site_workbook
from netdesign.solving.runner import Runner
from netdesign.study.cases import search_site
from netdesign.study.check_run import CheckRun
from netdesign.words.message import say

SCHEMA = "netdesign.bench-panel/1"
MOST = 1.5  # times the search without a panel
ROWS = 7  # of the example
_ROPE = Rope(stiffness=18e6, sag=0.05)
_BEARS = BorderRope(type_id="18 MN", breaking=None, source="")


def measure_panel_cost(
    *, repeats: int = 7, rows: int = ROWS, settings: SolverSettings | None = None
) -> dict[str, Any]:
    """Cost of a panel for each of the example's rows; its texts are messages.

    Parameters
    ----------
    repeats : int
        Pairs of searches a row; their median counts.
    rows : int
        How many of the example's rows.
    settings : SolverSettings, optional
        Of every case; the defaults of ``netdesign check`` unless told otherwise.

    Verified by
    -----------
    tests/evidence/benchmark/test_panel_cost.py
    """
    run = CheckRun(settings=settings or SolverSettings(accuracy=0.01))
    site = _read_example()
    found = [_measure_row(site, row, run, repeats) for row in site.rows[:rows]]
    times = [one["times"] for one in found]
    return {
        "schema": SCHEMA,
        "what": say("bench.panel_what"),
        "reach": say("bench.panel_reach", most=MOST),
        "reached": max(times) <= MOST,
        "repeats": repeats,
        "median": median(times),
        "rows": found,
    }


def _read_example() -> Site:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "example.xlsx"
        write_site_workbook(path, example=True)
        return read_site(path)


def _measure_row(
    site: Site, row: NetRow, run: CheckRun, repeats: int
) -> dict[str, Any]:
    """Searches of one row, without and with a panel; the first warms up."""
    plain, panel = (
        partial(_search, replace(site, rows=(replace(row, panel=given),)), run)
        for given in (None, _build_panel(row))
    )
    plain()
    works = {"panel": partial(measure, panel), "plain": partial(measure, plain)}
    found = run_in_turns(works, repeats)
    without, beside = found["plain"], found["panel"]
    searches = [search for search, _ in (without[0], beside[0])]
    ratios = [
        time.cpu_s / plain_time.cpu_s
        for (_, plain_time), (_, time) in zip(without, beside, strict=True)
    ]
    return {
        "row": row.id,
        "times": median(ratios),
        "plain_s": min(time.cpu_s for _, time in without),
        "panel_s": min(time.cpu_s for _, time in beside),
        "plain_cases": len(searches[0].results),
        "panel_cases": len(searches[1].results),
        "is_closed": all(search.gap is None for search in searches),
    }


def _build_panel(row: NetRow) -> RowPanel:
    panel = Panel(
        post_spacing=row.layout.post_spacing, lower=_ROPE, upper=_ROPE, cut="uniform"
    )
    return RowPanel(panels=(panel,), lower=_BEARS, upper=_BEARS)


def _search(site: Site, run: CheckRun) -> RowEnvelope:
    (found,) = search_site(site, run, Runner())
    return found
