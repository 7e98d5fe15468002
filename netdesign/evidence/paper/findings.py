"""The paper's statements, each decided by numbers that the runs computed."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Literal

import numpy as np

from netdesign.evidence.paper.runs import (
    FRICTIONS_DEG,
    NETS_DEG,
    NORMAL_NET_DEG,
    PAPER_TIME,
    RELATIVE_DENSITY,
    PaperCase,
    PaperRun,
    PaperStudy,
    Track,
    find_exchange,
    find_history,
    find_paper_time,
    find_steady,
    find_trend,
)
from netdesign.numerics.arrays import Floats
from netdesign.report.blocks import SMALL, Pair, Piece
from netdesign.report.words import ENGLISH, Words
from netdesign.snow.creep_law import ICE_DENSITY
from netdesign.units import SECONDS_PER_DAY

Call = Literal["agrees", "does not agree", "not decided"]
Trend = Literal["grows", "level", "falls", "mixed", "unknown"]

# A change counts if it is larger: the error of a history in time, meshes being equal.
LEAST_CHANGE = 0.01
# "Matters little": within what the plateau's own criterion lets a force drift.
LITTLE = 0.05
LEAST_SWING = 0.01  # of the largest value: a smaller turn is no oscillation
# Creep time in which a straight net finds its first shape: not counted as swinging.
SETTLED = 1e-5
_LEAST_JUMP = 0.005  # of the last value, off the line through the neighbours


@dataclass(frozen=True, slots=True, kw_only=True)
class Growth:
    """One force at the three friction angles, and whether it grows with them."""

    method: str
    inclination_deg: float
    quantity: str
    values: tuple[float | None, ...]  # [N/m]
    scale: float | None = None  # [N/m]; the node's whole force for a component of it

    @property
    def trend(self) -> Trend:
        """By each step from one friction angle to the next."""
        known = [value for value in self.values if value is not None]
        if len(known) < len(self.values):
            return "unknown"
        steps = [
            _judge_step((high - low) / (self.scale or known[0]))
            for low, high in pairwise(known)
        ]
        if {"grows", "falls"} <= set(steps):
            return "mixed"
        return next((step for step in steps if step != "level"), "level")

    @property
    def change(self) -> float | None:
        """From the smallest angle to the largest, over the scale or the first [-]."""
        first, last = self.values[0], self.values[-1]
        if first is None or last is None:
            return None
        return (last - first) / (self.scale or first)


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """One statement of the paper: whether the runs agree, and the numbers for it."""

    key: str
    call: Call
    numbers: Mapping[str, float] = field(default_factory=dict)


def judge_growth(study: PaperStudy) -> list[Growth]:
    """Forces against friction, by method and inclination."""
    found = []
    for inclination in NETS_DEG:
        runs = [study[find_history(inclination, phi)] for phi in FRICTIONS_DEG]
        found += _grow_histories("transient", inclination, runs)
        steady = [study[find_steady(run.case)] for run in runs]
        for end in ("foot", "head"):
            found.append(
                Growth(
                    method="steady",
                    inclination_deg=inclination,
                    quantity=end,
                    values=tuple(getattr(run, end) for run in steady),
                )
            )
    exchanges = [
        study[find_exchange(NORMAL_NET_DEG, study.settings, phi)]
        for phi in FRICTIONS_DEG
    ]
    return [*found, *_grow_histories("staggered", NORMAL_NET_DEG, exchanges)]


def list_findings(study: PaperStudy) -> list[Finding]:
    """Every statement of the paper, decided or not."""
    return [
        _decide_growth(study),
        _decide_oscillation(study),
        _decide_settlement(study),
        _decide_density(study),
        _decide_densification(study),
        _decide_swelling(study),
        _decide_seconds(study),
    ]


def count_swings(values: Floats) -> int:
    """Times that a force turns back by more than ``LEAST_SWING`` of its largest size.

    >>> count_swings(np.array([0.0, 1.0, 0.5, 1.0, 0.999, 1.0]))
    2
    """
    amount = LEAST_SWING * float(np.abs(values).max(initial=0.0))
    swings, direction, extreme = 0, 0, float(values[0])
    for value in values.tolist():
        if direction >= 0 and value < extreme - amount:
            swings += direction > 0
            direction, extreme = -1, value
        elif direction <= 0 and value > extreme + amount:
            swings += direction < 0
            direction, extreme = 1, value
        elif direction * (value - extreme) > 0:
            extreme = value
    return swings


def last_swing(run: PaperRun) -> float | None:
    """Time after which the foot's pull jumps no more from step to step [s]."""
    if run.track is None or len(run.track.foot) < 3:
        return None
    foot = run.track.foot
    jumps = np.abs(foot[1:-1] - (foot[2:] + foot[:-2]) / 2.0)
    late = np.flatnonzero(jumps > _LEAST_JUMP * foot[-1])
    return float(run.track.times[late[-1] + 1]) if late.size else 0.0


def _judge_step(change: float) -> Trend:
    if abs(change) <= LEAST_CHANGE:
        return "level"
    return "grows" if change > 0 else "falls"


def _grow_histories(
    method: str, inclination: float, runs: list[PaperRun]
) -> list[Growth]:
    """At one time for all: when the last of them has come to its plateau, or ended."""
    tracks = [run.track for run in runs]
    known = [track for track in tracks if track is not None]
    if len(known) < len(tracks):
        return []
    ends = [float(track.times[-1]) for track in known]
    begins = [run.plateau_time or end for run, end in zip(runs, ends, strict=True)]
    time = min(max(begins), min(ends))
    found = [
        Growth(
            method=method,
            inclination_deg=inclination,
            quantity=end,
            values=tuple(track.at(time, end) for track in known),
        )
        for end in ("foot", "head")
    ]
    for node in ("lower", "upper"):
        forces = [_read_node(track, node, time) for track in known]
        found += [
            Growth(
                method=method,
                inclination_deg=inclination,
                quantity=f"{node}_{name}",
                values=tuple(abs(force[axis]) for force in forces),
                scale=math.hypot(*forces[0]),
            )
            for axis, name in enumerate("xy")
        ]
    return found


def _read_node(track: Track, node: str, time: float) -> tuple[float, float]:
    x, y = (float(np.interp(time, track.times, part)) for part in getattr(track, node))
    return x, y


def _decide_growth(study: PaperStudy) -> Finding:
    """Every force of the paper's own scene has to grow."""
    growth = [
        one
        for one in judge_growth(study)
        if one.method != "steady" and one.inclination_deg == NORMAL_NET_DEG
    ]
    own = [one for one in growth if one.method == "transient"]
    trends = [one.trend for one in own]
    if not own or "unknown" in trends:
        return Finding(key="growth", call="not decided")
    changes = {one.quantity: (one.change or 0.0) for one in own}
    exchange = [one for one in growth if one.method == "staggered"]
    return Finding(
        key="growth",
        call="agrees" if all(t == "grows" for t in trends) else "does not agree",
        numbers={
            "forces": len(own),
            "growing": trends.count("grows"),
            "level": trends.count("level"),
            "falling": trends.count("falls") + trends.count("mixed"),
            "foot": changes["foot"],
            "head": changes["head"],
            "exchange_growing": sum(one.trend == "grows" for one in exchange),
            "exchange_forces": len(exchange),
        },
    )


def _decide_oscillation(study: PaperStudy) -> Finding:
    """The exchange has to swing, then rest; what the implicit history does is told."""
    exchange = study[find_exchange(NORMAL_NET_DEG, study.settings)]
    history = study[find_history(NORMAL_NET_DEG)]
    if exchange.track is None or history.track is None:
        return Finding(key="oscillation", call="not decided")
    trend = find_trend(study.settings)[:-1]
    swings = count_swings(exchange.track.foot)
    settled = SETTLED * history.case.scene.time_scale
    is_settled = history.track.times > settled
    agrees = swings > 1 and exchange.foot is not None and history.foot is not None
    first, last = (last_swing(study[case]) or 0.0 for case in (trend[0], trend[-1]))
    return Finding(
        key="oscillation",
        call="agrees" if agrees else "does not agree",
        numbers={
            "exchange_swings": swings,
            "history_swings": count_swings(history.track.foot[is_settled]),
            "settled": settled,
            "exchange_plateau": exchange.plateau_time or math.nan,
            "history_plateau": history.plateau_time or math.nan,
            "swings_until": last_swing(exchange) or 0.0,
            "largest_drag": trend[0].drag,
            "smallest_drag": trend[-1].drag,
            "swings_first": first,
            "swings_last": last,
        },
    )


def _decide_settlement(study: PaperStudy) -> Finding:
    """Full gravity against that along the slope, in the paper's scene."""
    numbers: dict[str, float] = {}
    for inclination in NETS_DEG:
        full = find_history(inclination)
        pairs = {"history": full, "steady": find_steady(full)}
        for name, case in pairs.items():
            for end in ("foot", "head"):
                change = _compare(study, case, replace(case, gravity="parallel"), end)
                if change is None:
                    return Finding(key="settlement", call="not decided")
                numbers[f"{name}_{end}_{inclination:g}"] = change
    own = [abs(value) for key, value in numbers.items() if key.endswith("_0")]
    late = find_history(NORMAL_NET_DEG)
    ends = [
        float(track.foot[-1])
        for case in (late, replace(late, gravity="parallel"))
        if (track := study[case].track) is not None
    ]
    agrees = max(own) < LITTLE
    return Finding(
        key="settlement",
        call="agrees" if agrees else "does not agree",
        numbers={
            **numbers,
            "largest": max(own),
            "little": LITTLE,
            "late_foot_0": ends[-1] / ends[0] - 1.0,
        },
    )


def _compare(
    study: PaperStudy, case: PaperCase, other: PaperCase, end: str
) -> float | None:
    """Change of a pull on the plateau from one case to another [-]."""
    before, after = (getattr(study[one], end) for one in (case, other))
    return None if before is None or after is None else after / before - 1.0


def _decide_density(study: PaperStudy) -> Finding:
    """Mean density after the paper's 8 s and at the end."""
    early = study[find_paper_time()].shape
    late = study[find_history(NORMAL_NET_DEG)]
    if early is None or late.shape is None or late.track is None:
        return Finding(key="density", call="not decided")
    first = RELATIVE_DENSITY * ICE_DENSITY
    rise = early.mean_density / first - 1.0
    return Finding(
        key="density",
        call="agrees" if rise < LEAST_CHANGE else "does not agree",
        numbers={
            "rise": rise,
            "first": first,
            "late": late.shape.mean_density,
            "days": float(late.track.times[-1]) / SECONDS_PER_DAY,
            "largest_early": late.track.at(PAPER_TIME, "density") * ICE_DENSITY,
        },
    )


def _decide_densification(study: PaperStudy) -> Finding:
    """Pull on the foot with densification against without, at one time."""
    begins, effects = [], []
    for start in ("straight", "sagged"):
        case = replace(find_history(NORMAL_NET_DEG), start=start)
        dense, loose = study[case], study[replace(case, densifies=False)]
        begin = dense.plateau_time
        if dense.track is None or loose.track is None or begin is None:
            return Finding(key="densification", call="not decided")
        begins.append(begin)
        effects.append(
            dense.track.at(begin, "foot") / loose.track.at(begin, "foot") - 1.0
        )
    return Finding(
        key="densification",
        call="agrees" if max(map(abs, effects)) < LITTLE else "does not agree",
        numbers={
            "straight": effects[0],
            "sagged": effects[1],
            "straight_time": begins[0],
            "sagged_time": begins[1],
            "little": LITTLE,
        },
    )


def _decide_swelling(study: PaperStudy) -> Finding:
    """Sag of the net at the end against friction."""
    numbers: dict[str, float] = {}
    for inclination in NETS_DEG:
        shapes = [
            study[find_history(inclination, phi)].shape
            for phi in (FRICTIONS_DEG[0], FRICTIONS_DEG[-1])
        ]
        if any(shape is None for shape in shapes):
            return Finding(key="swelling", call="not decided")
        low, high = (shape.sag for shape in shapes if shape is not None)
        numbers[f"low_{inclination:g}"] = low
        numbers[f"high_{inclination:g}"] = high
        numbers[f"change_{inclination:g}"] = high / low - 1.0
    grows = numbers[f"change_{NORMAL_NET_DEG:g}"] > LEAST_CHANGE
    return Finding(
        key="swelling",
        call="agrees" if grows else "does not agree",
        numbers=numbers,
    )


def _decide_seconds(study: PaperStudy) -> Finding:
    """The plateau has to begin within the 8 s that the paper computed."""
    run = study[find_history(NORMAL_NET_DEG)]
    begin = run.plateau_time
    if run.track is None or run.foot is None or begin is None:
        return Finding(key="seconds", call="not decided")
    return Finding(
        key="seconds",
        call="agrees" if begin <= PAPER_TIME else "does not agree",
        numbers={
            "plateau": begin,
            "share": run.track.at(PAPER_TIME, "foot") / run.foot,
            "ratio": begin / PAPER_TIME,
        },
    )


_SYMBOLS: dict[Call, str] = {"agrees": "✓", "does not agree": "✗", "not decided": "?"}


def word_finding(finding: Finding, words: Words = ENGLISH) -> Pair:
    """Statement with its call; what was found, its numbers put in, and the reason."""
    key, call = finding.key, finding.call
    found, reason = words("paper.no_run"), ""
    if call != "not decided":
        found = words(f"paper_found.{key}", **finding.numbers)
        reason = words(f"paper_reason.{key}", **finding.numbers)
    pieces = (
        Piece(words(f"paper_said.{key}"), "said"),
        Piece(_write_minus(found), "found"),
        Piece(_write_minus(reason), SMALL),
    )
    called = words(f"paper_call.{call.replace(' ', '_')}")
    return Pair(
        name=f"{_SYMBOLS[call]} {called}",
        text=tuple(one for one in pieces if one.text),
        look="" if call == "agrees" else "differs",
    )


def _write_minus(text: str) -> str:
    """Proper minus signs before digits; none before a rounded zero."""
    return re.sub(r"-(?=\d)", "−", re.sub(r"[+-](?=0[.,]0\s?%)", "", text))
