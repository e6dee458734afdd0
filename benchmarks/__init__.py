"""Benchmarks of speed and exactness beside rivals; the results that are kept stay in the checkout."""
