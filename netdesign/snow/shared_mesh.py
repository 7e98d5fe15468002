"""Templates of like aspects: one triangulation, its columns stretched.

A search for a limit moves the aspect in small steps. What hangs on the numbers of nodes
and on their heights alone, above all the order of elimination, is then found once.
Theory: snow/THEORY.md, section 3.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable
from dataclasses import replace
from functools import lru_cache, wraps
from typing import Concatenate, ParamSpec, TypeVar, cast

import numpy as np

from netdesign.numerics.arrays import freeze
from netdesign.snow.mesh import (
    BESIDE,
    MeshSize,
    MeshTemplate,
    build_template,
    require_aspect,
)

# Preferred numbers of ISO 3, twenty to a decade: steps of an eighth at most.
_PREFERRED = (
    *(1.0, 1.12, 1.25, 1.4, 1.6, 1.8, 2.0, 2.24, 2.5, 2.8),
    *(3.15, 3.55, 4.0, 4.5, 5.0, 5.6, 6.3, 7.1, 8.0, 9.0, 10.0),
)
_SHORTEST = 1.5  # snowpacks that are shorter have too few columns to stretch

Given = ParamSpec("Given")
Found = TypeVar("Found")


@lru_cache(maxsize=256)
def share_template(
    aspect: float, size: MeshSize, interfaces: tuple[float, ...] = ()
) -> MeshTemplate:
    """Reference mesh of a snowpack, which all of about its aspect have.

    Parameters
    ----------
    aspect : float
        Upslope length over thickness [-].
    size : MeshSize
        Resolution.
    interfaces : tuple of float
        Heights between layers over the thickness, ascending [-].

    Raises
    ------
    ModelError
        If the aspect is out of its range.
    """
    require_aspect(aspect)
    near = find_preferred(aspect) if aspect > _SHORTEST else aspect
    template = build_template(near, size, interfaces)
    return template if near == aspect else stretch_template(template, aspect)


def find_preferred(value: float) -> float:
    """Preferred number next to a value, by their ratio.

    Parameters
    ----------
    value : float
        Positive [-].
    """
    decade = 10.0 ** math.floor(math.log10(value))
    return min(
        (round(one * decade, 12) for one in _PREFERRED),
        key=lambda one: abs(math.log(one / value)),
    )


def stretch_template(template: MeshTemplate, aspect: float) -> MeshTemplate:
    """Template with its columns moved apart, or together; the rings stay.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.
    aspect : float
        Wanted upslope length over thickness [-].
    """
    ratio = (aspect - BESIDE) / (template.aspect - BESIDE)
    nodes = template.nodes.copy()
    beyond = np.maximum(nodes[0] - BESIDE, 0.0)
    nodes[0] += (ratio - 1.0) * beyond
    nodes[0, template.upstream] = aspect
    start, end = template.edges
    nodes[0, template.n_vertices :] = (nodes[0, start] + nodes[0, end]) / 2.0
    return replace(template, nodes=freeze(nodes), aspect=aspect, source=template.origin)


def find_once(
    find: Callable[Concatenate[MeshTemplate, Given], Found],
) -> Callable[Concatenate[MeshTemplate, Given], Found]:
    """Function of a template's numbers and heights, asked once for all that share them.

    Parameters
    ----------
    find : callable
        Of a template, and of what else can be a key.
    """
    known = lru_cache(maxsize=256)(find)

    @wraps(known)
    def find_of_origin(
        template: MeshTemplate, *given: Hashable, **named: Hashable
    ) -> Found:
        return known(template.origin, *given, **named)

    return cast("Callable[Concatenate[MeshTemplate, Given], Found]", find_of_origin)
