"""Predictions before measurements, tried on owners that are made up."""

import json
from dataclasses import replace

import numpy as np
import pytest

from netdesign.evidence.validation.measured_file import read_structures
from netdesign.evidence.validation.prediction import (
    compare,
    hash_inputs,
    open_sealed,
    predict,
    seal,
)
from netdesign.evidence.validation.prediction_page import write_form
from netdesign.evidence.validation.structure import Span, solve_cases
from netdesign.outcome import ModelError
from netdesign.words.catalogue import LANGUAGES
from tests.program import call_program

MADE = "2026-11-27T08:00:00+00:00"
MEMBERS = ("foot_anchor", "uphill_guy", "post")


def read_own_form():
    (form,) = read_structures(write_form("en")["form.toml"], is_form=True)
    return form


@pytest.fixture(scope="module")
def prediction():
    return predict([read_own_form()], MADE)


def measure(form, random):
    """The form with the forces of a net whose inputs lie somewhere in its ranges."""
    truth = {
        name: Span(low=value, high=value, mark="measured")
        for name, span in form.inputs.items()
        for value in [span.at(random.uniform())]
    }
    (case,), _, _ = solve_cases(replace(form, inputs=truth))
    return replace(
        form,
        measured=tuple(
            replace(one, value=case.values[one.members[0]]) for one in form.measured
        ),
    )


def test_nine_of_ten_forces_of_made_up_owners_lie_in_the_band(prediction):
    form, random = read_own_form(), np.random.default_rng(11)
    hits = [
        hit for _ in range(60) for hit in compare([measure(form, random)], prediction)
    ]
    assert len(hits) == 60 * len(MEMBERS)
    share = sum(one.is_inside for one in hits) / len(hits)
    assert 0.83 <= share <= 0.97
    outside = [one for one in hits if not one.is_inside]
    for one in outside:
        assert not one.predicted.low <= one.measured.value <= one.predicted.high


def test_a_stored_prediction_is_read_again_and_no_digit_of_it_may_change(prediction):
    text = seal(prediction).decode()
    assert open_sealed(text) == prediction
    for key in ("middle", "low", "high", "solved"):
        document = json.loads(text)
        (structure,) = document["prediction"]["structures"]
        place = structure if key == "solved" else structure["members"][0]
        place[key] += 1
        with pytest.raises(ModelError, match="altered"):
            open_sealed(json.dumps(document))
    for wrong in ("", "{}", "[1]", text[:-40]):
        with pytest.raises(ModelError, match="no stored prediction"):
            open_sealed(wrong)


def test_inputs_decide_the_digest_and_forces_do_not(prediction):
    form = read_own_form()
    measured = measure(form, np.random.default_rng(5))
    assert hash_inputs([measured]) == hash_inputs([form]) == prediction.inputs_sha256
    assert hash_inputs([replace(form, title="x", note="y")]) == hash_inputs([form])
    for name, span in form.inputs.items():
        other = replace(span, high=span.high * 1.01)
        changed = replace(form, inputs={**form.inputs, name: other})
        with pytest.raises(ModelError, match="are not those of the prediction"):
            compare([replace(changed, measured=measured.measured)], prediction)


def test_a_prediction_comes_first(prediction):
    form = read_own_form()
    with pytest.raises(ModelError, match="remove the values"):
        predict([measure(form, np.random.default_rng(3))], MADE)
    with pytest.raises(ModelError, match="no force is entered"):
        compare([form], prediction)


@pytest.mark.parametrize("language", LANGUAGES)
def test_an_owner_goes_from_the_form_to_the_comparison(tmp_path, language):
    def run(*words):
        options = ("--out", str(tmp_path), "--language", language)
        return call_program("validate", *words, *options)

    assert run("--form").code == 0
    letter = (tmp_path / "letter.txt").read_text("utf-8")
    assert "prediction.json" in letter
    assert "{" not in letter
    form = tmp_path / "form.toml"
    told = run("--predict", str(form))
    assert told.code == 0, told.err
    stored = open_sealed((tmp_path / "prediction.json").read_text("utf-8"))
    assert stored.digest in told.out
    assert stored.digest in (tmp_path / "prediction.html").read_text("utf-8")
    (middle,) = (
        one.middle
        for one in stored.structures[0].members
        if one.member == "foot_anchor"
    )
    text = form.read_text("utf-8")
    for factor, code in ((1.01, 0), (3.0, 4)):
        entered = f'members = ["foot_anchor"]\nvalue_kN = {factor * middle}'
        form.write_text(text.replace('members = ["foot_anchor"]', entered), "utf-8")
        ended = run("--predict", str(form), "--force", "--json")
        assert ended.code == code
        (hit,) = json.loads(ended.out)["forces"]
        assert hit["is_inside"] is (code == 0)
        assert hit["ratio"] == pytest.approx(factor)
        assert (tmp_path / "comparison.html").exists()


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("low = 35.0", "low = 38.0", "low <= high"),
        ('members = ["post"]', 'members = ["mast"]', "mast"),
        ("glide_factor", "glide", "glide"),
        ("high = 0.9", "high = -0.9", "filled"),
        ('kind = "net"', 'kind = "fence"', "kind"),
    ],
)
def test_a_wrong_form_is_refused_with_its_place(tmp_path, old, new, told):
    text = write_form("en")["form.toml"].decode()
    assert old in text
    form = tmp_path / "form.toml"
    form.write_text(text.replace(old, new), "utf-8")
    options = ["--predict", str(form), "--out", str(tmp_path)]
    ended = call_program("validate", *options)
    assert ended.code == 3
    assert told in ended.err
    assert not (tmp_path / "prediction.json").exists()
