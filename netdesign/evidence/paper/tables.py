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
from netdesign.report.words import ENGLISH
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


def list_tables(study: PaperStudy) -> list[Listed]:
    """All tables of the study."""
    return [
        _tabulate_plateaus(study),
        _tabulate_growth(study),
        _tabulate_parameters(study),
        _tabulate_trend(study),
        _tabulate_drift(study),
        _tabulate_runs(study),
    ]


def _tabulate_plateaus(study: PaperStudy) -> Listed:
    rows = []
    for net in _NETS:
        straight = find_history(net)
        ways = {
            "steady state": find_steady(straight),
            "history, sagged start": replace(straight, start="sagged"),
            "history, straight start": straight,
            "staggered, straight start": find_exchange(net, study.settings),
        }
        reference = study[find_steady(straight)]
        for way, case in ways.items():
            rows.append(
                (
                    given_cell(ENGLISH, net),
                    text_cell(way),
                    *_row(study[case], reference),
                )
            )
    return Listed(
        name="plateau",
        keys=("inclination_deg", "method", *_ROW_KEYS),
        table=Table(
            caption="Plateau of the paper's scene at a friction of 30°. Errors of "
            "histories and steady states are differences between two meshes; the "
            "staggered exchange has one mesh only. Without a number: no plateau in its "
            "time.",
            columns=(
                number_column("inclination_deg", "θ [°]"),
                text_column("Method"),
                *_ROW_COLUMNS,
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
_ROW_COLUMNS = (
    number_column(_FORCE, "Foot [kN/m]"),
    number_column("error_kN_per_m", "± "),
    number_column(_FORCE, "Head [kN/m]"),
    number_column("error_kN_per_m", "± "),
    number_column("change_percent", "Foot, against steady [%]"),
    number_column(_FORCE, "Largest foot [kN/m]"),
    Column(heading="Plateau from [s]", is_number=True),
)


def _row(run: PaperRun, reference: PaperRun) -> tuple[Cell, ...]:
    against = None
    if run.foot is not None and reference.foot is not None:
        against = 100.0 * (run.foot / reference.foot - 1.0)
    has_error = run.case.method != "staggered" and not run.failure
    begin = _plateau_begin(run)
    largest = None if run.track is None else float(run.track.foot.max())
    return (
        number_cell(ENGLISH, _FORCE, _kilo(run.foot)),
        number_cell(
            ENGLISH, "error_kN_per_m", _kilo(run.foot_error) if has_error else None
        ),
        number_cell(ENGLISH, _FORCE, _kilo(run.head)),
        number_cell(
            ENGLISH, "error_kN_per_m", _kilo(run.head_error) if has_error else None
        ),
        number_cell(ENGLISH, "change_percent", against),
        number_cell(ENGLISH, _FORCE, _kilo(largest)),
        _seconds(begin),
    )


def _tabulate_growth(study: PaperStudy) -> Listed:
    rows = tuple(
        (
            text_cell(growth.method),
            given_cell(ENGLISH, growth.inclination_deg),
            text_cell(growth.quantity),
            *(number_cell(ENGLISH, _FORCE, _kilo(value)) for value in growth.values),
            number_cell(
                ENGLISH,
                "change_percent",
                None if growth.change is None else 100.0 * growth.change,
            ),
            text_cell(growth.trend),
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
            caption="Sizes of forces against friction [kN/m], of histories at the time "
            "when the last of the three has come to its plateau. Change from 15° to "
            "45°; of a node's component over the node's whole force. Steps up to 1% "
            "count as level.",
            columns=(
                text_column("Method"),
                number_column("inclination_deg", "θ [°]"),
                text_column("Force"),
                *angles,
                number_column("change_percent", "Change [%]"),
                text_column("Trend"),
            ),
            rows=rows,
        ),
    )


def _tabulate_parameters(study: PaperStudy) -> Listed:
    cases = [find_history(net) for net in (NORMAL_NET_DEG, *INCLINATIONS_DEG)]
    cases += [replace(find_history(net), gravity="parallel") for net in _NETS]
    rows = []
    for case in cases:
        history, steady = study[case], study[find_steady(case)]
        rows.append(
            (
                given_cell(ENGLISH, case.inclination_deg),
                text_cell(case.gravity),
                *(
                    number_cell(ENGLISH, _FORCE, _kilo(value))
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
            caption="Inclination and gravity at a friction of 30°: plateau of a "
            "straight start, and steady state [kN/m]",
            columns=(
                number_column("inclination_deg", "θ [°]"),
                text_column("Gravity"),
                number_column(_FORCE, "History, foot"),
                number_column(_FORCE, "History, head"),
                number_column(_FORCE, "Steady, foot"),
                number_column(_FORCE, "Steady, head"),
            ),
            rows=tuple(rows),
        ),
    )


def _tabulate_trend(study: PaperStudy) -> Listed:
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
                given_cell(ENGLISH, run.case.drag),
                _seconds(None if track is None else float(track.times[0])),
                number_cell(ENGLISH, _FORCE, _kilo(got)),
                number_cell(ENGLISH, "change_percent", off),
                _seconds(last_swing(run)),
            )
        )
    return Listed(
        name="staggered-trend",
        keys=(
            *("base_drag", "step_s", "foot_kN_per_m"),
            *("against_implicit_percent", "oscillates_until_s"),
        ),
        table=Table(
            caption=f"Staggered exchange as drag and step vanish, at {end:.0f} s; the "
            "implicit history on the same mesh gives "
            f"{number_cell(ENGLISH, _FORCE, _kilo(expected)).text} kN/m",
            columns=(
                Column(heading="Base drag", is_number=True),
                Column(heading="Step [s]", is_number=True),
                number_column(_FORCE, "Foot [kN/m]"),
                number_column("change_percent", "Against implicit [%]"),
                Column(heading="Oscillates until [s]", is_number=True),
            ),
            rows=tuple(rows),
        ),
    )


def _tabulate_drift(study: PaperStudy) -> Listed:
    rows = [
        _row_of_drift(
            study, replace(find_history(net), start=start, densifies=densifies)
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
            caption="Drift of the foot's pull from the plateau to the end of the "
            "history, per e-fold of time. Without densification histories are followed "
            "for a shorter time.",
            columns=(
                number_column("inclination_deg", "θ [°]"),
                text_column("Start"),
                text_column("Densification"),
                number_column(_FORCE, "At plateau [kN/m]"),
                Column(heading="from [s]", is_number=True),
                number_column(_FORCE, "At the end [kN/m]"),
                Column(heading="after [d]", is_number=True),
                number_column("change_percent", "Drift [% per e-fold]"),
            ),
            rows=tuple(rows),
        ),
    )


def _row_of_drift(study: PaperStudy, case: PaperCase) -> tuple[Cell, ...]:
    run = study[case]
    track, begin = run.track, _plateau_begin(run)
    last = None if track is None else float(track.foot[-1])
    end = None if track is None else float(track.times[-1])
    drift = None
    if run.foot is not None and last is not None and begin and end and end > begin:
        drift = 100.0 * (last / run.foot - 1.0) / math.log(end / begin)
    return (
        given_cell(ENGLISH, case.inclination_deg),
        text_cell(case.start),
        text_cell("on" if case.densifies else "off"),
        number_cell(ENGLISH, _FORCE, _kilo(run.foot)),
        _seconds(begin),
        number_cell(ENGLISH, _FORCE, _kilo(last)),
        _rounded(None if end is None else day_from_second(end), 3),
        number_cell(ENGLISH, "change_percent", drift),
    )


def _tabulate_runs(study: PaperStudy) -> Listed:
    rows = []
    for run in study.runs.values():
        case, track = run.case, run.track
        ended = "" if track is None else track.ended
        result = run.failure or (f"ended early: {ended}" if ended else "complete")
        moments = 0 if track is None else len(track.times)
        rows.append(
            (
                text_cell(case.method + (", coarse" if case.is_coarse else "")),
                given_cell(ENGLISH, case.inclination_deg),
                given_cell(ENGLISH, case.friction_deg),
                text_cell(case.gravity),
                text_cell("-" if case.method == "steady" else case.start),
                text_cell("on" if case.densifies else "off"),
                given_cell(ENGLISH, float(moments)),
                text_cell(result),
            )
        )
    return Listed(
        name="runs",
        keys=(
            *("method", "inclination_deg", "friction_deg", "gravity", "start"),
            *("densification", "steps", "result"),
        ),
        table=Table(
            caption="All runs of the study",
            columns=(
                text_column("Method"),
                number_column("inclination_deg", "θ [°]"),
                number_column("friction_deg", "φ [°]"),
                text_column("Gravity"),
                text_column("Start"),
                text_column("Densification"),
                Column(heading="Steps", is_number=True),
                text_column("Result"),
            ),
            rows=tuple(rows),
        ),
    )


def _plateau_begin(run: PaperRun) -> float | None:
    track = run.track
    if track is None or track.plateau is None:
        return None
    return float(track.times[track.plateau])


def _kilo(value: float | None) -> float | None:
    return None if value is None else value / 1e3


def _seconds(value: float | None) -> Cell:
    return _rounded(value, 3)


def _rounded(value: float | None, digits: int) -> Cell:
    """Significant digits on the page, all of them in the CSV."""
    if value is None:
        return Cell(text="-")
    shown = float(f"{value:.{digits}g}")
    return Cell(text=f"{shown:.10g}", number=value)
