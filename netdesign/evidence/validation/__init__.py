"""Measured structures against the model, its export for other codes, and one page."""
