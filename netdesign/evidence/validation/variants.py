"""Examined: two measured forces that lie below nearly all cases of the model.

Each is solved again with one thing changed that nobody has written down. What brings
the measured force into the middle of the band may explain it, if it leaves the other
forces of the structure there.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

from netdesign.evidence.validation.structure import (
    Comparison,
    Measurement,
    Span,
    Structure,
    validate_structure,
)

Changes = Mapping[str, tuple[float, float]]  # inputs with other ranges
AS_GIVEN = "as_given"
_OF_ONE_SUPPORT = ("edge_support",)  # of all posts it holds for the last alone

# Structure, member of the model, and what is changed, by the names of the file.
_EXAMINED: Mapping[tuple[str, str], Mapping[str, Changes]] = MappingProxyType(
    {
        ("trumer-2007", "panel_upper_tension"): {
            AS_GIVEN: {},
            "half_full": {"filled": (0.3, 0.5)},
            "much_sag": {"rope_sag": (0.08, 0.15)},
            "half_full_much_sag": {"filled": (0.3, 0.5), "rope_sag": (0.08, 0.15)},
        },
        ("siglufjordur-2006", "post"): {
            AS_GIVEN: {},
            "half_full": {"filled": (0.4, 0.6)},
            "much_slack": {"slack": (0.08, 0.15)},
            # the last post of a row carries half a bay
            "edge_support": {"post_spacing_m": (1.5, 2.0)},
        },
    }
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Variant:
    """One measured force beside the model's with something changed.

    Attributes
    ----------
    structure : Structure
        With its changed inputs.
    name : str
        What is changed.
    comparison : Comparison
        Measured force and band.
    others : tuple of Comparison
        Other measured forces of the structure, under the same change; none of a change
        that holds for one support alone.
    """

    structure: Structure
    name: str
    comparison: Comparison
    others: tuple[Comparison, ...]

    @property
    def explains(self) -> bool:
        """The measured force lies where four of five cases do, and the others too."""
        return all(one.is_in_the_middle for one in (self.comparison, *self.others))


def examine(structures: Sequence[Structure]) -> list[Variant]:
    """Variants of the two forces, of the structures that are among these.

    Raises
    ------
    ModelError
        If no case of one has a result.
    """
    found = []
    for structure in structures:
        for (name, member), variants in _EXAMINED.items():
            if structure.id != name:
                continue
            measured = _find_measured(structure, member)
            found += [
                _solve(structure, measured, one, changes)
                for one, changes in variants.items()
            ]
    return found


def _find_measured(structure: Structure, member: str) -> Measurement:
    (measured,) = (one for one in structure.measured if member in one.members)
    return replace(measured, members=(member,))


def _solve(
    structure: Structure, measured: Measurement, name: str, changes: Changes
) -> Variant:
    spans = {
        key: Span(low=low, high=high, mark="assumed")
        for key, (low, high) in changes.items()
    }
    others = [one for one in structure.measured if one.name != measured.name]
    changed = replace(
        structure,
        measured=(measured, *others),
        inputs={**structure.inputs, **spans},
    )
    comparison, *further = validate_structure(changed).comparisons
    return Variant(
        structure=changed,
        name=name,
        comparison=comparison,
        others=() if name in _OF_ONE_SUPPORT else tuple(further),
    )
