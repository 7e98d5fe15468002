"""Snowpack of a station from its daily snow heights: layers, masses, densities."""
