"""Gaussian blue noise for a density: kernels as wide as the density wants them, and what attracts them."""
