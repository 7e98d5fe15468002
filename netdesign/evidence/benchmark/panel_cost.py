"""Cost of a panel in a search: the example's rows with one against without.

Processor time, in turn with and without, so that a busy machine slows both.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from statistics import median
from typing import Any

from netdesign.coupling.scene import SolverSettings
from netdesign.envelope.rows import RowEnvelope
from netdesign.evidence.benchmark.whole_site import build_bench_site
from netdesign.panel.inputs import Panel, Rope
from netdesign.site.model import BorderRope, NetRow, RowPanel, Site
from netdesign.solving.runner import Runner
from netdesign.study.cases import search_site
from netdesign.study.check_run import CheckRun
from netdesign.words.message import say

SCHEMA = "netdesign.bench-panel/1"
MOST = 1.5  # times the search without a panel
ROWS = 7  # of the example
_ROPE = Rope(stiffness=18e6, sag=0.05)
_BEARS = BorderRope(type_id="18 MN", breaking=None, source="")


@dataclass(frozen=True, slots=True, kw_only=True)
class Pair:
    """Searches of one row, without and with a panel: processor time and cases."""

    plain_s: float
    panel_s: float
    plain_cases: int
    panel_cases: int
    is_closed: bool

    @property
    def times(self) -> float:
        """With a panel over without [-]."""
        return self.panel_s / self.plain_s


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
    site = build_bench_site(rows)
    found = [_describe(row, _measure_row(site, row, run, repeats)) for row in site.rows]
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


def _measure_row(site: Site, row: NetRow, run: CheckRun, repeats: int) -> list[Pair]:
    """Pairs of one row; the first searches warm up and do not count."""
    plain = replace(site, rows=(replace(row, panel=None),))
    panel = replace(site, rows=(replace(row, panel=_build_panel(row)),))
    _search(plain, run)
    pairs = []
    for number in range(repeats):
        order = (plain, panel) if number % 2 else (panel, plain)
        timed = {id(one): _search(one, run) for one in order}
        (plain_s, without), (panel_s, beside) = timed[id(plain)], timed[id(panel)]
        pairs.append(
            Pair(
                plain_s=plain_s,
                panel_s=panel_s,
                plain_cases=len(without.results),
                panel_cases=len(beside.results),
                is_closed=without.gap is None and beside.gap is None,
            )
        )
    return pairs


def _build_panel(row: NetRow) -> RowPanel:
    panel = Panel(
        post_spacing=row.layout.post_spacing, lower=_ROPE, upper=_ROPE, cut="uniform"
    )
    return RowPanel(panels=(panel,), lower=_BEARS, upper=_BEARS)


def _search(site: Site, run: CheckRun) -> tuple[float, RowEnvelope]:
    start = time.process_time()
    (found,) = search_site(site, run, Runner())
    return time.process_time() - start, found


def _describe(row: NetRow, pairs: Sequence[Pair]) -> dict[str, Any]:
    first = pairs[0]
    return {
        "row": row.id,
        "times": median(one.times for one in pairs),
        "plain_s": min(one.plain_s for one in pairs),
        "panel_s": min(one.panel_s for one in pairs),
        "plain_cases": first.plain_cases,
        "panel_cases": first.panel_cases,
        "is_closed": first.is_closed,
    }
