"""Adaptive Gaussian blue noise: points whose density follows an image or any other density."""
