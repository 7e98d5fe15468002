"""Tables of the paper's study, for the page and as CSV."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from netdesign.coupling.history.settings import Start
from netdesign.evidence.paper.findings import judge_growth, last_swing
from netdesign.evidence.paper.runs import (
    FRICTIONS_DEG,
    INCLINATIONS_DEG,
    NETS_DEG,
    NORMAL_NET_DEG,
    PaperCase,
    PaperRun,
    PaperStudy,
    find_exchange,
    find_history,
    find_steady,
    find_trend,
)
from netdesign.evidence.table import (
    CHANGES,
    ERRORS,
    FORCE,
    FORCES,
    FRICTIONS,
    GIVEN,
    INCLINATIONS,
    TEXTS,
    TIMES,
    Kind,
    kilo,
    tabulate,
)
from netdesign.report.blocks import Table, text_cell, write_csv
from netdesign.report.words import MISSING, Words
from netdesign.units import day_from_second

_STARTS: tuple[Start, ...] = ("sagged", "straight")


@dataclass(frozen=True, slots=True, kw_only=True)
class Listed:
    """One table: name of its CSV file, keys of its columns, cells."""

    name: str
    keys: tuple[str, ...]
    table: Table

    def render(self) -> bytes:
        """CSV with full precision; a missing number is an empty cell."""
        rows = [
            [cell.number if column.is_number else cell.text for cell, column in pairs]
            for pairs in (
                list(zip(row, self.table.columns, strict=True))
                for row in self.table.rows
            )
        ]
        return write_csv(self.keys, rows)


Columns = Mapping[str, tuple[str, Kind]]  # by their keys in a file: heading, kind
_WORDS = Kind(
    show=lambda words, key: text_cell(words(f"paper_value.{key}")), is_number=False
)
_NET: Columns = {"inclination_deg": ("θ [°]", INCLINATIONS)}


def list_tables(study: PaperStudy, words: Words) -> list[Listed]:
    """All tables of the study in a language."""
    return [
        _tabulate_plateaus(study, words),
        _tabulate_growth(study, words),
        _tabulate_parameters(study, words),
        _tabulate_trend(study, words),
        _tabulate_drift(study, words),
        _tabulate_runs(study, words),
    ]


def _list(
    name: str,
    caption: str,
    columns: Columns,
    rows: Iterable[Sequence[object]],
    words: Words,
) -> Listed:
    table = tabulate(caption, list(columns.values()), rows, words)
    return Listed(name=name, keys=tuple(columns), table=table)


def _tabulate_plateaus(study: PaperStudy, words: Words) -> Listed:
    columns: Columns = {
        **_NET,
        "method": ("paper_table.method", _WORDS),
        "foot_kN_per_m": ("paper_table.foot", FORCES),
        "foot_error_kN_per_m": ("± ", ERRORS),
        "head_kN_per_m": ("paper_table.head", FORCES),
        "head_error_kN_per_m": ("± ", ERRORS),
        "foot_against_steady_percent": ("paper_table.foot_against_steady", CHANGES),
        "largest_foot_kN_per_m": ("paper_table.largest_foot", FORCES),
        "plateau_from_s": ("paper_table.plateau_from", TIMES),
    }
    rows = []
    for net in NETS_DEG:
        straight = find_history(net)
        ways = {
            "steady": find_steady(straight),
            "sagged": replace(straight, start="sagged"),
            "straight": straight,
            "staggered": find_exchange(net, study.settings),
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
    return _list("plateau", words("paper_table.plateau"), columns, rows, words)


def _tabulate_growth(study: PaperStudy, words: Words) -> Listed:
    columns: Columns = {
        "method": ("paper_table.method", _WORDS),
        **_NET,
        "quantity": ("paper_table.force", _WORDS),
        **{
            f"friction_{phi:.0f}_deg_kN_per_m": (f"{phi:.0f}°", FORCES)
            for phi in FRICTIONS_DEG
        },
        "change_percent": ("paper_table.change", CHANGES),
        "trend": ("paper_table.trend_heading", _WORDS),
    }
    rows = [
        (
            *(one.method, one.inclination_deg, one.quantity),
            *one.values,
            *(one.change, one.trend),
        )
        for one in judge_growth(study)
    ]
    return _list("friction", words("paper_table.friction"), columns, rows, words)


def _tabulate_parameters(study: PaperStudy, words: Words) -> Listed:
    columns: Columns = {
        **_NET,
        "gravity": ("paper_table.gravity", _WORDS),
        "history_foot_kN_per_m": ("paper_table.history_foot", FORCES),
        "history_head_kN_per_m": ("paper_table.history_head", FORCES),
        "steady_foot_kN_per_m": ("paper_table.steady_foot", FORCES),
        "steady_head_kN_per_m": ("paper_table.steady_head", FORCES),
    }
    cases = [find_history(net) for net in (NORMAL_NET_DEG, *INCLINATIONS_DEG)]
    cases += [replace(find_history(net), gravity="parallel") for net in NETS_DEG]
    rows = []
    for case in cases:
        history, steady = study[case], study[find_steady(case)]
        ends = (history.foot, history.head, steady.foot, steady.head)
        rows.append((case.inclination_deg, case.gravity, *ends))
    caption = words("paper_table.parameters")
    return _list("inclination-and-gravity", caption, columns, rows, words)


def _tabulate_trend(study: PaperStudy, words: Words) -> Listed:
    columns: Columns = {
        "base_drag": ("paper_table.base_drag", GIVEN),
        "step_s": ("paper_table.step", TIMES),
        "foot_kN_per_m": ("paper_table.foot", FORCES),
        "against_implicit_percent": ("paper_table.against_implicit", CHANGES),
        "oscillates_until_s": ("paper_table.oscillates", TIMES),
    }
    *staggered, history = (study[case] for case in find_trend(study.settings))
    end = study.settings.trend_time * history.case.scene.time_scale
    expected = _foot_at(history, end)
    rows = []
    for run in staggered:
        got = _foot_at(run, end)
        step = None if run.track is None else float(run.track.times[0])
        change = _change(got, expected)
        rows.append((run.case.drag, step, got, change, last_swing(run)))
    shown = words.show_number(FORCE, kilo(expected))
    caption = words("paper_table.trend", end=end, expected=shown)
    return _list("staggered-trend", caption, columns, rows, words)


def _tabulate_drift(study: PaperStudy, words: Words) -> Listed:
    columns: Columns = {
        **_NET,
        "start": ("paper_table.start", _WORDS),
        "densification": ("paper_table.densification", _WORDS),
        "foot_at_plateau_kN_per_m": ("paper_table.at_plateau", FORCES),
        "plateau_from_s": ("paper_table.from", TIMES),
        "foot_at_end_kN_per_m": ("paper_table.at_end", FORCES),
        "end_d": ("paper_table.after", TIMES),
        "drift_percent_per_efold": ("paper_table.drift_rate", CHANGES),
    }
    rows = [
        _list_drift(study[replace(find_history(net), start=start, densifies=densifies)])
        for net in NETS_DEG
        for start in _STARTS
        for densifies in (True, False)
    ]
    return _list("drift", words("paper_table.drift"), columns, rows, words)


def _list_drift(run: PaperRun) -> tuple[object, ...]:
    case, track, begin = run.case, run.track, run.plateau_time
    last = None if track is None else float(track.foot[-1])
    end = None if track is None else float(track.times[-1])
    drift = None
    if run.foot is not None and last is not None and begin and end and end > begin:
        drift = (last / run.foot - 1.0) / math.log(end / begin)
    return (
        *(case.inclination_deg, case.start, _name_switch(case)),
        *(run.foot, begin),
        *(last, None if end is None else day_from_second(end)),
        drift,
    )


def _tabulate_runs(study: PaperStudy, words: Words) -> Listed:
    columns: Columns = {
        "method": ("paper_table.method", TEXTS),
        **_NET,
        "friction_deg": ("φ [°]", FRICTIONS),
        "gravity": ("paper_table.gravity", _WORDS),
        "start": ("paper_table.start", TEXTS),
        "densification": ("paper_table.densification", _WORDS),
        "steps": ("paper_table.steps", GIVEN),
        "result": ("paper_table.result", TEXTS),
    }
    rows = []
    for run in study.runs.values():
        case, track = run.case, run.track
        is_steady = case.method == "steady"
        start = MISSING if is_steady else words(f"paper_value.{case.start}")
        rows.append(
            (
                _name_method(case, words),
                *(case.inclination_deg, case.friction_deg, case.gravity),
                *(start, _name_switch(case)),
                float(0 if track is None else len(track.times)),
                _describe_result(run, words),
            )
        )
    return _list("runs", words("paper_table.runs"), columns, rows, words)


def _foot_at(run: PaperRun, time: float) -> float | None:
    return None if run.track is None else run.track.at(time, "foot")


def _change(value: float | None, reference: float | None) -> float | None:
    """Share by which a value differs from a reference; None without one of them."""
    if value is None or reference is None:
        return None
    return value / reference - 1.0


def _name_switch(case: PaperCase) -> str:
    return "on" if case.densifies else "off"


def _name_method(case: PaperCase, words: Words) -> str:
    method = words(f"paper_value.{case.method}")
    return words("paper_value.coarse", method=method) if case.is_coarse else method


def _describe_result(run: PaperRun, words: Words) -> str:
    if run.failure:
        return words.show(run.failure)
    if run.track is not None and run.track.ended:
        return words("paper_value.ended", reason=run.track.ended)
    return words("paper_value.complete")
