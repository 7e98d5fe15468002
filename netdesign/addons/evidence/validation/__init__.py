"""Measured structures against the model, on one page."""
