"""``netdesign winter`` and ``snowpack``: a station's heights on net rows, or alone."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.config import ConfiguredCommand
from netdesign.commands.options import (
    refuse_without,
    take_options,
)
from netdesign.commands.running import (
    open_phases,
    print_document,
    print_faults,
    require_places,
    tell,
    write_outputs,
)
from netdesign.commands.site_input import (
    build_text_format,
    choose_rows,
    read_asked_site,
    require_source,
)
from netdesign.outcome import EXIT_CODES, ModelError, Verdict
from netdesign.words.message import say

if TYPE_CHECKING:
    from netdesign.addons.winter.document import WinterRun
    from netdesign.addons.winter.settling import DayPack
    from netdesign.addons.winter.winter_sheet import StationWinter
    from netdesign.site.model import Site
    from netdesign.solving.runner import Runner
    from netdesign.words.message import Message

_FOLDER = "winter"
_PHASE = 150  # solves of a row and winter, about; a table has 63
EXAMPLE_HEIGHTS = "winter_2000.csv"


@click.command(cls=ConfiguredCommand)
@click.argument("site_file", required=False, type=click.Path(path_type=Path))
@take_options("winter")
def winter(site_file: Path | None, **asked: Any) -> None:
    """Follow a station's snow heights on the net rows of a site.

    \b
    netdesign winter --example
    netdesign winter site.xlsx --out winter
    netdesign winter site.xlsx --heights station.csv --model hs2swe
    netdesign winter site.xlsx --row R1 --every 1 --json > winter.json

    Daily snow heights become layers, each day's snow is solved at rest: forces against
    date, the governing day, annual maxima of many winters, and a range of density that
    sheet Project may use. Exit code 4 if a winter may be the largest and has no proven
    maximum.
    """
    from netdesign.addons.winter.document import write_winter_document
    from netdesign.addons.winter.page import (
        DOCUMENT_FILE,
        PAGE_FILE,
        render_winter,
    )
    from netdesign.edge.progress import Phase

    require_source(site_file, asked)
    folder = asked["out"] or (None if asked["as_json"] else Path(_FOLDER))
    require_places(folder, (DOCUMENT_FILE, PAGE_FILE), asked)
    site = read_asked_site(site_file, asked)
    station = _find_heights(site, asked)
    chosen = choose_rows(site, asked["rows"])
    count = _PHASE * len(chosen.rows)
    phase = Phase(key="winters", words=say("phase.winters"), cases=count)
    with open_phases([phase], asked) as (runner, progress):
        progress.enter("winters")
        run = _solve(chosen, station, runner, asked)
    failed = print_faults(runner.faults)
    document = write_winter_document(run)
    if folder:
        write_outputs(folder, render_winter(document), asked)
    if asked["as_json"]:
        print_document(document)
    else:
        _show(document)
    sys.exit(failed or (0 if _is_proven(document) else EXIT_CODES[Verdict.NOT_PROVEN]))


def _is_proven(document: dict[str, Any]) -> bool:
    """Every winter has a proven maximum or is not the largest."""
    return all(
        winter["is_proven"] or winter["is_below_largest"]
        for row in document["rows"]
        for winter in row["winters"]
    )


def _find_heights(site: Site, asked: Mapping[str, Any]) -> StationWinter:
    """Heights of the file, else those of the site, else those of the example."""
    from importlib.resources import as_file, files

    from netdesign.addons.winter.height_file import complete_by_sheet, read_height_file
    from netdesign.addons.winter.heights import smooth

    of_site: StationWinter | None = site.of_addons.get("Winter")
    station = of_site
    if asked["heights"] is not None:
        read = _read_heights(asked["heights"], asked, [row.id for row in site.rows])
        station, note = complete_by_sheet(read, of_site)
        if note:
            tell(note, err=True)
    elif station is None and asked["example"]:
        with as_file(files("netdesign.addons.winter") / EXAMPLE_HEIGHTS) as path:
            station, _ = read_height_file(path)
    if station is None:
        raise ModelError(say("winter.no_heights"))
    return (
        replace(station, series=smooth(station.series)) if asked["median"] else station
    )


def _read_heights(
    path: Path, asked: Mapping[str, Any], row_ids: Sequence[str] = ()
) -> StationWinter:
    """Heights of a station's file, as the options say; remarks on it are told."""
    from netdesign.addons.winter.height_file import build_columns, read_height_file

    form, columns = build_text_format(asked), build_columns(asked)
    station, remarks = read_height_file(path, form, row_ids, columns)
    for remark in remarks:
        tell(remark.message, err=True)
    return station


def _solve(
    site: Site, station: StationWinter, runner: Runner, asked: Mapping[str, Any]
) -> WinterRun:
    from netdesign.addons.winter.day import (
        DaySolver,
        build_winter_row,
        require_plausible_heights,
    )
    from netdesign.addons.winter.document import WinterRun
    from netdesign.addons.winter.measured import (
        list_measured_pulls,
        name_measured_winters,
    )
    from netdesign.addons.winter.season import StationPacks, follow_winters
    from netdesign.addons.winter.settling import MODELS as KNOWN
    from netdesign.coupling.scene import SolverSettings

    rows = [build_winter_row(site, row, station) for row in site.rows]
    if not asked["accept_heights"]:
        require_plausible_heights(rows, site.rows, station)
    models = sorted(KNOWN.values(), key=lambda model: model.name != asked["model"])
    packs = StationPacks(series=station.series, models=models)
    settings = SolverSettings(accuracy=asked["accuracy"])
    results = []
    for row in rows:
        solver = DaySolver(row=row, settings=settings, runner=runner)
        named = name_measured_winters(list_measured_pulls(site, row.id))
        results.append(follow_winters(packs, solver, asked["every"], named))
    return WinterRun(
        site=site,
        winter=station,
        rows=results,
        is_smoothed=asked["median"],
        accuracy=asked["accuracy"],
    )


def _show(document: dict[str, Any]) -> None:
    for row in document["rows"]:
        for winter in row["winters"]:
            tell(_tell_winter(row["id"], winter))
            if winter["days_without_force"]:
                tell(
                    say(
                        "winter.without_force",
                        row=row["id"],
                        winter=winter["name"],
                        count=winter["days_without_force"],
                        days=len(winter["curve"]),
                    )
                )
        if row["equivalent_density"]:
            tell(row["equivalent_density"]["justification"])
        if row["snow_heights"]:
            tell(row["snow_heights"])
        _show_statistics(row)


def _tell_winter(row: str, winter: Mapping[str, Any]) -> Message:
    """Line on the pulls of a winter, or on their bound."""
    has_none = winter["foot_peak_kN_per_m"] is None
    if has_none or winter["uniform_at_most_kN_per_m"] is not None:
        return say("show.label", label=f"{row} {winter['name']}", text=winter["why"])
    return say(
        "winter.line",
        row=row,
        winter=winter["name"],
        foot=winter["foot_peak_kN_per_m"],
        head=winter["head_peak_kN_per_m"] or 0.0,
        day=winter["governing_date"] or "-",
        why=winter["why"],
    )


def _show_statistics(row: Mapping[str, Any]) -> None:
    """Lines on the return values of a row with their errors."""
    statistics = row["statistics"]
    for value in statistics["return_values"] if statistics else ():
        message = say(
            "winter.return_value",
            row=row["id"],
            period=value["period_a"],
            foot=value["foot_kN_per_m"],
            low=value["low_kN_per_m"],
            high=value["high_kN_per_m"],
            count=statistics["winters"],
        )
        tell(message)
    for text in row["statistics_notes"]:
        tell(say("show.label", label=row["id"], text=text))


SCHEMA = "netdesign.snowpack/1"


@click.command(cls=ConfiguredCommand)
@click.argument("height_file", type=click.Path(path_type=Path))
@take_options("snowpack")
def snowpack(height_file: Path, **asked: Any) -> None:
    """Mass and density of snow from daily heights.

    \b
    netdesign snowpack station.csv
    netdesign snowpack station.csv --model hs2swe --json --layers > days.json

    The file has the columns of sheet Winter: date, snow height with its unit.
    """
    from netdesign.addons.winter.heights import smooth
    from netdesign.addons.winter.season import FIRST_DENSITY
    from netdesign.addons.winter.settling import MODELS as KNOWN
    from netdesign.addons.winter.settling import follow_heights

    if not asked["as_json"]:
        refuse_without(["layers"], "--json")
    series = _read_heights(height_file, asked).series
    series = smooth(series) if asked["median"] else series
    packs = follow_heights(series.heights, KNOWN[asked["model"]], FIRST_DENSITY)
    days = [
        _write_day(day.isoformat(), pack, with_layers=asked["layers"])
        for day, pack in zip(series.days, packs, strict=True)
    ]
    if asked["as_json"]:
        print_document({"schema": SCHEMA, "model": asked["model"], "days": days})
        return
    for day in days:
        tell(
            say(
                "snowpack.line",
                date=day["date"],
                height=day["height_m"],
                mass=day["swe_kg_m2"],
                density=day["density_kg_m3"],
            )
        )


def _write_day(day: str, pack: DayPack, *, with_layers: bool) -> dict[str, Any]:
    values: dict[str, Any] = {
        "date": day,
        "height_m": pack.height,
        "swe_kg_m2": pack.mass,
        "density_kg_m3": pack.density,
        "new_snow_kg_m2": pack.new_mass,
        "runoff_kg_m2": pack.runoff,
    }
    if with_layers:
        values["layers"] = [
            {"height_m": float(h), "density_kg_m3": float(rho), "age_d": int(age)}
            for h, rho, age in zip(
                pack.heights,
                pack.densities if pack.heights.size else (),
                pack.ages,
                strict=True,
            )
        ]
    return values
