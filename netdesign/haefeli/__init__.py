"""Creep and glide pressure in closed form, after Haefeli: a second opinion."""
