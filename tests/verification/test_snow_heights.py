"""Settling models against their authors' series, snow pits, and another code."""

import csv
from datetime import date, timedelta
from importlib.resources import files

import numpy as np
import pytest

from netdesign.addons.evidence.verification.winters import (
    list_snow_heights,
    measure_imbalance,
    read_weissfluhjoch,
)
from netdesign.addons.winter.command import snowpack
from netdesign.addons.winter.heights import name_winter
from netdesign.addons.winter.settling import MODELS, follow_heights

FIRST = date(2016, 9, 1)  # day of the Weissfluhjoch's series


def read_made_up_winter():
    """Heights [m] and true SWE [kg/m2] of the winter at 2000 m that comes along."""
    text = (
        files("netdesign.addons.winter").joinpath("winter_2000.csv").read_text("utf-8")
    )
    lines = list(csv.DictReader(text.splitlines()))
    heights = [float(line["HS [cm]"]) / 100.0 for line in lines]
    return heights, [float(line["true SWE [kg/m2]"]) for line in lines]


def test_densities_against_103_pits_are_as_the_page_says():
    got = {case.id: case.got for case in list_snow_heights()}
    for name, bias, spread in (
        ("delta-snow", -37.6, 64.2),
        ("delta-snow-ageing", -6.6, 48.8),
        ("hs2swe", -1.3, 45.8),
    ):
        assert got[f"{name}-density-bias"] == pytest.approx(bias, abs=0.05)
        assert got[f"{name}-density-rmse"] == pytest.approx(spread, abs=0.05)


def test_default_model_errs_least_to_the_unsafe_side():
    """Pulls go with rho^1.2 HS^1.9: pits on the days that may govern their winter."""
    series = read_weissfluhjoch()
    pits = np.flatnonzero(~np.isnan(series.measured) & (series.heights > 0.2))
    heights = series.heights[pits]
    ranks = (series.measured[pits] / heights) ** 1.2 * heights**1.9
    winters = np.array([name_winter(FIRST + timedelta(days=int(k))) for k in pits])
    largest = {name: ranks[winters == name].max() for name in set(winters)}
    near = pits[ranks >= 0.7 * np.array([largest[name] for name in winters])]
    mean = {}
    for name, model in MODELS.items():
        packs = follow_heights(list(map(float, series.heights)), model)
        masses = np.array([packs[k].mass for k in near])
        mean[name] = float(np.mean((masses / series.measured[near]) ** 1.2))
    default, *others = mean
    assert near.size == 35
    (model,) = (one for one in snowpack.params if one.name == "model")
    assert default == model.default
    assert tuple(mean) == tuple(model.type.choices)
    assert mean == pytest.approx(
        {"delta-snow-ageing": 0.984, "hs2swe": 0.966, "delta-snow": 0.885}, abs=1e-3
    )
    assert all(abs(mean[default] - 1.0) < abs(mean[one] - 1.0) for one in others)


def test_largest_mass_of_the_made_up_winter():
    """An independent code has 885 kg/m2; the truth is a tenth less."""
    heights, true = read_made_up_winter()
    masses = [pack.mass for pack in follow_heights(heights, MODELS["delta-snow"])]
    assert max(masses) == pytest.approx(885.0, abs=0.5)
    assert 1.05 < max(masses) / max(true) < 1.12


@pytest.mark.parametrize("name", MODELS)
def test_no_mass_is_lost_in_drawn_winters(name):
    rng = np.random.default_rng(61)
    steps = rng.normal(0.0, 0.17, size=(6, 160))
    for walk in steps:
        heights = np.append(np.abs(np.cumsum(walk)), 0.0)
        packs = follow_heights(list(map(float, heights)), MODELS[name])
        fallen = sum(pack.new_mass for pack in packs)
        assert sum(pack.runoff for pack in packs) == pytest.approx(fallen, rel=1e-12)
        assert fallen > 10.0
        assert measure_imbalance(packs) < 1e-9
        assert all((pack.heights > 0.0).all() for pack in packs)
        off = max(abs(p.height - h) for p, h in zip(packs, heights, strict=True))
        assert off < (0.02 + 1e-9 if name == "hs2swe" else 1e-9)
