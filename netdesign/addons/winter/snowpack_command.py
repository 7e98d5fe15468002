"""``netdesign snowpack``: mass and density of snow, without a net."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.config import ConfiguredCommand
from netdesign.commands.options import (
    refuse_delimiter,
    refuse_without,
    take_options,
)
from netdesign.commands.running import print_document
from netdesign.commands.site_input import build_text_format
from netdesign.commands.usage import tell
from netdesign.words.message import say

if TYPE_CHECKING:
    from netdesign.addons.winter.settling.pack import DayPack

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
    from netdesign.addons.winter.height_file import build_columns, read_height_file
    from netdesign.addons.winter.season import FIRST_DENSITY
    from netdesign.addons.winter.settling.follow import MODELS as KNOWN
    from netdesign.addons.winter.settling.follow import follow_heights
    from netdesign.snowpack.series import smooth

    refuse_delimiter(height_file)
    if not asked["as_json"]:
        refuse_without(["layers"], "--json")
    form, columns = build_text_format(asked), build_columns(asked)
    found, remarks = read_height_file(height_file, form, columns=columns)
    for remark in remarks:
        tell(remark.message, err=True)
    series = smooth(found.series) if asked["median"] else found.series
    packs = follow_heights(series.heights, KNOWN[asked["model"]], FIRST_DENSITY)
    days = [
        _write_day(day.isoformat(), pack, with_layers=asked["layers"])
        for day, pack in zip(series.days, packs, strict=True)
    ]
    if asked["as_json"]:
        print_document({"schema": SCHEMA, "model": asked["model"], "days": days})
        return
    for one in days:
        tell(
            say(
                "snowpack.line",
                date=one["date"],
                height=one["height_m"],
                mass=one["swe_kg_m2"],
                density=one["density_kg_m3"],
            )
        )


def _write_day(day: str, pack: DayPack, *, with_layers: bool) -> dict[str, Any]:
    found: dict[str, Any] = {
        "date": day,
        "height_m": pack.height,
        "swe_kg_m2": pack.mass,
        "density_kg_m3": pack.density,
        "new_snow_kg_m2": pack.new_mass,
        "runoff_kg_m2": pack.runoff,
    }
    if with_layers:
        found["layers"] = [
            {"height_m": float(h), "density_kg_m3": float(rho), "age_d": int(age)}
            for h, rho, age in zip(
                pack.heights,
                pack.densities if pack.heights.size else (),
                pack.ages,
                strict=True,
            )
        ]
    return found
