"""Dithering, as a reference: points at the centres of pixels that a halftone turns black."""
