"""Series of daily snow heights: gaps, winters; densities of a model code."""
