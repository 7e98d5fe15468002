"""The manufactured solution is one: its residual is zero, symbolically."""

import numpy as np
import pytest
import sympy

from netdesign.addons.evidence.verification import exact_solutions as manufactured
from netdesign.addons.evidence.verification.exact_solutions import (
    BULK_RATIO,
    exact_body_force,
    exact_pressure,
    exact_strain,
    exact_velocity,
    linear_stress,
    list_manufactured,
    strain_slopes,
)

X, Y = sympy.symbols("x y", real=True)


def is_zero(expression):
    return sympy.simplify(sympy.together(expression)) == 0


def test_strain_rate_is_that_of_the_velocity():
    u, v = exact_velocity(X, Y)
    xx, yy, xy = exact_strain(X, Y)
    assert is_zero(xx - sympy.diff(u, X))
    assert is_zero(yy - sympy.diff(v, Y))
    assert is_zero(xy - sympy.diff(u, Y) - sympy.diff(v, X))


def test_slopes_are_those_of_the_strain_rate():
    for axis, slopes in zip((X, Y), strain_slopes(X, Y), strict=True):
        for part, slope in zip(exact_strain(X, Y), slopes, strict=True):
            assert is_zero(slope - sympy.diff(part, axis))


def exact_stress(x, y):
    """Stress of the velocity; its common factor, the viscosity, after it."""
    strain = exact_strain(x, y)
    shape = linear_stress(strain)
    size = sum(a * b for a, b in zip(strain, shape, strict=True))
    viscosity = size ** sympy.Rational(-1, 3)
    return tuple(part * viscosity for part in shape), viscosity


def test_residual_of_the_exact_solution_is_zero():
    (xx, yy, xy), viscosity = exact_stress(X, Y)
    force_x, force_y = exact_body_force(X, Y)
    # the viscosity is divided out: what is left is rational
    for residual in (
        sympy.diff(xx, X) + sympy.diff(xy, Y) + force_x,
        sympy.diff(xy, X) + sympy.diff(yy, Y) + force_y,
    ):
        assert is_zero(sympy.powsimp(sympy.expand(residual / viscosity)))


def test_pressure_is_that_of_the_stress():
    """P = -(s_xx + s_yy + s_zz) / 3, with s_zz of plane strain from the full law."""
    (xx, yy, _), viscosity = exact_stress(X, Y)
    strain = exact_strain(X, Y)
    trace = strain[0] + strain[1]
    zz = viscosity * (2 * (-trace / 3) + BULK_RATIO * trace)
    residual = exact_pressure(X, Y) + (xx + yy + zz) / 3
    assert is_zero(residual / viscosity)


@pytest.mark.parametrize("spoilt", ["exact_body_force", "exact_velocity"])
def test_spoilt_solution_fails(monkeypatch, spoilt):
    original = getattr(manufactured, spoilt)
    monkeypatch.setattr(
        manufactured,
        spoilt,
        lambda x, y: tuple(1.001 * np.asarray(part) for part in original(x, y)),
    )
    assert not all(case.passes for case in list_manufactured())
