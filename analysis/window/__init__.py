"""Estimates for points seen in a window that is no torus: a rectangle, or a box of any dimension."""
