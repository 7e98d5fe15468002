"""Tables of the paper's study."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from netdesign.addons.evidence.paper.runs import (
    FRICTIONS_DEG,
    INCLINATIONS_DEG,
    NETS_DEG,
    NORMAL_NET_DEG,
    PaperRun,
    PaperStudy,
    Track,
    find_exchange,
    find_history,
    find_steady,
)
from netdesign.addons.evidence.table import (
    CHANGES,
    ERRORS,
    FORCES,
    INCLINATIONS,
    TIMES,
    Kind,
    tabulate,
)
from netdesign.report.blocks import Table, text_cell
from netdesign.report.words import ENGLISH

Columns = tuple[tuple[str, Kind], ...]  # headings, or their keys, and kinds
_WORDS = Kind(
    show=lambda key: text_cell(ENGLISH(f"paper_value.{key}")), is_number=False
)
_NET = ("θ [°]", INCLINATIONS)


def list_tables(study: PaperStudy) -> dict[str, Table]:
    """Tables of the study by their anchors on the page."""
    return {
        "plateau": _tabulate_plateaus(study),
        "friction": _tabulate_growth(study),
        "inclination-and-gravity": _tabulate_parameters(study),
    }


def _tabulate_plateaus(study: PaperStudy) -> Table:
    columns: Columns = (
        _NET,
        ("paper_table.method", _WORDS),
        ("paper_table.foot", FORCES),
        ("± ", ERRORS),
        ("paper_table.head", FORCES),
        ("± ", ERRORS),
        ("paper_table.foot_against_steady", CHANGES),
        ("paper_table.largest_foot", FORCES),
        ("paper_table.plateau_from", TIMES),
    )
    rows = []
    for net in NETS_DEG:
        straight = find_history(net)
        ways = {
            "steady": find_steady(straight),
            "sagged": replace(straight, start="sagged"),
            "straight": straight,
            "staggered": find_exchange(net),
        }
        steady = study[find_steady(straight)].foot
        for way, case in ways.items():
            run = study[case]
            has_error = case.method != "staggered" and not run.failure
            rows.append(
                (
                    *(net, f"way_{way}"),
                    *(run.foot, run.foot_error if has_error else None),
                    *(run.head, run.head_error if has_error else None),
                    _change(run.foot, steady),
                    None if run.track is None else float(run.track.foot.max()),
                    run.plateau_time,
                )
            )
    return tabulate(ENGLISH("paper_table.plateau"), columns, rows)


def _tabulate_growth(study: PaperStudy) -> Table:
    columns: Columns = (
        ("paper_table.method", _WORDS),
        _NET,
        ("paper_table.force", _WORDS),
        *((f"{phi:.0f}°", FORCES) for phi in FRICTIONS_DEG),
        ("paper_table.change", CHANGES),
    )
    rows: list[tuple[object, ...]] = []
    for net in NETS_DEG:
        histories = [find_history(net, phi) for phi in FRICTIONS_DEG]
        rows += _grow_histories("transient", net, [study[case] for case in histories])
        steady = [study[find_steady(case)] for case in histories]
        for end in ("foot", "head"):
            values = [getattr(run, end) for run in steady]
            rows.append(("steady", net, end, *values, _change(values[-1], values[0])))
    exchanges = [study[find_exchange(NORMAL_NET_DEG, phi)] for phi in FRICTIONS_DEG]
    rows += _grow_histories("staggered", NORMAL_NET_DEG, exchanges)
    return tabulate(ENGLISH("paper_table.friction"), columns, rows)


def _grow_histories(
    method: str, inclination: float, runs: Sequence[PaperRun]
) -> Iterator[tuple[object, ...]]:
    """At one time for all: when the last of them has come to its plateau, or ended.

    The change of a component of a node's force is told over that whole force.
    """
    tracks = [run.track for run in runs if run.track is not None]
    if len(tracks) < len(runs):
        return
    ends = [float(track.times[-1]) for track in tracks]
    begins = [run.plateau_time or end for run, end in zip(runs, ends, strict=True)]
    time = min(max(begins), min(ends))
    for end in ("foot", "head"):
        values = [track.at(time, end) for track in tracks]
        yield (method, inclination, end, *values, values[-1] / values[0] - 1.0)
    for node in ("lower", "upper"):
        forces = [_read_node(track, node, time) for track in tracks]
        whole = math.hypot(*forces[0])
        for axis, name in enumerate("xy"):
            values = [abs(force[axis]) for force in forces]
            change = (values[-1] - values[0]) / whole
            yield (method, inclination, f"{node}_{name}", *values, change)


def _read_node(track: Track, node: str, time: float) -> tuple[float, float]:
    x, y = (float(np.interp(time, track.times, part)) for part in getattr(track, node))
    return x, y


def _tabulate_parameters(study: PaperStudy) -> Table:
    columns: Columns = (
        _NET,
        ("paper_table.gravity", _WORDS),
        ("paper_table.history_foot", FORCES),
        ("paper_table.history_head", FORCES),
        ("paper_table.steady_foot", FORCES),
        ("paper_table.steady_head", FORCES),
    )
    cases = [find_history(net) for net in (NORMAL_NET_DEG, *INCLINATIONS_DEG)]
    cases += [replace(find_history(net), gravity="parallel") for net in NETS_DEG]
    rows = []
    for case in cases:
        history, steady = study[case], study[find_steady(case)]
        ends = (history.foot, history.head, steady.foot, steady.head)
        rows.append((case.inclination_deg, case.gravity, *ends))
    return tabulate(ENGLISH("paper_table.parameters"), columns, rows)


def _change(value: float | None, reference: float | None) -> float | None:
    """Share by which a value differs from a reference; None without one of them."""
    if value is None or reference is None:
        return None
    return value / reference - 1.0
