"""Predictions before measurements: bands of forces, stored under a digest and a date.

An owner fills in a form: the structure, and its inputs as ranges. The bands are
computed and stored before any force is known. Forces that are entered later are
compared with what was stored; a form whose inputs have changed since is refused.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from netdesign import __version__
from netdesign.edge.causes import explain
from netdesign.edge.json_text import read_json, write_json, write_part
from netdesign.evidence.validation.structure import (
    CaseForces,
    Measurement,
    Structure,
    solve_cases,
)
from netdesign.outcome import ModelError
from netdesign.words.message import say

SCHEMA = "netdesign.prediction/1"
SAMPLES = 240
_BAND = (5.0, 50.0, 95.0)  # per cent of the cases
_FIGURES = 4  # that a stored force has


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberPrediction:
    """Predicted force of one member [kN], or [kN/m] of a wall.

    Attributes
    ----------
    member : str
        Its key.
    low, middle, high : float
        Not reached in 5, in 50 and in 95 of 100 cases.
    """

    member: str
    low: float
    middle: float
    high: float


@dataclass(frozen=True, slots=True, kw_only=True)
class StructurePrediction:
    """Predictions of one structure; ``solved`` and ``failed`` count its cases."""

    id: str
    title: str
    solved: int
    failed: int
    members: tuple[MemberPrediction, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Prediction:
    """Content of a stored prediction.

    Attributes
    ----------
    schema, version, made : str
        Form of the file, of the program, and the time in UTC.
    inputs_sha256 : str
        Of all inputs of the form.
    structures : tuple of StructurePrediction
        In the form's order.
    """

    schema: str
    version: str
    made: str
    inputs_sha256: str
    structures: tuple[StructurePrediction, ...]

    @property
    def day(self) -> str:
        """Day on which it was made, in ISO form."""
        return self.made[:10]

    @property
    def digest(self) -> str:
        """SHA-256 of all of it, which the owner keeps."""
        return _hash(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class Sealed:
    """A prediction and its digest, as the file has both."""

    prediction: Prediction
    sha256: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Hit:
    """One measured force beside what was predicted for one member.

    Attributes
    ----------
    structure : str
        Title.
    measured : Measurement
        With its value.
    predicted : MemberPrediction
        As stored.
    """

    structure: str
    measured: Measurement
    predicted: MemberPrediction

    @property
    def is_inside(self) -> bool:
        """The force lies in the band, with its own uncertainty."""
        value, uncertainty = self.measured.value, self.measured.uncertainty
        return (
            self.predicted.low <= value + uncertainty
            and value - uncertainty <= self.predicted.high
        )

    @property
    def ratio(self) -> float | None:
        """Measured over the middle of the prediction [-]; None where that is 0."""
        middle = self.predicted.middle
        return self.measured.value / middle if middle else None


def predict(structures: Sequence[Structure], made: str) -> Prediction:
    """Bands of every member's force over the ranges of the inputs.

    Parameters
    ----------
    structures : sequence of Structure
        Of a form, without measured forces.
    made : str
        Time in UTC.

    Raises
    ------
    ModelError
        If a force is given already, or no case of a structure has a result.
    """
    if any(is_measured(force) for one in structures for force in one.measured):
        raise ModelError(say("prediction.too_late"))
    return Prediction(
        schema=SCHEMA,
        version=__version__,
        made=made,
        inputs_sha256=hash_inputs(structures),
        structures=tuple(_predict(one) for one in structures),
    )


def _predict(structure: Structure) -> StructurePrediction:
    good, _, failed = solve_cases(structure, SAMPLES)
    # a member that no case loads is none of this structure, unless it is asked for
    names = dict.fromkeys(
        name for case in good for name, force in case.values.items() if force
    )
    wanted = dict.fromkeys(name for one in structure.measured for name in one.members)
    unknown = sorted(wanted.keys() - good[0].values.keys())
    if unknown:
        raise ModelError(say("measured.no_member", member=unknown[0][:200]))
    return StructurePrediction(
        id=structure.id,
        title=structure.title,
        solved=len(good),
        failed=failed,
        members=tuple(_find_band(name, good) for name in names | wanted),
    )


def _find_band(member: str, cases: Sequence[CaseForces]) -> MemberPrediction:
    found = [case.values[member] for case in cases if member in case.values]
    shares = np.percentile(found, _BAND)
    low, middle, high = (float(f"{one:.{_FIGURES}g}") for one in shares)
    return MemberPrediction(member=member, low=low, middle=middle, high=high)


def hash_inputs(structures: Sequence[Structure]) -> str:
    """SHA-256 of what a prediction rests on: inputs, and which forces are asked for."""
    return _hash(
        [
            {
                "id": one.id,
                "kind": one.kind,
                "inputs": {
                    name: [span.low, span.high]
                    for name, span in sorted(one.inputs.items())
                },
                "forces": [[force.name, *force.members] for force in one.measured],
            }
            for one in structures
        ]
    )


def _hash(value: object) -> str:
    return hashlib.sha256(write_part(value).values.encode()).hexdigest()


def seal(prediction: Prediction) -> bytes:
    """File of a prediction, with its digest."""
    return write_json(Sealed(prediction=prediction, sha256=prediction.digest)).encode()


def open_sealed(text: str) -> Prediction:
    """Prediction of a file that `seal` wrote.

    Raises
    ------
    ModelError
        If it is no such file, or was altered.
    """
    try:
        sealed: Sealed = read_json(Sealed, text)
    except ValueError as error:
        raise ModelError(say("prediction.no_file", reason=explain(error))) from None
    if sealed.prediction.schema != SCHEMA or sealed.sha256 != sealed.prediction.digest:
        raise ModelError(say("prediction.altered"))
    return sealed.prediction


def compare(structures: Sequence[Structure], prediction: Prediction) -> list[Hit]:
    """Measured forces of a form beside a prediction, one for each member.

    Raises
    ------
    ModelError
        If the form's inputs are not those of the prediction, or no force is measured.
    """
    if hash_inputs(structures) != prediction.inputs_sha256:
        raise ModelError(say("prediction.other_inputs", made=prediction.day))
    hits = list(_find_hits(structures, prediction))
    if not hits:
        raise ModelError(say("prediction.nothing_measured", made=prediction.day))
    return hits


def _find_hits(
    structures: Sequence[Structure], prediction: Prediction
) -> Iterator[Hit]:
    for structure, predicted in zip(structures, prediction.structures, strict=True):
        bands = {one.member: one for one in predicted.members}
        for measured in filter(is_measured, structure.measured):
            for member in measured.members:
                yield Hit(
                    structure=structure.title,
                    measured=measured,
                    predicted=bands[member],
                )


def write_hits(hits: Sequence[Hit], prediction: Prediction) -> dict[str, Any]:
    """Plain values of a comparison, in the form ``netdesign.comparison/1``."""
    return {
        "schema": "netdesign.comparison/1",
        "made": prediction.made,
        "sha256": prediction.digest,
        "forces": [
            {
                "structure": one.structure,
                "name": one.measured.name,
                "measured": one.measured.value,
                "uncertainty": one.measured.uncertainty,
                "predicted": asdict(one.predicted),
                "is_inside": one.is_inside,
                "ratio": one.ratio,
            }
            for one in hits
        ],
    }


def is_measured(force: Measurement) -> bool:
    """The form has a value for it."""
    return not math.isnan(force.value)
