"""Prices of types: read in any office's way, every fault told at once."""

import random

import pytest

from netdesign.files.prices import read_prices
from netdesign.outcome import TerrainError
from netdesign.study.parts import PartRecord, Price, add_costs, find_unit_cost

TYPES = ("A25-tested", "Seil 22", "HEB 140")


def write(tmp_path, text, name="prices.csv"):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("mark", [";", "\t", ","])
def test_prices_are_read_whatever_the_columns_are_apart_by(tmp_path, mark):
    draws = random.Random(f"prices {mark}")
    amounts = [round(draws.uniform(0.0, 900.0), 2) for _ in range(5)]
    shown = [
        f"{one:.2f}" if mark == "," else f"{one:.2f}".replace(".", ",")
        for one in amounts
    ]
    lines = [
        mark.join(("Type", "PRICE", "per")),
        mark.join((TYPES[0], shown[0], "piece")),
        mark.join((TYPES[0], shown[1], "m")),
        "",
        mark.join((TYPES[1], shown[2], "m")),
        mark.join((TYPES[2], shown[3], "Stück")),
        mark.join(("net", shown[4], "m²")),
    ]
    found = read_prices(write(tmp_path, "\n".join(lines)), TYPES)
    assert found == {
        TYPES[0]: (
            Price(amount=amounts[0], per="piece"),
            Price(amount=amounts[1], per="m"),
        ),
        TYPES[1]: (Price(amount=amounts[2], per="m"),),
        TYPES[2]: (Price(amount=amounts[3], per="piece"),),
        "net": (Price(amount=amounts[4], per="m2"),),
    }


@pytest.mark.parametrize(
    "lines",
    [
        ("Typ;Preis;je", "Seil 22;{};Stück", "Netz;{};m2"),
        ("type;prix;par", "Seil 22;{};pièce", "filet;{};m²"),
    ],
)
def test_prices_in_the_other_languages(tmp_path, lines):
    shown = "\n".join(lines).format("217,35", "88,4")
    found = read_prices(write(tmp_path, shown), ["Seil 22"])
    assert found["Seil 22"] == (Price(amount=217.35, per="piece"),)
    assert found["net"] == (Price(amount=88.4, per="m2"),)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "first line"),
        ("name;cost;unit\nx;1;m\n", "first line"),
        ("type;price;per\nA25-tested;-3;m\n", "line 2"),
        ("type;price;per\nA25-tested;nan;m\n", "line 2"),
        ("type;price;per\nA25-tested;1e999;m\n", "line 2"),
        ("type;price;per\nA25-tested;12;kg\n", "line 2"),
        ("type;price;per\nA25-tested;12\n", "line 2"),
        ("type;price;per\nA99;12;m\n", "no type A99"),
        ("type;price;per\nA25-tested;12;m\n", "missing: Seil 22, HEB 140, net"),
    ],
)
def test_what_is_no_price_is_told(tmp_path, text, said):
    with pytest.raises(TerrainError) as refused:
        read_prices(write(tmp_path, text), TYPES)
    assert said in str(refused.value.message)
    assert "prices.csv" in str(refused.value.message)


def test_every_fault_is_told_at_once(tmp_path):
    text = "type;price;per\nA25-tested;x;m\nSeil 22;3;m\nA99;2;m\n;4;m\n"
    with pytest.raises(TerrainError) as refused:
        read_prices(write(tmp_path, text), TYPES)
    for said in ("line 2", "line 4", "line 5"):
        assert said in str(refused.value.message)


def test_no_file_and_no_text_are_refused(tmp_path):
    for path in (tmp_path / "none.csv", tmp_path):
        with pytest.raises(TerrainError, match="cannot be read"):
            read_prices(path, TYPES)
    path = tmp_path / "binary.csv"
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(TerrainError):
        read_prices(path, TYPES)


def test_a_part_costs_its_piece_and_its_metres():
    prices = {
        "A": (Price(amount=120.0, per="piece"), Price(amount=95.0, per="m")),
        "net": (Price(amount=90.0, per="m2"),),
    }
    anchor = PartRecord(part="foot_anchor", type_id="A", count=17, size=4.5)
    net = PartRecord(part="net", type_id="", count=1, size=160.0)
    assert find_unit_cost(anchor, prices) == pytest.approx(120.0 + 95.0 * 4.5)
    total, unknown = add_costs([anchor, net], prices)
    assert total == pytest.approx(17 * (120.0 + 95.0 * 4.5) + 90.0 * 160.0)
    assert unknown == ()


@pytest.mark.parametrize(
    "part",
    [
        PartRecord(part="foot_anchor", type_id="A", count=3, size=None),
        PartRecord(part="foot_anchor", type_id="A", count=None, size=4.0),
        PartRecord(part="post", type_id="HEB 100", count=3, size=4.0),
    ],
)
def test_what_is_not_known_costs_nothing_in_silence(part):
    prices = {"A": (Price(amount=95.0, per="m"),)}
    assert add_costs([part], prices) == (0.0, (part.type_id,))
