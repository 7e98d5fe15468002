"""Calculations from named quantities: computed, shown, stored and worked out again."""
