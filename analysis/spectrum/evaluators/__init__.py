"""Evaluators of power, each of which is one way to compute it, with its cost and its errors."""
