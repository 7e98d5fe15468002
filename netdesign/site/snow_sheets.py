"""Sheet Snow: layers of net rows, from the ground up."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from netdesign.envelope.ranges import Ranges
from netdesign.site.cells.findings import Finding
from netdesign.site.model import InputEcho, NetRow
from netdesign.site.readings import Reading, Row, refuse
from netdesign.snow.creep_law import DENSEST_SNOW, ICE_DENSITY
from netdesign.snow.snowpack import THINNEST_LAYER, Layer
from netdesign.words.message import say

LayersByRow = Mapping[str, Sequence[Row]]  # lines from the ground up, by net row

# Layers may miss the thickness of their net row by rounding to the centimetre.
_SUM_TOLERANCE = 0.0101  # [m]


def order_layers(rows: Sequence[Row], findings: list[Finding]) -> LayersByRow:
    """Lines by net row, from the ground up."""
    by_row: dict[str, list[Row]] = {}
    for row in rows:
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
        As ``order_layers`` gives them.
    slope_angle : Reading
        Turns vertical heights into thicknesses normal to the slope.
    findings : list of Finding
        Appended to.
    """
    layers = []
    for line in lines:
        if any(reading.state == "faulty" for reading in line.values()):
            continue
        density, temperature = line["density"], line["temperature"]
        thickness = measure_normal(line["thickness"], slope_angle)
        if thickness is None:
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
            refuse(line["thickness"], rule, say("layer.put_together"), findings)
    return tuple(layers)


def resolve_thickness(
    layers: tuple[Layer, ...],
    typed: Reading,
    slope_angle: Reading,
    findings: list[Finding],
) -> float | None:
    """Snow thickness of layered snow [m]: the sum, which has to agree with sheet Rows.

    Parameters
    ----------
    layers : tuple of Layer
        Of the net row.
    typed : Reading
        Thickness or vertical height in sheet Rows.
    slope_angle : Reading
        Of the net row.
    findings : list of Finding
        Appended to.
    """
    total = sum(layer.thickness for layer in layers)
    is_vertical = typed.field.key == "snow_height"
    factor = math.cos(slope_angle.si) if is_vertical else 1.0
    if abs(total - typed.si * factor) > _SUM_TOLERANCE:
        rule = say("layer.other_sum", sum=total / factor)
        refuse(typed, rule, say("layer.sum_or_empty"), findings)
        return None
    return total


def check_layers(
    rows: tuple[NetRow, ...],
    snow: LayersByRow,
    ranges: Ranges,
    findings: list[Finding],
) -> None:
    """Refuse layers whose mean lies outside the range, or that get too dense.

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


def echo_layers(lines: Sequence[Row]) -> tuple[InputEcho, ...]:
    """Every input of the layers of a net row."""
    echoes = []
    for line in lines:
        number = f"{line['layer'].number:g}"
        for key in ("thickness", "density", "temperature"):
            reading = line[key]
            if reading.state == "given":
                quantity = say(f"column.Snow.{reading.field.key}")
                name = say("column.of_layer", layer=number, name=quantity)
                echoes.append(reading.echo(name))
    return tuple(echoes)


def measure_normal(typed: Reading, slope_angle: Reading) -> float | None:
    """Thickness normal to the slope [m], typed as such or as a vertical height."""
    if typed.field.key not in ("height", "snow_height"):
        return typed.si
    if slope_angle.state == "faulty":
        return None
    return typed.si * math.cos(slope_angle.si)


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
