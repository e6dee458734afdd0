"""Stippling: the darkness of an image as a density of points, their amplitudes and order, and inks."""
