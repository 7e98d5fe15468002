"""From the lines of sheet Snow to the layers of each net row."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from netdesign.envelope.ranges import Ranges
from netdesign.site.cells.findings import Finding
from netdesign.site.headings import Table
from netdesign.site.model import InputEcho, NetRow
from netdesign.site.readings import Reading, Row, choose_given, refuse
from netdesign.site.tables import read_rows
from netdesign.snow.creep_law import DENSEST_SNOW, ICE_DENSITY
from netdesign.snow.snowpack import THINNEST_LAYER, Layer
from netdesign.words.message import say

LayersByRow = Mapping[str, Sequence[Row]]  # lines from the ground up, by net row

# Layers may miss the thickness of their net row by rounding to the centimetre.
_SUM_TOLERANCE = 0.0101  # [m]


def read_layers(table: Table | None, findings: list[Finding]) -> LayersByRow:
    """Lines of sheet Snow by net row, from the ground up; faults go to ``findings``."""
    by_row: dict[str, list[Row]] = {}
    for row in read_rows(table, findings):
        if row["row"].word and row["layer"].state == "given":
            by_row.setdefault(row["row"].word, []).append(row)
    for lines in by_row.values():
        lines.sort(key=lambda line: line["layer"].number)
        _check_numbers(lines, findings)
        _check_temperatures(lines, findings)
    return {name: tuple(lines) for name, lines in by_row.items()}


def build_layers(
    lines: Sequence[Row], slope_angle: Reading, findings: list[Finding]
) -> tuple[Layer, ...]:
    """Layers of one net row, from the ground up; none if a line is faulty.

    Parameters
    ----------
    lines : sequence of Row
        As ``read_layers`` gives them.
    slope_angle : Reading
        Turns vertical heights into thicknesses normal to the slope.
    findings : list of Finding
        Appended to.
    """
    layers = []
    for line in lines:
        given = choose_given(line, ("thickness", "height"), findings)
        thickness = measure_normal(given, slope_angle) if given else None
        density, temperature = line["density"], line["temperature"]
        if thickness is None or "faulty" in (density.state, temperature.state):
            continue
        layer = Layer(
            thickness=thickness,
            density=density.si,
            temperature=temperature.given_si,
        )
        layers.append(layer)
    if len(layers) < len(lines):
        return ()
    total = sum(layer.thickness for layer in layers)
    for line, layer in zip(lines, layers, strict=True):
        if layer.thickness < THINNEST_LAYER * total:
            rule = say("layer.too_thin", least=THINNEST_LAYER, total=total)
            refuse(_size_of(line), rule, say("layer.put_together"), findings)
    return tuple(layers)


def resolve_thickness(
    layers: tuple[Layer, ...],
    given: Reading,
    slope_angle: Reading,
    findings: list[Finding],
) -> float | None:
    """Snow thickness of layered snow [m]: the sum, which has to agree with sheet Nets.

    Parameters
    ----------
    layers : tuple of Layer
        Of the net row.
    given : Reading
        Thickness or vertical height in sheet Nets; may be blank.
    slope_angle : Reading
        Of the net row.
    findings : list of Finding
        Appended to.
    """
    total = sum(layer.thickness for layer in layers)
    if given.state != "given":
        return total
    is_vertical = given.field.key == "snow_height"
    factor = math.cos(slope_angle.si) if is_vertical else 1.0
    if abs(total - given.si * factor) > _SUM_TOLERANCE:
        rule = say("layer.other_sum", sum=total / factor)
        refuse(given, rule, say("layer.sum_or_empty"), findings)
        return None
    return total


def check_layers(
    rows: tuple[NetRow, ...],
    snow: LayersByRow,
    ranges: Ranges,
    findings: list[Finding],
) -> None:
    """Refuse layers whose mean or sum lies outside the ranges, or that get too dense.

    Parameters
    ----------
    rows : tuple of NetRow
        Built rows.
    snow : mapping of str to sequence of Row
        Lines of sheet Snow.
    ranges : Ranges
        Of the site.
    findings : list of Finding
        Appended to.
    """
    low, high = ranges["density"].low, ranges["density"].high
    for row in rows:
        if not row.layers:
            continue
        _check_sum(row, snow[row.id], ranges, findings)
        place = snow[row.id][0]["density"]
        mean = row.mean_density
        densest = max(layer.density for layer in row.layers) * high / mean
        if not low <= mean <= high:
            rule = say("layer.mean_outside", mean=mean)
            accepted = say("layer.mean_or_wider", low=low, high=high)
            refuse(place, rule, accepted, findings)
        elif densest > DENSEST_SNOW * ICE_DENSITY:
            rule = say("layer.too_dense", density=densest)
            accepted = say("layer.at_most_density", most=DENSEST_SNOW * ICE_DENSITY)
            refuse(place, rule, accepted, findings)


def _check_sum(
    row: NetRow, lines: Sequence[Row], ranges: Ranges, findings: list[Finding]
) -> None:
    """Refuse layers whose thickness lies outside its range."""
    total = sum(layer.thickness for layer in row.layers)
    for name, factor in (
        ("thickness", 1.0),
        ("snow_height", math.cos(row.slope_angle)),
    ):
        if name not in ranges.further:
            continue
        low, high = ranges[name].low * factor, ranges[name].high * factor
        if not low - _SUM_TOLERANCE <= total <= high + _SUM_TOLERANCE:
            rule = say("range.sum_outside", sum=total, low=low, high=high)
            refuse(_size_of(lines[0]), rule, say("range.sum_or_wider"), findings)


def echo_layers(lines: Sequence[Row]) -> tuple[InputEcho, ...]:
    """Every input of the layers of a net row."""
    echoes = []
    for line in lines:
        number = f"{line['layer'].number:g}"
        for key in ("thickness", "height", "density", "temperature"):
            reading = line[key]
            if reading.state != "given":
                continue
            name = say("column.of_layer", layer=number, name=reading.field.name)
            echoes.append(reading.echo(name))
    return tuple(echoes)


def _size_of(line: Row) -> Reading:
    return line["thickness" if line["thickness"].state == "given" else "height"]


def measure_normal(given: Reading, slope_angle: Reading) -> float | None:
    """Thickness normal to the slope [m], of itself or of a vertical height."""
    if given.field.key not in ("height", "snow_height"):
        return given.si
    if slope_angle.state == "faulty":
        return None
    return given.si * math.cos(slope_angle.si)


def _check_numbers(lines: list[Row], findings: list[Finding]) -> None:
    """Refuse gaps and doubles: 1 lies on the ground, then 2, and so on."""
    for expected, line in enumerate(lines, start=1):
        if line["layer"].number != expected:
            row = line["row"].word
            rule = say("layer.wrong_number", expected=expected, row=row)
            refuse(line["layer"], rule, say("layer.numbers"), findings)
            return


def _check_temperatures(lines: list[Row], findings: list[Finding]) -> None:
    """Refuse temperatures of some layers of a row only: the others would be unknown."""
    states = {line["temperature"].state for line in lines}
    if "given" not in states or "blank" not in states:
        return
    empty = next(line for line in lines if line["temperature"].state == "blank")
    rule = say("layer.temperature_lacks")
    refuse(empty["temperature"], rule, say("layer.all_or_none"), findings)
