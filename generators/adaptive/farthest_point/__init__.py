"""Farthest-point optimisation for a density."""
