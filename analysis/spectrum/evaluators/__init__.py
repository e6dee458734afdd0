"""Evaluators of power: one module a way to compute it, each with its cost and stated error."""
