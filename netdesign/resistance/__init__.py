"""Characteristic resistances from dimensions: pure functions and their data."""
