"""Sliced optimal transport: points moved along random directions until projections are evenly spread."""
