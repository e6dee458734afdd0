"""Stipplers side by side: sets of points for one density, how well they follow it, local spectra."""
