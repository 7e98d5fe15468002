"""The command ``snowpack``: the days of a station by each model."""

import json

import pytest

from netdesign.addons.winter.settling import MODELS, follow_heights
from tests.addons.winter.test_command import HEIGHTS, write_heights


@pytest.mark.parametrize("model", MODELS)
def test_document_has_the_days_of_the_model(call, tmp_path, model):
    path = write_heights(tmp_path / "station.csv")
    ended = call("snowpack", path, "--model", model, "--json", "--layers")
    document = json.loads(ended.out)
    packs = follow_heights([h / 100 for h in HEIGHTS], MODELS[model])
    assert (ended.code, document["schema"]) == (0, "netdesign.snowpack/1")
    masses = [day["swe_kg_m2"] for day in document["days"]]
    assert masses == pytest.approx([pack.mass for pack in packs], rel=1e-12)
    assert document["days"][8]["date"] == "2003-02-09"
    assert document["days"][0]["layers"] == []
    layers = document["days"][8]["layers"]
    total = sum(layer["height_m"] for layer in layers)
    assert total == pytest.approx(document["days"][8]["height_m"], rel=1e-12)


def test_faults_are_told_and_nothing_is_printed(call, tmp_path):
    path = write_heights(tmp_path / "station.csv", [0, -20])
    ended = call("snowpack", path)
    assert (ended.code, ended.out) == (3, "")
    assert "B3" in ended.err
