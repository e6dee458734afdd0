"""Measures of a spectrum by radius: radial power, anisotropy, scalars of the profile, PSA's statistics."""
