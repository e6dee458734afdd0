"""Generators whose points have power cells of equal area on the torus."""
