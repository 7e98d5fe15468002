"""Settling of snow: layers, masses and densities from daily snow heights."""
