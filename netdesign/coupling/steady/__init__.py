"""Steady state of creeping snow and a net at rest."""
