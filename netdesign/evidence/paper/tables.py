"""Tables of the paper's study, for the page and as CSV."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from netdesign.coupling.history.settings import Start
from netdesign.evidence.paper.cases import (
    DESIGN_NET_DEG,
    FRICTIONS_DEG,
    INCLINATIONS_DEG,
    NORMAL_NET_DEG,
    PaperCase,
    find_exchange,
    find_history,
    find_steady,
    find_trend,
)
from netdesign.evidence.paper.findings import judge_growth, last_swing
from netdesign.evidence.paper.runs import PaperRun
from netdesign.evidence.paper.study import PaperStudy
from netdesign.report.page.csv_text import write_csv
from netdesign.report.view.table import (
    Cell,
    Column,
    Table,
    given_cell,
    number_cell,
    number_column,
    text_cell,
    text_column,
)
from netdesign.report.words import MISSING, Words
from netdesign.units import day_from_second

_FORCE = "foot_size_kN_per_m"
_NETS = (NORMAL_NET_DEG, DESIGN_NET_DEG)
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


def _tabulate_plateaus(study: PaperStudy, words: Words) -> Listed:
    rows = []
    for net in _NETS:
        straight = find_history(net)
        ways = {
            "steady": find_steady(straight),
            "sagged": replace(straight, start="sagged"),
            "straight": straight,
            "staggered": find_exchange(net, study.settings),
        }
        reference = study[find_steady(straight)]
        for way, case in ways.items():
            rows.append(
                (
                    given_cell(words, net),
                    text_cell(words(f"paper_value.way_{way}")),
                    *_row(study[case], reference, words),
                )
            )
    return Listed(
        name="plateau",
        keys=("inclination_deg", "method", *_ROW_KEYS),
        table=Table(
            caption=words("paper_table.plateau"),
            columns=(
                number_column("inclination_deg", "θ [°]"),
                text_column(words("paper_table.method")),
                *_list_row_columns(words),
            ),
            rows=tuple(rows),
        ),
    )


_ROW_KEYS = (
    "foot_kN_per_m",
    "foot_error_kN_per_m",
    "head_kN_per_m",
    "head_error_kN_per_m",
    "foot_against_steady_percent",
    "largest_foot_kN_per_m",
    "plateau_from_s",
)


def _list_row_columns(words: Words) -> tuple[Column, ...]:
    return (
        number_column(_FORCE, words("paper_table.foot")),
        number_column("error_kN_per_m", "± "),
        number_column(_FORCE, words("paper_table.head")),
        number_column("error_kN_per_m", "± "),
        number_column("change_percent", words("paper_table.foot_against_steady")),
        number_column(_FORCE, words("paper_table.largest_foot")),
        Column(heading=words("paper_table.plateau_from"), is_number=True),
    )


def _row(run: PaperRun, reference: PaperRun, words: Words) -> tuple[Cell, ...]:
    against = None
    if run.foot is not None and reference.foot is not None:
        against = 100.0 * (run.foot / reference.foot - 1.0)
    has_error = run.case.method != "staggered" and not run.failure
    begin = _plateau_begin(run)
    largest = None if run.track is None else float(run.track.foot.max())
    return (
        number_cell(words, _FORCE, _kilo(run.foot)),
        number_cell(
            words, "error_kN_per_m", _kilo(run.foot_error) if has_error else None
        ),
        number_cell(words, _FORCE, _kilo(run.head)),
        number_cell(
            words, "error_kN_per_m", _kilo(run.head_error) if has_error else None
        ),
        number_cell(words, "change_percent", against),
        number_cell(words, _FORCE, _kilo(largest)),
        _seconds(words, begin),
    )


def _tabulate_growth(study: PaperStudy, words: Words) -> Listed:
    rows = tuple(
        (
            _value(words, growth.method),
            given_cell(words, growth.inclination_deg),
            _value(words, growth.quantity),
            *(number_cell(words, _FORCE, _kilo(value)) for value in growth.values),
            number_cell(
                words,
                "change_percent",
                None if growth.change is None else 100.0 * growth.change,
            ),
            _value(words, growth.trend),
        )
        for growth in judge_growth(study)
    )
    angles = tuple(number_column(_FORCE, f"{phi:.0f}°") for phi in FRICTIONS_DEG)
    return Listed(
        name="friction",
        keys=(
            *("method", "inclination_deg", "quantity"),
            *(f"friction_{phi:.0f}_deg_kN_per_m" for phi in FRICTIONS_DEG),
            *("change_percent", "trend"),
        ),
        table=Table(
            caption=words("paper_table.friction"),
            columns=(
                text_column(words("paper_table.method")),
                number_column("inclination_deg", "θ [°]"),
                text_column(words("paper_table.force")),
                *angles,
                number_column("change_percent", words("paper_table.change")),
                text_column(words("paper_table.trend_heading")),
            ),
            rows=rows,
        ),
    )


def _tabulate_parameters(study: PaperStudy, words: Words) -> Listed:
    cases = [find_history(net) for net in (NORMAL_NET_DEG, *INCLINATIONS_DEG)]
    cases += [replace(find_history(net), gravity="parallel") for net in _NETS]
    rows = []
    for case in cases:
        history, steady = study[case], study[find_steady(case)]
        rows.append(
            (
                given_cell(words, case.inclination_deg),
                _value(words, case.gravity),
                *(
                    number_cell(words, _FORCE, _kilo(value))
                    for value in (history.foot, history.head, steady.foot, steady.head)
                ),
            )
        )
    return Listed(
        name="inclination-and-gravity",
        keys=(
            *("inclination_deg", "gravity"),
            *("history_foot_kN_per_m", "history_head_kN_per_m"),
            *("steady_foot_kN_per_m", "steady_head_kN_per_m"),
        ),
        table=Table(
            caption=words("paper_table.parameters"),
            columns=(
                number_column("inclination_deg", "θ [°]"),
                text_column(words("paper_table.gravity")),
                number_column(_FORCE, words("paper_table.history_foot")),
                number_column(_FORCE, words("paper_table.history_head")),
                number_column(_FORCE, words("paper_table.steady_foot")),
                number_column(_FORCE, words("paper_table.steady_head")),
            ),
            rows=tuple(rows),
        ),
    )


def _tabulate_trend(study: PaperStudy, words: Words) -> Listed:
    *staggered, history = (study[case] for case in find_trend(study.settings))
    end = study.settings.trend_time * history.case.scene.time_scale
    expected = None if history.track is None else history.track.at(end, "foot")
    rows = []
    for run in staggered:
        track = run.track
        got = None if track is None else track.at(end, "foot")
        off = None
        if got is not None and expected is not None:
            off = 100.0 * (got / expected - 1.0)
        rows.append(
            (
                given_cell(words, run.case.drag),
                _seconds(words, None if track is None else float(track.times[0])),
                number_cell(words, _FORCE, _kilo(got)),
                number_cell(words, "change_percent", off),
                _seconds(words, last_swing(run)),
            )
        )
    return Listed(
        name="staggered-trend",
        keys=(
            *("base_drag", "step_s", "foot_kN_per_m"),
            *("against_implicit_percent", "oscillates_until_s"),
        ),
        table=Table(
            caption=words(
                "paper_table.trend",
                end=end,
                expected=words.show_number(_FORCE, _kilo(expected)),
            ),
            columns=(
                Column(heading=words("paper_table.base_drag"), is_number=True),
                Column(heading=words("paper_table.step"), is_number=True),
                number_column(_FORCE, words("paper_table.foot")),
                number_column("change_percent", words("paper_table.against_implicit")),
                Column(heading=words("paper_table.oscillates"), is_number=True),
            ),
            rows=tuple(rows),
        ),
    )


def _tabulate_drift(study: PaperStudy, words: Words) -> Listed:
    rows = [
        _row_of_drift(
            study, words, replace(find_history(net), start=start, densifies=densifies)
        )
        for net in _NETS
        for start in _STARTS
        for densifies in (True, False)
    ]
    return Listed(
        name="drift",
        keys=(
            *("inclination_deg", "start", "densification", "foot_at_plateau_kN_per_m"),
            *("plateau_from_s", "foot_at_end_kN_per_m", "end_d"),
            "drift_percent_per_efold",
        ),
        table=Table(
            caption=words("paper_table.drift"),
            columns=(
                number_column("inclination_deg", "θ [°]"),
                text_column(words("paper_table.start")),
                text_column(words("paper_table.densification")),
                number_column(_FORCE, words("paper_table.at_plateau")),
                Column(heading=words("paper_table.from"), is_number=True),
                number_column(_FORCE, words("paper_table.at_end")),
                Column(heading=words("paper_table.after"), is_number=True),
                number_column("change_percent", words("paper_table.drift_rate")),
            ),
            rows=tuple(rows),
        ),
    )


def _row_of_drift(study: PaperStudy, words: Words, case: PaperCase) -> tuple[Cell, ...]:
    run = study[case]
    track, begin = run.track, _plateau_begin(run)
    last = None if track is None else float(track.foot[-1])
    end = None if track is None else float(track.times[-1])
    drift = None
    if run.foot is not None and last is not None and begin and end and end > begin:
        drift = 100.0 * (last / run.foot - 1.0) / math.log(end / begin)
    return (
        given_cell(words, case.inclination_deg),
        _value(words, case.start),
        _value(words, "on" if case.densifies else "off"),
        number_cell(words, _FORCE, _kilo(run.foot)),
        _seconds(words, begin),
        number_cell(words, _FORCE, _kilo(last)),
        _rounded(words, None if end is None else day_from_second(end), 3),
        number_cell(words, "change_percent", drift),
    )


def _tabulate_runs(study: PaperStudy, words: Words) -> Listed:
    rows = []
    for run in study.runs.values():
        case, track = run.case, run.track
        moments = 0 if track is None else len(track.times)
        rows.append(
            (
                text_cell(_name_method(case, words)),
                given_cell(words, case.inclination_deg),
                given_cell(words, case.friction_deg),
                _value(words, case.gravity),
                text_cell(MISSING)
                if case.method == "steady"
                else _value(words, case.start),
                _value(words, "on" if case.densifies else "off"),
                given_cell(words, float(moments)),
                text_cell(_tell_result(run, words)),
            )
        )
    return Listed(
        name="runs",
        keys=(
            *("method", "inclination_deg", "friction_deg", "gravity", "start"),
            *("densification", "steps", "result"),
        ),
        table=Table(
            caption=words("paper_table.runs"),
            columns=(
                text_column(words("paper_table.method")),
                number_column("inclination_deg", "θ [°]"),
                number_column("friction_deg", "φ [°]"),
                text_column(words("paper_table.gravity")),
                text_column(words("paper_table.start")),
                text_column(words("paper_table.densification")),
                Column(heading=words("paper_table.steps"), is_number=True),
                text_column(words("paper_table.result")),
            ),
            rows=tuple(rows),
        ),
    )


def _plateau_begin(run: PaperRun) -> float | None:
    track = run.track
    if track is None or track.plateau is None:
        return None
    return float(track.times[track.plateau])


def _value(words: Words, key: str) -> Cell:
    return text_cell(words(f"paper_value.{key}"))


def _name_method(case: PaperCase, words: Words) -> str:
    method = words(f"paper_value.{case.method}")
    return words("paper_value.coarse", method=method) if case.is_coarse else method


def _tell_result(run: PaperRun, words: Words) -> str:
    if run.failure:
        return words.show(run.failure)
    if run.track is not None and run.track.ended:
        return words("paper_value.ended", reason=run.track.ended)
    return words("paper_value.complete")


def _kilo(value: float | None) -> float | None:
    return None if value is None else value / 1e3


def _seconds(words: Words, value: float | None) -> Cell:
    return _rounded(words, value, 3)


def _rounded(words: Words, value: float | None, digits: int) -> Cell:
    """Significant digits on the page, all of them in the CSV."""
    if value is None:
        return Cell(text=MISSING)
    shown = float(f"{value:.{digits}g}")
    return Cell(text=words.write(f"{shown:.10g}"), number=value)
