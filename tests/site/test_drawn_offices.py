"""Drawn variants of three offices' lists: read as meant, or asked; never misread."""

import copy
import random
from types import SimpleNamespace

import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.cells.numbers import parse_number
from netdesign.site.columns.all_tables import NETS
from netdesign.site.columns.fields import convert_unit, split_heading
from netdesign.site.columns.lexicon import Lexicon
from netdesign.site.reader import read_site
from tests.site.offices import austrian, french, norwegian
from tests.site.offices.write import write_folder, write_xlsx

LEXICON = Lexicon.of(NETS.fields, NETS)
SHEETS = {french: ("Filets A", "Filets B"), austrian: ("Werkliste",)}
PARTS = ("Abschnitt Nord", "Secteur Est", "Section 3")
SUMS = ("Summe", "Total", "Sous-total")
MOST_ASKED = 0.5  # of the drawn lists


def find_head(lines):
    """Number of the line with the headings: the longest one."""
    return max(range(len(lines)), key=lambda k: sum(x is not None for x in lines[k]))


def find_field(heading):
    """Field and unit of a heading, as the office meant it."""
    meaning = LEXICON.match(str(heading))
    return meaning.field, split_heading(str(heading))[1]


def rename(rng, heading):
    """Another heading of the same field, perhaps in another unit, and that unit."""
    field, unit = find_field(heading)
    if field is None or rng.random() < 0.5:
        return heading, unit, unit
    name = rng.choice(field.raw_names)
    if not field.units or not unit:
        return (f"{name} [{unit}]" if unit else name), unit, unit
    angles = ("rad", "gon", *(("%",) if field.unit == "deg" else ()))
    other = rng.choice([one for one in field.units if one not in angles])
    return f"{name} [{other}]", unit, other


def convert(value, field, unit, other, rng):
    """A number in another unit, as text with a comma or a point, or as a number."""
    number = parse_number(value, "")
    if field is None or unit == other or not isinstance(number, float):
        return value
    first = convert_unit(number, unit, field.unit)
    scale = convert_unit(1.0, other, field.unit)
    shown = f"{first / scale:.6f}".rstrip("0").rstrip(".")
    return shown.replace(".", ",") if rng.random() < 0.5 else float(shown)


def vary(rng, lines):
    """Lines of a sheet of net rows with columns moved and renamed, parts and sums."""
    head = find_head(lines)
    width = len(lines[head])
    order = rng.sample(range(width), width) if rng.random() < 0.6 else range(width)
    names = [rename(rng, one) for one in lines[head]]
    fields = [find_field(one)[0] for one in lines[head]]
    varied = [list(line) for line in lines[:head]]
    padded = [[*line, *[None] * (width - len(line))] for line in lines[head + 1 :]]
    varied.append([names[k][0] for k in order])
    for line in padded:
        if sum(one is not None for one in line) < 5:
            continue  # parts and sums of the office's own
        if rng.random() < 0.15:
            varied += [[], [rng.choice(PARTS)]] if rng.random() < 0.5 else [[]]
        varied.append(
            [convert(line[k], fields[k], names[k][1], names[k][2], rng) for k in order]
        )
    if rng.random() < 0.5:
        first = order[0] if isinstance(order, list) else 0
        total = [None] * width
        total[0] = rng.choice(SUMS)
        if first is not None and width > 3:
            total[2] = "99,5"
        varied.append(total)
    return varied


def draw_office(rng):
    office = rng.choice((french, austrian, norwegian))
    sheets = copy.deepcopy(office.SHEETS)
    sheets.pop("Filets (ancien)", None)
    if "Seilliste" in sheets:
        for line in sheets["Seilliste"][1:]:
            line[2] = "6x19-FC"
    for name in SHEETS.get(office, ("Nets",)):
        sheets[name] = vary(rng, sheets[name])
    return office, SimpleNamespace(SHEETS=sheets, MERGED={}, STRUCK={})


def read_rows(site):
    return {
        row.id: {
            echo.label.key.rpartition(".")[2]: echo.value
            for echo in row.inputs
            if "!" in echo.cell and echo.value != "" and not echo.derivation
        }
        for row in site.rows
    }


def compare(tmp_path, seeds):
    """Share of the lists that are asked about; no value is another than was meant."""
    asked = 0
    for seed in seeds:
        rng = random.Random(seed)
        office, drawn = draw_office(rng)
        is_book = rng.random() < 0.3
        write = write_xlsx if is_book else write_folder
        path = write(drawn, tmp_path / (f"{seed}.xlsx" if is_book else str(seed)))
        try:
            rows = read_rows(read_site(path))
        except SiteDataError:
            asked += 1
            continue
        assert list(rows) == list(office.ROWS), seed
        for name, meant in office.ROWS.items():
            found = rows[name]
            for key, value in meant.items():
                if isinstance(value, str):
                    assert found[key].partition(" (")[0] == value, (seed, name, key)
                else:
                    assert found[key] == pytest.approx(value, rel=1e-5), (seed, key)
    return asked / len(seeds)


@pytest.mark.long
def test_a_drawn_list_is_read_as_it_was_meant_or_asked_about(tmp_path):
    assert compare(tmp_path, range(60)) < MOST_ASKED


@pytest.mark.slow
def test_two_thousand_drawn_lists_are_never_misread(tmp_path):
    assert compare(tmp_path, range(1000, 3000)) < MOST_ASKED
