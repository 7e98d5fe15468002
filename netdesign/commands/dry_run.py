"""What a check would do, and how long it would take here; nothing is written."""

from __future__ import annotations

import json
import time
from dataclasses import replace
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from netdesign.site.model import Site
    from netdesign.site_cases import CheckRun


_TIMED_ROWS = 5  # about; enough for a guess, few enough to be quick


def announce(site: Site, run: CheckRun, *, as_json: bool) -> None:
    """Print net rows, cases and the predicted time."""
    from netdesign.site_cases import count_cases

    cases = count_cases(site)
    seconds = _measure_case(site, run) * cases / run.jobs
    if as_json:
        plan = {
            "schema": "netdesign.plan/1",
            "net_rows": len(site.rows),
            "cases": cases,
            "is_searched": not site.ranges.is_grid,  # then about so many
            "jobs": run.jobs,
            "predicted_s": seconds,
            "notes": list(site.notes),
        }
        click.echo(json.dumps(plan, indent=1))
        return
    about = "" if site.ranges.is_grid else "about "
    click.echo(
        f"{site.file_name}: {len(site.rows)} net rows, {about}{cases} cases, about "
        f"{max(seconds, 1.0):.0f} s with {run.jobs} processes; nothing was written"
    )
    for note in site.notes:
        click.echo(f"note: {note}")


def _measure_case(site: Site, run: CheckRun) -> float:
    """Seconds of one case on this machine: the middle of the ranges, for some rows."""
    from netdesign.envelope.grid import Interval, Ranges
    from netdesign.site_cases import solve_site

    def middle(interval: Interval) -> Interval:
        value = (interval.low + interval.high) / 2
        return Interval(low=value, high=value, count=1)

    ranges = Ranges(
        density=middle(site.ranges.density),
        friction_angle=middle(site.ranges.friction_angle),
        inclination=middle(site.ranges.inclination),
    )
    rows = site.rows[:: max(1, len(site.rows) // _TIMED_ROWS)]
    alone = replace(run, jobs=1)
    # the first solve also loads what the solver needs, which happens only once
    solve_site(replace(site, rows=rows[:1], ranges=ranges), alone)
    start = time.perf_counter()
    solve_site(replace(site, rows=rows, ranges=ranges), alone)
    return (time.perf_counter() - start) / len(rows)
